/** What of a run of spheres is drawn: messages heard -> a picture. */
#include "hearing.hpp"

namespace
{
/** Of spheres in a box that is as high as wide. */
struct hearing_spheres : hearing {
    const uint32_t nz[2] = {0, 1};

    explicit hearing_spheres(const char *boundary = "periodic", double height = 10.0)
        : hearing(boundary)
    {
        heard_clear(&h);
        info.dimension = 3, info.box_z = height, info.boundary_z = boundary;
        info.wave_nz = {nz, 2};
        EXPECT_TRUE(heard_run_info(&h, &info));
    }

    void state(double time, uint32_t count)
    {
        hdr_state message = {};
        message.run_id = "run", message.sim_time = time;
        message.x = array(DISKS), message.y = array(DISKS, 10), message.z = array(count, 50);
        heard_state(&h, &message);
    }

    hdr_mode_field field_message(double time)
    {
        hdr_mode_field message = {};
        message.run_id = "run", message.sim_time = time, message.kind = HDR_MODE_T;
        message.nz = 1, message.index = 7, message.exponent = 1.5;
        message.x = array(DISKS, 20), message.y = array(DISKS, 30), message.z = array(DISKS, 60);
        message.dqx = array(DISKS, 7), message.dqy = array(DISKS, 40);
        message.dqz = array(DISKS, 75);
        return message;
    }
};

/** Of LP(0,0,1) with eight pairs, and of T(0,1,1). */
struct slow_spheres : hearing_spheres {
    const uint8_t kind[2] = {HDR_MODE_LP, HDR_MODE_T}, pairs[2] = {8, 0};
    const uint32_t none[2] = {0, 0}, y[2] = {0, 1}, z[2] = {1, 1};

    hdr_slow_vectors message()
    {
        hdr_slow_vectors m = {};
        m.run_id = "run", m.sim_time = 2.5, m.first_index = 6, m.vectors = 2;
        m.x = array(DISKS), m.y = array(DISKS, 10), m.z = array(DISKS, 20);
        m.exponents = array(2), m.kind = {kind, 2}, m.pairs = {pairs, 2};
        m.nx = {none, 2}, m.ny = {y, 2}, m.nz = {z, 2};
        m.a = array(16), m.b = array(16, 20);
        m.dqx = array(6, 50), m.dqy = array(6, 60), m.dqz = array(6, 84);
        return m;
    }
};
} // namespace

TEST(heard, spheres_have_a_third_coordinate)
{
    hearing_spheres on;
    EXPECT_EQ(-1.0, on.h.time); // before the first message
    on.state(9.0, DISKS);
    picture p = on.drawn();
    EXPECT_TRUE(heard_has_spheres(p.run));
    EXPECT_TRUE(p.run->box[2] == 10.0 && p.run->periodic[2]);
    EXPECT_TRUE(p.run->q[0].z == 0.50 && p.run->q[2].z == 0.52);
    const hdr_mode_field field = on.field_message(10.0);
    heard_mode_field(&on.h, &field);
    p = on.drawn();
    EXPECT_STREQ("T(0,0,1)", p.mode[0].name);
    ASSERT_TRUE(p.mode[0].d);
    EXPECT_TRUE(p.run->q[0].z == 0.60 && p.run->at[1].z == 0.61);
    EXPECT_TRUE(p.mode[0].d[0].x == 0.07 && p.mode[0].d[0].y == 0.40);
    EXPECT_TRUE(p.mode[0].d[0].z == 0.75 && p.mode[0].d[2].z == 0.77);
}

