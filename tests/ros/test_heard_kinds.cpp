/** What of a run of spheres and of dumbbells is drawn: messages heard -> a picture. */
#include <functional>

#include "hearing.hpp"

namespace
{
/** A run of spheres in a box that is so high, or of dumbbells, and messages that fit it: of slow
 * vectors LP(0,0,1) with eight pairs and T(0,1,1), or T(1,0) and LP(0,1). */
struct hearing_kind : hearing {
    const bool solid;
    const uint32_t none[2] = {0, 0}, z[2] = {1, 1}, nz[2] = {0, 1};
    const uint8_t kind[2], pairs[2];

    explicit hearing_kind(bool is_solid, const char *boundary = "periodic", double height = 10.0)
        : hearing(boundary), solid(is_solid), kind{uint8_t(solid ? HDR_MODE_LP : HDR_MODE_T),
                                                   uint8_t(solid ? HDR_MODE_T : HDR_MODE_LP)},
          pairs{uint8_t(solid ? 8 : 0), uint8_t(solid ? 0 : 2)}
    {
        heard_clear(&h);
        if (solid) {
            info.dimension = 3, info.box_z = height, set("boundary_z", boundary);
            info.wave_nz = {nz, 2};
        } else {
            set("particles", "dumbbells"), info.inertia = 0.25, info.sites = array(2);
            set("inertia", "disks", true), set("bond", "0.75", true);
        }
        EXPECT_TRUE(heard_run_info(&h, &info));
    }

    /** Places, and what the kind has beside them, counted from `from`. */
    template <typename message> message of_all(double time, uint32_t from)
    {
        message m = {};
        m.run_id = "run", m.sim_time = time;
        m.x = array(DISKS, from), m.y = array(DISKS, from + 10);
        if (solid) m.z = array(DISKS, from + 50);
        if (!solid) m.angle = array(DISKS, from + 20), m.spin = array(DISKS, from + 30);
        return m;
    }

    hdr_state state_of(double time) { return of_all<hdr_state>(time, 0); }

    hdr_mode_field field_of(double time)
    {
        hdr_mode_field m = of_all<hdr_mode_field>(time, 1);
        m.kind = HDR_MODE_T, m.nx = !solid, m.nz = solid, m.index = 7, m.exponent = 1.5;
        m.dqx = array(DISKS, 7), m.dqy = array(DISKS, 40);
        (solid ? m.dqz : m.dq_angle) = array(DISKS, 75);
        return m;
    }

    hdr_slow_vectors slow_of(double time)
    {
        hdr_slow_vectors m = of_all<hdr_slow_vectors>(time, 2);
        m.first_index = 6, m.vectors = 2;
        m.exponents = array(2), m.kind = {kind, 2}, m.pairs = {pairs, 2};
        m.nx = {solid ? none : nx, 2}, m.ny = {ny, 2};
        if (solid) m.nz = {z, 2};
        m.a = array(solid ? 16 : 8), m.b = array(solid ? 16 : 8, 20);
        m.dqx = array(6, 50), m.dqy = array(6, 60);
        (solid ? m.dqz : m.dq_angle) = array(6, 84);
        return m;
    }

    void hear(const hdr_state &m) { heard_state(&h, &m); }
    void hear(const hdr_mode_field &m) { heard_mode_field(&h, &m); }
    void hear(const hdr_slow_vectors &m) { heard_slow_vectors(&h, &m); }
};

/** Whether anything of a message is heard that was changed. */
template <typename message>
bool is_heard(bool solid, message m, const std::function<void(message &)> &change)
{
    hearing_kind on(solid);
    change(m);
    on.hear(m);
    return on.h.time == m.sim_time;
}
} // namespace

