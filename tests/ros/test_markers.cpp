/** Pictures for rviz: the bytes of a MarkerArray, what rviz demands of one, what is drawn where. */
#include <algorithm>

#include "drawn.hpp"

extern "C" {
#include "common/numbers.h"
}

using namespace drawn;

/** As the tables of hdlyap plot have them. */
TEST(markers, numbers_with_errors)
{
    const struct {
        double value, error;
        const char *text;
    } cases[] = {{0.61252, 0.00067, "0.61252(67)"},   {5.262, 0.0095, "5.2620(95)"},
                 {5.262, 0.00996, "5.262(10)"},       {12.34, 1.52, "12.3(1.5)"},
                 {1234.0, 15.2, "1234(15)"},          {0.61252, -1.0, "0.6125"},
                 {-0.00128, 0.00047, "-0.00128(47)"}, {1.5, 1e-12, "1.5e+00"},
                 {6.5, 0.099951, "6.50(10)"},         {12.34, 1.0, "12.3(1.0)"}};
    for (const auto &c : cases) {
        char text[48];
        number_with_error(text, sizeof text, c.value, c.error);
        EXPECT_STREQ(c.text, text);
    }
}

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

/** Boxes of all shapes, hardly any disks, many modes: rviz takes what is drawn, and nothing of it
 * is left out. */
TEST(markers, rviz_takes_every_picture)
{
    for (const double shape : {0.01, 0.3, 0.867, 1.0, 3.0, 80.0})
        for (const int modes : {0, 1, 2, 3, 8})
            for (const int disks : {2, 50}) {
                scene s(30.0 / std::sqrt(shape), 30.0 * std::sqrt(shape), disks, modes, 1);
                const MarkerArray array = drawing().of(s.p);
                expect_shown(array);
                // deletion, box, disks, caption; of each mode arrows and title, of one in two its
                // dials
                EXPECT_EQ(4u + 2u * modes + 2u * (modes / 2), array.markers.size());
                EXPECT_EQ(1u, in(array, "caption", Marker::TEXT_VIEW_FACING).size());
            }
}

/** Of two lines. */
TEST(markers, the_caption_says_what_is_known)
{
    scene s(20.0, 20.0, 10, 0, 7);
    drawing on;
    const auto expect = [&](const std::string &text) {
        const MarkerArray array = on.of(s.p);
        EXPECT_EQ(text, in(array, "caption", Marker::TEXT_VIEW_FACING).at(0).text);
        expect_shown(array);
    };
    expect("a scene: 10 disks, x reflecting, y reflecting\nt = 12.5, averaging (25 %)");
    s.h.periodic[1] = true;
    s.p.note = "(nothing new since 14:03:27)";
    expect("a scene: 10 disks, x reflecting, y periodic\n"
           "t = 12.5, averaging (25 %)   (nothing new since 14:03:27)");
    s.h.corners = 1;
    std::snprintf(s.h.container, sizeof s.h.container, "lens");
    s.p.note = "", s.h.progress = -1.0;
    expect("a scene: 10 disks, lens\nt = 12.5, averaging");
    s.h.time = -1.0; // described, and not begun
    expect("a scene: 10 disks, lens\nwaiting for its first message");
}

