/** C structs against roscpp's messages: the same bytes, the same type; out and in. */
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "message_fields.hpp"
#include "wrapper/received.hpp"

namespace
{
using hdlyap_ros::message_of;
using hdlyap_ros::received;
using hdlyap_ros::sent;
namespace traits = ros::message_traits;

/** A stream that roscpp's messages read from: numbers that are all distinct, arrays and strings of
 * distinct lengths. */
class distinct
{
  public:
    void next(ros::Time &time)
    {
        next(time.sec);
        next(time.nsec);
    }
    void next(std::string &text) { text = "text " + std::to_string(++last); }
    void next(double &number) { number = ++last + 0.25; }
    template <class Number> std::enable_if_t<std::is_integral<Number>::value> next(Number &number)
    {
        number = static_cast<Number>(++last);
    }
    template <class Item, class Allocator> void next(std::vector<Item, Allocator> &array)
    {
        array.resize(2 + ++length % 3);
        for (Item &item : array) next(item);
    }
    template <class Message> std::enable_if_t<traits::IsMessage<Message>::value> next(Message &part)
    {
        ros::serialization::Serializer<Message>::template allInOne<distinct &, Message &>(*this,
                                                                                          part);
    }

  private:
    int last = 0, length = 0;
};

/** All numbers are known, and go out as they are. Whatever is not 0 is true, and comes out as 1. */
void make_known(hdlyap::Steps &message)
{
    message.t_points = message.l_points = message.v_phases = 1;
    for (hdlyap::Step &step : message.steps) step.conjugate = !(step.resolved = 1);
}
void make_known(hdlyap::RunInfo &message)
{
    for (hdlyap::Parameter &one : message.parameters) one.as_before = one.own = 1;
}
void make_known(hdlyap::Modes &message)
{
    for (hdlyap::Mode &mode : message.modes) mode.kind = hdlyap::Mode::LP;
}
void make_known(hdlyap::ModeField &message) { message.kind = message.pairs = 1; }
void make_known(hdlyap::Cost &message) { message.orthonormalisations = 1; }
void make_known(hdlyap::RunStatus &message) { message.caged = 1; }
template <class Other> void make_known(Other &) {}

template <class Message> typename message_of<Message>::type filled()
{
    typename message_of<Message>::type message;
    distinct().next(message);
    make_known(message);
    return message;
}

template <class Message> typename message_of<Message>::type empty()
{
    typename message_of<Message>::type message;
    make_known(message);
    return message;
}

template <class Message, class Ros> void expect_same(const Message &message, const Ros &wanted)
{
    const sent<Message> out = {message};
    const ros::SerializedMessage got = ros::serialization::serializeMessage(out);
    const ros::SerializedMessage want = ros::serialization::serializeMessage(wanted);
    ASSERT_EQ(want.num_bytes, got.num_bytes);
    EXPECT_EQ(0, std::memcmp(want.buf.get(), got.buf.get(), want.num_bytes));
    EXPECT_STREQ(traits::md5sum<Ros>(), traits::md5sum(out));
    EXPECT_STREQ(traits::datatype<Ros>(), traits::datatype(out));
    EXPECT_STREQ(traits::definition<Ros>(), traits::definition(out));
}

/** In, and out again. */
template <class Message> void expect_both_ways(const typename message_of<Message>::type &wanted)
{
    using type = typename message_of<Message>::type;
    received<Message> in;
    ros::serialization::deserializeMessage(ros::serialization::serializeMessage(wanted), in);
    ASSERT_EQ(1u, in.messages.size());
    expect_same(in.messages[0], wanted);
    EXPECT_STREQ(traits::md5sum<type>(), traits::md5sum<received<Message>>());
    EXPECT_STREQ(traits::datatype<type>(), traits::datatype<received<Message>>());
    EXPECT_EQ(traits::hasHeader<type>(), traits::hasHeader<received<Message>>());
}

const double numbers[] = {1.5, -2.25, 3e300, 4e-300, 5, 6};
} // namespace