TEST(heard, spheres_have_a_third_coordinate)
{
    hearing_kind on(true);
    EXPECT_EQ(-1.0, on.h.time); // before the first message
    on.hear(on.state_of(9.0));
    picture p = on.drawn();
    EXPECT_TRUE(heard_has_spheres(p.run));
    EXPECT_TRUE(p.run->box[2] == 10.0 && p.run->periodic[2]);
    EXPECT_TRUE(p.run->q[0].z == 0.50 && p.run->q[2].z == 0.52);
    on.hear(on.field_of(10.0));
    p = on.drawn();
    EXPECT_STREQ("T(0,0,1)", p.mode[0].name);
    ASSERT_TRUE(p.mode[0].d);
    EXPECT_TRUE(p.run->q[0].z == 0.51 && p.run->at[1].z == 0.52);
    EXPECT_TRUE(p.mode[0].d[0].x == 0.07 && p.mode[0].d[0].y == 0.40);
    EXPECT_TRUE(p.mode[0].d[0].z == 0.75 && p.mode[0].d[2].z == 0.77);
    on.hear(on.slow_of(12.5));
    p = on.drawn();
    EXPECT_STREQ("T(0,1,1)", p.mode[0].name);
    EXPECT_STREQ("LP(0,0,1)", p.mode[1].name);
    EXPECT_TRUE(p.run->q[0].z == 0.52 && p.run->at[2].z == 0.54);
    EXPECT_TRUE(p.mode[0].d[0].x == 0.53 && p.mode[0].d[0].y == 0.63);
    EXPECT_TRUE(p.mode[0].d[0].z == 0.87 && p.mode[1].d[0].z == 0.84);
    ASSERT_EQ(8u, p.mode[1].lp.pairs);
    EXPECT_TRUE(p.mode[1].lp.a[7] == 0.07 && p.mode[1].lp.b[7] == 0.27);
    double l = 0.0, all = 0.0;
    for (int k = 0; k < 8; k++) l += std::pow(0.01 * k, 2), all += std::pow(0.01 * (20 + k), 2);
    EXPECT_DOUBLE_EQ(all / (l + all), p.mode[1].momentum);
}

TEST(heard, dumbbells_have_angles)
{
    hearing_kind on(false);
    EXPECT_STREQ("dumbbells", on.h.particles);
    EXPECT_STREQ("inertia disks, bond 0.75", on.h.own);
    EXPECT_TRUE(on.h.sites == 2 && on.h.site[0] == 0.0 && on.h.site[1] == 0.01);
    EXPECT_EQ(0.25, on.h.inertia);
    on.hear(on.state_of(1.0));
    EXPECT_TRUE(on.h.time == 1.0 && on.h.angle[2] == 0.22 && on.h.spin[1] == 0.31);
    on.hear(on.field_of(2.0));
    EXPECT_TRUE(on.h.time == 2.0 && on.h.angle[2] == 0.23 && on.h.spin[1] == 0.32);
    ASSERT_EQ(2, on.drawn().modes);
    EXPECT_EQ(0.77, on.drawn().mode[0].turn[2]);
    on.hear(on.slow_of(2.5));
    EXPECT_TRUE(on.h.time == 2.5 && on.h.angle[2] == 0.24 && on.h.spin[1] == 0.33);
    EXPECT_EQ(0.84, on.drawn().mode[0].turn[0]);
    EXPECT_EQ(0.89, on.drawn().mode[1].turn[2]);
}

/** Of each particle, as many as its kind has; else nothing of it is taken. */
TEST(heard, what_is_not_of_each_is_passed_over)
{
    using states = std::function<void(hdr_state &)>;
    using fields = std::function<void(hdr_mode_field &)>;
    using slows = std::function<void(hdr_slow_vectors &)>;
    hearing_kind balls(true), bars(false);
    for (hearing_kind *on : {&balls, &bars}) {
        EXPECT_TRUE(is_heard<hdr_state>(on->solid, on->state_of(9.0), [](hdr_state &) {}));
        EXPECT_TRUE(
            is_heard<hdr_mode_field>(on->solid, on->field_of(9.0), [](hdr_mode_field &) {}));
        EXPECT_FALSE(is_heard<hdr_state>(!on->solid, on->state_of(9.0), [](hdr_state &) {}));
    }
    hearing disks;
    const hdr_state of_bars = bars.state_of(9.0);
    heard_state(&disks.h, &of_bars);
    EXPECT_EQ(-1.0, disks.h.time);
    for (const uint32_t count : {0u, DISKS - 1, DISKS + 1})
        EXPECT_FALSE(is_heard<hdr_state>(true, balls.state_of(9.0),
                                         [&](hdr_state &m) { m.z.count = count; }));
    for (const states &change : {states([](hdr_state &m) { m.angle.count--; }),
                                 states([](hdr_state &m) { m.spin.count--; })})
        EXPECT_FALSE(is_heard(false, bars.state_of(9.0), change));
    for (const fields &change : {fields([](hdr_mode_field &m) { m.dqz.count = 0; }),
                                 fields([](hdr_mode_field &m) { m.z.count = 2; })})
        EXPECT_FALSE(is_heard(true, balls.field_of(9.0), change));
    EXPECT_FALSE(is_heard<hdr_mode_field>(false, bars.field_of(9.0),
                                          [](hdr_mode_field &m) { m.dq_angle.count = 0; }));
    for (const slows &change :
         {slows([](hdr_slow_vectors &m) { m.a.count = m.b.count = 8; }), // as disks have them
          slows([](hdr_slow_vectors &m) { m.nz.count = 0; }),
          slows([](hdr_slow_vectors &m) { m.dqz.count = 0; }),
          slows([](hdr_slow_vectors &m) { m.dqz.count = 5; }),
          slows([](hdr_slow_vectors &m) { m.z.count = 2; })})
        EXPECT_FALSE(is_heard(true, balls.slow_of(9.0), change));
    EXPECT_FALSE(is_heard<hdr_slow_vectors>(false, bars.slow_of(9.0),
                                            [](hdr_slow_vectors &m) { m.dq_angle.count = 3; }));
    hdr_slow_vectors m = balls.slow_of(2.5);
    m.dqx.count = m.dqy.count = m.dqz.count = 0; // at rest
    balls.hear(m);
    EXPECT_TRUE(balls.h.time == 2.5 && !balls.drawn().mode[0].d);
}