/** From corner to corner, and back to the first one. */
TEST(markers, an_outline_takes_the_place_of_the_box)
{
    scene s(20.0, 20.0, 40, 2, 2);
    const hdr_point corners[] = {{20.0, 0.0, 0.0}, {10.0, 20.0, 0.0}, {0.0, 5.0, 0.0}};
    s.h.corners = 3;
    std::copy(corners, corners + 3, s.h.outline);
    const std::vector<Marker> walls = in(drawing().of(s.p), "box", Marker::LINE_LIST);
    ASSERT_EQ(1u, walls.size());
    ASSERT_EQ(12u, walls[0].points.size()); // of two panels, the first at (0, 0)
    for (int k = 0; k < 6; k++) {
        EXPECT_EQ(corners[(k + 1) / 2 % 3].x, walls[0].points[k].x);
        EXPECT_EQ(corners[(k + 1) / 2 % 3].y, walls[0].points[k].y);
        EXPECT_NEAR(walls[0].points[6].x - walls[0].points[0].x,
                    walls[0].points[6 + k].x - walls[0].points[k].x, 1e-12);
    }
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
        EXPECT_LT(disks[0].points[i].z, -0.5); // they hide no arrow
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
    EXPECT_FLOAT_EQ(0.0F, found[0].color.r); // blue, of T
    EXPECT_FLOAT_EQ(0.698F, found[0].color.b);
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
    std::vector<hdr_point> before(s.places.rbegin(), s.places.rend());
    s.h.at = before.data();
    s.h.vector_time = 10.0;
    const MarkerArray array = on.of(s.p);
    EXPECT_EQ("T(0,0)   lambda = 0.61252(67)\nvector 7 of t = 10.0",
              title(array, "mode/T(0,0)").text);
    const std::vector<arrow> arrows = arrows_of(
        in(array, "mode/T(0,0)", Marker::TRIANGLE_LIST).at(0));
    const Marker disks = in(array, "disks", Marker::SPHERE_LIST).at(0);
    for (int i = 0; i < 60; i++) {
        EXPECT_EQ(s.q[2 * i], disks.points[i].x);
        EXPECT_NEAR(before[i].x, arrows[i].x, 1e-12);
        EXPECT_NEAR(before[i].y, arrows[i].y, 1e-12);
    }
}

/** They are cut where they would be too long, wherever they are. The caption is above all titles.
 */
TEST(markers, no_arrow_crosses_a_text)
{
    for (const int disks : {10, 100, 800})
        for (const double shape : {0.2, 0.867, 3.0}) {
            scene s(30.0 / std::sqrt(shape), 30.0 * std::sqrt(shape), disks, 6, 11);
            for (size_t k = 0; k < s.vectors.size(); k += 7) s.vectors[k] *= 20.0; // are cut
            s.point();
            const MarkerArray array = drawing().of(s.p);
            const Marker caption = title(array, "caption");
            std::vector<Marker> arrows;
            for (const Marker &m : array.markers)
                if (m.type == Marker::TRIANGLE_LIST) arrows.push_back(m);
            ASSERT_EQ(6u, arrows.size());
            for (const Marker &m : array.markers) {
                if (m.type != Marker::TEXT_VIEW_FACING) continue;
                const long lines = 1 + std::count(m.text.begin(), m.text.end(), '\n');
                const double reach = 0.6 * lines * m.scale.z, y = m.pose.position.y;
                EXPECT_TRUE(m.ns == "caption" ||
                            y + reach < caption.pose.position.y - 1.2 * caption.scale.z);
                for (const Marker &a : arrows)
                    for (const auto &point : a.points)
                        EXPECT_FALSE(std::fabs(point.y - y) < reach &&
                                     std::fabs(point.x - m.pose.position.x) < reach)
                            << m.text;
            }
            for (const Marker &m : arrows)
                for (const arrow &a : arrows_of(m))
                    EXPECT_LT(std::hypot(a.dx, a.dy), 2.6001 * std::sqrt(900.0 / disks));
        }
}

TEST(markers, panels_stand_in_rows)
{
    scene s(20.0, 20.0, 50, 8, 2);
    const MarkerArray array = drawing().of(s.p);
    const auto box = in(array, "box", Marker::LINE_LIST).at(0).points;
    const auto dials = in(array, "phases", Marker::LINE_LIST).at(0).points; // of the second
    const double right = box[8 * 3].x + 20.0, radius = 0.5 * (dials[0].x - dials[32].x);
    const double row = 4.8 * radius; // of two
    for (int k = 0; k < 8; k++) {    // four in each, whose corners are eight points
        const double x = box[8 * k].x;
        EXPECT_EQ(x, box[8 * (k % 4)].x);
        EXPECT_EQ(k < 4 ? 0.0 : box[8 * 4].y, box[8 * k].y);
        const Marker text = title(array, std::string("mode/") + s.p.mode[k].box);
        EXPECT_NEAR(x + 10.0 - (k % 2 ? 0.5 * row : 0.0), text.pose.position.x, 1e-9);
    }
    EXPECT_LT(box[8 * 4].y, -20.0);
    EXPECT_NEAR(0.5 * right, title(array, "caption").pose.position.x, 1e-9);
}