#define TEST_BOTH_WAYS(type)                                                                       \
    TEST(messages, type)                                                                           \
    {                                                                                              \
        expect_both_ways<type>(filled<type>());                                                    \
        expect_both_ways<type>(empty<type>());                                                     \
    }
HDR_MESSAGES(TEST_BOTH_WAYS)
TEST_BOTH_WAYS(hdr_float64)
TEST_BOTH_WAYS(hdr_string)

TEST(messages, hdr_diagnostic)
{
    diagnostic_msgs::DiagnosticArray message = filled<hdr_diagnostic>();
    message.status.resize(1);
    expect_both_ways<hdr_diagnostic>(message);
}

/** Names, which no bytes show: in all kinds of fields. */
TEST(messages, fields_by_name)
{
    const hdlyap::Steps want = filled<hdr_steps>();
    received<hdr_steps> in;
    ros::serialization::deserializeMessage(ros::serialization::serializeMessage(want), in);
    const hdr_steps &got = in.messages.at(0);
    EXPECT_EQ(want.header.stamp.nsec, got.header.stamp.nsec);
    EXPECT_EQ(want.header.seq, got.header.seq);
    EXPECT_EQ(want.run_id, got.run_id);
    EXPECT_EQ(want.averaged_time, got.averaged_time);
    EXPECT_EQ(want.c_t2, got.c_t2);
    EXPECT_EQ(want.l_points, got.l_points);
    ASSERT_EQ(want.steps.size(), got.steps.count);
    EXPECT_EQ(want.steps[1].kind, got.steps.data[1].kind);
    EXPECT_EQ(want.steps[1].set, got.steps.data[1].set);
    EXPECT_EQ(int(hdlyap::LpPhase::SIN_SIN), int(HDR_LP_PHASE_SIN_SIN));
    EXPECT_EQ(int(hdlyap::Mode::LP), int(HDR_MODE_LP));
}

/** As hdlyap.data.fields has them, which test_data.py looks at. */
TEST(messages, names_of_constants)
{
    EXPECT_STREQ(hdr_run_status_stage_text(HDR_RUN_STATUS_EQUILIBRATING), "equilibrating");
    EXPECT_STREQ(hdr_run_status_stage_text(HDR_RUN_STATUS_FINISHED), "finished");
    EXPECT_STREQ(hdr_run_status_stage_text(HDR_RUN_STATUS_FINISHED + 1), "unknown");
    EXPECT_STREQ(hdr_cost_interval_limit_text(HDR_COST_LIMIT_SCHEDULE), "report interval");
    EXPECT_STREQ(hdr_cost_interval_limit_text(HDR_COST_LIMIT_NONE), "none yet");
    EXPECT_STREQ(hdr_step_sharing_text(HDR_STEP_SHARING_COINCIDENT), "coincide");
    EXPECT_STREQ(hdr_step_kind_text(HDR_STEP_LP), "LP");
    EXPECT_STREQ(hdr_step_kind_text(0), "unknown"); /* what is alone in Mode */
    EXPECT_STREQ(hdr_mode_kind_text(0), "none");
    EXPECT_STREQ(hdr_lp_phase_modulation_text(HDR_LP_PHASE_SIN_COS), "A = sin(kx x) cos(ky y)");
}

TEST(messages, strides)
{
    hdr_state state = {};
    state.header.frame_id = state.run_id = "";
    state.x = {numbers, 3, 2};
    state.y = {numbers + 1, 3, 2};
    state.px = {numbers, 2, 3};
    state.py = {numbers, 6, 1};
    hdlyap::State message;
    message.x = {1.5, 3e300, 5};
    message.y = {-2.25, 4e-300, 6};
    message.px = {1.5, 4e-300};
    message.py.assign(numbers, numbers + 6);
    expect_same(state, message);
}

namespace
{
/** As it arrives. */
template <class Ros, class Message> Ros arrived(const Message &message)
{
    Ros in;
    const sent<Message> out = {message};
    ros::serialization::deserializeMessage(ros::serialization::serializeMessage(out), in);
    return in;
}

template <class Message> Message named()
{
    Message message = {};
    message.header.frame_id = message.run_id = "";
    return message;
}

/** Whether the message may go out with this number in that place. */
template <class Message> bool may_be(Message message, double Message::*place, double number)
{
    message.*place = number;
    return hdlyap_ros::is_finite(message);
}
} // namespace