/** Without a box of spheres all is as of disks. */
TEST(heard, a_box_without_height_is_of_disks)
{
    hearing_kind flat(true, "periodic", 0.0);
    flat.hear(flat.state_of(9.0));
    EXPECT_EQ(-1.0, flat.h.time);
    flat.state(9.0);
    EXPECT_EQ(9.0, flat.h.time);
    const picture p = flat.drawn();
    EXPECT_TRUE(!heard_has_spheres(p.run) && p.run->q[0].z == 0.0 && !p.run->periodic[2]);
    flat.info.run_id = "disks", flat.info.dimension = 2, flat.info.box_z = 10.0;
    EXPECT_TRUE(heard_run_info(&flat.h, &flat.info));
    EXPECT_EQ(0.0, flat.h.box[2]);
}

/** Steps, vectors and phases that only nz tells apart. */
TEST(heard, waves_along_z_are_waves_of_their_own)
{
    hearing_kind on(true);
    on.step = {a_step(HDR_MODE_LP, 1, 0, 0.6, 7, 8, 1.5, 0.25),
               a_step(HDR_MODE_LP, 1, 0, 0.9, 5, 6, 1.8, 0.5)};
    on.step[1].nz = 1;
    hdr_steps steps = {};
    steps.run_id = "run", steps.steps = {on.step.data(), 2};
    heard_steps(&on.h, &steps);
    on.lowest.count = 3;
    const char *const names[] = {"LP(1,0,1)", "LP(1,0)", "LP(1,0,2)"};
    for (int k = 0; k < 3; k++) ASSERT_TRUE(mode_name_parse(&on.lowest.mode[k], names[k]));
    hdr_mode_field field = on.field_of(10.0);
    field.kind = HDR_MODE_LP, field.nx = 1, field.index = 5;
    heard_mode_field(&on.h, &field);
    on.phase(10.0, 0.5, -0.25); // of LP(0,1,0)
    picture p = on.drawn();
    EXPECT_STREQ("LP(1,0,1)", p.mode[0].name);
    EXPECT_TRUE(p.mode[0].exponent == 1.8 && p.mode[0].d && p.mode[0].lp.pairs == 0);
    EXPECT_STREQ("LP(1,0,0)", p.mode[1].name);
    EXPECT_STREQ("LP(1,0,0)", p.mode[1].box);
    EXPECT_TRUE(p.mode[1].exponent == 1.5 && !p.mode[1].d && !p.mode[1].absent);
    EXPECT_TRUE(p.mode[2].absent);
    hdr_lp_phase phase = {};
    phase.nx = 1, phase.index = 5, phase.a = 0.75;
    hdr_lp_phases phases = {};
    phases.run_id = "run", phases.phases = {&phase, 1}, phases.sample_time = 10.0;
    heard_lp_phases(&on.h, &phases); // of LP(1,0,0)
    EXPECT_EQ(0u, on.drawn().mode[0].lp.pairs);
    phase.nz = 1;
    heard_lp_phases(&on.h, &phases);
    p = on.drawn();
    EXPECT_TRUE(p.mode[0].lp.pairs == 1 && p.mode[0].lp.a[0] == 0.75);
}

/** Two directions along which something may go, of spheres too. */
TEST(heard, only_transverse_modes_that_there_can_be)
{
    hearing_kind free(true), walls(true, "reflecting"); // y and z
    EXPECT_TRUE(free.h.has_t && walls.h.has_t);
    walls.info.run_id = "short", walls.info.wave_nx.count = walls.info.wave_ny.count = 1;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info)); // (1,0,0) alone
    EXPECT_FALSE(walls.h.has_t);
    walls.info.run_id = "open", walls.set("boundary_z", "periodic");
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_TRUE(walls.h.has_t);
}

