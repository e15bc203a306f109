/** C views -> bytes on the wire, through roscpp's traits: type, md5 and definition are those of the
 *  generated messages, and the fields are written straight from the caller's buffers. */
#pragma once

#include <cstring>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <hdlyap/Cost.h>
#include <hdlyap/RunInfo.h>
#include <hdlyap/Spectrum.h>
#include <hdlyap/State.h>
#include <ros/serialization.h>

#include "hdlyap_ros/messages.h"

static_assert(int(HDR_FINISHED) == int(hdlyap::Cost::FINISHED), "phases as in Cost.msg");
static_assert(int(HDR_DIAGNOSTIC_ERROR) == int(diagnostic_msgs::DiagnosticStatus::ERROR),
              "levels as in DiagnosticStatus.msg");

namespace hdlyap_ros
{

/** The generated message that a view stands for. */
template <class View> struct message_of;

template <class Stream> void put(Stream &stream, const char *text)
{
    stream.next(std::string(text));
}

template <class Stream> void put(Stream &stream, const hdr_strings &list)
{
    stream.next(list.count);
    for (uint32_t k = 0; k < list.count; k++) put(stream, list.data[k]);
}

template <class Stream> void put(Stream &stream, const hdr_header &header)
{
    stream.next(uint32_t(0));
    stream.next(header.stamp.sec);
    stream.next(header.stamp.nsec);
    put(stream, header.frame_id);
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

template <class Stream> void put(Stream &stream, double value) { stream.next(value); }
template <class Stream> void put(Stream &stream, uint8_t value) { stream.next(value); }
template <class Stream> void put(Stream &stream, uint32_t value) { stream.next(value); }
template <class Stream> void put(Stream &stream, uint64_t value) { stream.next(value); }

template <class Stream, class First, class Second, class... Rest>
void put(Stream &stream, const First &first, const Second &second, const Rest &...rest)
{
    put(stream, first);
    put(stream, second, rest...);
}

template <> struct message_of<hdr_run_info> {
    using type = hdlyap::RunInfo;
    template <class Stream> static void write(Stream &s, const hdr_run_info &v)
    {
        put(s, v.header, v.run_id, v.version, v.scene, v.disks, v.density, v.aspect, v.box_x,
            v.box_y, v.boundary_x, v.boundary_y, v.seed, v.exponents, v.vectors, v.zero_exponents,
            v.equilibration, v.warmup, v.duration, v.target_std_error, v.interval, v.accuracy,
            v.report_interval, v.observables, v.pace, v.threads, v.blas_threads, v.blas_library,
            v.blas_kernel, v.blas_threading);
    }
};

template <> struct message_of<hdr_spectrum> {
    using type = hdlyap::Spectrum;
    template <class Stream> static void write(Stream &s, const hdr_spectrum &v)
    {
        put(s, v.header, v.run_id, v.sim_time, v.averaged_time, v.collisions, v.lambda_max,
            v.ks_entropy, v.pairing_error, v.first_index, v.exponents, v.std_errors,
            v.local_exponents, v.cos_theta, v.dp_dq_ratio);
    }
};

template <> struct message_of<hdr_state> {
    using type = hdlyap::State;
    template <class Stream> static void write(Stream &s, const hdr_state &v)
    {
        put(s, v.header, v.run_id, v.sim_time, v.kinetic_energy, v.x, v.y, v.px, v.py);
    }
};

template <> struct message_of<hdr_cost> {
    using type = hdlyap::Cost;
    template <class Stream> static void write(Stream &s, const hdr_cost &v)
    {
        put(s, v.header, v.run_id, v.sim_time, v.phase, v.wall_seconds, v.events_seconds,
            v.replay_seconds, v.ortho_seconds, v.spectrum_seconds, v.publish_seconds,
            v.events_per_second, v.interval, v.condition, v.orthogonality_defect, v.error_bound,
            v.orthonormalisations, v.second_passes, v.repairs, v.progress, v.remaining_seconds);
    }
};

template <> struct message_of<hdr_diagnostic> {
    using type = diagnostic_msgs::DiagnosticArray;
    template <class Stream> static void write(Stream &s, const hdr_diagnostic &v)
    {
        const uint32_t statuses = 1;
        put(s, v.header, statuses, v.level, v.name, v.message, v.hardware_id, v.count);
        for (uint32_t k = 0; k < v.count; k++) put(s, v.values[k].key, v.values[k].value);
    }
};

} // namespace hdlyap_ros

namespace ros
{
namespace message_traits
{
/** Traits are specialised per type, not per family of types, so a macro names the family. */
#define HDR_VIEW_TRAIT(trait, view)                                                                \
    template <> struct trait<view> {                                                               \
        static const char *value() { return trait<hdlyap_ros::message_of<view>::type>::value(); }  \
        static const char *value(const view &) { return value(); }                                 \
    };
#define HDR_VIEW_TRAITS(view)                                                                      \
    HDR_VIEW_TRAIT(MD5Sum, view)                                                                   \
    HDR_VIEW_TRAIT(DataType, view)                                                                 \
    HDR_VIEW_TRAIT(Definition, view)
HDR_VIEW_TRAITS(hdr_run_info)
HDR_VIEW_TRAITS(hdr_spectrum)
HDR_VIEW_TRAITS(hdr_state)
HDR_VIEW_TRAITS(hdr_cost)
HDR_VIEW_TRAITS(hdr_diagnostic)
#undef HDR_VIEW_TRAITS
#undef HDR_VIEW_TRAIT
} // namespace message_traits

namespace serialization
{
template <class View> struct ViewSerializer {
    template <class Stream> static void write(Stream &stream, const View &view)
    {
        hdlyap_ros::message_of<View>::write(stream, view);
    }
    static uint32_t serializedLength(const View &view)
    {
        LStream stream;
        write(stream, view);
        return stream.getLength();
    }
};
template <> struct Serializer<hdr_run_info> : ViewSerializer<hdr_run_info> {
};
template <> struct Serializer<hdr_spectrum> : ViewSerializer<hdr_spectrum> {
};
template <> struct Serializer<hdr_state> : ViewSerializer<hdr_state> {
};
template <> struct Serializer<hdr_cost> : ViewSerializer<hdr_cost> {
};
template <> struct Serializer<hdr_diagnostic> : ViewSerializer<hdr_diagnostic> {
};
} // namespace serialization
} // namespace ros
