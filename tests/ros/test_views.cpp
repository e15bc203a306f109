/** C views against the generated messages: the same bytes, the same type; and back. */
#include <gtest/gtest.h>

#include <vector>

#include "received.hpp"

namespace
{
const std::vector<double> numbers = {1.5, -2.25, 3e300, 4e-300, 5, 6};
const hdr_header header = {{1234567890, 987654321}, "box", 7};

template <class Message> void fill_header(Message &message)
{
    message.header.seq = header.seq;
    message.header.stamp = ros::Time(header.stamp.sec, header.stamp.nsec);
    message.header.frame_id = header.frame_id;
}

hdr_doubles every(uint32_t stride, uint32_t from = 0)
{
    const auto count = static_cast<uint32_t>((numbers.size() - from + stride - 1) / stride);
    return {numbers.data() + from, count, stride};
}

std::vector<double> copy(const hdr_doubles &array)
{
    std::vector<double> copied;
    for (uint32_t k = 0; k < array.count; k++) copied.push_back(array.data[k * array.stride]);
    return copied;
}

template <class View, class Message> void expect_same(const View &view, const Message &message)
{
    namespace traits = ros::message_traits;
    const ros::SerializedMessage got = ros::serialization::serializeMessage(view);
    const ros::SerializedMessage want = ros::serialization::serializeMessage(message);
    ASSERT_EQ(want.num_bytes, got.num_bytes);
    EXPECT_EQ(0, std::memcmp(want.buf.get(), got.buf.get(), want.num_bytes));
    EXPECT_STREQ(traits::md5sum<Message>(), traits::md5sum(view));
    EXPECT_STREQ(traits::datatype<Message>(), traits::datatype(view));
    EXPECT_STREQ(traits::definition<Message>(), traits::definition(view));
}

/** A view as the message, and the message as a view that is the message again. */
template <class View, class Message> void expect_both_ways(const View &view, const Message &message)
{
    namespace traits = ros::message_traits;
    using received = hdlyap_ros::received<View>;
    expect_same(view, message);
    received got;
    ros::serialization::deserializeMessage(ros::serialization::serializeMessage(message), got);
    ASSERT_EQ(1u, got.views.size());
    expect_same(got.views[0], message);
    EXPECT_STREQ(traits::md5sum<Message>(), traits::md5sum<received>());
    EXPECT_STREQ(traits::datatype<Message>(), traits::datatype<received>());
    EXPECT_EQ(traits::hasHeader<Message>(), traits::hasHeader<received>());
}
} // namespace

TEST(views, run_info)
{
    const char *const observables[] = {"spectrum", "state"}, *const awaited[] = {"cost"};
    const uint32_t nodes[] = {1, 0, 4294967295};
    /* clang-format off: one number a line otherwise */
    const hdr_run_info view = {header,
                               "id",
                               "0.1.0",
                               "scene",
                               780,
                               0.8,
                               0.867,
                               33.5,
                               29.1,
                               "periodic",
                               "reflecting",
                               "18446744073709551615",
                               "all",
                               3120,
                               6,
                               1,
                               2,
                               3,
                               4,
                               5,
                               6,
                               7,
                               {observables, 2},
                               0.25,
                               9,
                               {nodes, 3},
                               {nodes + 1, 2},
                               10,
                               11,
                               13,
                               14,
                               "file",
                               "folder",
                               "[1, 5]",
                               2.5,
                               {awaited, 1},
                               8.5,
                               2.5,
                               60,
                               "file",
                               60,
                               "before",
                               12.5,
                               2,
                               1,
                               "blas",
                               "kernel",
                               "openmp"};
    /* clang-format on */
    hdlyap::RunInfo message;
    fill_header(message);
    message.run_id = "id";
    message.version = "0.1.0";
    message.scene = "scene";
    message.disks = 780;
    message.density = 0.8;
    message.aspect = 0.867;
    message.box_x = 33.5;
    message.box_y = 29.1;
    message.boundary_x = "periodic";
    message.boundary_y = "reflecting";
    message.seed = "18446744073709551615";
    message.exponents = "all";
    message.vectors = 3120;
    message.zero_exponents = 6;
    message.equilibration = 1;
    message.warmup = 2;
    message.duration = 3;
    message.target_std_error = 4;
    message.interval = 5;
    message.accuracy = 6;
    message.report_interval = 7;
    message.observables = {"spectrum", "state"};
    message.max_wave_number = 0.25;
    message.max_mode_number = 9;
    message.wave_nx = {1, 0, 4294967295};
    message.wave_ny = {0, 4294967295};
    message.covariant_window = 10;
    message.covariant_transient = 11;
    message.covariant_sampling = 13;
    message.covariant_memory = 14;
    message.covariant_storage = "recompute";
    message.field_indices = "[1, 5]";
    message.field_interval = 2.5;
    message.wait_for_subscribers = {"cost"};
    message.pace = 8.5;
    message.slow_vectors_rate = 2.5;
    message.slow_vectors_count = 60;
    message.checkpoint = "file";
    message.checkpoint_interval = 60;
    message.resume = "before";
    message.resumed_time = 12.5;
    message.threads = 2;
    message.blas_threads = 1;
    message.blas_library = "blas";
    message.blas_kernel = "kernel";
    message.blas_threading = "openmp";
    expect_both_ways(view, message);
}

