/** The fields of messages of other packages, as far as the C structs have them. */
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <visualization_msgs/MarkerArray.h>

#include "hdlyap_ros/markers.h"
#include "hdlyap_ros/standard_messages.h"
#include "serialise.hpp"

static_assert(int(HDR_DIAGNOSTIC_ERROR) == int(diagnostic_msgs::DiagnosticStatus::ERROR),
              "levels as in DiagnosticStatus.msg");
static_assert(int(HDR_MARKER_TEXT) == int(visualization_msgs::Marker::TEXT_VIEW_FACING) &&
                  int(HDR_MARKER_TRIANGLE_LIST) == int(visualization_msgs::Marker::TRIANGLE_LIST),
              "types as in Marker.msg");

namespace hdlyap_ros
{

template <> struct message_of<hdr_key_value> {
    using type = diagnostic_msgs::KeyValue;
    template <class Stream, class Message> static void fields(Stream &s, Message &m)
    {
        pass(s, m.key, m.value);
    }
};

template <> struct item_of<hdr_key_value_list> {
    using type = hdr_key_value;
};

template <> struct message_of<hdr_diagnostic> {
    using type = diagnostic_msgs::DiagnosticArray;
    template <class Stream> static void fields(Stream &s, const hdr_diagnostic &m)
    {
        const uint32_t statuses = 1;
        pass(s, m.header, statuses);
        status(s, m);
    }
    template <class Stream, class Message> static void status(Stream &s, Message &m)
    {
        pass(s, m.level, m.name, m.message, m.hardware_id, m.values);
    }
};

template <> struct message_of<hdr_float64> {
    using type = std_msgs::Float64;
    template <class Stream, class Message> static void fields(Stream &s, Message &m)
    {
        pass(s, m.data);
    }
};

template <> struct message_of<hdr_string> {
    using type = std_msgs::String;
    template <class Stream, class Message> static void fields(Stream &s, Message &m)
    {
        pass(s, m.data);
    }
};

/** Writes a struct of numbers of one type, which has the order of the message. */
template <class Stream, class Numbers> void put_block(Stream &stream, const Numbers &numbers)
{
    uint8_t *out = stream.advance(static_cast<uint32_t>(sizeof numbers));
    std::memcpy(out, &numbers, sizeof numbers);
}

template <class Numbers> void put_block(ros::serialization::LStream &stream, const Numbers &numbers)
{
    stream.advance(static_cast<uint32_t>(sizeof numbers));
}

template <class Stream, class Block>
void put_blocks(Stream &stream, const Block *blocks, uint32_t count)
{
    stream.next(count);
    for (uint32_t k = 0; k < count; k++) put_block(stream, blocks[k]);
}

template <> struct message_of<hdr_markers> {
    using type = visualization_msgs::MarkerArray;
    template <class Stream> static void fields(Stream &s, const hdr_markers &m)
    {
        s.next(m.count);
        for (uint32_t k = 0; k < m.count; k++) marker(s, m.frame_id, m.markers[k]);
    }

    /** Writes pose, scale, colour, life time, frame_locked, points, colours and text, without a
     * mesh. */
    template <class Stream> static void marker(Stream &s, const char *frame_id, const hdr_marker &m)
    {
        const uint32_t zero = 0;
        const double upright[] = {0.0, 0.0, 0.0, 1.0};
        pass(s, hdr_header{{0, 0}, frame_id, 0}, m.ns, m.id, m.type, m.action);
        put_block(s, m.position);
        put_block(s, upright);
        put_block(s, m.scale);
        put_block(s, m.colour);
        pass(s, zero, zero, false);
        put_blocks(s, m.points, m.count);
        put_blocks(s, m.colours, m.colours ? m.count : 0);
        pass(s, m.text, "", false);
    }
};

} // namespace hdlyap_ros