TEST(heard, numbers_along_z_that_do_not_fit)
{
    hearing_spheres on;
    for (const uint32_t count : {0u, DISKS - 1, DISKS + 1}) on.state(9.0, count);
    EXPECT_EQ(-1.0, on.h.time);
    hdr_mode_field field = on.field_message(10.0);
    field.dqz.count = 0;
    heard_mode_field(&on.h, &field);
    field = on.field_message(10.0);
    field.z.count = 2;
    heard_mode_field(&on.h, &field);
    EXPECT_TRUE(on.h.time == -1.0 && !on.drawn().mode[0].d);
    hearing_spheres flat("periodic", 0.0); // no box of spheres: as disks
    flat.state(9.0, DISKS);
    EXPECT_EQ(-1.0, flat.h.time);
    flat.state(9.0, 0);
    EXPECT_EQ(9.0, flat.h.time);
    const picture p = flat.drawn();
    EXPECT_TRUE(!heard_has_spheres(p.run) && p.run->q[0].z == 0.0 && !p.run->periodic[2]);
    flat.info.run_id = "disks", flat.info.dimension = 2, flat.info.box_z = 10.0;
    EXPECT_TRUE(heard_run_info(&flat.h, &flat.info));
    EXPECT_EQ(0.0, flat.h.box[2]);
}

TEST(heard, slow_vectors_of_spheres)
{
    slow_spheres on;
    const hdr_slow_vectors m = on.message();
    heard_slow_vectors(&on.h, &m);
    const picture p = on.drawn();
    EXPECT_STREQ("T(0,1,1)", p.mode[0].name);
    EXPECT_STREQ("LP(0,0,1)", p.mode[1].name);
    EXPECT_TRUE(p.run->q[0].z == 0.20 && p.run->at[2].z == 0.22);
    EXPECT_TRUE(p.mode[0].d[0].x == 0.53 && p.mode[0].d[0].y == 0.63);
    EXPECT_TRUE(p.mode[0].d[0].z == 0.87 && p.mode[1].d[0].z == 0.84);
    ASSERT_EQ(8u, p.mode[1].lp.pairs);
    EXPECT_TRUE(p.mode[1].lp.a[7] == 0.07 && p.mode[1].lp.b[7] == 0.27);
    double l = 0.0, all = 0.0;
    for (int k = 0; k < 8; k++) l += std::pow(0.01 * k, 2), all += std::pow(0.01 * (20 + k), 2);
    EXPECT_DOUBLE_EQ(all / (l + all), p.mode[1].momentum);
}

TEST(heard, slow_vectors_of_spheres_that_do_not_fit)
{
    slow_spheres on;
    hdr_slow_vectors m = on.message();
    const auto is_heard = [&] {
        heard_slow_vectors(&on.h, &m);
        m = on.message();
        return on.h.time == 2.5;
    };
    m.a.count = m.b.count = 8; // as disks have them
    EXPECT_FALSE(is_heard());
    m.nz.count = 0;
    EXPECT_FALSE(is_heard());
    m.dqz.count = 0;
    EXPECT_FALSE(is_heard());
    m.dqz.count = 5;
    EXPECT_FALSE(is_heard());
    m.z.count = 2;
    EXPECT_FALSE(is_heard());
    m.dqx.count = m.dqy.count = m.dqz.count = 0; // at rest
    EXPECT_TRUE(is_heard());
    EXPECT_FALSE(on.drawn().mode[0].d);
}

/** Steps, vectors and phases that only nz tells apart. */
TEST(heard, waves_along_z_are_waves_of_their_own)
{
    hearing_spheres on;
    on.step = {a_step(HDR_MODE_LP, 1, 0, 0.6, 7, 8, 1.5, 0.25),
               a_step(HDR_MODE_LP, 1, 0, 0.9, 5, 6, 1.8, 0.5)};
    on.step[1].nz = 1;
    hdr_steps steps = {};
    steps.run_id = "run", steps.steps = {on.step.data(), 2};
    heard_steps(&on.h, &steps);
    on.lowest.count = 3;
    const char *const names[] = {"LP(1,0,1)", "LP(1,0)", "LP(1,0,2)"};
    for (int k = 0; k < 3; k++) ASSERT_TRUE(mode_name_parse(&on.lowest.mode[k], names[k]));
    hdr_mode_field field = on.field_message(10.0);
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
    hearing_spheres free, walls("reflecting"); // y and z
    EXPECT_TRUE(free.h.has_t && walls.h.has_t);
    walls.info.run_id = "short", walls.info.wave_nx.count = walls.info.wave_ny.count = 1;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info)); // (1,0,0) alone
    EXPECT_FALSE(walls.h.has_t);
    walls.info.run_id = "open", walls.info.boundary_z = "periodic";
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
