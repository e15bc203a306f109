/** Pictures for rviz: the bytes of a MarkerArray, what rviz demands of one, what is drawn where,
 * and what of a run is drawn. */
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "standard_messages.hpp"

extern "C" {
#include "compose.h"
#include "draw.h"
}

namespace
{
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/** As rviz gets it. */
MarkerArray received(const hdr_markers &markers)
{
    const hdlyap_ros::sent<hdr_markers> out = {markers};
    const ros::SerializedMessage bytes = ros::serialization::serializeMessage(out);
    MarkerArray message;
    ros::serialization::deserializeMessage(bytes, message);
    return message;
}

/** A picture and all that it points to. */
struct scene {
    picture p = {};
    std::vector<double> q, exponents, vectors;
    std::vector<hdr_step> step;
    hdr_steps steps = {};

    scene(double width, double height, int disks, int modes, unsigned seed)
    {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> part(0.0, 1.0);
        p.scene = "a scene";
        p.stage = "averaging";
        p.box[0] = width;
        p.box[1] = height;
        p.time = 12.5;
        p.progress = 0.25;
        p.modes = modes;
        for (int i = 0; i < disks; i++) {
            q.push_back(width * part(random));
            q.push_back(height * part(random));
        }
        for (int k = 0; k < 2 * disks * modes; k++) vectors.push_back(part(random) - 0.5);
        point();
    }

    void point()
    {
        const auto disks = static_cast<uint32_t>(q.size() / 2);
        p.x = {q.data(), disks, 2};
        p.y = {q.data() + 1, disks, 2};
        for (int k = 0; k < p.modes; k++) {
            picture_mode &m = p.mode[k];
            std::snprintf(m.name, sizeof m.name, k % 2 ? "LP(%d,1)" : "T(%d,0)", k);
            m.kind = k % 2 ? HDR_MODE_LP : HDR_MODE_T;
            m.found = m.known = true;
            m.index = 7;
            m.pairs = k % 2 ? 2 : 0;
            m.a[0] = 0.6, m.b[0] = 0.3, m.a[1] = -0.4, m.b[1] = 0.1;
            m.dx = {vectors.data() + 2 * disks * k, disks, 2};
            m.dy = {vectors.data() + 2 * disks * k + 1, disks, 2};
        }
    }

    void measure(uint32_t n)
    {
        for (uint32_t k = 0; k < n; k++) exponents.push_back(6.0 - 5.0 * k / n);
        p.has_exponents = true;
        p.exponents = {exponents.data(), n, 1};
        step.push_back({HDR_MODE_T, 1, 0, 0.2, false, true, 2, n - 1, n, 1.9, 0, 1, 1.05, 0.01, 0,
                        1.0, 1.0, 0.0, 0.0});
        step.push_back({HDR_MODE_LP, 1, 0, 0.2, false, true, 4, n - 5, n - 2, 3.5, 1, 1, 1.1, -1, 0,
                        1.0, 1.0, 0.0, 0.0});
        step.push_back(
            {HDR_MODE_LP, 0, 1, 0.3, false, false, 4, 0, 0, 0, -1, 0, 0, 0, 0, 1.0, 1.0, 0.0, 0.0});
        steps.steps = {step.data(), static_cast<uint32_t>(step.size())};
        steps.t_points = 2, steps.c_t = 3.2, steps.c_t_error = 0.1, steps.c_t2 = 0.2;
        steps.l_points = 1, steps.c_l = 4.2, steps.c_l_error = -1;
        p.steps = &steps;
    }