TEST(views, spectrum)
{
    const hdr_spectrum view = {header, "id", 1.5,      2.5,      3,        4.5,      5.5,
                               -1,     7,    every(1), every(2), every(3), every(1), every(2, 1)};
    hdlyap::Spectrum message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.averaged_time = 2.5;
    message.collisions = 3;
    message.lambda_max = 4.5;
    message.ks_entropy = 5.5;
    message.pairing_error = -1;
    message.first_index = 7;
    message.exponents = copy(every(1));
    message.std_errors = copy(every(2));
    message.local_exponents = copy(every(3));
    message.cos_theta = copy(every(1));
    message.dp_dq_ratio = copy(every(2, 1));
    expect_both_ways(view, message);
}

TEST(views, modes)
{
    const hdr_mode modes[] = {{1, 1.5, HDR_MODE_NONE, 0, 0, 0, 0, 0, 0, 0, 2, 3, 4, -1},
                              {2, -1.5, HDR_MODE_LP, 1, 2, 3, 4, 5, 6, 6.5, 7, 8, 9, 10}};
    hdlyap::Modes message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.averaged_time = 2.5;
    message.samples = 3;
    message.modes.resize(2);
    message.modes[0].index = 1;
    message.modes[0].exponent = 1.5;
    message.modes[0].null_x = 2;
    message.modes[0].null_y = 3;
    message.modes[0].null_p = 4;
    message.modes[0].step = -1;
    hdlyap::Mode &lp = message.modes[1];
    lp.index = 2;
    lp.exponent = -1.5;
    lp.kind = hdlyap::Mode::LP;
    lp.nx = 1;
    lp.ny = 2;
    lp.wave_number = 3;
    lp.weight = 4;
    lp.weight_l = 5;
    lp.weight_p = 6;
    lp.weight_now = 6.5;
    lp.null_x = 7;
    lp.null_y = 8;
    lp.null_p = 9;
    lp.step = 10;
    expect_both_ways(hdr_modes{header, "id", 1.5, 2.5, 3, modes, 2}, message);
    message.modes.clear();
    expect_both_ways(hdr_modes{header, "id", 1.5, 2.5, 3, nullptr, 0}, message);
}

