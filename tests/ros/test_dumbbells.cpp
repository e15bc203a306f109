/** Pictures of dumbbells: both disks, the bond, how they turn. */
#include "drawn.hpp"

using namespace drawn;

namespace
{
const float LEFT[3] = {0.50F, 0.75F, 0.48F}, RIGHT[3] = {0.69F, 0.55F, 0.76F}, GREY = 0.86F;

/** From grey to the colour of its sign, in four shades. */
void expect_colour(const std_msgs::ColorRGBA &found, double part)
{
    const float *full = part > 0.0 ? LEFT : RIGHT;
    const float p = std::round(4 * std::min(1.0, std::abs(part))) / 4;
    EXPECT_NEAR(GREY + p * (full[0] - GREY), found.r, 1e-5);
    EXPECT_NEAR(GREY + p * (full[1] - GREY), found.g, 1e-5);
    EXPECT_NEAR(GREY + p * (full[2] - GREY), found.b, 1e-5);
    EXPECT_EQ(1.0F, found.a);
}

struct disk {
    geometry_msgs::Point at;
    std_msgs::ColorRGBA colour;
};

/** Both of each dumbbell, of panel after panel, wherever they are in the markers. */
std::vector<disk> disks_of(const MarkerArray &array, const dumbbells &s)
{
    std::vector<disk> all, found;
    for (const Marker &m : in(array, "dumbbells", Marker::SPHERE_LIST)) {
        EXPECT_EQ(1.0, m.scale.x);     // sigma
        EXPECT_TRUE(m.colors.empty()); // they would be as of glass
        for (const auto &point : m.points) all.push_back({point, m.color});
    }
    const std::vector<Marker> box = in(array, "box", Marker::LINE_LIST);
    for (size_t corner = 0; corner < box.at(0).points.size(); corner += 8)
        for (size_t i = 0; i < s.angle.size(); i++)
            for (const int side : {1, -1}) {
                const auto &origin = box[0].points[corner];
                const double x = s.q[2 * i] + side * 0.25 * std::cos(s.angle[i]) + origin.x,
                             y = s.q[2 * i + 1] + side * 0.25 * std::sin(s.angle[i]) + origin.y;
                for (const disk &one : all)
                    if (std::hypot(one.at.x - x, one.at.y - y) < 1e-9) found.push_back(one);
            }
    EXPECT_EQ(all.size(), found.size());
    return found;
}

std::string caption(const MarkerArray &array)
{
    return in(array, "caption", Marker::TEXT_VIEW_FACING).at(0).text;
}
} // namespace

/** Half a bond from the middle each, under the arrows, with the bond between them above the disks;
 * of both panels. */
TEST(dumbbells, have_two_disks_and_a_bond)
{
    dumbbells s(20.0, 10.0, 40, 2, 2);
    const MarkerArray array = drawing().of(s.p);
    const std::vector<disk> disks = disks_of(array, s);
    const Marker bonds = in(array, "dumbbells", Marker::LINE_LIST).at(0);
    ASSERT_EQ(160u, disks.size());
    ASSERT_EQ(160u, bonds.points.size());
    EXPECT_TRUE(in(array, "disks", Marker::SPHERE_LIST).empty());
    for (int k = 0; k < 160; k++) {
        const auto &end = bonds.points[k ^ 1];
        EXPECT_NEAR(disks[k].at.x, end.x, 1e-9);
        EXPECT_NEAR(disks[k].at.y, end.y, 1e-9);
        EXPECT_LT(disks[k].at.z, -0.5);
        EXPECT_GT(end.z, disks[k].at.z + 0.5);
        EXPECT_LT(end.z, 0.0); // of a picture in the plane, and below the arrows
    }
}

