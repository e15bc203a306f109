/** C views -> bytes on the wire, through roscpp's traits: type, md5 and definition are those of the
 * generated messages, and the fields are written straight from the caller's buffers. What a view
 * consists of is listed once: received.hpp reads by the same lists. */
#pragma once

#include <cstring>
#include <string>
#include <type_traits>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <hdlyap/Cost.h>
#include <hdlyap/Covariant.h>
#include <hdlyap/Hydro.h>
#include <hdlyap/LpPhases.h>
#include <hdlyap/ModeField.h>
#include <hdlyap/Modes.h>
#include <hdlyap/RunInfo.h>
#include <hdlyap/SlowVectors.h>
#include <hdlyap/Spectrum.h>
#include <hdlyap/State.h>
#include <hdlyap/Steps.h>
#include <ros/serialization.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <visualization_msgs/MarkerArray.h>

#include "hdlyap_ros/markers.h"
#include "hdlyap_ros/messages.h"

static_assert(int(HDR_FINISHED) == int(hdlyap::Cost::FINISHED), "phases as in Cost.msg");
static_assert(int(HDR_MODE_LP) == int(hdlyap::Mode::LP), "kinds as in Mode.msg");
static_assert(int(HDR_MODE_LP) == int(hdlyap::Step::LP), "kinds as in Step.msg");
static_assert(int(HDR_LP_TRACKED) == int(hdlyap::LpPhase::TRACKED), "states as in LpPhase.msg");
static_assert(int(HDR_CENTRE_STABLE) == int(hdlyap::CovariantAngle::CENTRE_STABLE),
              "pairs of spaces as in CovariantAngle.msg");
static_assert(int(HDR_DIAGNOSTIC_ERROR) == int(diagnostic_msgs::DiagnosticStatus::ERROR),
              "levels as in DiagnosticStatus.msg");
static_assert(int(HDR_MARKER_TEXT) == int(visualization_msgs::Marker::TEXT_VIEW_FACING) &&
                  int(HDR_MARKER_TRIANGLE_LIST) == int(visualization_msgs::Marker::TRIANGLE_LIST),
              "types as in Marker.msg");

namespace hdlyap_ros
{

/** What a view stands for: the generated message, unless it is a part of another one only, and its
 * fields in the order of the message, each passed to the stream or filled from it. */
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

/** Views within views. */
template <class Stream> void put(Stream &stream, const hdr_header &header);
template <class Stream> void put(Stream &stream, const hdr_fit &fit);

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

/** Numbers of one type, in the order of the message. */
template <class Stream, class Numbers> void put_block(Stream &stream, const Numbers &numbers)
{
    uint8_t *out = stream.advance(static_cast<uint32_t>(sizeof numbers));
    std::memcpy(out, &numbers, sizeof numbers);
}

template <class Numbers> void put_block(ros::serialization::LStream &stream, const Numbers &numbers)
{
    stream.advance(static_cast<uint32_t>(sizeof numbers));
}

template <class Stream> void put(Stream &stream, const hdr_point &point)
{
    put_block(stream, point);
}
template <class Stream> void put(Stream &stream, const hdr_colour &colour)
{
    put_block(stream, colour);
}

template <class Stream> void put(Stream &stream, double value) { stream.next(value); }
template <class Stream> void put(Stream &stream, bool value) { stream.next(uint8_t(value)); }
template <class Stream> void put(Stream &stream, uint8_t value) { stream.next(value); }
template <class Stream> void put(Stream &stream, int32_t value) { stream.next(value); }
template <class Stream> void put(Stream &stream, uint32_t value) { stream.next(value); }
template <class Stream> void put(Stream &stream, uint64_t value) { stream.next(value); }

/** An array of parts of a message: two members of a view. */
template <class Pointer, class Count> struct items {
    Pointer &data;
    Count &count;
};

template <class Pointer, class Count> items<Pointer, Count> items_of(Pointer &data, Count &count)
{
    return {data, count};
}

template <class Stream, class Pointer, class Count>
void put(Stream &stream, const items<Pointer, Count> &list)
{
    using item = std::remove_pointer_t<Pointer>;
    stream.next(list.count);
    for (uint32_t k = 0; k < list.count; k++)
        message_of<std::remove_const_t<item>>::fields(stream, list.data[k]);
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

/** A field on its way out; on its way in it is taken, see received.hpp. */
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

template <> struct message_of<hdr_header> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.seq, v.stamp.sec, v.stamp.nsec, v.frame_id);
    }
};

template <> struct message_of<hdr_fit> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.points, v.c, v.c_error, v.c2, v.c2_error);
    }
};

template <class Stream> void put(Stream &stream, const hdr_header &header)
{
    message_of<hdr_header>::fields(stream, header);
}

template <class Stream> void put(Stream &stream, const hdr_fit &fit)
{
    message_of<hdr_fit>::fields(stream, fit);
}

