/** What of a run is drawn: messages heard -> a picture. */
#include "hearing.hpp"

namespace
{
std::vector<drawn::Marker> disks_of(const picture &p)
{
    return drawn::in(drawn::drawing().of(p), "disks", drawn::Marker::SPHERE_LIST);
}

std::string caption_of(const picture &p)
{
    return drawn::in(drawn::drawing().of(p), "caption", drawn::Marker::TEXT_VIEW_FACING).at(0).text;
}
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
        EXPECT_FALSE(p.mode[k].d);
    }
    EXPECT_EQ(7u, p.mode[0].index);
    EXPECT_EQ(1.5, p.mode[0].exponent);
    EXPECT_EQ(0.25, p.mode[0].error);
    EXPECT_EQ(1.8, p.mode[1].exponent);
    EXPECT_EQ(-1.0, p.mode[1].error);
    for (const auto &marker : drawn::drawing().of(p).markers)
        EXPECT_EQ(std::string::npos, marker.text.find("not resolved"));
}

TEST(heard, a_mode_that_no_step_has_is_absent)
{
    hearing on;
    mode_choice asked = {};
    asked.count = 2;
    asked.mode[0] = {HDR_MODE_LP, 0, 1, 0}, asked.mode[1] = {HDR_MODE_T, 0, 1, 0};
    on.state(1.0);
    const picture before = picture_of(&on.h, &asked, "");
    EXPECT_FALSE(before.mode[0].absent || before.mode[1].absent); // no steps yet
    on.steps(false);
    const picture p = picture_of(&on.h, &asked, "");
    EXPECT_FALSE(p.mode[0].absent);
    EXPECT_TRUE(p.mode[1].absent);
}

TEST(heard, where_the_run_is)
{
    hearing on;
    hdr_run_status status = {};
    status.run_id = "run", status.sim_time = 2.0, status.progress = 0.25;
    status.stage = HDR_RUN_STATUS_WARMING_UP;
    heard_run_status(&on.h, &status);
    const picture p = on.drawn();
    EXPECT_NE(std::string::npos, caption_of(p).find("\nt = 2.0, warming up (25 %)"));
    on.state(2.0);
    on.h.changed = false;
    heard_run_status(&on.h, &status);
    EXPECT_FALSE(on.h.changed);
    status.stage = HDR_RUN_STATUS_AVERAGING;
    heard_run_status(&on.h, &status);
    EXPECT_TRUE(on.h.changed);
}

/** The run is described, and nothing else is known of it yet. */
TEST(heard, before_the_first_message)
{
    hearing on;
    EXPECT_TRUE(on.h.changed);
    picture p = on.drawn();
    EXPECT_EQ(-1.0, p.run->time);
    EXPECT_TRUE(disks_of(p).empty());
    EXPECT_EQ(DISKS, p.run->number);
    hdr_run_status status = {};
    status.run_id = "run", status.sim_time = 2.0; // a bag without places
    heard_run_status(&on.h, &status);
    p = on.drawn();
    EXPECT_NE(std::string::npos, caption_of(p).find("\nt = 2.0, "));
    EXPECT_TRUE(disks_of(p).empty());
    on.state(3.0);
    EXPECT_EQ(1u, disks_of(on.drawn()).size());
}

