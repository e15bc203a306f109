/** Messages as they arrive, whole and damaged: what C has of them, what is refused. */
#include <gtest/gtest.h>

#include <cstdint>

#include "message_fields.hpp"
#include "wrapper/received.hpp"

namespace
{
using bytes = std::vector<uint8_t>;

template <class Message> bytes bytes_of(const Message &message)
{
    const ros::SerializedMessage whole = ros::serialization::serializeMessage(message);
    return bytes(whole.message_start, whole.buf.get() + whole.num_bytes);
}

template <class Message> void read(hdlyap_ros::received<Message> &out, bytes all)
{
    ros::serialization::IStream stream(all.data(), static_cast<uint32_t>(all.size()));
    ros::serialization::deserialize(stream, out);
} /* the bytes are gone: they point into what was kept */

template <class Message> void expect_refused(const bytes &message)
{
    hdlyap_ros::received<Message> out;
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
    const hdr_mode_field &got = out.messages.at(0);
    EXPECT_EQ(5u, got.header.seq);
    EXPECT_STREQ("box", got.header.frame_id);
    EXPECT_STREQ("odd", got.run_id);
    ASSERT_EQ(3u, got.x.count);
    EXPECT_EQ(1u, got.x.stride);
    EXPECT_EQ(0u, reinterpret_cast<uintptr_t>(got.x.data) % alignof(double));
    EXPECT_EQ(3.5, got.x.data[2]);
    ASSERT_EQ(2u, got.modulation.count);
    EXPECT_EQ(3, got.modulation.data[1]);
    EXPECT_EQ(0u, got.l_x.count);
    ASSERT_EQ(1u, got.p_over_py.count);
    EXPECT_EQ(-4.5, got.p_over_py.data[0]);
}

TEST(received, lists)
{
    hdlyap::RunInfo message;
    message.given = {"spectrum", "", "state"};
    message.wave_nx = {1, 4294967295};
    hdlyap_ros::received<hdr_run_info> out;
    read(out, bytes_of(message));
    const hdr_run_info &got = out.messages.at(0);
    ASSERT_EQ(3u, got.given.count);
    EXPECT_STREQ("spectrum", got.given.data[0]);
    EXPECT_STREQ("", got.given.data[1]);
    EXPECT_STREQ("state", got.given.data[2]);
    ASSERT_EQ(2u, got.wave_nx.count);
    EXPECT_EQ(4294967295u, got.wave_nx.data[1]);
}

/** Of the array of many nodes each status is a message with the array's header. */
TEST(received, every_status_of_an_array)
{
    for (const size_t statuses : {0, 1, 3}) {
        hdlyap_ros::received<hdr_diagnostic> out;
        read(out, bytes_of(diagnostics(statuses)));
        ASSERT_EQ(statuses, out.messages.size());
        for (size_t k = 0; k < statuses; k++) {
            EXPECT_STREQ("of all", out.messages[k].header.frame_id);
            EXPECT_STREQ(std::to_string(k).c_str(), out.messages[k].name);
            EXPECT_EQ(k, out.messages[k].values.count);
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
    EXPECT_FALSE(out.messages.at(0).steps.data[0].conjugate);
    EXPECT_TRUE(out.messages.at(0).steps.data[0].resolved);
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
        for (const size_t at : {size_t(12), header_end, header_end + 4 + 3 + 8 + 4 + 1 + 12 + 16}) {
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
