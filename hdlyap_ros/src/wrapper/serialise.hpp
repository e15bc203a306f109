/** C structs of messages -> bytes on the wire, by roscpp's traits. Type, md5 and definition come
 * from the generated messages; fields are written directly from the caller's buffers. received.hpp
 * reads by the same lists of fields. */
#pragma once

#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

#include <ros/serialization.h>
#include <std_msgs/Header.h>

#include "hdlyap_ros/fields.h"

namespace hdlyap_ros
{

/** Describes the struct of a message. `type` is roscpp's type; `fields` passes each field, in the
 * order of the message, to a stream that writes or reads it. */
template <class Message> struct message_of;

/** Describes an array of messages {data, count}: `type` is the struct of an element. */
template <class List> struct item_of;

template <class Number> using if_number = std::enable_if_t<std::is_arithmetic<Number>::value>;

template <class Stream, class Number, class = if_number<Number>>
void put(Stream &stream, Number value)
{
    stream.next(value);
}

template <class Stream> void put(Stream &stream, bool value) { stream.next(uint8_t(value)); }

template <class Stream> void put(Stream &stream, const char *text)
{
    stream.next(std::string(text));
}

template <class Stream> void put(Stream &stream, const hdr_strings &list)
{
    stream.next(list.count);
    for (uint32_t k = 0; k < list.count; k++) put(stream, list.data[k]);
}

inline void put(ros::serialization::LStream &stream, const hdr_doubles &array)
{
    stream.next(array.count);
    stream.advance(array.count * static_cast<uint32_t>(sizeof(double)));
}

inline void put(ros::serialization::OStream &stream, const hdr_doubles &array)
{
    stream.next(array.count);
    uint8_t *out = stream.advance(array.count * static_cast<uint32_t>(sizeof(double)));
    if (array.stride == 1 && array.count > 0)
        std::memcpy(out, array.data, array.count * sizeof(double));
    for (uint32_t k = 0; array.stride != 1 && k < array.count; k++)
        std::memcpy(out + k * sizeof(double), array.data + size_t(k) * array.stride,
                    sizeof(double));
}

template <class Stream, class Number>
void put_numbers(Stream &stream, const Number *data, uint32_t count)
{
    stream.next(count);
    for (uint32_t k = 0; k < count; k++) stream.next(data[k]);
}

template <class Stream> void put(Stream &stream, const hdr_uints &list)
{
    put_numbers(stream, list.data, list.count);
}

template <class Stream> void put(Stream &stream, const hdr_counts &list)
{
    put_numbers(stream, list.data, list.count);
}

template <class Stream> void put(Stream &stream, const hdr_bytes &list)
{
    put_numbers(stream, list.data, list.count);
}

/** A stream that writes nothing, but checks that the numbers are finite which have to be. */
struct finite_check {
    bool finite = true, nan_too = false;
    void next(double x) { finite = finite && (std::isfinite(x) || (nan_too && std::isnan(x))); }
    template <class Other> void next(const Other &) {}
};

inline void put(finite_check &check, const hdr_doubles &array)
{
    for (uint32_t k = 0; k < array.count; k++) check.next(array.data[size_t(k) * array.stride]);
}

/** A number, or an array of numbers, that may be NaN. When a message is read, or_nan returns the
 * field itself. */
template <class Field> struct nan_or {
    const Field &field;
};
template <class Field> nan_or<Field> or_nan(const Field &field) { return {field}; }
template <class Field> Field &or_nan(Field &field) { return field; }

template <class Stream, class Field> void put(Stream &stream, const nan_or<Field> &any)
{
    put(stream, any.field);
}

template <class Field> void put(finite_check &check, const nan_or<Field> &any)
{
    check.nan_too = true;
    put(check, any.field);
    check.nan_too = false;
}

/** A number, or an array of numbers, that may be unknown; then `unknown` is written instead. When a
 * message is read, known_if returns the field itself. */
template <class Field> struct if_known {
    bool known;
    const Field &field;
    double unknown;
};
template <class Field> if_known<Field> known_if(bool known, const Field &field, double unknown)
{
    return {known, field, unknown};
}
template <class Field> Field &known_if(bool, Field &field, double) { return field; }

inline double unknown_of(double, const double &unknown) { return unknown; }
inline hdr_doubles unknown_of(const hdr_doubles &array, const double &unknown)
{
    return {&unknown, array.count, 0};
}

template <class Stream, class Field> void put(Stream &stream, const if_known<Field> &perhaps)
{
    put(stream, perhaps.known ? perhaps.field : unknown_of(perhaps.field, perhaps.unknown));
}

template <class Field> void put(finite_check &check, const if_known<Field> &perhaps)
{
    if (perhaps.known) put(check, perhaps.field);
}

/** Writes a message within another message. */
template <class Stream, class Message, class = typename message_of<Message>::type>
void put(Stream &stream, const Message &message)
{
    message_of<Message>::fields(stream, message);
}

template <class Stream, class List, class Item = typename item_of<List>::type, int = 0>
void put(Stream &stream, const List &list)
{
    stream.next(list.count);
    for (uint32_t k = 0; k < list.count; k++) message_of<Item>::fields(stream, list.data[k]);
}

/** Writes a field. received.hpp has the overload that reads it. */
template <class Stream, class Field> void pass(Stream &stream, const Field &field)
{
    put(stream, field);
}

template <class Stream, class First, class Second, class... Rest>
void pass(Stream &stream, First &&first, Second &&second, Rest &&...rest)
{
    pass(stream, first);
    pass(stream, second, rest...);
}

/** Whether all numbers of a message that have to be finite are so. */
template <class Message> bool is_finite(const Message &message)
{
    finite_check check;
    message_of<Message>::fields(check, message);
    return check.finite;
}

template <> struct message_of<hdr_header> {
    using type = std_msgs::Header;
    template <class Stream, class Message> static void fields(Stream &s, Message &m)
    {
        pass(s, m.seq, m.stamp.sec, m.stamp.nsec, m.frame_id);
    }
};

/** What is handed to roscpp as a message. */
template <class Message> struct sent {
    const Message &message;
};

} // namespace hdlyap_ros

namespace ros
{
namespace message_traits
{
#define HDR_SENT_TRAIT(trait)                                                                      \
    template <class Message> struct trait<hdlyap_ros::sent<Message>> {                             \
        using message = typename hdlyap_ros::message_of<Message>::type;                            \
        static const char *value() { return trait<message>::value(); }                             \
        static const char *value(const hdlyap_ros::sent<Message> &) { return value(); }            \
    };
HDR_SENT_TRAIT(MD5Sum)
HDR_SENT_TRAIT(DataType)
HDR_SENT_TRAIT(Definition)
#undef HDR_SENT_TRAIT
} // namespace message_traits

namespace serialization
{
template <class Message> struct Serializer<hdlyap_ros::sent<Message>> {
    template <class Stream> static void write(Stream &stream, const hdlyap_ros::sent<Message> &out)
    {
        hdlyap_ros::message_of<Message>::fields(stream, out.message);
    }
    static uint32_t serializedLength(const hdlyap_ros::sent<Message> &out)
    {
        LStream stream;
        write(stream, out);
        return stream.getLength();
    }
};
} // namespace serialization
} // namespace ros