template <> struct message_of<hdr_run_info> {
    using type = hdlyap::RunInfo;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.version, v.scene, v.disks, v.density, v.aspect, v.box_x,
             v.box_y, v.boundary_x, v.boundary_y, v.seed, v.exponents, v.vectors, v.zero_exponents,
             v.equilibration, v.warmup, v.duration, v.target_std_error, v.interval, v.accuracy,
             v.report_interval, v.observables, v.max_wave_number, v.max_mode_number, v.wave_nx,
             v.wave_ny, v.covariant_window, v.covariant_transient, v.covariant_sampling,
             v.covariant_memory, v.covariant_storage, v.field_indices, v.field_interval,
             v.wait_for_subscribers, v.pace, v.slow_vectors_rate, v.slow_vectors_count, v.checkpoint,
             v.checkpoint_interval, v.resume, v.resumed_time, v.threads, v.blas_threads,
             v.blas_library, v.blas_kernel, v.blas_threading);
    }
};

template <> struct message_of<hdr_spectrum> {
    using type = hdlyap::Spectrum;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.averaged_time, v.collisions, v.lambda_max,
             v.ks_entropy, v.pairing_error, v.first_index, v.exponents, v.std_errors,
             v.local_exponents, v.cos_theta, v.dp_dq_ratio);
    }
};

template <> struct message_of<hdr_mode> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.index, v.exponent, v.kind, v.nx, v.ny, v.wave_number, v.weight, v.weight_l,
             v.weight_p, v.weight_now, v.null_x, v.null_y, v.null_p, v.step);
    }
};

template <> struct message_of<hdr_modes> {
    using type = hdlyap::Modes;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.averaged_time, v.samples,
             items_of(v.modes, v.count));
    }
};

template <> struct message_of<hdr_step> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.kind, v.nx, v.ny, v.wave_number, v.conjugate, v.resolved, v.expected,
             v.first_index, v.last_index, v.multiplicity, v.set, v.members, v.exponent,
             v.std_error);
    }
};

template <> struct message_of<hdr_steps> {
    using type = hdlyap::Steps;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.averaged_time, v.threshold,
             items_of(v.steps, v.count), v.t, v.l, v.v_phases, v.v, v.v_error);
    }
};

template <> struct message_of<hdr_lp_phase> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.step, v.nx, v.ny, v.modulation, v.index, v.state, v.a, v.b, v.phase, v.omega,
             v.omega_error, v.velocity, v.tracked_time);
    }
};

template <> struct message_of<hdr_lp_phases> {
    using type = hdlyap::LpPhases;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.samples_per_report, items_of(v.phases, v.count));
    }
};

template <> struct message_of<hdr_mode_field> {
    using type = hdlyap::ModeField;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.index, v.kind, v.nx, v.ny, v.wave_number,
             v.exponent, v.x, v.y, v.px, v.py, v.dqx, v.dqy, v.dpx, v.dpy, v.pairs, v.modulation,
             v.residual_l, v.residual_p, v.rotation_distance, v.l_x, v.l_y, v.p_x, v.p_y,
             v.p_over_px, v.p_over_py);
    }
};

template <> struct message_of<hdr_hydro_mode> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.step, v.index, v.kind, v.nx, v.ny, v.modulation, v.density, v.along, v.across,
             v.energy);
    }
};

template <> struct message_of<hdr_hydro> {
    using type = hdlyap::Hydro;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, items_of(v.responses, v.count));
    }
};

template <> struct message_of<hdr_covariant_angle> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.spaces, v.last, v.mean, v.std_error, v.least, v.mean_of_all, v.smallest_counts,
             v.all_counts);
    }
};

template <> struct message_of<hdr_covariant_weight> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.kind, v.nx, v.ny, v.wave_number, v.dimension, v.dq, v.dp, v.gram_schmidt);
    }
};

template <> struct message_of<hdr_covariant> {
    using type = hdlyap::Covariant;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.averaged_time, v.windows, v.lost_windows, v.looks,
             v.seconds, v.first_index, v.exponents, v.std_errors, v.local_exponents, v.apart,
             v.neighbour_angles, v.least_neighbour_angles, v.violations, v.entangled, v.widths,
             v.cos_theta, v.centre_apart, v.stable_apart, v.null_angle, v.largest_null_angle,
             items_of(v.angles, v.angle_count), items_of(v.weights, v.weight_count));
    }
};

template <> struct message_of<hdr_state> {
    using type = hdlyap::State;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.kinetic_energy, v.x, v.y, v.px, v.py);
    }
};

template <> struct message_of<hdr_slow_vectors> {
    using type = hdlyap::SlowVectors;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.x, v.y, v.px, v.py, v.first_index, v.vectors,
             v.exponents, v.kind, v.nx, v.ny, v.pairs, v.a, v.b, v.dqx, v.dqy);
    }
};