TEST(views, steps)
{
    const hdr_step step = {HDR_MODE_T, 1, 2, 3.5, true, false, 4, 5, 6, 7.5, -1, 8, 9.5, 10.5};
    hdlyap::Steps message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.averaged_time = 2.5;
    message.threshold = 0.5;
    message.steps.resize(1);
    hdlyap::Step &want = message.steps[0];
    want.kind = hdlyap::Step::T;
    want.nx = 1;
    want.ny = 2;
    want.wave_number = 3.5;
    want.conjugate = true;
    want.resolved = false;
    want.expected = 4;
    want.first_index = 5;
    want.last_index = 6;
    want.multiplicity = 7.5;
    want.set = -1;
    want.members = 8;
    want.exponent = 9.5;
    want.std_error = 10.5;
    message.t_points = 1;
    message.c_t = 2;
    message.c_t_error = 3;
    message.c_t2 = 4;
    message.c_t2_error = 5;
    message.l_points = 6;
    message.c_l = 7;
    message.c_l_error = 8;
    message.c_l2 = 9;
    message.c_l2_error = 10;
    message.v_phases = 11;
    message.v = 12;
    message.v_error = 13;
    const hdr_fit t = {1, 2, 3, 4, 5}, l = {6, 7, 8, 9, 10};
    expect_both_ways(hdr_steps{header, "id", 1.5, 2.5, 0.5, &step, 1, t, l, 11, 12, 13}, message);
    message.steps.clear();
    expect_both_ways(hdr_steps{header, "id", 1.5, 2.5, 0.5, nullptr, 0, t, l, 11, 12, 13}, message);
}

TEST(views, lp_phases)
{
    const hdr_lp_phase phase = {1, 2, 3, 3, 4, HDR_LP_COARSE, 5, 6, 7, 8, 9, 10, 11};
    hdlyap::LpPhases message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.samples_per_report = 2;
    message.phases.resize(1);
    hdlyap::LpPhase &want = message.phases[0];
    want.step = 1;
    want.nx = 2;
    want.ny = 3;
    want.modulation = hdlyap::LpPhase::SIN_SIN;
    want.index = 4;
    want.state = hdlyap::LpPhase::COARSE;
    want.a = 5;
    want.b = 6;
    want.phase = 7;
    want.omega = 8;
    want.omega_error = 9;
    want.velocity = 10;
    want.tracked_time = 11;
    expect_both_ways(hdr_lp_phases{header, "id", 1.5, 2, &phase, 1}, message);
    message.phases.clear();
    expect_both_ways(hdr_lp_phases{header, "id", 1.5, 2, nullptr, 0}, message);
}

TEST(views, mode_field)
{
    const uint8_t modulation[] = {0, 3};
    const hdr_doubles one = every(1), even = every(2), odd = every(2, 1), third = every(3);
    const hdr_mode_field view = {
        header, "id",  1.5, 2, HDR_MODE_LP,     3,    4,   5.5, 6.5,  even, odd,   even, odd, one,
        odd,    third, one, 2, {modulation, 2}, even, odd, 7.5, even, odd,  third, one,  odd, even};
    hdlyap::ModeField message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.index = 2;
    message.kind = hdlyap::Mode::LP;
    message.nx = 3;
    message.ny = 4;
    message.wave_number = 5.5;
    message.exponent = 6.5;
    message.x = message.px = copy(even);
    message.y = message.py = copy(odd);
    message.dqx = message.dpy = copy(one);
    message.dqy = copy(odd);
    message.dpx = copy(third);
    message.pairs = 2;
    message.modulation = {0, 3};
    message.residual_l = copy(even);
    message.residual_p = copy(odd);
    message.rotation_distance = 7.5;
    message.l_x = message.p_over_py = copy(even);
    message.l_y = message.p_over_px = copy(odd);
    message.p_x = copy(third);
    message.p_y = copy(one);
    expect_both_ways(view, message);
}

TEST(views, mode_field_without_pairs)
{
    hdr_mode_field view = {};
    view.header = header;
    view.run_id = "id";
    view.x = every(2);
    hdlyap::ModeField message;
    fill_header(message);
    message.run_id = "id";
    message.x = copy(view.x);
    expect_both_ways(view, message);
}

