/** Bytes on the wire -> C structs, by roscpp's traits and the lists of fields that serialise.hpp
 * uses. The bytes are copied once: on the wire numbers are not aligned and strings have no end. */
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "serialise.hpp"
#include "standard_messages.hpp"

namespace hdlyap_ros
{

/** A message as its callback gets it: one struct; for an array of diagnostics, one struct for each
 * status. */
template <class Message> struct received {
    std::vector<Message> messages;
    std::vector<std::shared_ptr<const void>> kept; /**< memory that messages point to */
};

/** A message that is being read. */
struct reader {
    ros::serialization::IStream bytes; /**< bytes that are still to be read */
    std::vector<std::shared_ptr<const void>> &kept;
};

template <class Item> const Item *keep(reader &in, std::vector<Item> &&list)
{
    const auto kept = std::make_shared<const std::vector<Item>>(std::move(list));
    in.kept.push_back(kept);
    return kept->data();
}

/** Takes the next `count` numbers. A count may be wrong, so bytes are checked before memory is
 * allocated. */
template <class Number> std::vector<Number> numbers(reader &in, uint32_t count)
{
    if (count > in.bytes.getLength() / sizeof(Number)) ros::serialization::throwStreamOverrun();
    const auto size = static_cast<uint32_t>(count * sizeof(Number));
    std::vector<Number> list(count);
    if (count > 0) std::memcpy(list.data(), in.bytes.advance(size), size);
    return list;
}

template <class Number> void take_numbers(reader &in, const Number *&data, uint32_t &count)
{
    in.bytes.next(count);
    data = keep(in, numbers<Number>(in, count));
}

inline void take(reader &in, hdr_doubles &array)
{
    array.stride = 1;
    take_numbers(in, array.data, array.count);
}

inline void take(reader &in, hdr_uints &list) { take_numbers(in, list.data, list.count); }
inline void take(reader &in, hdr_counts &list) { take_numbers(in, list.data, list.count); }
inline void take(reader &in, hdr_bytes &list) { take_numbers(in, list.data, list.count); }

inline void take(reader &in, const char *&text)
{
    uint32_t length = 0;
    in.bytes.next(length);
    std::vector<char> copy = numbers<char>(in, length);
    copy.push_back('\0');
    text = keep(in, std::move(copy));
}

inline void take(reader &in, hdr_strings &list)
{
    std::vector<const char *> strings;
    in.bytes.next(list.count);
    for (uint32_t k = 0; k < list.count; k++) {
        strings.emplace_back();
        take(in, strings.back());
    }
    list.data = keep(in, std::move(strings));
}

template <class Number, class = if_number<Number>> void take(reader &in, Number &value)
{
    in.bytes.next(value);
}

inline void take(reader &in, bool &value) { value = numbers<uint8_t>(in, 1)[0] != 0; }

template <class Message, class = typename message_of<Message>::type, int = 0>
void take(reader &in, Message &message)
{
    message_of<Message>::fields(in, message);
}

template <class List, class Item = typename item_of<List>::type, char = 0>
void take(reader &in, List &list)
{
    std::vector<Item> items;
    in.bytes.next(list.count);
    for (uint32_t k = 0; k < list.count; k++) {
        items.emplace_back();
        message_of<Item>::fields(in, items.back());
    }
    list.data = keep(in, std::move(items));
}

/** Overload resolution prefers this to pass of serialise.hpp, whose field is const. */
template <class Field> void pass(reader &in, Field &field) { take(in, field); }

template <class Message> void read(reader &in, std::vector<Message> &messages)
{
    messages.emplace_back();
    message_of<Message>::fields(in, messages.back());
}

inline void read(reader &in, std::vector<hdr_diagnostic> &messages)
{
    uint32_t statuses = 0;
    hdr_diagnostic each = {};
    pass(in, each.header, statuses);
    for (uint32_t k = 0; k < statuses; k++) {
        message_of<hdr_diagnostic>::status(in, each);
        messages.push_back(each);
    }
}

} // namespace hdlyap_ros

namespace ros
{
namespace message_traits
{
#define HDR_RECEIVED_TRAIT(trait)                                                                  \
    template <class Message> struct trait<hdlyap_ros::received<Message>> {                         \
        using message = typename hdlyap_ros::message_of<Message>::type;                            \
        static const char *value() { return trait<message>::value(); }                             \
        static const char *value(const hdlyap_ros::received<Message> &) { return value(); }        \
    };
HDR_RECEIVED_TRAIT(MD5Sum)
HDR_RECEIVED_TRAIT(DataType)
#undef HDR_RECEIVED_TRAIT
template <class Message> struct HasHeader<hdlyap_ros::received<Message>>
    : HasHeader<typename hdlyap_ros::message_of<Message>::type> {
};
} // namespace message_traits

namespace serialization
{
template <class Message> struct Serializer<hdlyap_ros::received<Message>> {
    /** If this throws, roscpp logs it and drops the message. */
    template <class Stream> static void read(Stream &stream, hdlyap_ros::received<Message> &whole)
    {
        hdlyap_ros::reader in = {{stream.getData(), stream.getLength()}, whole.kept};
        hdlyap_ros::read(in, whole.messages);
        if (in.bytes.getLength() > 0)
            throw std::length_error(std::to_string(in.bytes.getLength()) + " bytes too many");
    }
};
} // namespace serialization
} // namespace ros