template <> struct message_of<hdr_cost> {
    using type = hdlyap::Cost;
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.header, v.run_id, v.sim_time, v.phase, v.wall_seconds, v.events_seconds,
             v.replay_seconds, v.ortho_seconds, v.spectrum_seconds, v.modes_seconds,
             v.covariant_seconds, v.publish_seconds, v.events_per_second, v.interval,
             v.interval_limit, v.condition, v.orthogonality_defect, v.error_bound,
             v.orthonormalisations, v.second_passes, v.looks, v.repairs, v.std_error, v.progress,
             v.remaining_seconds);
    }
};

template <> struct message_of<hdr_key_value> {
    template <class Stream, class View> static void fields(Stream &s, View &v)
    {
        pass(s, v.key, v.value);
    }
};

template <> struct message_of<hdr_diagnostic> {
    using type = diagnostic_msgs::DiagnosticArray;
    template <class Stream> static void fields(Stream &s, const hdr_diagnostic &v)
    {
        const uint32_t statuses = 1;
        pass(s, v.header, statuses);
        status(s, v);
    }
    template <class Stream, class View> static void status(Stream &s, View &v)
    {
        pass(s, v.level, v.name, v.message, v.hardware_id, items_of(v.values, v.count));
    }
};

template <> struct message_of<hdr_float64> {
    using type = std_msgs::Float64;
    template <class Stream, class View> static void fields(Stream &s, View &v) { pass(s, v.data); }
};

template <> struct message_of<hdr_string> {
    using type = std_msgs::String;
    template <class Stream, class View> static void fields(Stream &s, View &v) { pass(s, v.data); }
};

/** pose, scale, colour, life time, frame_locked; points, colours, text; no mesh. */
template <> struct message_of<hdr_marker> {
    template <class Stream> static void write(Stream &s, const char *frame_id, const hdr_marker &v)
    {
        const uint32_t zero = 0;
        const double upright[] = {0.0, 0.0, 0.0, 1.0};
        pass(s, hdr_header{{0, 0}, frame_id, 0}, v.ns, v.id, v.type, v.action, v.position);
        put_block(s, upright);
        pass(s, v.scale, v.colour, zero, zero, false);
        put_points(s, v.points, v.count);
        put_points(s, v.colours, v.colours ? v.count : 0);
        pass(s, v.text, "", false);
    }

    template <class Stream, class Item>
    static void put_points(Stream &s, const Item *items, uint32_t count)
    {
        s.next(count);
        for (uint32_t k = 0; k < count; k++) put(s, items[k]);
    }
};

template <> struct message_of<hdr_markers> {
    using type = visualization_msgs::MarkerArray;
    template <class Stream> static void fields(Stream &s, const hdr_markers &v)
    {
        s.next(v.count);
        for (uint32_t k = 0; k < v.count; k++)
            message_of<hdr_marker>::write(s, v.frame_id, v.markers[k]);
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
HDR_VIEW_TRAITS(hdr_modes)
HDR_VIEW_TRAITS(hdr_steps)
HDR_VIEW_TRAITS(hdr_lp_phases)
HDR_VIEW_TRAITS(hdr_mode_field)
HDR_VIEW_TRAITS(hdr_hydro)
HDR_VIEW_TRAITS(hdr_covariant)
HDR_VIEW_TRAITS(hdr_state)
HDR_VIEW_TRAITS(hdr_slow_vectors)
HDR_VIEW_TRAITS(hdr_cost)
HDR_VIEW_TRAITS(hdr_diagnostic)
HDR_VIEW_TRAITS(hdr_float64)
HDR_VIEW_TRAITS(hdr_string)
HDR_VIEW_TRAITS(hdr_markers)
#undef HDR_VIEW_TRAITS
#undef HDR_VIEW_TRAIT
} // namespace message_traits

namespace serialization
{
template <class View> struct ViewSerializer {
    template <class Stream> static void write(Stream &stream, const View &view)
    {
        hdlyap_ros::message_of<View>::fields(stream, view);
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
template <> struct Serializer<hdr_modes> : ViewSerializer<hdr_modes> {
};
template <> struct Serializer<hdr_steps> : ViewSerializer<hdr_steps> {
};
template <> struct Serializer<hdr_lp_phases> : ViewSerializer<hdr_lp_phases> {
};
template <> struct Serializer<hdr_mode_field> : ViewSerializer<hdr_mode_field> {
};
template <> struct Serializer<hdr_hydro> : ViewSerializer<hdr_hydro> {
};
template <> struct Serializer<hdr_covariant> : ViewSerializer<hdr_covariant> {
};
template <> struct Serializer<hdr_state> : ViewSerializer<hdr_state> {
};
template <> struct Serializer<hdr_slow_vectors> : ViewSerializer<hdr_slow_vectors> {
};
template <> struct Serializer<hdr_cost> : ViewSerializer<hdr_cost> {
};
template <> struct Serializer<hdr_diagnostic> : ViewSerializer<hdr_diagnostic> {
};
template <> struct Serializer<hdr_float64> : ViewSerializer<hdr_float64> {
};
template <> struct Serializer<hdr_string> : ViewSerializer<hdr_string> {
};
template <> struct Serializer<hdr_markers> : ViewSerializer<hdr_markers> {
};
} // namespace serialization
} // namespace ros
