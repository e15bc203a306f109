/** Pictures made up for tests, and what is in the markers that are drawn of them. */
#ifndef HDLYAP_DRAWN_HPP
#define HDLYAP_DRAWN_HPP

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "wrapper/standard_messages.hpp"

extern "C" {
#include "viewer/draw.h"
}

namespace drawn
{
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/** As rviz gets it. */
inline MarkerArray received(const hdr_markers &markers)
{
    const hdlyap_ros::sent<hdr_markers> out = {markers};
    const ros::SerializedMessage bytes = ros::serialization::serializeMessage(out);
    MarkerArray message;
    ros::serialization::deserializeMessage(bytes, message);
    return message;
}

/** A picture and all that it points to; point() after a change of q, z, vectors or dz. */
struct scene {
    heard h = {};
    picture p = {};
    std::vector<double> q, z, vectors, dz; // [N][2], [N], [modes][N][2], [modes][N]
    std::vector<hdr_point> places;
    std::vector<std::vector<hdr_point>> fields;

    scene(double width, double height, int disks, int modes, unsigned seed)
    {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        std::snprintf(h.scene, sizeof h.scene, "a scene");
        std::snprintf(h.particles, sizeof h.particles, "disks");
        h.stage = HDR_RUN_STATUS_AVERAGING;
        h.number = static_cast<uint32_t>(disks);
        h.kind[0] = {h.number, 1.0, 1.0}, h.kinds = 1;
        h.box[0] = width;
        h.box[1] = height;
        h.time = h.vector_time = 12.5;
        h.status_time = -1.0;
        h.progress = 0.25;
        p.run = &h;
        p.note = "";
        p.modes = modes;
        for (int i = 0; i < disks; i++) {
            q.push_back(width * part(random));
            q.push_back(height * part(random));
        }
        for (int k = 0; k < 2 * disks * modes; k++) vectors.push_back(part(random) - 0.5);
        z.resize(disks), dz.resize(disks * modes);
        for (int k = 0; k < modes; k++) set_mode(k);
        point();
    }
    scene(const scene &) = delete;

    void set_mode(int k)
    {
        picture_mode &m = p.mode[k];
        std::snprintf(m.name, sizeof m.name, k % 2 ? "LP(%d,1)" : "T(%d,0)", k);
        std::memcpy(m.box, m.name, sizeof m.box);
        m.exponent = 0.61252, m.error = 0.00067, m.momentum = k % 2 ? 0.25 : -1.0;
        m.kind = k % 2 ? HDR_MODE_LP : HDR_MODE_T;
        m.found = true;
        m.index = 7;
        m.lp.pairs = k % 2 ? 2 : 0;
        m.lp.a[0] = 0.6, m.lp.b[0] = 0.3, m.lp.a[1] = -0.4, m.lp.b[1] = 0.1;
    }

    void point()
    {
        const size_t n = z.size();
        places.clear(), fields.assign(p.modes, {});
        for (size_t i = 0; i < n; i++) places.push_back({q[2 * i], q[2 * i + 1], z[i]});
        h.q = h.at = places.data();
        for (size_t k = 0; k < fields.size(); k++) {
            for (size_t i = k * n; i < (k + 1) * n; i++)
                fields[k].push_back({vectors[2 * i], vectors[2 * i + 1], dz[i]});
            p.mode[k].d = fields[k].data();
        }
    }
};

/** The same of spheres, in a box that is so high. */
struct spheres : scene {
    spheres(double width, double height, double depth, int count, int modes, unsigned seed)
        : scene(width, height, count, modes, seed)
    {
        std::mt19937_64 random(seed + 1);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        h.box[2] = depth;
        std::snprintf(h.particles, sizeof h.particles, "spheres");
        for (double &one : z) one = depth * part(random);
        for (double &one : dz) one = part(random) - 0.5;
        point();
    }
};

/** The same of dumbbells. */
struct dumbbells : scene {
    std::vector<double> angle, spin, turn; // [N], [N], [modes][N]

