/** What of a run is drawn: messages heard -> a picture. */
#include "drawn.hpp"

extern "C" {
#include "viewer/compose.h"
}

namespace
{
const uint32_t DISKS = 3;

/** What a viewer has heard, and the arrays of what it hears. */
struct hearing {
    heard h = {};
    std::vector<double> numbers;
    const char *topics[2] = {"steps", "fields"};
    const uint32_t nx[2] = {1, 0}, ny[2] = {0, 1};
    hdr_run_info info = {};
    std::vector<hdr_step> step;
    mode_choice lowest = {};

    explicit hearing(const char *boundary = "periodic")
    {
        heard_clear(&h);
        for (int k = 0; k < 100; k++) numbers.push_back(0.01 * k);
        info.run_id = "run", info.scene = "a scene", info.disks = DISKS;
        info.box_x = info.box_y = 10.0, info.boundary_x = "periodic", info.boundary_y = boundary;
        info.vectors = 9;
        info.observables = {topics, 2};
        info.wave_nx = {nx, 2}, info.wave_ny = {ny, 2};
        EXPECT_TRUE(heard_run_info(&h, &info));
        EXPECT_FALSE(heard_run_info(&h, &info)); // the same
    }
    ~hearing() { heard_clear(&h); }

    hdr_doubles array(uint32_t count, uint32_t from = 0) { return {&numbers[from], count, 1}; }

    void steps(bool resolved)
    {
        step = {drawn::a_step(HDR_MODE_T, 1, 0, 0.6, 7, 8, 1.5, 0.25),
                drawn::a_step(HDR_MODE_LP, 0, 1, 0.6, 5, 6, 1.8, -1.0)};
        for (hdr_step &one : step) one.resolved = resolved;
        hdr_steps message = {};
        message.run_id = "run", message.steps = {step.data(), 2};
        heard_steps(&h, &message);
    }

    void state(double time)
    {
        hdr_state message = {};
        message.run_id = "run", message.sim_time = time;
        message.x = array(DISKS), message.y = array(DISKS, 10);
        heard_state(&h, &message);
    }

    void field(double time, uint8_t kind, uint32_t x, uint32_t index)
    {
        hdr_mode_field message = {};
        message.run_id = "run", message.sim_time = time, message.kind = kind;
        message.nx = x, message.ny = !x, message.index = index,
        message.exponent = 2.0 - 0.1 * index;
        message.x = array(DISKS, 20), message.y = array(DISKS, 30);
        message.dqx = array(DISKS, index), message.dqy = array(DISKS, 40);
        heard_mode_field(&h, &message);
    }

    /** Of the vector of LP(0,1). */
    void phase(double time, double a, double b)
    {
        hdr_lp_phase phase = {1, 0, 1, 0, 0.6, 0, 5, HDR_LP_PHASE_TRACKED, a, b, 0, 0, 0, 0, 0};
        hdr_lp_phases phases = {};
        phases.run_id = "run", phases.phases = {&phase, 1}, phases.sim_time = time;
        heard_lp_phases(&h, &phases);
    }

    picture drawn() { return compose(&h, &lowest, ""); }
};

/** Of spheres in a box that is as high as wide. */
struct hearing_spheres : hearing {
    const uint32_t nz[2] = {0, 1};

