/** C views against the generated messages: the same bytes, the same type. */
#include <gtest/gtest.h>

#include <vector>

#include "views.hpp"

namespace
{
const std::vector<double> numbers = {1.5, -2.25, 3e300, 4e-300, 5, 6};
const hdr_header header = {{1234567890, 987654321}, "box"};

template <class Message> void fill_header(Message &message)
{
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
} // namespace

TEST(views, run_info)
{
    const char *const observables[] = {"spectrum", "state"};
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
                               8.5,
                               2,
                               1,
                               "blas",
                               "kernel",
                               "openmp"};
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
    message.pace = 8.5;
    message.threads = 2;
    message.blas_threads = 1;
    message.blas_library = "blas";
    message.blas_kernel = "kernel";
    message.blas_threading = "openmp";
    expect_same(view, message);
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
    expect_same(view, message);
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
    expect_same(view, message);
}

TEST(views, state_without_disks)
{
    const hdr_doubles none = {nullptr, 0, 2};
    const hdr_state view = {header, "id", 0, 0, none, none, none, none};
    hdlyap::State message;
    fill_header(message);
    message.run_id = "id";
    expect_same(view, message);
}

TEST(views, cost)
{
    const hdr_cost view = {header, "id", 1.5, HDR_AVERAGING, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12,
                           13,     14,   15,  0.5,           -1};
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
    message.publish_seconds = 7;
    message.events_per_second = 8;
    message.interval = 9;
    message.condition = 10;
    message.orthogonality_defect = 11;
    message.error_bound = 12;
    message.orthonormalisations = 13;
    message.second_passes = 14;
    message.repairs = 15;
    message.progress = 0.5;
    message.remaining_seconds = -1;
    expect_same(view, message);
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
    expect_same(view, message);
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
