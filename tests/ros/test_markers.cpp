/** Pictures for rviz: the bytes of a MarkerArray, what rviz demands of one, what is drawn where. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "standard_messages.hpp"

extern "C" {
#include "draw.h"
#include "numbers.h"
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
        p.note = "";
        p.disks = static_cast<uint32_t>(disks);
        p.box[0] = width;
        p.box[1] = height;
        p.time = p.vector_time = 12.5;
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
        p.at_x = p.x, p.at_y = p.y;
        for (int k = 0; k < p.modes; k++) {
            picture_mode &m = p.mode[k];
            std::snprintf(m.name, sizeof m.name, k % 2 ? "LP(%d,1)" : "T(%d,0)", k);
            std::memcpy(m.box, m.name, sizeof m.box);
            m.exponent = 0.61252, m.error = 0.00067, m.momentum = k % 2 ? 0.25 : -1.0;
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
                EXPECT_EQ(1u, in(array, "caption", Marker::TEXT_VIEW_FACING).size());
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

namespace
{
Marker title(const MarkerArray &array, const std::string &ns)
{
    return in(array, ns, Marker::TEXT_VIEW_FACING).at(0);
}
} // namespace

/** Between two fields of a bag the disks go on; arrows stay where and when they belong. */
TEST(markers, vectors_of_before_say_so)
{
    scene s(20.0, 15.0, 60, 1, 3);
    drawing on;
    EXPECT_EQ("T(0,0)   lambda = 0.61252(67)\nvector 7", title(on.of(s.p), "mode/T(0,0)").text);
    std::vector<double> before(s.q.rbegin(), s.q.rend());
    for (size_t k = 0; k < before.size(); k++) before[k] *= k % 2 ? 20.0 / 15.0 : 15.0 / 20.0;
    s.p.at_x.data = before.data() + 1, s.p.at_y.data = before.data();
    s.p.vector_time = 10.0;
    const MarkerArray array = on.of(s.p);
    EXPECT_EQ("T(0,0)   lambda = 0.61252(67)\nvector 7 of t = 10.0",
              title(array, "mode/T(0,0)").text);
    const std::vector<arrow> arrows = arrows_of(
        in(array, "mode/T(0,0)", Marker::TRIANGLE_LIST).at(0));
    const Marker disks = in(array, "disks", Marker::SPHERE_LIST).at(0);
    for (int i = 0; i < 60; i++) {
        EXPECT_EQ(s.q[2 * i], disks.points[i].x);
        EXPECT_NEAR(before[2 * i + 1], arrows[i].x, 1e-12);
        EXPECT_NEAR(before[2 * i], arrows[i].y, 1e-12);
    }
}

/** However long, and wherever they are. */
TEST(markers, no_arrow_crosses_a_text)
{
    for (const int disks : {10, 100, 800})
        for (const double shape : {0.2, 0.867, 3.0}) {
            scene s(30.0 / std::sqrt(shape), 30.0 * std::sqrt(shape), disks, 6, 11);
            for (size_t k = 0; k < s.vectors.size(); k += 7) s.vectors[k] *= 20.0; // are cut
            s.measure(97);
            const MarkerArray array = drawing().of(s.p);
            for (const Marker &m : array.markers) {
                if (m.type != Marker::TEXT_VIEW_FACING) continue;
                const long lines = 1 + std::count(m.text.begin(), m.text.end(), '\n');
                const double reach = 0.6 * lines * m.scale.z, y = m.pose.position.y;
                for (const Marker &a : array.markers) {
                    if (a.ns.find("mode/") != 0 || a.type != Marker::TRIANGLE_LIST) continue;
                    for (const auto &point : a.points)
                        EXPECT_FALSE(std::fabs(point.y - y) < reach &&
                                     std::fabs(point.x - m.pose.position.x) < reach)
                            << m.text;
                }
            }
        }
}