    dumbbells(double width, double height, int count, int modes, unsigned seed)
        : scene(width, height, count, modes, seed)
    {
        std::mt19937_64 random(seed + 2);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        std::snprintf(h.particles, sizeof h.particles, "dumbbells");
        h.site[0] = -0.25, h.site[1] = 0.25, h.sites = 2, h.inertia = 0.1875;
        for (int i = 0; i < count; i++) angle.push_back(6.28 * part(random));
        for (int i = 0; i < count; i++) spin.push_back(6.0 * part(random) - 3.0);
        for (int k = 0; k < count * modes; k++) turn.push_back(part(random) - 0.5);
        h.angle = angle.data(), h.spin = spin.data();
        for (int k = 0; k < modes; k++) p.mode[k].turn = &turn[k * count];
    }
};

struct drawing {
    canvas *on = nullptr;
    drawing() { EXPECT_TRUE(canvas_create(&on)); }
    ~drawing() { canvas_free(on); }
    MarkerArray of(const picture &p)
    {
        hdr_markers markers;
        EXPECT_TRUE(draw(on, &markers, &p, "box"));
        return received(markers);
    }
};

inline std::vector<Marker> in(const MarkerArray &array, const std::string &ns, int type)
{
    std::vector<Marker> found;
    for (const Marker &m : array.markers)
        if (m.ns == ns && m.type == type && m.action == Marker::ADD) found.push_back(m);
    return found;
}

/** What rviz 1.14 refuses, see its marker_utils.cpp. */
inline void expect_shown(const MarkerArray &array)
{
    std::set<std::pair<std::string, int>> names;
    EXPECT_EQ(int(Marker::DELETEALL), array.markers.at(0).action); // the picture before
    for (const Marker &m : array.markers) {
        EXPECT_TRUE(names.emplace(m.ns, m.id).second) << m.ns << " " << m.id;
        EXPECT_EQ("box", m.header.frame_id);
        EXPECT_TRUE(m.header.stamp.isZero());
        EXPECT_EQ(1.0, m.pose.orientation.w);
        if (&m == &array.markers[0]) continue;
        EXPECT_EQ(int(Marker::ADD), m.action);
        EXPECT_GT(m.color.a, 0.0f);
        EXPECT_TRUE(m.scale.x > 0 && m.scale.y > 0 && m.scale.z > 0);
        EXPECT_TRUE(m.colors.empty() || m.colors.size() == m.points.size());
        EXPECT_EQ(m.type == Marker::TEXT_VIEW_FACING, m.points.empty());
        EXPECT_EQ(m.type == Marker::TEXT_VIEW_FACING, !m.text.empty());
        EXPECT_TRUE(m.type != Marker::LINE_LIST || m.points.size() % 2 == 0);
        EXPECT_TRUE(m.type != Marker::TRIANGLE_LIST || m.points.size() % 3 == 0);
        for (const auto &point : m.points) EXPECT_TRUE(std::isfinite(point.x + point.y + point.z));
        EXPECT_TRUE(std::isfinite(m.pose.position.x + m.pose.position.y));
    }
}

/** Middle and difference of the ends of each arrow: of the shaft's tail and of the point. */
struct arrow {
    double x, y, dx, dy;
};
inline std::vector<arrow> arrows_of(const Marker &m)
{
    std::vector<arrow> found;
    for (size_t k = 0; k + 9 <= m.points.size(); k += 9) {
        const auto &a = m.points[k], &b = m.points[k + 5], &tip = m.points[k + 7];
        const double x = 0.5 * (a.x + b.x), y = 0.5 * (a.y + b.y);
        found.push_back({0.5 * (x + tip.x), 0.5 * (y + tip.y), tip.x - x, tip.y - y});
    }
    return found;
}
} // namespace drawn

#endif
