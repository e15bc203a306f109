/** Pictures of dumbbells: both disks, the bond, how they turn; and what is heard of them. */
#include "hearing.hpp"

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
        "a scene: 40 dumbbells of bond 0.5, x reflecting, y reflecting\n"
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
    s.h.bond = 0.0;
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

namespace
{
struct hearing_dumbbells : hearing {
    const char *const own[2] = {"inertia=disks", "bond=0.75"};
    const uint8_t kind[2] = {HDR_MODE_T, HDR_MODE_LP}, pairs[2] = {0, 2};
    const uint32_t x[2] = {1, 0}, y[2] = {0, 1};

    hearing_dumbbells()
    {
        heard_clear(&h);
        info.particles = "dumbbells", info.inertia = 0.25, info.own = {own, 2};
        EXPECT_TRUE(heard_run_info(&h, &info));
    }

    hdr_state state(double time)
    {
        hdr_state m = {};
        m.run_id = "run", m.sim_time = time;
        m.x = array(DISKS), m.y = array(DISKS, 10);
        m.angle = array(DISKS, 20), m.spin = array(DISKS, 30);
        return m;
    }

    hdr_mode_field field(double time)
    {
        hdr_mode_field m = {};
        m.run_id = "run", m.sim_time = time, m.kind = HDR_MODE_T, m.nx = 1, m.index = 7;
        m.x = array(DISKS, 1), m.y = array(DISKS, 11);
        m.angle = array(DISKS, 21), m.spin = array(DISKS, 31);
        m.dqx = array(DISKS, 40), m.dqy = array(DISKS, 50), m.dq_angle = array(DISKS, 60);
        return m;
    }

    hdr_slow_vectors slow()
    {
        hdr_slow_vectors m = {};
        m.run_id = "run", m.sim_time = 2.5, m.first_index = 6, m.vectors = 2;
        m.x = array(DISKS, 2), m.y = array(DISKS, 12);
        m.angle = array(DISKS, 22), m.spin = array(DISKS, 32);
        m.exponents = array(2), m.kind = {kind, 2}, m.pairs = {pairs, 2};
        m.nx = {x, 2}, m.ny = {y, 2}, m.a = array(8), m.b = array(8, 20);
        m.dqx = array(6, 50), m.dqy = array(6, 60), m.dq_angle = array(6, 84);
        return m;
    }
};
} // namespace

TEST(dumbbells, are_heard_of)
{
    hearing_dumbbells on;
    EXPECT_STREQ("dumbbells", on.h.particles);
    EXPECT_TRUE(on.h.bond == 0.75 && on.h.inertia == 0.25);
    hdr_state state = on.state(1.0);
    heard_state(&on.h, &state);
    EXPECT_TRUE(on.h.time == 1.0 && on.h.angle[2] == 0.22 && on.h.spin[1] == 0.31);
    hdr_mode_field field = on.field(2.0);
    heard_mode_field(&on.h, &field);
    EXPECT_TRUE(on.h.time == 2.0 && on.h.angle[2] == 0.23 && on.h.spin[1] == 0.32);
    ASSERT_EQ(2, on.drawn().modes);
    EXPECT_EQ(0.62, on.drawn().mode[0].turn[2]);
    const hdr_slow_vectors slow = on.slow();
    heard_slow_vectors(&on.h, &slow);
    EXPECT_TRUE(on.h.time == 2.5 && on.h.angle[2] == 0.24 && on.h.spin[1] == 0.33);
    EXPECT_EQ(0.84, on.drawn().mode[0].turn[0]);
    EXPECT_EQ(0.89, on.drawn().mode[1].turn[2]);
}

/** Of each dumbbell, and of no disk; else nothing of it is taken. */
TEST(dumbbells, what_is_not_of_each_is_passed_over)
{
    hearing_dumbbells on;
    for (int k = 0; k < 2; k++) {
        hdr_state state = on.state(1.0);
        (k ? state.spin : state.angle).count--;
        heard_state(&on.h, &state);
        EXPECT_EQ(-1.0, on.h.time);
    }
    hdr_mode_field field = on.field(2.0);
    field.dq_angle.count = 0;
    heard_mode_field(&on.h, &field);
    EXPECT_EQ(0, on.h.vectors);
    hdr_slow_vectors slow = on.slow();
    slow.dq_angle.count = 3;
    heard_slow_vectors(&on.h, &slow);
    EXPECT_EQ(-1.0, on.h.time);
    hearing flat;
    const hdr_state state = on.state(1.0);
    heard_state(&flat.h, &state);
    EXPECT_EQ(-1.0, flat.h.time);
}

/** In words; numbers in four digits. */
TEST(dumbbells, others_say_their_own)
{
    hearing on;
    static const char *const own[] = {"potential=lennard_jones", "energy=1",
                                      "time_step=0.0044274919805363921"};
    heard_clear(&on.h);
    on.info.particles = "soft_disks", on.info.own = {own, 3};
    ASSERT_TRUE(heard_run_info(&on.h, &on.info));
    EXPECT_STREQ("soft disks", on.h.particles);
    EXPECT_STREQ("potential lennard jones, energy 1, time step 0.004427", on.h.own);
    EXPECT_STREQ("", hearing_dumbbells().h.own);
}

/** Anybody's bag: no length that cannot be drawn, and none of what only has that name. */
TEST(dumbbells, a_bond_is_a_number_of_dumbbells)
{
    hearing on;
    for (const char *text : {"bond=inf", "bond=nan", "bond=", "bonds=2", "bond"}) {
        const char *const own[1] = {text};
        heard_clear(&on.h);
        on.info.particles = "dumbbells", on.info.own = {own, 1};
        EXPECT_TRUE(heard_run_info(&on.h, &on.info));
        EXPECT_EQ(0.0, on.h.bond) << text;
    }
    const char *const own[1] = {"bond=2"};
    heard_clear(&on.h);
    on.info.particles = "springs", on.info.own = {own, 1};
    EXPECT_TRUE(heard_run_info(&on.h, &on.info));
    EXPECT_EQ(0.0, on.h.bond);
}