/** As the tables of plot_bag have them. */
TEST(markers, numbers_with_errors)
{
    const struct {
        double value, error;
        const char *text;
    } cases[] = {{0.61252, 0.00067, "0.61252(67)"},   {5.262, 0.0095, "5.2620(95)"},
                 {5.262, 0.00996, "5.262(10)"},       {12.34, 1.52, "12.3(1.5)"},
                 {1234.0, 15.2, "1234(15)"},          {0.61252, -1.0, "0.6125"},
                 {-0.00128, 0.00047, "-0.00128(47)"}, {1.5, 1e-12, "1.5e+00"},
                 {6.5, 0.099951, "6.50(10)"}};
    for (const auto &c : cases) {
        char text[48];
        number_with_error(text, sizeof text, c.value, c.error);
        EXPECT_STREQ(c.text, text);
    }
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
    const auto red = [&](double momentum) {
        lp.momentum = momentum;
        return in(on.of(s.p), "mode/LP(1,1)", Marker::TRIANGLE_LIST)[0].color.r;
    };
    EXPECT_FLOAT_EQ(0.902F, red(0.0)); // all L
    EXPECT_FLOAT_EQ(0.40F, red(1.0));  // all P
    EXPECT_FLOAT_EQ(0.651F, red(0.5));
    s.p.vector_time = 2.5; // pale: of another time
    EXPECT_FLOAT_EQ(0.75570F, red(0.5));
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

/** The check box of a panel stays, whichever mode is in it. */
TEST(markers, what_is_gone_is_deleted)
{
    scene s(20.0, 20.0, 10, 2, 6);
    drawing on;
    EXPECT_EQ(1u, in(on.of(s.p), "mode/LP(1,1)", Marker::TRIANGLE_LIST).size());
    std::snprintf(s.p.mode[0].name, sizeof s.p.mode[0].name, "T(0,1)");
    s.p.mode[1].found = s.p.mode[1].known = false;
    for (int again = 0; again < 2; again++) { // and stays so for who has missed it
        const MarkerArray array = on.of(s.p);
        std::map<std::string, int> deleted;
        for (const Marker &m : array.markers) deleted[m.ns] += m.action == Marker::DELETE;
        expect_shown(array);
        EXPECT_EQ(0, deleted["mode/T(0,0)"]);
        EXPECT_EQ(0u, title(array, "mode/T(0,0)").text.find("T(0,1) "));
        EXPECT_EQ(2, deleted["phases"]);
        EXPECT_EQ(1, deleted["mode/LP(1,1)"]); // arrows; its title says that it is not resolved
        EXPECT_EQ("LP(1,1): not resolved", title(array, "mode/LP(1,1)").text);
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
    EXPECT_EQ("LP(1,1)   lambda = 0.61252(67)\nvector 7 not known now",
              title(array, "mode/LP(1,1)").text);
}

namespace
{
std::string caption(const MarkerArray &array)
{
    return in(array, "caption", Marker::TEXT_VIEW_FACING).at(0).text;
}
} // namespace

TEST(markers, the_caption_says_what_is_known)
{
    scene s(20.0, 20.0, 10, 0, 7);
    drawing on;
    EXPECT_NE(std::string::npos,
              in(on.of(s.p), "caption", Marker::TEXT_VIEW_FACING).at(0).text.find("t = 12.5"));
    s.measure(40);
    const std::string text = in(on.of(s.p), "caption", Marker::TEXT_VIEW_FACING).at(0).text;
    EXPECT_NE(std::string::npos, text.find("c_T 3.20(10)")) << text;
    EXPECT_NE(std::string::npos, text.find("c_L 4.2000 ")) << text;
    EXPECT_NE(std::string::npos, text.find("v unknown")) << text;
    EXPECT_NE(std::string::npos, text.find("a scene: 10 disks")) << text;
    EXPECT_NE(std::string::npos, text.find("25 %")) << text;
    s.p.note = "(nothing new since 14:03:27)";
    EXPECT_NE(std::string::npos, caption(on.of(s.p)).find("   (nothing new since 14:03:27)\n"));
    s.p.time = -1.0, s.p.x.count = s.p.y.count = 0; // described, and not begun
    const MarkerArray empty = on.of(s.p);
    expect_shown(empty);
    EXPECT_NE(std::string::npos, caption(empty).find("waiting for its first message"));
    EXPECT_NE(std::string::npos, caption(empty).find("a scene: 10 disks"));
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