TEST(views, hydro)
{
    const hdr_hydro_mode response = {1, 2, HDR_MODE_T, 3, 4, 2, 5, 6, 7, 8};
    hdlyap::Hydro message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.responses.resize(1);
    hdlyap::HydroMode &want = message.responses[0];
    want.step = 1;
    want.index = 2;
    want.kind = hdlyap::Mode::T;
    want.nx = 3;
    want.ny = 4;
    want.modulation = hdlyap::LpPhase::COS_SIN;
    want.density = 5;
    want.along = 6;
    want.across = 7;
    want.energy = 8;
    expect_both_ways(hdr_hydro{header, "id", 1.5, &response, 1}, message);
    message.responses.clear();
    expect_both_ways(hdr_hydro{header, "id", 1.5, nullptr, 0}, message);
}

TEST(views, covariant)
{
    const std::vector<uint64_t> bins = {1, 18446744073709551615u, 3};
    const hdr_counts some = {bins.data(), 2}, all = {bins.data(), 3};
    const hdr_covariant_angle angle = {HDR_CENTRE_STABLE, 1, 2, 3, 4, 5, some, all};
    const hdr_covariant_weight weight = {HDR_MODE_LP, 1, 2, 3.5, 8, every(2), every(1), every(3)};
    hdr_covariant view = {header,      "id",        1.5,
                          2.5,         3,           4,
                          5,           6.5,         7,
                          every(1),    every(2),    every(3),
                          every(1, 1), every(1, 2), every(1, 3),
                          every(1, 4), every(2, 1), every(3, 1),
                          every(3, 2), 8.5,         9.5,
                          10.5,        11.5,        &angle,
                          1,           &weight,     1};
    hdlyap::Covariant message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.averaged_time = 2.5;
    message.windows = 3;
    message.lost_windows = 4;
    message.looks = 5;
    message.seconds = 6.5;
    message.first_index = 7;
    message.exponents = copy(every(1));
    message.std_errors = copy(every(2));
    message.local_exponents = copy(every(3));
    message.apart = copy(every(1, 1));
    message.neighbour_angles = copy(every(1, 2));
    message.least_neighbour_angles = copy(every(1, 3));
    message.violations = copy(every(1, 4));
    message.entangled = copy(every(2, 1));
    message.widths = copy(every(3, 1));
    message.cos_theta = copy(every(3, 2));
    message.centre_apart = 8.5;
    message.stable_apart = 9.5;
    message.null_angle = 10.5;
    message.largest_null_angle = 11.5;
    message.angles.resize(1);
    message.angles[0].spaces = hdlyap::CovariantAngle::CENTRE_STABLE;
    message.angles[0].last = 1;
    message.angles[0].mean = 2;
    message.angles[0].std_error = 3;
    message.angles[0].least = 4;
    message.angles[0].mean_of_all = 5;
    message.angles[0].smallest_counts = {bins[0], bins[1]};
    message.angles[0].all_counts = bins;
    message.weights.resize(1);
    message.weights[0].kind = hdlyap::Mode::LP;
    message.weights[0].nx = 1;
    message.weights[0].ny = 2;
    message.weights[0].wave_number = 3.5;
    message.weights[0].dimension = 8;
    message.weights[0].dq = copy(every(2));
    message.weights[0].dp = copy(every(1));
    message.weights[0].gram_schmidt = copy(every(3));
    expect_both_ways(view, message);
    view.angle_count = view.weight_count = 0;
    message.angles.clear();
    message.weights.clear();
    expect_both_ways(view, message);
}

TEST(views, state)
{
    const hdr_state view = {header, "", 1.5, 3, every(2, 0), every(2, 1), every(2, 0), every(2, 1)};
    hdlyap::State message;
    fill_header(message);
    message.sim_time = 1.5;
    message.kinetic_energy = 3;
    message.x = copy(view.x);
    message.y = copy(view.y);
    message.px = copy(view.px);
    message.py = copy(view.py);
    EXPECT_EQ((std::vector<double>{1.5, 3e300, 5}), message.x);
    EXPECT_EQ((std::vector<double>{-2.25, 4e-300, 6}), message.y);
    expect_both_ways(view, message);
}

