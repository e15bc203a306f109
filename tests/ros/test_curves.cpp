/** Plots and caption of the pictures for rviz. */
#include "drawn.hpp"

extern "C" {
#include "numbers.h"
}

using namespace drawn;

/** As the tables of plot_bag have them. */
TEST(curves, numbers_with_errors)
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

TEST(curves, curves_are_the_numbers)
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

namespace
{
std::string caption(const MarkerArray &array)
{
    return in(array, "caption", Marker::TEXT_VIEW_FACING).at(0).text;
}
} // namespace

TEST(curves, the_caption_says_what_is_known)
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