/** Fields are drawn where the disks were at their time, until the next ones; the disks go on. */
TEST(heard, fields_of_a_bag)
{
    hearing on;
    on.steps(true);
    on.state(9.0);
    EXPECT_EQ(0.00, on.drawn().run->q[0].x);
    on.field(10.0, HDR_MODE_T, 1, 7);
    on.field(10.0, HDR_MODE_LP, 0, 5);
    picture p = on.drawn();
    EXPECT_TRUE(p.run->time == 10.0 && p.run->vector_time == 10.0);
    EXPECT_TRUE(p.run->q[0].x == 0.20 && p.run->at[0].x == 0.20);
    EXPECT_TRUE(p.mode[0].d && p.mode[1].d);
    EXPECT_TRUE(p.run->q[1].y == 0.31 && p.run->at[1].y == 0.31);
    EXPECT_TRUE(p.mode[0].d[0].x == 0.07 && p.mode[0].d[2].y == 0.42);
    EXPECT_TRUE(p.mode[1].d[1].x == 0.06 && p.mode[1].d[0].y == 0.40);
    EXPECT_EQ(0u, p.mode[1].lp.pairs);
    on.phase(10.0, 0.5, -0.25);
    p = on.drawn();
    ASSERT_EQ(1u, p.mode[1].lp.pairs);
    EXPECT_TRUE(p.mode[1].lp.a[0] == 0.5 && p.mode[1].lp.b[0] == -0.25);
    EXPECT_DOUBLE_EQ(0.2, p.mode[1].momentum);
    on.h.changed = false;
    on.state(11.0);
    EXPECT_TRUE(on.h.changed);
    p = on.drawn();
    EXPECT_TRUE(p.run->time == 11.0 && p.run->vector_time == 10.0);
    EXPECT_TRUE(p.run->q[0].x == 0.00 && p.run->at[0].x == 0.20);
    EXPECT_TRUE(p.mode[0].d && p.mode[1].d);
    EXPECT_EQ(-0.25, p.mode[1].lp.b[0]); // the last that is known
    on.phase(11.0, 0.25, 0.5);
    p = on.drawn();
    EXPECT_EQ(0.5, p.mode[1].lp.b[0]);         // of the time of the disks
    EXPECT_DOUBLE_EQ(0.2, p.mode[1].momentum); // of the arrows'
    on.field(20.0, HDR_MODE_T, 1, 7);          // the other one has not come yet
    p = on.drawn();
    EXPECT_EQ(20.0, p.run->time);
    EXPECT_TRUE(p.mode[0].d);
    EXPECT_TRUE(p.mode[1].found && !p.mode[1].d);
    on.state(21.0);
    on.field(20.0, HDR_MODE_LP, 0, 5); // disks do not go back for it
    p = on.drawn();
    EXPECT_TRUE(p.run->time == 21.0 && p.run->q[0].x == 0.00 && p.run->at[0].x == 0.20);
    EXPECT_TRUE(p.mode[1].d && p.mode[1].lp.pairs == 0); // phases are of before
    on.state(3.0);                                       // played again
    EXPECT_EQ(3.0, on.h.time);
    EXPECT_FALSE(on.drawn().mode[0].d);
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
    EXPECT_EQ(2.5, p.run->time);
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_EQ(8u, p.mode[0].index);
    EXPECT_EQ(0.02, p.mode[0].exponent);
    EXPECT_TRUE(p.mode[0].d[0].x == 0.56 && p.mode[0].d[0].y == 0.76); // the third
    EXPECT_STREQ("LP(0,1)", p.mode[1].name);
    EXPECT_EQ(6u, p.mode[1].index); // the first of the two
    EXPECT_TRUE(p.mode[1].lp.a[0] == 0.00 && p.mode[1].lp.b[0] == 0.20);
    on.lowest.count = 2; // by their names
    ASSERT_TRUE(mode_name_parse(&on.lowest.mode[0], "LP(0,1)"));
    ASSERT_TRUE(mode_name_parse(&on.lowest.mode[1], "T(0,1)"));
    p = on.drawn();
    EXPECT_TRUE(p.mode[0].d);
    EXPECT_FALSE(p.mode[1].found);
    EXPECT_STREQ("T(0,1)", p.mode[1].name);
    m.dqx.count = m.dqy.count = 0; // at rest
    heard_slow_vectors(&on.h, &m);
    EXPECT_TRUE(on.drawn().mode[0].found && !on.drawn().mode[0].d);
    m.sim_time = 3.5, m.nx.count = 3; // arrays that do not fit
    heard_slow_vectors(&on.h, &m);
    m.nx.count = 4, m.dqx.count = 12;
    heard_slow_vectors(&on.h, &m);
    m.dqy.count = 12, m.run_id = "another";
    heard_slow_vectors(&on.h, &m);
    EXPECT_EQ(2.5, on.h.time);
}

/** Of a step whose set it shares, and where no vector is its own: the first of the set. */
TEST(heard, a_step_without_a_vector_of_its_own)
{
    hearing on;
    on.steps(true);
    on.field(10.0, HDR_MODE_LP, 0, 7);
    const picture p = on.drawn();
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_TRUE(p.mode[0].d);
    EXPECT_EQ(0.07, p.mode[0].d[0].x);
}

TEST(heard, only_modes_that_there_can_be)
{
    hearing walls("reflecting");
    EXPECT_TRUE(walls.h.has_t); // (0,1) has a node between them
    EXPECT_TRUE(walls.h.periodic[0] && !walls.h.periodic[1]);
    walls.info.run_id = "narrow", walls.info.wave_nx.count = walls.info.wave_ny.count = 1;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_FALSE(walls.h.has_t);
    EXPECT_EQ(1, walls.drawn().modes);
    walls.info.run_id = "state alone", walls.set("observables", "covariant, t_phases_of_mine");
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_EQ(0, walls.drawn().modes);
}

/** Corners that both lists have; T waves may go along it. */
TEST(heard, an_outline)
{
    const double x[] = {8.0, 4.0, 0.0, 4.0}, y[] = {3.0, 6.0, 3.0};
    hearing lens("curved");
    EXPECT_EQ(0u, lens.h.corners);
    lens.info.run_id = "lens", lens.set("container", "lens"), lens.set("boundary_x", "curved");
    lens.info.outline_x = {x, 4, 1}, lens.info.outline_y = {y, 3, 1};
    lens.info.wave_nx.count = lens.info.wave_ny.count = 1;
    EXPECT_TRUE(heard_run_info(&lens.h, &lens.info));
    ASSERT_EQ(3u, lens.h.corners);
    EXPECT_STREQ("lens", lens.h.container);
    for (int k = 0; k < 3; k++) {
        EXPECT_EQ(x[k], lens.h.outline[k].x);
        EXPECT_EQ(y[k], lens.h.outline[k].y);
    }
    EXPECT_TRUE(lens.h.has_t);
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

/** A disk's vector has four numbers, whatever it says. */
TEST(heard, pairs_are_no_more_than_their_numbers)
{
    hearing on;
    const uint8_t kind = HDR_MODE_LP, pairs = 7;
    const uint32_t nx = 0, ny = 1;
    hdr_slow_vectors m = {};
    m.run_id = "run", m.sim_time = 2.5, m.first_index = 6, m.vectors = 1;
    m.x = on.array(DISKS), m.y = on.array(DISKS, 10);
    m.exponents = on.array(1), m.kind = {&kind, 1}, m.pairs = {&pairs, 1};
    m.nx = {&nx, 1}, m.ny = {&ny, 1}, m.a = on.array(4, 5), m.b = on.array(4, 20);
    m.dqx = on.array(DISKS, 50), m.dqy = on.array(DISKS, 60);
    heard_slow_vectors(&on.h, &m);
    EXPECT_EQ(4u, on.drawn().mode[1].lp.pairs);
    EXPECT_EQ(0.0, on.drawn().mode[1].d[0].z);
}