    explicit hearing_spheres(const char *boundary = "periodic", double height = 10.0)
        : hearing(boundary)
    {
        heard_clear(&h);
        info.dimensions = 3, info.box_z = height, info.boundary_z = boundary;
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
        EXPECT_FALSE(p.mode[k].known);
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
    const picture before = compose(&on.h, &asked, "");
    EXPECT_FALSE(before.mode[0].absent || before.mode[1].absent); // no steps yet
    on.steps(false);
    const picture p = compose(&on.h, &asked, "");
    EXPECT_FALSE(p.mode[0].absent);
    EXPECT_TRUE(p.mode[1].absent);
}

/** Exponents and where the run is. */
TEST(heard, numbers_of_the_run)
{
    hearing on;
    hdr_spectrum spectrum = {};
    spectrum.run_id = "run", spectrum.first_index = 1, spectrum.lambda_max = 2.5;
    spectrum.averaged_time = 7.5;
    spectrum.exponents = on.array(5, 30), spectrum.std_errors = on.array(5, 3);
    heard_spectrum(&on.h, &spectrum);
    hdr_run_status status = {};
    status.run_id = "run", status.sim_time = 2.0, status.progress = 0.25;
    status.stage = HDR_RUN_STATUS_WARMING_UP;
    heard_run_status(&on.h, &status);
    const picture p = on.drawn();
    ASSERT_EQ(5u, p.exponents.count);
    for (uint32_t k = 0; k < 5; k++) EXPECT_EQ(0.01 * (30 + k), p.exponents.data[k]);
    EXPECT_EQ(2.5, p.lambda_max);
    EXPECT_EQ(0.03, p.lambda_max_error);
    EXPECT_TRUE(p.progress == 0.25 && p.averaged == 7.5 && p.time == 2.0);
    EXPECT_STREQ("warming up", p.stage);
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
    EXPECT_EQ(-1.0, p.time);
    EXPECT_EQ(0u, p.x.count);
    EXPECT_EQ(DISKS, p.disks);
    hdr_run_status status = {};
    status.run_id = "run", status.sim_time = 2.0; // a bag without places
    heard_run_status(&on.h, &status);
    p = on.drawn();
    EXPECT_EQ(2.0, p.time);
    EXPECT_EQ(0u, p.x.count);
}

/** Fields are drawn where the disks were at their time, until the next ones; the disks go on. */
TEST(heard, fields_of_a_bag)
{
    hearing on;
    on.steps(true);
    on.state(9.0);
    EXPECT_EQ(0.00, on.drawn().x.data[0]);
    on.field(10.0, HDR_MODE_T, 1, 7);
    on.field(10.0, HDR_MODE_LP, 0, 5);
    picture p = on.drawn();
    EXPECT_TRUE(p.time == 10.0 && p.vector_time == 10.0);
    EXPECT_TRUE(p.x.data[0] == 0.20 && p.at_x.data[0] == 0.20);
    EXPECT_TRUE(p.mode[0].known && p.mode[1].known);
    EXPECT_TRUE(p.y.data[1] == 0.31 && p.at_y.data[1] == 0.31);
    EXPECT_TRUE(p.mode[0].dx.data[0] == 0.07 && p.mode[0].dy.data[2] == 0.42);
    EXPECT_TRUE(p.mode[1].dx.data[1] == 0.06 && p.mode[1].dy.data[0] == 0.40);
    EXPECT_EQ(0u, p.mode[1].pairs);
    on.phase(10.0, 0.5, -0.25);
    p = on.drawn();
    ASSERT_EQ(1u, p.mode[1].pairs);
    EXPECT_TRUE(p.mode[1].a[0] == 0.5 && p.mode[1].b[0] == -0.25);
    EXPECT_DOUBLE_EQ(0.2, p.mode[1].momentum);
    on.h.changed = false;
    on.state(11.0);
    EXPECT_TRUE(on.h.changed);
    p = on.drawn();
    EXPECT_TRUE(p.time == 11.0 && p.vector_time == 10.0);
    EXPECT_TRUE(p.x.data[0] == 0.00 && p.at_x.data[0] == 0.20);
    EXPECT_TRUE(p.mode[0].known && p.mode[1].known);
    EXPECT_EQ(-0.25, p.mode[1].b[0]); // the last that is known
    on.phase(11.0, 0.25, 0.5);
    p = on.drawn();
    EXPECT_EQ(0.5, p.mode[1].b[0]);            // of the time of the disks
    EXPECT_DOUBLE_EQ(0.2, p.mode[1].momentum); // of the arrows'
    on.field(20.0, HDR_MODE_T, 1, 7);          // the other one has not come yet
    p = on.drawn();
    EXPECT_EQ(20.0, p.time);
    EXPECT_TRUE(p.mode[0].known);
    EXPECT_TRUE(p.mode[1].found && !p.mode[1].known);
    on.state(3.0); // played again
    EXPECT_EQ(3.0, on.drawn().time);
    EXPECT_FALSE(on.drawn().mode[0].known);
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
    EXPECT_EQ(2.5, p.time);
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_EQ(8u, p.mode[0].index);
    EXPECT_EQ(0.02, p.mode[0].exponent);
    EXPECT_TRUE(p.mode[0].dx.data[0] == 0.56 && p.mode[0].dy.data[0] == 0.76); // the third
    EXPECT_STREQ("LP(0,1)", p.mode[1].name);
    EXPECT_EQ(6u, p.mode[1].index); // the first of the two
    EXPECT_TRUE(p.mode[1].a[0] == 0.00 && p.mode[1].b[0] == 0.20);
    on.lowest.count = 2; // by their names
    ASSERT_TRUE(mode_name_parse(&on.lowest.mode[0], "LP(0,1)"));
    ASSERT_TRUE(mode_name_parse(&on.lowest.mode[1], "T(0,1)"));
    p = on.drawn();
    EXPECT_TRUE(p.mode[0].known);
    EXPECT_FALSE(p.mode[1].found);
    EXPECT_STREQ("T(0,1)", p.mode[1].name);
    m.dqx.count = m.dqy.count = 0; // at rest
    heard_slow_vectors(&on.h, &m);
    EXPECT_TRUE(on.drawn().mode[0].found && !on.drawn().mode[0].known);
    m.sim_time = 3.5, m.nx.count = 3; // arrays that do not fit
    heard_slow_vectors(&on.h, &m);
    m.nx.count = 4, m.dqx.count = 12;
    heard_slow_vectors(&on.h, &m);
    m.dqy.count = 12, m.run_id = "another";
    heard_slow_vectors(&on.h, &m);
    EXPECT_EQ(2.5, on.drawn().time);
}

/** Of a step whose set it shares, and where no vector is its own: the first of the set. */
TEST(heard, a_step_without_a_vector_of_its_own)
{
    hearing on;
    on.steps(true);
    on.field(10.0, HDR_MODE_LP, 0, 7);
    const picture p = on.drawn();
    EXPECT_STREQ("T(1,0)", p.mode[0].name);
    EXPECT_TRUE(p.mode[0].known);
    EXPECT_EQ(0.07, p.mode[0].dx.data[0]);
}

TEST(heard, only_modes_that_there_can_be)
{
    hearing walls("reflecting");
    EXPECT_TRUE(walls.h.has_t); // (0,1) has a node between them
    EXPECT_TRUE(walls.drawn().periodic[0] && !walls.drawn().periodic[1]);
    walls.info.run_id = "narrow", walls.info.wave_nx.count = walls.info.wave_ny.count = 1;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_FALSE(walls.h.has_t);
    EXPECT_EQ(1, walls.drawn().modes);
    walls.info.run_id = "state alone", walls.info.observables.count = 0;
    EXPECT_TRUE(heard_run_info(&walls.h, &walls.info));
    EXPECT_EQ(0, walls.drawn().modes);
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

TEST(heard, spheres_have_a_third_coordinate)
{
    hearing_spheres on;
    EXPECT_EQ(0u, on.drawn().z.count); // before the first message
    on.state(9.0, DISKS);
    picture p = on.drawn();
    EXPECT_TRUE(picture_has_spheres(&p));
    EXPECT_TRUE(p.box[2] == 10.0 && p.periodic[2]);
    ASSERT_EQ(DISKS, p.z.count);
    EXPECT_TRUE(p.z.data[0] == 0.50 && p.z.data[2] == 0.52);
    const hdr_mode_field field = on.field_message(10.0);
    heard_mode_field(&on.h, &field);
    p = on.drawn();
    EXPECT_STREQ("T(0,0,1)", p.mode[0].name);
    ASSERT_TRUE(p.mode[0].known);
    ASSERT_TRUE(p.at_z.count == DISKS && p.mode[0].dz.count == DISKS);
    EXPECT_TRUE(p.z.data[0] == 0.60 && p.at_z.data[1] == 0.61);
    EXPECT_TRUE(p.mode[0].dx.data[0] == 0.07 && p.mode[0].dy.data[0] == 0.40);
    EXPECT_TRUE(p.mode[0].dz.data[0] == 0.75 && p.mode[0].dz.data[2] == 0.77);
}

TEST(heard, numbers_along_z_that_do_not_fit)
{
    hearing_spheres on;
    for (const uint32_t count : {0u, DISKS - 1, DISKS + 1}) on.state(9.0, count);
    EXPECT_EQ(-1.0, on.drawn().time);
    hdr_mode_field field = on.field_message(10.0);
    field.dqz.count = 0;
    heard_mode_field(&on.h, &field);
    field = on.field_message(10.0);
    field.z.count = 2;
    heard_mode_field(&on.h, &field);
    EXPECT_TRUE(on.drawn().time == -1.0 && !on.drawn().mode[0].known);
    hearing_spheres flat("periodic", 0.0); // no box of spheres: as disks
    flat.state(9.0, DISKS);
    EXPECT_EQ(-1.0, flat.drawn().time);
    flat.state(9.0, 0);
    EXPECT_EQ(9.0, flat.drawn().time);
    const picture p = flat.drawn();
    EXPECT_TRUE(!picture_has_spheres(&p) && p.z.count == 0 && !p.periodic[2]);
    flat.info.run_id = "disks", flat.info.dimensions = 2, flat.info.box_z = 10.0;
    EXPECT_TRUE(heard_run_info(&flat.h, &flat.info));
    EXPECT_EQ(0.0, flat.drawn().box[2]);
}

TEST(heard, slow_vectors_of_spheres)
{
    slow_spheres on;
    const hdr_slow_vectors m = on.message();
    heard_slow_vectors(&on.h, &m);
    const picture p = on.drawn();
    EXPECT_STREQ("T(0,1,1)", p.mode[0].name);
    EXPECT_STREQ("LP(0,0,1)", p.mode[1].name);
    EXPECT_TRUE(p.z.data[0] == 0.20 && p.at_z.data[2] == 0.22);
    EXPECT_TRUE(p.mode[0].dx.data[0] == 0.53 && p.mode[0].dy.data[0] == 0.63);
    EXPECT_TRUE(p.mode[0].dz.data[0] == 0.87 && p.mode[1].dz.data[0] == 0.84);
    ASSERT_EQ(8u, p.mode[1].pairs);
    EXPECT_TRUE(p.mode[1].a[7] == 0.07 && p.mode[1].b[7] == 0.27);
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
        return on.drawn().time == 2.5;
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
    EXPECT_FALSE(on.drawn().mode[0].known);
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
    EXPECT_EQ(4u, on.drawn().mode[1].pairs);
    EXPECT_EQ(0u, on.drawn().mode[1].dz.count);
}

/** Steps, vectors and phases that only nz tells apart. */
TEST(heard, waves_along_z_are_waves_of_their_own)
{
    hearing_spheres on;
    on.step = {drawn::a_step(HDR_MODE_LP, 1, 0, 0.6, 7, 8, 1.5, 0.25),
               drawn::a_step(HDR_MODE_LP, 1, 0, 0.9, 5, 6, 1.8, 0.5)};
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
    EXPECT_TRUE(p.mode[0].exponent == 1.8 && p.mode[0].known && p.mode[0].pairs == 0);
    EXPECT_STREQ("LP(1,0,0)", p.mode[1].name);
    EXPECT_STREQ("LP(1,0,0)", p.mode[1].box);
    EXPECT_TRUE(p.mode[1].exponent == 1.5 && !p.mode[1].known && !p.mode[1].absent);
    EXPECT_TRUE(p.mode[2].absent);
    hdr_lp_phase phase = {};
    phase.nx = 1, phase.index = 5, phase.a = 0.75;
    hdr_lp_phases phases = {};
    phases.run_id = "run", phases.phases = {&phase, 1}, phases.sim_time = 10.0;
    heard_lp_phases(&on.h, &phases); // of LP(1,0,0)
    EXPECT_EQ(0u, on.drawn().mode[0].pairs);
    phase.nz = 1;
    heard_lp_phases(&on.h, &phases);
    p = on.drawn();
    EXPECT_TRUE(p.mode[0].pairs == 1 && p.mode[0].a[0] == 0.75);
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
