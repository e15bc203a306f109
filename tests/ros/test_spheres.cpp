/** Pictures of spheres: what lies in space, where, and what stays in the plane. */
#include <algorithm>
#include <array>

#include "drawn.hpp"

using namespace drawn;

namespace
{
using vec = std::array<double, 3>;

vec of(const geometry_msgs::Point &p) { return {p.x, p.y, p.z}; }
vec minus(const vec &a, const vec &b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const vec &a, const vec &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/** Of an arrow in space: tail, tip, and across its shaft. */
struct shaft {
    vec tail, tip, across;
    vec along() const { return minus(tip, tail); }
    double middle(int d) const { return 0.5 * (tail[d] + tip[d]); }
};

std::vector<shaft> shafts_of(const Marker &m)
{
    std::vector<shaft> found;
    for (size_t k = 0; k + 9 <= m.points.size(); k += 9) {
        const vec a = of(m.points[k]), b = of(m.points[k + 5]);
        found.push_back({{}, of(m.points[k + 7]), minus(b, a)});
        for (int d = 0; d < 3; d++) found.back().tail[d] = 0.5 * (a[d] + b[d]);
    }
    return found;
}

std::vector<Marker> arrows(const MarkerArray &array)
{
    return in(array, "mode/T(0,0)", Marker::TRIANGLE_LIST);
}
} // namespace

TEST(spheres, lie_in_space)
{
    spheres s(20.0, 10.0, 8.0, 40, 2, 2);
    const MarkerArray array = drawing().of(s.p);
    const std::vector<Marker> balls = in(array, "spheres", Marker::SPHERE_LIST);
    const Marker box = in(array, "box", Marker::LINE_LIST).at(0);
    ASSERT_EQ(1u, balls.size());
    ASSERT_EQ(80u, balls[0].points.size());
    EXPECT_TRUE(in(array, "disks", Marker::SPHERE_LIST).empty());
    EXPECT_EQ(1.0, balls[0].scale.x);  // sigma
    EXPECT_LT(balls[0].color.a, 0.5F); // arrows are seen through them
    for (int i = 0; i < 40; i++)
        for (const int panel : {0, 1}) {
            const auto &at = balls[0].points[40 * panel + i];
            EXPECT_NEAR(s.q[2 * i], at.x - box.points[24 * panel].x, 1e-12);
            EXPECT_NEAR(s.q[2 * i + 1], at.y - box.points[24 * panel].y, 1e-12);
            EXPECT_EQ(s.z[i], at.z);
        }
}

/** Each of full length along one direction, between corners, and none twice. */
TEST(spheres, a_box_has_twelve_edges)
{
    spheres s(20.0, 10.0, 8.0, 40, 2, 2);
    const Marker box = in(drawing().of(s.p), "box", Marker::LINE_LIST).at(0);
    const double size[3] = {20.0, 10.0, 8.0};
    ASSERT_EQ(48u, box.points.size());
    std::set<std::pair<vec, vec>> edges;
    for (int k = 0; k < 24; k += 2) { // of the first panel
        const vec a = of(box.points[k]), b = of(box.points[k + 1]);
        int differ = 0;
        for (int d = 0; d < 3; d++) {
            for (const double at : {a[d], b[d]}) EXPECT_TRUE(at == 0.0 || at == size[d]) << at;
            differ += a[d] != b[d];
        }
        EXPECT_EQ(1, differ);
        edges.insert({std::min(a, b), std::max(a, b)});
    }
    EXPECT_EQ(12u, edges.size());
}

/** Two of each, across each other; at the spheres, along the field. */
TEST(spheres, arrows_are_the_field_in_space)
{
    spheres s(20.0, 15.0, 12.0, 60, 1, 3);
    const std::vector<Marker> found = arrows(drawing().of(s.p));
    ASSERT_EQ(2u, found.size());
    const std::vector<shaft> one = shafts_of(found[0]), other = shafts_of(found[1]);
    ASSERT_TRUE(one.size() == 60 && other.size() == 60);
    const double factor = one[0].along()[2] / s.dz[0];
    double square = 0.0;
    EXPECT_GT(factor, 0.0);
    for (int i = 0; i < 60; i++) {
        const vec field = {s.vectors[2 * i], s.vectors[2 * i + 1], s.dz[i]};
        const vec at = {s.q[2 * i], s.q[2 * i + 1], s.z[i]};
        for (const shaft &arrow : {one[i], other[i]})
            for (int d = 0; d < 3; d++) {
                EXPECT_NEAR(at[d], arrow.middle(d), 1e-12);
                EXPECT_NEAR(factor * field[d], arrow.along()[d], 1e-12);
            }
        EXPECT_NEAR(0.0, dot(one[i].across, field), 1e-12);
        EXPECT_NEAR(0.0, dot(other[i].across, field), 1e-12);
        EXPECT_NEAR(0.0, dot(one[i].across, other[i].across), 1e-12);
        EXPECT_NEAR(dot(one[i].across, one[i].across), dot(other[i].across, other[i].across),
                    1e-12);
        square += dot(one[i].along(), one[i].along());
    }
    EXPECT_NEAR(1.3 * std::cbrt(20.0 * 15.0 * 12.0 / 60), std::sqrt(square / 60), 1e-9);
}

TEST(spheres, an_arrow_may_stand_upright)
{
    spheres s(20.0, 15.0, 12.0, 1, 1, 3);
    s.vectors = {0.0, 0.0}, s.dz[0] = -0.5;
    s.point();
    const MarkerArray array = drawing().of(s.p);
    expect_shown(array);
    for (const Marker &m : arrows(array)) {
        const shaft arrow = shafts_of(m).at(0);
        EXPECT_LT(arrow.along()[2], -1.0);
        EXPECT_GT(dot(arrow.across, arrow.across), 0.0);
    }
}

/** rviz sheds light on a list of one colour: dark sides of arrows would be black. */
TEST(spheres, arrows_have_the_hue_of_their_kind_from_all_sides)
{
    spheres s(20.0, 15.0, 12.0, 20, 1, 3);
    const std::vector<Marker> found = arrows(drawing().of(s.p));
    ASSERT_EQ(2u, found.size());
    for (const Marker &m : found) {
        ASSERT_EQ(m.points.size(), m.colors.size());
        for (const auto &colour : m.colors) EXPECT_EQ(m.color, colour);
    }
    EXPECT_FLOAT_EQ(0.698F, found[0].color.b); // blue, of T
    EXPECT_FLOAT_EQ(0.7F * 0.698F, found[1].color.b);
    EXPECT_TRUE(arrows(drawing().of(scene(20.0, 15.0, 20, 1, 3).p)).at(0).colors.empty());
}

/** Titles, dials and the caption are at the height of the box's lid. */
TEST(spheres, texts_lie_above_their_box)
{
    spheres s(20.0, 10.0, 8.0, 40, 2, 2);
    for (const Marker &m : drawing().of(s.p).markers) {
        if (m.type == Marker::TEXT_VIEW_FACING) {
            EXPECT_EQ(8.5, m.pose.position.z) << m.text;
        } else if (m.ns == "phases") {
            for (const auto &point : m.points) EXPECT_EQ(8.0, point.z);
        }
    }
}

/** From where rviz's view begins, 55 degrees above the plane, no box hides the title of the one
 * below it. */
TEST(spheres, rows_of_panels_leave_room_for_what_is_high)
{
    const double sine = std::sin(0.96), cosine = std::cos(0.96);
    for (const double depth : {5.0, 20.0}) {
        spheres s(20.0, 20.0, depth, 40, 8, 2);
        const MarkerArray array = drawing().of(s.p);
        const auto box = in(array, "box", Marker::LINE_LIST).at(0).points;
        const auto on_screen = [&](double y, double z) { return y * sine + z * cosine; };
        for (int k = 1; k < 8; k++) {
            const std::string ns = std::string("mode/") + s.p.mode[k].box;
            const Marker title = in(array, ns, Marker::TEXT_VIEW_FACING).at(0);
            const auto &at = title.pose.position;
            for (int other = 0; other < k; other++) // whose lowest edge is its first
            {
                if (box[24 * other].y < box[24 * k].y + 1.0) continue; // in the same row
                EXPECT_LT(on_screen(at.y, at.z) + 1.2 * title.scale.z,
                          on_screen(box[24 * other].y, 0.0));
            }
        }
    }
}

/** Eight dials of a mode along all three directions are as wide as four. */
TEST(spheres, eight_pairs_have_a_dial_each)
{
    spheres s(20.0, 20.0, 20.0, 40, 2, 2);
    drawing on;
    const auto width = [&](uint32_t pairs) {
        s.p.mode[1].lp.pairs = pairs;
        const std::vector<Marker> dials = in(on.of(s.p), "phases", Marker::LINE_LIST);
        EXPECT_EQ(2 * pairs, dials.at(1).points.size());
        const auto ends = std::minmax_element(
            dials[0].points.begin(), dials[0].points.end(),
            [](const auto &a, const auto &b) { return a.x < b.x; });
        return ends.second->x - ends.first->x;
    };
    const double four = width(4);
    EXPECT_GT(width(8), 0.98 * four);
    EXPECT_LT(width(8), 1.03 * four);
    s.p.mode[1].lp.a[7] = 0.25;
    width(8);
    const std::vector<Marker> dials = in(on.of(s.p), "phases", Marker::LINE_LIST);
    const double radius = dials[0].points[2 * 32 * 7].x - dials[1].points[14].x;
    EXPECT_NEAR(0.25, (dials[1].points[15].x - dials[1].points[14].x) / radius, 1e-9);
}

TEST(spheres, the_caption_has_the_box)
{
    spheres s(20.158737, 5.0, 10.25, 10, 0, 2);
    s.h.periodic[2] = true;
    const MarkerArray array = drawing().of(s.p);
    const std::string text = in(array, "caption", Marker::TEXT_VIEW_FACING).at(0).text;
    EXPECT_EQ("a scene: 10 spheres, 20.16 x 5 x 10.25, x reflecting, y reflecting, z periodic\n",
              text.substr(0, text.find('\n') + 1));
}

TEST(spheres, rviz_takes_every_picture)
{
    for (const double shape : {0.05, 0.3, 1.0, 4.0, 80.0})
        for (const double depth : {1.5, 30.0})
            for (const int modes : {0, 1, 2, 8})
                for (const int count : {2, 50})
                    expect_shown(
                        drawing().of(spheres(30.0 * shape, 30.0, depth, count, modes, 1).p));
}