TEST(markers, an_lp_mode_shows_its_phase)
{
    scene s(20.0, 20.0, 10, 2, 4);
    picture_mode &mode = s.p.mode[1];
    drawing on;
    const std::vector<Marker> dials = in(on.of(s.p), "phases", Marker::LINE_LIST);
    ASSERT_EQ(2u, dials.size()); // circles, hands
    ASSERT_EQ(4u, dials[1].points.size());
    const double radius = dials[0].points[0].x - dials[1].points[0].x;
    for (int k = 0; k < 2; k++) {
        EXPECT_NEAR(mode.lp.a[k],
                    (dials[1].points[2 * k + 1].x - dials[1].points[2 * k].x) / radius, 1e-9);
        EXPECT_NEAR(mode.lp.b[k],
                    (dials[1].points[2 * k + 1].y - dials[1].points[2 * k].y) / radius, 1e-9);
    }
    const auto red = [&](double momentum) {
        mode.momentum = momentum;
        return in(on.of(s.p), "mode/LP(1,1)", Marker::TRIANGLE_LIST)[0].color.r;
    };
    EXPECT_FLOAT_EQ(0.902F, red(0.0)); // all L
    EXPECT_FLOAT_EQ(0.40F, red(1.0));  // all P
    EXPECT_FLOAT_EQ(0.651F, red(0.5));
    s.h.vector_time = 2.5; // pale: of another time
    EXPECT_FLOAT_EQ(0.75570F, red(0.5));
}

/** Nothing of the picture before stays, but the check box of a panel, whichever mode is in it. */
TEST(markers, what_is_gone_is_deleted)
{
    scene s(20.0, 20.0, 10, 2, 6);
    drawing on;
    EXPECT_EQ(1u, in(on.of(s.p), "mode/LP(1,1)", Marker::TRIANGLE_LIST).size());
    std::snprintf(s.p.mode[0].name, sizeof s.p.mode[0].name, "T(0,1)");
    s.p.mode[1].found = false, s.p.mode[1].d = nullptr;
    const MarkerArray array = on.of(s.p);
    expect_shown(array);
    EXPECT_EQ(0u, title(array, "mode/T(0,0)").text.find("T(0,1) "));
    EXPECT_TRUE(in(array, "phases", Marker::LINE_LIST).empty());
    EXPECT_TRUE(in(array, "mode/LP(1,1)", Marker::TRIANGLE_LIST).empty());
    EXPECT_EQ("LP(1,1): not resolved", title(array, "mode/LP(1,1)").text);
    s.p.mode[1].absent = true;
    EXPECT_EQ("LP(1,1): this run does not look for it", title(on.of(s.p), "mode/LP(1,1)").text);
}

/** Between two orthonormalisations, of a run that rests: a mode is found although its vector is not
 * known. */
TEST(markers, a_mode_without_its_vector_keeps_its_number)
{
    scene s(20.0, 20.0, 10, 2, 6);
    drawing on;
    s.p.mode[1].d = nullptr;
    const MarkerArray array = on.of(s.p);
    expect_shown(array);
    EXPECT_TRUE(in(array, "mode/LP(1,1)", Marker::TRIANGLE_LIST).empty());
    EXPECT_TRUE(in(array, "phases", Marker::LINE_LIST).empty());
    EXPECT_EQ("LP(1,1)   lambda = 0.61252(67)\nvector 7 not received",
              title(array, "mode/LP(1,1)").text);
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
