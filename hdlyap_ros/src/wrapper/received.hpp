/** Bytes on the wire -> C views, through roscpp's traits and by the lists of fields of views.hpp.
 * The bytes are copied once, since on the wire numbers lie at any address and strings end nowhere.
 */
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "views.hpp"

namespace hdlyap_ros
{

/** A message as its callback sees it: one view, or of an array of diagnostics one for each status.
 */
template <class View> struct received {
    std::vector<View> views;
    std::vector<std::shared_ptr<const void>> kept; /**< what the views point into */
};

/** A message on its way in. */
struct reader {
    ros::serialization::IStream bytes; /**< what is left of them */
    std::vector<std::shared_ptr<const void>> &kept;
};

template <class Item> const Item *keep(reader &in, std::vector<Item> &&list)
{
    const auto kept = std::make_shared<const std::vector<Item>>(std::move(list));
    in.kept.push_back(kept);
    return kept->data();
}

/** The next `count` numbers, which are there before there is memory for them: counts may lie. */
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

inline void take(reader &in, double &value) { in.bytes.next(value); }
inline void take(reader &in, uint8_t &value) { in.bytes.next(value); }
inline void take(reader &in, int32_t &value) { in.bytes.next(value); }
inline void take(reader &in, uint32_t &value) { in.bytes.next(value); }
inline void take(reader &in, uint64_t &value) { in.bytes.next(value); }
inline void take(reader &in, bool &value) { value = numbers<uint8_t>(in, 1)[0] != 0; }
inline void take(reader &in, hdr_header &header) { message_of<hdr_header>::fields(in, header); }
inline void take(reader &in, hdr_fit &fit) { message_of<hdr_fit>::fields(in, fit); }

template <class Pointer, class Count> void take(reader &in, items<Pointer, Count> &list)
{
    using item = std::remove_const_t<std::remove_pointer_t<Pointer>>;
    std::vector<item> parts;
    in.bytes.next(list.count);
    for (uint32_t k = 0; k < list.count; k++) {
        parts.emplace_back();
        message_of<item>::fields(in, parts.back());
    }
    list.data = keep(in, std::move(parts));
}

/** Chosen before the pass of views.hpp, which takes its field for a constant. */
template <class Field> void pass(reader &in, Field &field) { take(in, field); }

template <class View> void read(reader &in, std::vector<View> &views)
{
    views.emplace_back();
    message_of<View>::fields(in, views.back());
}

inline void read(reader &in, std::vector<hdr_diagnostic> &views)
{
    uint32_t statuses = 0;
    hdr_diagnostic each = {};
    pass(in, each.header, statuses);
    for (uint32_t k = 0; k < statuses; k++) {
        message_of<hdr_diagnostic>::status(in, each);
        views.push_back(each);
    }
}

} // namespace hdlyap_ros

namespace ros
{
namespace message_traits
{
#define HDR_RECEIVED_TRAIT(trait)                                                                  \
    template <class View> struct trait<hdlyap_ros::received<View>> {                               \
        using message = typename hdlyap_ros::message_of<View>::type;                               \
        static const char *value() { return trait<message>::value(); }                             \
        static const char *value(const hdlyap_ros::received<View> &) { return value(); }           \
    };
HDR_RECEIVED_TRAIT(MD5Sum)
HDR_RECEIVED_TRAIT(DataType)
#undef HDR_RECEIVED_TRAIT
template <class View> struct HasHeader<hdlyap_ros::received<View>>
    : HasHeader<typename hdlyap_ros::message_of<View>::type> {
};
} // namespace message_traits

namespace serialization
{
template <class View> struct Serializer<hdlyap_ros::received<View>> {
    /** roscpp logs what is thrown here and drops the message. */
    template <class Stream> static void read(Stream &stream, hdlyap_ros::received<View> &message)
    {
        hdlyap_ros::reader in = {{stream.getData(), stream.getLength()}, message.kept};
        hdlyap_ros::read(in, message.views);
        if (in.bytes.getLength() > 0)
            throw std::length_error(std::to_string(in.bytes.getLength()) + " bytes too many");
    }
};
} // namespace serialization
} // namespace ros