TEST(views, slow_vectors)
{
    const uint8_t kind[] = {HDR_MODE_LP, HDR_MODE_T}, pairs[] = {4, 0};
    const uint32_t nodes[] = {1, 2, 3};
    const hdr_slow_vectors view = {
        header,         "id",       1.5,      every(2),    every(2, 1), every(3),
        every(3, 1),    1556,       2,        every(5),    {kind, 2},   {nodes, 2},
        {nodes + 1, 2}, {pairs, 2}, every(1), every(1, 1), every(1, 2), every(2)};
    hdlyap::SlowVectors message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.x = copy(view.x);
    message.y = copy(view.y);
    message.px = copy(view.px);
    message.py = copy(view.py);
    message.first_index = 1556;
    message.vectors = 2;
    message.exponents = copy(view.exponents);
    message.kind = {hdlyap::Mode::LP, hdlyap::Mode::T};
    message.nx = {1, 2};
    message.ny = {2, 3};
    message.pairs = {4, 0};
    message.a = copy(view.a);
    message.b = copy(view.b);
    message.dqx = copy(view.dqx);
    message.dqy = copy(view.dqy);
    expect_both_ways(view, message);
}

TEST(views, state_without_disks)
{
    const hdr_doubles none = {nullptr, 0, 2};
    const hdr_state view = {header, "id", 0, 0, none, none, none, none};
    hdlyap::State message;
    fill_header(message);
    message.run_id = "id";
    expect_both_ways(view, message);
}

TEST(views, cost)
{
    const hdr_cost view = {header, "id", 1.5, HDR_AVERAGING,  2,  3,  4,  5,  6,  16, 18,
                           7,      8,    9,   HDR_LIMIT_LOOK, 10, 11, 12, 13, 14, 17, 15,
                           0.25,   0.5,  -1};
    hdlyap::Cost message;
    fill_header(message);
    message.run_id = "id";
    message.sim_time = 1.5;
    message.phase = hdlyap::Cost::AVERAGING;
    message.wall_seconds = 2;
    message.events_seconds = 3;
    message.replay_seconds = 4;
    message.ortho_seconds = 5;
    message.spectrum_seconds = 6;
    message.modes_seconds = 16;
    message.covariant_seconds = 18;
    message.publish_seconds = 7;
    message.events_per_second = 8;
    message.interval = 9;
    message.interval_limit = hdlyap::Cost::LIMIT_LOOK;
    message.condition = 10;
    message.orthogonality_defect = 11;
    message.error_bound = 12;
    message.orthonormalisations = 13;
    message.second_passes = 14;
    message.looks = 17;
    message.repairs = 15;
    message.std_error = 0.25;
    message.progress = 0.5;
    message.remaining_seconds = -1;
    expect_both_ways(view, message);
}

TEST(views, diagnostic)
{
    const hdr_key_value values[] = {{"phase", "averaging"}, {"repairs", "0"}};
    const hdr_diagnostic view = {header, HDR_DIAGNOSTIC_WARN, "name", "message", "id", values, 2};
    diagnostic_msgs::DiagnosticArray message;
    fill_header(message);
    message.status.resize(1);
    message.status[0].level = diagnostic_msgs::DiagnosticStatus::WARN;
    message.status[0].name = "name";
    message.status[0].message = "message";
    message.status[0].hardware_id = "id";
    message.status[0].values.resize(2);
    message.status[0].values[0].key = "phase";
    message.status[0].values[0].value = "averaging";
    message.status[0].values[1].key = "repairs";
    message.status[0].values[1].value = "0";
    expect_both_ways(view, message);
}

TEST(views, float64)
{
    std_msgs::Float64 message;
    message.data = -1.5;
    expect_both_ways(hdr_float64{-1.5}, message);
}

TEST(views, string)
{
    std_msgs::String message;
    expect_both_ways(hdr_string{""}, message);
    message.data = "two words";
    expect_both_ways(hdr_string{"two words"}, message);
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
