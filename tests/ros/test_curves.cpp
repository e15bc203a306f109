/** Plots and caption of the pictures for rviz. */
#include "drawn.hpp"

#include <algorithm>

extern "C" {
#include "common/numbers.h"
}

using namespace drawn;

/** As the tables of hdlyap plot have them. */
TEST(curves, numbers_with_errors)
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

/** The numbers of a plot, whose frame is that list of lines of this name. */
struct plotted {
    scale x, y;
    plotted(const MarkerArray &array, const std::string &ns, size_t which, double unit)
    {
        const auto frame = in(array, ns, Marker::LINE_LIST).at(which).points;
        const double left = frame[0].x, bottom = frame[0].y, gap = 1.3 * unit;
        x = scale_along(array, ns, true, bottom - gap, left - 1, frame[1].x + 1);
        y = scale_along(array, ns, false, left - gap, bottom - 1, bottom + 100);
    }
    void expect(const geometry_msgs::Point &point, double wanted_x, double wanted_y) const
    {
        EXPECT_NEAR(wanted_x, x.of(point.x), 1e-6);
        EXPECT_NEAR(wanted_y, y.of(point.y), 1e-9);
    }
};
bool is_blue(const std_msgs::ColorRGBA &colour) { return colour.b > colour.r; }
} // namespace

TEST(curves, spectra_are_the_numbers)
{
    scene s(20.0, 20.0, 50, 2, 5);
    s.measure(97);
    const MarkerArray array = drawing().of(s.p);
    const Marker curve = in(array, "spectrum", Marker::LINE_STRIP).at(0);
    const Marker dots = in(array, "spectrum", Marker::POINTS).at(0);
    const double unit = curve.scale.x / 0.2;
    const plotted whole(array, "spectrum", 0, unit), lowest(array, "spectrum", 1, unit);
    ASSERT_EQ(97u, curve.points.size());
    for (int k = 0; k < 97; k++) whole.expect(curve.points[k], k + 1, s.exponents[k]);
    const size_t shown = dots.points.size();
    ASSERT_EQ(25u, shown);
    for (size_t k = 97 - shown; k < 97; k++) {
        const size_t at = k - (97 - shown);
        lowest.expect(dots.points[at], k + 1, s.exponents[k]);
        EXPECT_EQ(k + 1 >= 96, is_blue(dots.colors[at]) && dots.colors[at].b > 0.5F); // of T
        EXPECT_EQ(k + 1 >= 92 && k + 1 <= 95, dots.colors[at].r > 0.5F);              // of LP
    }
}

TEST(curves, dispersion_is_the_numbers)
{
    scene s(20.0, 20.0, 50, 2, 5);
    s.measure(97);
    const MarkerArray array = drawing().of(s.p);
    const std::vector<Marker> lines = in(array, "dispersion", Marker::LINE_LIST);
    const Marker dots = in(array, "dispersion", Marker::POINTS).at(0);
    const plotted axes(array, "dispersion", 0, dots.scale.x / 0.55);
    ASSERT_EQ(2u, dots.points.size());
    axes.expect(dots.points[0], 0.2, 1.05);
    axes.expect(dots.points[1], 0.2, 1.1);
    EXPECT_TRUE(is_blue(dots.colors[0])); // T
    EXPECT_FALSE(is_blue(dots.colors[1]));
    ASSERT_EQ(4u, lines.size()); // axes, two fits, errors
    EXPECT_GT(lines[0].points[0].x, in(array, "spectrum", Marker::LINE_LIST).at(1).points[1].x);
    const double c[2][3] = {{3.2, 0.2, 0.5}, {4.2, 0.0, 0.0}};
    for (const int fit : {0, 1}) {
        EXPECT_EQ(fit == 0, is_blue(lines[1 + fit].color));
        EXPECT_GT(lines[1 + fit].points.size(), 20u);
        for (const auto &point : lines[1 + fit].points) {
            const double k = axes.x.of(point.x);
            axes.expect(point, k, c[fit][0] * k + c[fit][1] * k * k + c[fit][2] * k * k * k);
        }
    }
    ASSERT_EQ(2u, lines[3].points.size()); // that of LP is not known
    axes.expect(lines[3].points[0], 0.2, 1.04);
    axes.expect(lines[3].points[1], 0.2, 1.06);
}

TEST(curves, the_caption_says_what_is_known)
{
    scene s(20.0, 20.0, 10, 0, 7);
    drawing on;
    const auto expect = [&](const std::vector<std::string> &parts) {
        const MarkerArray array = on.of(s.p);
        const std::string text = in(array, "caption", Marker::TEXT_VIEW_FACING).at(0).text;
        for (const std::string &part : parts) EXPECT_NE(std::string::npos, text.find(part)) << text;
        expect_shown(array);
    };
    s.p.averaged = 8.25;
    expect({"t = 12.5, averaging (25 %), averaged 8.2"});
    s.measure(40);
    s.p.lambda_max = 5.262, s.p.lambda_max_error = 0.0095;
    expect({"lambda_max 5.2620(95)", "c_T 3.20(10), misfit 6.5  ", "c_L 4.2000  ", "v unknown",
            "a scene: 10 disks, x reflecting, y reflecting"});
    s.steps.v_phases = 8, s.steps.v = 1.612, s.steps.v_error = 0.023, s.steps.v_misfit = 0.04;
    s.p.periodic[1] = true;
    s.p.note = "(nothing new since 14:03:27)";
    expect({"v 1.612(23), misfit 0.0", "x reflecting, y periodic",
            "   (nothing new since 14:03:27)\n"});
    s.p.round = true;
    s.steps.l_points = 0, s.steps.l_long_c2 = NAN; // LP steps follow no relation
    expect({"a scene: 10 disks, in a circle", "misfit 6.5    v 1.612"});
    EXPECT_EQ(3u, in(on.of(s.p), "dispersion", Marker::LINE_LIST).size()); // axes, T, errors
    const auto texts = in(on.of(s.p), "dispersion", Marker::TEXT_VIEW_FACING);
    EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), [](const Marker &m) {
        return m.text == "T blue, LP orange (no relation)";
    }));
    s.p.time = -1.0, s.p.x.count = s.p.y.count = 0; // described, and not begun
    expect({"waiting for its first message", "a scene: 10 disks"});
}