TEST(heard, names_of_modes_of_spheres)
{
    mode_name name = {};
    EXPECT_TRUE(mode_name_parse(&name, "T(12,3,9999)"));
    EXPECT_TRUE(name.kind == HDR_MODE_T && name.nx == 12 && name.ny == 3 && name.nz == 9999);
    EXPECT_TRUE(mode_name_parse(&name, "T(12,3)"));
    EXPECT_EQ(0u, name.nz);
    for (const char *text : {"T(1,0,)", "T(1,0,0,0)", "T(1,0,0", "T(1,0,0)x", "T(1,,0)"})
        EXPECT_FALSE(mode_name_parse(&name, text)) << text;
    hearing disks; // have no such mode, and it is named as it was asked for
    disks.steps(true);
    disks.lowest.count = 1;
    ASSERT_TRUE(mode_name_parse(&disks.lowest.mode[0], "T(1,0,1)"));
    const picture p = disks.drawn();
    EXPECT_STREQ("T(1,0,1)", p.mode[0].name);
    EXPECT_TRUE(p.mode[0].absent);
}

/** In words; numbers in four digits. */
TEST(heard, others_say_their_own)
{
    hearing on;
    heard_clear(&on.h);
    on.set("particles", "soft_disks"), on.set("potential", "lennard_jones", true);
    on.set("energy", "1", true), on.set("time_step", "0.0044274919805363921", true);
    ASSERT_TRUE(heard_run_info(&on.h, &on.info));
    EXPECT_STREQ("soft disks", on.h.particles);
    EXPECT_STREQ("potential lennard jones, energy 1, time step 0.004427", on.h.own);
}

TEST(heard, walls_that_shear_say_how_much)
{
    hearing on;
    heard_clear(&on.h);
    on.set("boundary_y", "shearing"), on.set("shear_b", "2.5");
    ASSERT_TRUE(heard_run_info(&on.h, &on.info));
    EXPECT_STREQ("", on.h.wall[0]);
    EXPECT_STREQ("shearing, shear b 2.5", on.h.wall[1]);
}

/** Anybody's bag: no more disks than there is room for. */
TEST(heard, sites_fit)
{
    hearing on;
    on.info.sites = on.array(100);
    heard_clear(&on.h);
    EXPECT_TRUE(heard_run_info(&on.h, &on.info));
    EXPECT_EQ(HEARD_SITES_MAX, on.h.sites);
}

/** Of each kind in its size, displaced as its mass has it; kinds beyond the number of particles,
 * and particles beyond those of the kinds, as far as they go. */
TEST(heard, kinds_of_a_mixture)
{
    const double diameter[] = {1.0, 1.4}, mass[] = {1.0, 4.0};
    const uint32_t wrong[][2] = {{1, 2}, {1, 9}, {1, 0}, {9, 2}}, size[] = {1, 1, 1, 3};
    for (int k = 0; k < 4; k++) {
        hearing on;
        on.info.kind_numbers = {wrong[k], 2};
        on.info.kind_diameters = {diameter, 2, 1}, on.info.kind_masses = {mass, 2, 1};
        heard_clear(&on.h);
        ASSERT_TRUE(heard_run_info(&on.h, &on.info));
        ASSERT_EQ(2, on.h.kinds);
        EXPECT_TRUE(on.h.kind[0].end == size[k] && on.h.kind[1].end == DISKS);
        on.steps(true);
        on.field(1.0, HDR_MODE_T, 1, 7);
        const picture p = on.drawn();
        for (uint32_t i = 0; i < DISKS; i++) {
            const double root = i < size[k] ? 1.0 : 2.0;
            EXPECT_DOUBLE_EQ((0.07 + 0.01 * i) / root, p.mode[0].d[i].x);
            EXPECT_DOUBLE_EQ((0.4 + 0.01 * i) / root, p.mode[0].d[i].y);
        }
        const auto drawn_ones = drawn::in(drawn::drawing().of(p), "disks",
                                          drawn::Marker::SPHERE_LIST);
        size_t points = 0;
        for (const drawn::Marker &one : drawn_ones) {
            const bool second = std::abs(one.scale.x - 1.4) < 1e-9;
            EXPECT_TRUE(second || one.scale.x == 1.0);
            EXPECT_EQ(p.modes * (second ? DISKS - size[k] : size[k]), one.points.size());
            points += one.points.size();
        }
        EXPECT_EQ(p.modes * DISKS, points);
    }
}