/** Twice the thermal spin, kT being 2/3, has the full colour; beyond that there is none. */
TEST(dumbbells, colours_say_the_spin)
{
    dumbbells s(20.0, 10.0, 40, 0, 2);
    s.spin[0] = 100.0, s.spin[1] = -100.0;
    const MarkerArray array = drawing().of(s.p);
    const std::vector<disk> disks = disks_of(array, s);
    ASSERT_EQ(80u, disks.size());
    for (int k = 0; k < 80; k++)
        expect_colour(disks[k].colour, s.spin[k / 2] / (2 * std::sqrt(2.0 / 3 / 0.1875)));
    EXPECT_EQ(
        "a scene: 40 dumbbells, x reflecting, y reflecting\n"
        "t = 12.5, averaging (25 %)\ngreen: the particle spins to the left, purple: to the right",
        caption(array));
}

/** Its strength counts what turns, too: arrows get shorter, and what is as strong as the whole has
 * the full colour. */
TEST(dumbbells, colours_say_how_a_vector_turns)
{
    dumbbells s(20.0, 15.0, 60, 2, 3);
    drawing on;
    const MarkerArray array = on.of(s.p);
    const std::vector<disk> disks = disks_of(array, s);
    const std::vector<arrow> arrows = arrows_of(
        in(array, "mode/T(0,0)", Marker::TRIANGLE_LIST).at(0));
    double square[2] = {0, 0};
    for (int i = 0; i < 120; i++)
        square[i / 60] += std::pow(s.vectors[2 * i], 2) + std::pow(s.vectors[2 * i + 1], 2) +
                          std::pow(s.turn[i], 2);
    ASSERT_EQ(240u, disks.size());
    for (int k = 0; k < 240; k++)
        expect_colour(disks[k].colour, s.turn[k / 2] / std::sqrt(square[k / 120] / 60));
    const double factor = 1.3 * std::sqrt(20.0 * 15.0 / 60) / std::sqrt(square[0] / 60);
    for (int i = 0; i < 60; i++) EXPECT_NEAR(factor * s.vectors[2 * i], arrows[i].dx, 1e-9);
    EXPECT_NE(std::string::npos,
              caption(array).find("\ngreen: the vector turns the particle to the left"));
    s.p.mode[1].d = nullptr; // not known: the spin
    const MarkerArray half = on.of(s.p);
    const std::vector<disk> of_both = disks_of(half, s);
    ASSERT_EQ(240u, of_both.size());
    for (int k = 0; k < 120; k++) {
        EXPECT_EQ(disks[k].colour, of_both[k].colour);
        expect_colour(of_both[120 + k].colour, s.spin[k / 2] / (2 * std::sqrt(2.0 / 3 / 0.1875)));
    }
    EXPECT_NE(std::string::npos, caption(half).find("or without one the spin"));
}

/** What turns and is no dumbbell is one disk. */
TEST(dumbbells, others_that_turn_are_disks)
{
    dumbbells s(20.0, 15.0, 60, 1, 3);
    s.h.sites = 0;
    std::snprintf(s.h.particles, sizeof s.h.particles, "rotors");
    const MarkerArray array = drawing().of(s.p);
    std::multiset<double> places, wanted;
    for (const Marker &m : in(array, "disks", Marker::SPHERE_LIST))
        for (const auto &point : m.points) places.insert(point.x);
    for (int i = 0; i < 60; i++) wanted.insert(s.q[2 * i]);
    EXPECT_EQ(wanted, places);
    EXPECT_LT(1u, in(array, "disks", Marker::SPHERE_LIST).size()); // coloured
    EXPECT_TRUE(in(array, "disks", Marker::LINE_LIST).empty());
    EXPECT_EQ(0u, caption(array).find("a scene: 60 rotors, x"));
}

TEST(dumbbells, rviz_takes_every_picture)
{
    for (const double shape : {0.01, 1.0, 80.0})
        for (const int modes : {0, 1, 8})
            for (const int count : {1, 50}) {
                dumbbells s(30.0 / std::sqrt(shape), 30.0 * std::sqrt(shape), count, modes, 1);
                expect_shown(drawing().of(s.p));
                std::fill(s.turn.begin(), s.turn.end(), 0.0);
                std::fill(s.vectors.begin(), s.vectors.end(), 0.0);
                s.point();
                expect_shown(drawing().of(s.p));
                s.h.time = -1.0; // described, and not begun
                expect_shown(drawing().of(s.p));
            }
}