/** By the rules in the comments of Step: what it holds does not go out while it is not known. */
TEST(messages, unknown)
{
    hdr_steps message = named<hdr_steps>();
    hdr_step step = {};
    step.multiplicity = step.exponent = step.gap = INFINITY;
    step.gap_error = step.omega = 7.0;
    message.steps = {&step, 1};
    message.c_t = 3.0;
    message.v_k_max = 3.0; /* by the comment of v_k_min, above it */
    message.v_error = 3.0;
    EXPECT_TRUE(hdlyap_ros::is_finite(message));
    const auto unknown = arrived<hdlyap::Steps>(message);
    EXPECT_TRUE(std::isnan(unknown.steps.at(0).multiplicity));
    EXPECT_TRUE(std::isnan(unknown.steps[0].gap));
    EXPECT_EQ(-1.0, unknown.steps[0].gap_error);
    EXPECT_EQ(7.0, unknown.steps[0].omega);
    EXPECT_TRUE(std::isnan(unknown.c_t));
    EXPECT_TRUE(std::isnan(unknown.v_k_max));
    EXPECT_EQ(-1.0, unknown.v_error);

    step.resolved = true;
    EXPECT_FALSE(hdlyap_ros::is_finite(message));
    step.multiplicity = step.exponent = 2.0;
    EXPECT_TRUE(hdlyap_ros::is_finite(message));
    step.sharing = HDR_STEP_SHARING_MIXING;
    EXPECT_FALSE(hdlyap_ros::is_finite(message));
    step.gap = 0.5;
    message.t_points = message.v_phases = 1;
    const auto known = arrived<hdlyap::Steps>(message);
    EXPECT_EQ(2.0, known.steps.at(0).multiplicity);
    EXPECT_EQ(0.5, known.steps[0].gap);
    EXPECT_EQ(7.0, known.steps[0].gap_error);
    EXPECT_EQ(3.0, known.c_t);
    EXPECT_EQ(3.0, known.v_error);
}

/** Arrays too. */
TEST(messages, unknown_arrays)
{
    hdr_spectrum message = named<hdr_spectrum>();
    const double local[] = {1.0, NAN, 2.0};
    message.local_exponents = {local, 3, 1};
    EXPECT_TRUE(hdlyap_ros::is_finite(message));
    const auto unknown = arrived<hdlyap::Spectrum>(message);
    ASSERT_EQ(3u, unknown.local_exponents.size());
    EXPECT_TRUE(std::isnan(unknown.local_exponents[0]));
    message.local_time = 1.0;
    EXPECT_FALSE(hdlyap_ros::is_finite(message));
    message.local_exponents.stride = 2;
    message.local_exponents.count = 2;
    EXPECT_TRUE(hdlyap_ros::is_finite(message));
    EXPECT_EQ(2.0, arrived<hdlyap::Spectrum>(message).local_exponents[1]);
    message.cos_theta = {local, 3, 1};
    EXPECT_TRUE(hdlyap_ros::is_finite(message)); /* may be NaN */
    const double far[] = {HUGE_VAL};
    message.cos_theta = {far, 1, 1};
    EXPECT_FALSE(hdlyap_ros::is_finite(message));
}

TEST(messages, finite)
{
    const hdr_cost cost = named<hdr_cost>();
    for (const double number : {double(NAN), HUGE_VAL, -HUGE_VAL}) {
        EXPECT_FALSE(may_be(cost, &hdr_cost::wall_seconds, number));
        EXPECT_TRUE(may_be(cost, &hdr_cost::condition, number)); /* of none yet, goes out as NaN */
        EXPECT_EQ(std::isnan(number), may_be(cost, &hdr_cost::events_per_second, number));
        EXPECT_FALSE(may_be(named<hdr_gas>(), &hdr_gas::pressure_error, number));
    }
    EXPECT_TRUE(may_be(named<hdr_gas>(), &hdr_gas::pressure_error, -1.0));
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