    /** Of one vector each, below those of measure. */
    void more_steps(uint32_t count)
    {
        for (uint32_t k = 0; k < count; k++)
            step.push_back({HDR_MODE_T, 2, k, 0.3, false, true, 1, 90 - k, 90 - k, 1, int(k), 1,
                            1.2 + 0.05 * k, 0.01, 0, 1.0, 1.0, 0.0, 0.0});
        steps.steps = {step.data(), static_cast<uint32_t>(step.size())};
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

std::vector<Marker> in(const MarkerArray &array, const std::string &ns, int type)
{
    std::vector<Marker> found;
    for (const Marker &m : array.markers)
        if (m.ns == ns && m.type == type && m.action == Marker::ADD) found.push_back(m);
    return found;
}

/** What rviz 1.14 refuses, see its marker_utils.cpp. */
void expect_shown(const MarkerArray &array)
{
    std::set<std::pair<std::string, int>> names;
    for (const Marker &m : array.markers) {
        EXPECT_TRUE(names.emplace(m.ns, m.id).second) << m.ns << " " << m.id;
        EXPECT_EQ("box", m.header.frame_id);
        EXPECT_TRUE(m.header.stamp.isZero());
        EXPECT_EQ(1.0, m.pose.orientation.w);
        if (m.action == Marker::DELETE) continue;
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
std::vector<arrow> arrows_of(const Marker &m)
{
    std::vector<arrow> found;
    for (size_t k = 0; k + 9 <= m.points.size(); k += 9) {
        const auto &a = m.points[k], &b = m.points[k + 5], &tip = m.points[k + 7];
        const double x = 0.5 * (a.x + b.x), y = 0.5 * (a.y + b.y);
        found.push_back({0.5 * (x + tip.x), 0.5 * (y + tip.y), tip.x - x, tip.y - y});
    }
    return found;
}
} // namespace

TEST(markers, bytes)
{
    const hdr_point points[] = {{1, 2, 3}, {-4, 5e300, 6}};
    const hdr_colour colours[] = {{0.25F, 0.5F, 0.75F, 1.0F}, {1, 0, 0, 0.5F}};
    const hdr_marker list[] = {{"a",
                                3,
                                HDR_MARKER_LINE_LIST,
                                HDR_MARKER_ADD,
                                {1, 2, 3},
                                {4, 5, 6},
                                colours[0],
                                points,
                                colours,
                                2,
                                ""},
                               {"b",
                                0,
                                HDR_MARKER_TEXT,
                                HDR_MARKER_DELETE,
                                {},
                                {},
                                colours[1],
                                nullptr,
                                nullptr,
                                0,
                                "some text"}};
    const hdr_markers markers = {"box", list, 2};
    MarkerArray message;
    message.markers.resize(2);
    Marker &line = message.markers[0], &text = message.markers[1];
    line.header.frame_id = text.header.frame_id = "box";
    line.pose.orientation.w = text.pose.orientation.w = 1.0;
    line.ns = "a", line.id = 3, line.type = Marker::LINE_LIST, line.action = Marker::ADD;
    line.pose.position.x = 1, line.pose.position.y = 2, line.pose.position.z = 3;
    line.scale.x = 4, line.scale.y = 5, line.scale.z = 6;
    line.points.resize(2);
    line.colors.resize(2);
    for (int k = 0; k < 2; k++) {
        line.points[k].x = points[k].x, line.points[k].y = points[k].y,
        line.points[k].z = points[k].z;
        line.colors[k].r = colours[k].r, line.colors[k].g = colours[k].g;
        line.colors[k].b = colours[k].b, line.colors[k].a = colours[k].a;
    }
    line.color = line.colors[0];
    text.ns = "b", text.type = Marker::TEXT_VIEW_FACING, text.action = Marker::DELETE,
    text.text = "some text";
    text.color = line.colors[1];
    const hdlyap_ros::sent<hdr_markers> out = {markers};
    const ros::SerializedMessage got = ros::serialization::serializeMessage(out);
    const ros::SerializedMessage want = ros::serialization::serializeMessage(message);
    ASSERT_EQ(want.num_bytes, got.num_bytes);
    EXPECT_EQ(0, std::memcmp(want.buf.get(), got.buf.get(), want.num_bytes));
    EXPECT_STREQ(ros::message_traits::md5sum<MarkerArray>(), ros::message_traits::md5sum(out));
}

/** Boxes of all shapes, hardly any disks, many modes and steps: rviz takes what is drawn, and
 * nothing of it is left out. */
TEST(markers, rviz_takes_every_picture)
{
    for (const double shape : {0.01, 0.3, 0.867, 1.0, 3.0, 80.0})
        for (const int modes : {0, 1, 2, 3, 8})
            for (const bool measured : {false, true}) {
                scene s(30.0 / std::sqrt(shape), 30.0 * std::sqrt(shape), measured ? 50 : 2, modes,
                        1);
                if (measured) s.measure(97);
                if (measured) s.more_steps(20);
                const MarkerArray array = drawing().of(s.p);
                expect_shown(array);
                EXPECT_LE(array.markers.size(), 150u);
                EXPECT_EQ(1u, in(array, "text", Marker::TEXT_VIEW_FACING).size());
                int names = 0; // of steps
                for (const Marker &m : in(array, "spectrum", Marker::TEXT_VIEW_FACING))
                    names += m.text.find('(') != std::string::npos;
                EXPECT_EQ(measured ? 12 : 0, names);
            }
}

/** Steps are looked for and none is found: rviz takes an empty list for an error. */
TEST(markers, nothing_is_found_yet)
{
    scene s(20.0, 20.0, 10, 2, 9);
    s.measure(40);
    for (hdr_step &step : s.step) step.resolved = false;
    const MarkerArray array = drawing().of(s.p);
    expect_shown(array);
    EXPECT_TRUE(in(array, "dispersion", Marker::POINTS).empty());
}

TEST(markers, disks_and_boxes_lie_where_they_are)
{
    scene s(20.0, 10.0, 40, 2, 2);
    const MarkerArray array = drawing().of(s.p);
    const std::vector<Marker> disks = in(array, "disks", Marker::SPHERE_LIST);
    const std::vector<Marker> boxes = in(array, "box", Marker::LINE_LIST);
    ASSERT_EQ(1u, disks.size());
    ASSERT_EQ(1u, boxes.size());
    ASSERT_EQ(80u, disks[0].points.size());
    ASSERT_EQ(16u, boxes[0].points.size());
    EXPECT_EQ(1.0, disks[0].scale.x); // sigma
    for (int i = 0; i < 40; i++) {
        EXPECT_EQ(s.q[2 * i], disks[0].points[i].x);
        EXPECT_EQ(s.q[2 * i + 1], disks[0].points[i].y);
        EXPECT_NEAR(s.q[2 * i], disks[0].points[40 + i].x - boxes[0].points[8].x, 1e-12);
    }
    EXPECT_EQ(0.0, boxes[0].points[0].x);
    EXPECT_EQ(20.0, boxes[0].points[1].x);
    EXPECT_EQ(10.0, boxes[0].points[3].y);
}

/** At the disks, along the field, as long as it is but for one factor: none is clipped here. */
TEST(markers, arrows_are_the_field)
{
    scene s(20.0, 15.0, 60, 1, 3);
    const std::vector<Marker> found = in(drawing().of(s.p), "mode/T(0,0)", Marker::TRIANGLE_LIST);
    ASSERT_EQ(1u, found.size());
    const std::vector<arrow> arrows = arrows_of(found[0]);
    ASSERT_EQ(60u, arrows.size());
    const double factor = arrows[0].dx / s.vectors[0];
    double square = 0;
    EXPECT_GT(factor, 0.0);
    for (int i = 0; i < 60; i++) {
        EXPECT_NEAR(s.q[2 * i], arrows[i].x, 1e-12);
        EXPECT_NEAR(s.q[2 * i + 1], arrows[i].y, 1e-12);
        EXPECT_NEAR(factor * s.vectors[2 * i], arrows[i].dx, 1e-12);
        EXPECT_NEAR(factor * s.vectors[2 * i + 1], arrows[i].dy, 1e-12);
        square += arrows[i].dx * arrows[i].dx + arrows[i].dy * arrows[i].dy;
    }
    EXPECT_NEAR(1.3 * std::sqrt(20.0 * 15.0 / 60), std::sqrt(square / 60), 1e-9);
}

/** A box too long for arrows: each component against x, in proportion, below the box and above the
 * plots. */
TEST(markers, the_field_of_a_long_box_is_plotted)
{
    scene s(200.0, 1.5, 60, 2, 8);
    s.measure(97);
    const MarkerArray array = drawing().of(s.p);
    const Marker boxes = in(array, "box", Marker::LINE_LIST).at(0);
    const std::vector<Marker> dots = in(array, "mode/LP(1,1)", Marker::POINTS);
    const double left = boxes.points[16].x, bottom = boxes.points[24].y, top = boxes.points[28].y;
    ASSERT_EQ(32u, boxes.points.size());
    ASSERT_EQ(2u, dots.size()); // across, along
    EXPECT_TRUE(in(array, "mode/LP(1,1)", Marker::TRIANGLE_LIST).empty());
    EXPECT_LT(top, boxes.points[16].y);
    EXPECT_GT(bottom, in(array, "spectrum", Marker::LINE_LIST).at(0).points[3].y);
    double square = 0;
    for (int k = 120; k < 240; k++) square += s.vectors[k] * s.vectors[k] / 60;
    for (int i = 0; i < 60; i++)
        for (const int along : {0, 1}) {
            const auto &point = dots[along].points[i];
            const double wanted = 0.3 * s.vectors[120 + 2 * i + 1 - along] / std::sqrt(square);
            EXPECT_NEAR(left + s.q[2 * i], point.x, 1e-9);
            EXPECT_NEAR(wanted, (2 * point.y - top - bottom) / (top - bottom), 1e-9);
        }
}

TEST(markers, an_lp_mode_shows_its_phase)
{
    scene s(20.0, 20.0, 10, 2, 4);
    picture_mode &lp = s.p.mode[1];
    drawing on;
    const std::vector<Marker> dials = in(on.of(s.p), "phases", Marker::LINE_LIST);
    ASSERT_EQ(2u, dials.size()); // circles, hands
    ASSERT_EQ(4u, dials[1].points.size());
    const double radius = dials[0].points[0].x - dials[1].points[0].x;
    for (int k = 0; k < 2; k++) {
        EXPECT_NEAR(lp.a[k], (dials[1].points[2 * k + 1].x - dials[1].points[2 * k].x) / radius,
                    1e-9);
        EXPECT_NEAR(lp.b[k], (dials[1].points[2 * k + 1].y - dials[1].points[2 * k].y) / radius,
                    1e-9);
    }
    const auto red = [&](double a, double b) {
        lp.pairs = 1, lp.a[0] = a, lp.b[0] = b;
        return in(on.of(s.p), "mode/LP(1,1)", Marker::TRIANGLE_LIST)[0].color.r;
    };
    EXPECT_FLOAT_EQ(0.902F, red(0.7, 0.0)); // all L
    EXPECT_FLOAT_EQ(0.40F, red(0.0, -0.7)); // all P
    EXPECT_FLOAT_EQ(0.651F, red(0.5, 0.5));
}

namespace
{
/** Of an axis, by the first and the last of the numbers beside it: place -> number. */
struct scale {
    double place[2], number[2];
    double of(double at) const
    {
        return number[0] + (at - place[0]) / (place[1] - place[0]) * (number[1] - number[0]);
    }
};
scale scale_along(const MarkerArray &array, const std::string &ns, bool along_x, double at,
                  double low, double high)
{
    scale found = {{1e300, -1e300}, {0, 0}};
    for (const Marker &m : in(array, ns, Marker::TEXT_VIEW_FACING)) {
        char *end = nullptr;
        const double number = std::strtod(m.text.c_str(), &end);
        const double place = along_x ? m.pose.position.x : m.pose.position.y;
        const double other = along_x ? m.pose.position.y : m.pose.position.x;
        if (*end || std::fabs(other - at) > 1e-9 || place < low || place > high) continue;
        if (place < found.place[0]) found.place[0] = place, found.number[0] = number;
        if (place > found.place[1]) found.place[1] = place, found.number[1] = number;
    }
    return found;
}
} // namespace

TEST(markers, curves_are_the_numbers)
{
    scene s(20.0, 20.0, 50, 2, 5);
    s.measure(97);
    const MarkerArray array = drawing().of(s.p);
    const Marker curve = in(array, "spectrum", Marker::LINE_STRIP).at(0);
    const Marker frame = in(array, "spectrum", Marker::LINE_LIST).at(0);
    const double unit = curve.scale.x / 0.2, left = frame.points[0].x, bottom = frame.points[0].y;
    const scale y = scale_along(array, "spectrum", false, left - 1.3 * unit, bottom - 1,
                                bottom + 100);
    const scale x = scale_along(array, "spectrum", true, bottom - 1.3 * unit, left - 1,
                                frame.points[1].x + 1);
    ASSERT_EQ(97u, curve.points.size());
    for (int k = 0; k < 97; k++) {
        EXPECT_NEAR(k + 1, x.of(curve.points[k].x), 1e-6);
        EXPECT_NEAR(s.exponents[k], y.of(curve.points[k].y), 1e-9);
    }
    const Marker dots = in(array, "dispersion", Marker::POINTS).at(0);
    const Marker axes = in(array, "dispersion", Marker::LINE_LIST).at(0);
    const scale k = scale_along(array, "dispersion", true, axes.points[0].y - 1.3 * unit,
                                axes.points[0].x - 1, 1e9);
    const scale lambda = scale_along(array, "dispersion", false, axes.points[0].x - 1.3 * unit,
                                     -1e9, 1e9);
    ASSERT_EQ(2u, dots.points.size());
    EXPECT_NEAR(0.2, k.of(dots.points[0].x), 1e-9);
    EXPECT_NEAR(1.05, lambda.of(dots.points[0].y), 1e-9);
    EXPECT_NEAR(1.1, lambda.of(dots.points[1].y), 1e-9);
    EXPECT_GT(dots.colors[0].b, dots.colors[0].r); // T is blue, LP is not
    EXPECT_LT(dots.colors[1].b, dots.colors[1].r);
    const Marker fit = in(array, "dispersion", Marker::LINE_LIST).at(1);
    for (const auto &point : fit.points) {
        const double at = k.of(point.x);
        EXPECT_NEAR(3.2 * at + 0.2 * at * at, lambda.of(point.y), 1e-9);
    }
}

TEST(markers, what_is_gone_is_deleted)
{
    scene s(20.0, 20.0, 10, 2, 6);
    drawing on;
    EXPECT_EQ(1u, in(on.of(s.p), "mode/T(0,0)", Marker::TRIANGLE_LIST).size());
    std::snprintf(s.p.mode[0].name, sizeof s.p.mode[0].name, "T(0,1)");
    s.p.mode[1].found = s.p.mode[1].known = false;
    for (int again = 0; again < 2; again++) { // and stays so for who has missed it
        const MarkerArray array = on.of(s.p);
        std::map<std::string, int> deleted;
        for (const Marker &m : array.markers) deleted[m.ns] += m.action == Marker::DELETE;
        expect_shown(array);
        EXPECT_EQ(2, deleted["mode/T(0,0)"]); // arrows and title
        EXPECT_EQ(2, deleted["phases"]);
        EXPECT_EQ(1, deleted["mode/LP(1,1)"]);
        EXPECT_EQ(0, deleted["mode/T(0,1)"]);
    }
}

/** Between two orthonormalisations, of a run that rests: a mode is found although its vector is not
 * known. */
TEST(markers, a_mode_without_its_vector_keeps_its_number)
{
    scene s(20.0, 20.0, 10, 2, 6);
    drawing on;
    s.p.mode[1].known = false;
    const MarkerArray array = on.of(s.p);
    expect_shown(array);
    EXPECT_TRUE(in(array, "mode/LP(1,1)", Marker::TRIANGLE_LIST).empty());
    EXPECT_TRUE(in(array, "phases", Marker::LINE_LIST).empty());
    const std::string text = in(array, "mode/LP(1,1)", Marker::TEXT_VIEW_FACING).at(0).text;
    EXPECT_NE(std::string::npos, text.find("index 7")) << text;
    EXPECT_NE(std::string::npos, text.find("not known now")) << text;
}

TEST(markers, the_caption_says_what_is_known)
{
    scene s(20.0, 20.0, 10, 0, 7);
    drawing on;
    EXPECT_NE(std::string::npos,
              in(on.of(s.p), "text", Marker::TEXT_VIEW_FACING).at(0).text.find("t = 12.5"));
    s.measure(40);
    const std::string text = in(on.of(s.p), "text", Marker::TEXT_VIEW_FACING).at(0).text;
    EXPECT_NE(std::string::npos, text.find("c_T 3.200 +- 0.100")) << text;
    EXPECT_NE(std::string::npos, text.find("c_L 4.200 ")) << text;
    EXPECT_NE(std::string::npos, text.find("v unknown")) << text;
    EXPECT_NE(std::string::npos, text.find("a scene: 10 disks")) << text;
    EXPECT_NE(std::string::npos, text.find("25 %")) << text;
}

/* ---- what is drawn of what was heard ----------------------------------------------------------
 */

namespace
{
const uint32_t DISKS = 3;

/** What a viewer has heard, and the arrays of what it hears. */
struct hearing {
    heard h = {};
    std::vector<double> numbers;
    const char *topics[2] = {"steps", "fields"};
    const uint32_t nx[2] = {1, 0}, ny[2] = {0, 1};
    hdr_run_info info = {};
    std::vector<hdr_step> step;
    mode_choice lowest = {};

    explicit hearing(const char *boundary = "periodic")
    {
        h.time = -1.0;
        for (int k = 0; k < 100; k++) numbers.push_back(0.01 * k);
        info.run_id = "run", info.scene = "a scene", info.disks = DISKS;
        info.box_x = info.box_y = 10.0, info.boundary_x = "periodic", info.boundary_y = boundary;
        info.vectors = 9;
        info.observables = {topics, 2};
        info.wave_nx = {nx, 2}, info.wave_ny = {ny, 2};
        EXPECT_TRUE(heard_run_info(&h, &info));
        EXPECT_FALSE(heard_run_info(&h, &info)); // the same
    }
    ~hearing() { heard_clear(&h); }

    hdr_doubles array(uint32_t count, uint32_t from = 0) { return {&numbers[from], count, 1}; }

    void steps(bool resolved)
    {
        step.assign({{HDR_MODE_T, 1, 0, 0.6, false, resolved, 2, 7, 8, 2, 0, 1, 1.5, -1, 0, 1.0,
                      1.0, 0.0, 0.0},
                     {HDR_MODE_LP, 0, 1, 0.6, false, resolved, 2, 5, 6, 2, 1, 1, 1.8, -1, 0, 1.0,
                      1.0, 0.0, 0.0}});
        hdr_steps message = {};
        message.run_id = "run", message.steps = {step.data(), 2};
        heard_steps(&h, &message);
    }

    void state(double time)
    {
        hdr_state message = {};
        message.run_id = "run", message.sim_time = time;
        message.x = array(DISKS), message.y = array(DISKS, 10);
        heard_state(&h, &message);
    }

    void field(double time, uint8_t kind, uint32_t x, uint32_t index)
    {
        hdr_mode_field message = {};
        message.run_id = "run", message.sim_time = time, message.kind = kind;
        message.nx = x, message.ny = !x, message.index = index,
        message.exponent = 2.0 - 0.1 * index;
        message.x = array(DISKS, 20), message.y = array(DISKS, 30);
        message.dqx = array(DISKS, index), message.dqy = array(DISKS, 40);
        heard_mode_field(&h, &message);
    }

    picture drawn() { return compose(&h, &lowest); }
};
} // namespace

/** Between two fields of a bag, or before the first: a mode that is resolved says so. */
TEST(heard, a_resolved_mode_is_found_without_its_vector)
{
    hearing on;
    on.state(1.0);
    on.steps(false);
    EXPECT_FALSE(on.drawn().mode[0].found || on.drawn().mode[1].found);
    on.steps(true);
    const picture p = on.drawn();
    ASSERT_EQ(2, p.modes);
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_STREQ("LP(0,1)", p.mode[1].name);
    for (const int k : {0, 1}) {
        EXPECT_TRUE(p.mode[k].found);
        EXPECT_FALSE(p.mode[k].known);
    }
    EXPECT_EQ(7u, p.mode[0].index);
    EXPECT_EQ(1.8, p.mode[1].exponent);
    const MarkerArray array = drawing().of(p);
    for (const Marker &m : array.markers) EXPECT_EQ(std::string::npos, m.text.find("not resolved"));
}

/** Fields of one time are drawn where the disks were then. */
TEST(heard, fields_of_a_bag)
{
    hearing on;
    on.steps(true);
    on.state(9.0);
    on.field(10.0, HDR_MODE_T, 1, 7);
    on.field(10.0, HDR_MODE_LP, 0, 5);
    on.state(11.0); // is not drawn
    picture p = on.drawn();
    EXPECT_EQ(10.0, p.time);
    EXPECT_EQ(0.20, p.x.data[0]);
    EXPECT_TRUE(p.mode[0].known && p.mode[1].known);
    EXPECT_EQ(0.07, p.mode[0].dx.data[0]);
    EXPECT_EQ(0u, p.mode[1].pairs);
    hdr_lp_phase phase = {1, 0, 1, 0, 5, HDR_LP_PHASE_TRACKED, 0.5, -0.25, 0, 0, 0, 0, 0};
    hdr_lp_phases phases = {};
    phases.run_id = "run", phases.phases = {&phase, 1}, phases.sim_time = 10.0;
    heard_phases(&on.h, &phases);
    p = on.drawn();
    ASSERT_EQ(1u, p.mode[1].pairs);
    EXPECT_EQ(-0.25, p.mode[1].b[0]);
    on.field(20.0, HDR_MODE_T, 1, 7); // the other one has not come yet
    p = on.drawn();
    EXPECT_EQ(20.0, p.time);
    EXPECT_TRUE(p.mode[0].known);
    EXPECT_TRUE(p.mode[1].found && !p.mode[1].known);
    on.state(3.0); // played again
    EXPECT_EQ(3.0, on.drawn().time);
    EXPECT_FALSE(on.drawn().mode[0].known);
}

TEST(heard, slow_vectors)
{
    hearing on;
    const uint8_t kind[] = {HDR_MODE_LP, HDR_MODE_LP, HDR_MODE_T, HDR_MODE_NONE};
    const uint8_t pairs[] = {1, 1, 0, 0};
    const uint32_t nx[] = {0, 0, 1, 0}, ny[] = {1, 1, 0, 0};
    hdr_slow_vectors m = {};
    m.run_id = "run", m.sim_time = 2.5, m.x = on.array(DISKS), m.y = on.array(DISKS, 10);
    m.first_index = 6, m.vectors = 4;
    m.exponents = on.array(4), m.kind = {kind, 4}, m.pairs = {pairs, 4};
    m.nx = {nx, 4}, m.ny = {ny, 4};
    m.a = on.array(16), m.b = on.array(16, 20), m.dqx = on.array(12, 50), m.dqy = on.array(12, 70);
    heard_slow_vectors(&on.h, &m); // before any message of steps
    picture p = on.drawn();
    EXPECT_EQ(2.5, p.time);
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_EQ(8u, p.mode[0].index);
    EXPECT_EQ(0.56, p.mode[0].dx.data[0]); // the third
    EXPECT_STREQ("LP(0,1)", p.mode[1].name);
    EXPECT_EQ(6u, p.mode[1].index); // the first of the two
    EXPECT_EQ(0.20, p.mode[1].b[0]);
    on.lowest.count = 2; // by their names
    ASSERT_TRUE(mode_name_parse(&on.lowest.mode[0], "LP(0,1)"));
    ASSERT_TRUE(mode_name_parse(&on.lowest.mode[1], "T(0,1)"));
    p = on.drawn();
    EXPECT_TRUE(p.mode[0].known);
    EXPECT_FALSE(p.mode[1].found);
    EXPECT_STREQ("T(0,1)", p.mode[1].name);
    m.dqx.count = m.dqy.count = 0; // at rest
    heard_slow_vectors(&on.h, &m);
    EXPECT_TRUE(on.drawn().mode[0].found && !on.drawn().mode[0].known);
    m.sim_time = 3.5, m.nx.count = 3; // arrays that do not fit
    heard_slow_vectors(&on.h, &m);
    m.nx.count = 4, m.dqx.count = 12;
    heard_slow_vectors(&on.h, &m);
    m.dqy.count = 12, m.run_id = "another";
    heard_slow_vectors(&on.h, &m);
    EXPECT_EQ(2.5, on.drawn().time);
}

/** Of a step whose set it shares, and where no vector is its own: the first of the set. */
TEST(heard, a_step_without_a_vector_of_its_own)
{
    hearing on;
    on.steps(true);
    on.field(10.0, HDR_MODE_LP, 0, 7);
    const picture p = on.drawn();
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_TRUE(p.mode[0].known);
    EXPECT_EQ(0.07, p.mode[0].dx.data[0]);
}

TEST(heard, only_modes_that_there_can_be)
{
    hearing walls("reflecting");
    EXPECT_TRUE(walls.h.has_t); // (0,1) has a node between them
    walls.info.run_id = "narrow", walls.info.wave_nx.count = walls.info.wave_ny.count = 1;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_FALSE(walls.h.has_t);
    EXPECT_EQ(1, walls.drawn().modes);
    walls.info.run_id = "state alone", walls.info.observables.count = 0;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_EQ(0, walls.drawn().modes);
}

TEST(heard, names_of_modes)
{
    mode_name name = {};
    EXPECT_TRUE(mode_name_parse(&name, "LP(12,3)"));
    EXPECT_TRUE(name.kind == HDR_MODE_LP && name.nx == 12 && name.ny == 3);
    for (const char *text : {"", "T", "T(1)", "T(1,0", "T(1,0)x", "P(1,0)", "T(-1,0)", "T( 1,0)",
                             "LP(+1,0)", "T(1,0)(", "TT(1,0)"})
        EXPECT_FALSE(mode_name_parse(&name, text)) << text;
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
