/** Messages as they arrive, whole and damaged: what the views of them hold, what is refused. */
#include <gtest/gtest.h>

#include <cstdint>

#include "received.hpp"

namespace
{
using bytes = std::vector<uint8_t>;

template <class Message> bytes bytes_of(const Message &message)
{
    const ros::SerializedMessage whole = ros::serialization::serializeMessage(message);
    return bytes(whole.message_start, whole.buf.get() + whole.num_bytes);
}

template <class View> void read(hdlyap_ros::received<View> &out, bytes message)
{
    ros::serialization::IStream stream(message.data(), static_cast<uint32_t>(message.size()));
    ros::serialization::deserialize(stream, out);
} /* the bytes are gone: views point into what was kept */

template <class View> void expect_refused(const bytes &message)
{
    hdlyap_ros::received<View> out;
    EXPECT_THROW(read(out, message), std::exception);
}

/** With counts of everything that has one; the numbers lie at odd addresses. */
hdlyap::ModeField some_field()
{
    hdlyap::ModeField message;
    message.header.frame_id = "box";
    message.header.seq = 5;
    message.run_id = "odd";
    message.x = {1.5, 2.5, 3.5};
    message.modulation = {0, 3};
    message.p_over_py = {-4.5};
    return message;
}

diagnostic_msgs::DiagnosticArray diagnostics(size_t statuses)
{
    diagnostic_msgs::DiagnosticArray message;
    message.header.frame_id = "of all";
    message.status.resize(statuses);
    for (size_t k = 0; k < statuses; k++) {
        message.status[k].name = std::to_string(k);
        message.status[k].values.resize(k);
    }
    return message;
}
} // namespace

TEST(received, numbers_are_aligned_and_the_receivers_own)
{
    hdlyap_ros::received<hdr_mode_field> out;
    read(out, bytes_of(some_field()));
    const hdr_mode_field &view = out.views.at(0);
    EXPECT_EQ(5u, view.header.seq);
    EXPECT_STREQ("box", view.header.frame_id);
    EXPECT_STREQ("odd", view.run_id);
    ASSERT_EQ(3u, view.x.count);
    EXPECT_EQ(1u, view.x.stride);
    EXPECT_EQ(0u, reinterpret_cast<uintptr_t>(view.x.data) % alignof(double));
    EXPECT_EQ(3.5, view.x.data[2]);
    ASSERT_EQ(2u, view.modulation.count);
    EXPECT_EQ(3, view.modulation.data[1]);
    EXPECT_EQ(0u, view.l_x.count);
    ASSERT_EQ(1u, view.p_over_py.count);
    EXPECT_EQ(-4.5, view.p_over_py.data[0]);
}

TEST(received, lists)
{
    hdlyap::RunInfo message;
    message.observables = {"spectrum", "", "state"};
    message.wave_nx = {1, 4294967295};
    hdlyap_ros::received<hdr_run_info> out;
    read(out, bytes_of(message));
    const hdr_run_info &view = out.views.at(0);
    ASSERT_EQ(3u, view.observables.count);
    EXPECT_STREQ("spectrum", view.observables.data[0]);
    EXPECT_STREQ("", view.observables.data[1]);
    EXPECT_STREQ("state", view.observables.data[2]);
    ASSERT_EQ(2u, view.wave_nx.count);
    EXPECT_EQ(4294967295u, view.wave_nx.data[1]);
}

/** Of the array of many nodes each status is a view with the array's header. */
TEST(received, every_status_of_an_array)
{
    for (const size_t statuses : {0, 1, 3}) {
        hdlyap_ros::received<hdr_diagnostic> out;
        read(out, bytes_of(diagnostics(statuses)));
        ASSERT_EQ(statuses, out.views.size());
        for (size_t k = 0; k < statuses; k++) {
            EXPECT_STREQ("of all", out.views[k].header.frame_id);
            EXPECT_STREQ(std::to_string(k).c_str(), out.views[k].name);
            EXPECT_EQ(k, out.views[k].count);
        }
    }
}

TEST(received, true_is_one_and_any_other)
{
    hdlyap::Steps message;
    message.steps.resize(1);
    message.steps[0].resolved = 2;
    hdlyap_ros::received<hdr_steps> out;
    read(out, bytes_of(message));
    EXPECT_FALSE(out.views.at(0).steps[0].conjugate);
    EXPECT_TRUE(out.views.at(0).steps[0].resolved);
}

TEST(received, of_any_other_length_is_refused)
{
    bytes whole = bytes_of(some_field());
    for (size_t length = 0; length < whole.size(); length++)
        expect_refused<hdr_mode_field>(
            bytes(whole.begin(), whole.begin() + static_cast<long>(length)));
    whole.push_back(0);
    expect_refused<hdr_mode_field>(whole);
    bytes status = bytes_of(diagnostics(2));
    status.pop_back();
    expect_refused<hdr_diagnostic>(status);
}

/** Each count of four bytes in turn says the most that it can, and what times 8 is little in 32
 * bits. */
TEST(received, counts_that_lie_are_refused)
{
    const bytes whole = bytes_of(some_field());
    const size_t header_end = 4 + 8 + 4 + 3;
    for (const uint32_t lie : {0xffffffffu, 0x20000001u}) {
        for (const size_t at : {size_t(12), header_end, header_end + 4 + 3 + 8 + 4 + 1 + 8 + 16}) {
            bytes wrong = whole;
            std::memcpy(wrong.data() + at, &lie, sizeof lie);
            expect_refused<hdr_mode_field>(wrong);
        }
    }
    bytes steps = bytes_of(hdlyap::Steps());
    steps.at(4 + 8 + 4 + 4 + 24 + 3) = 0xff;
    expect_refused<hdr_steps>(steps);
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
