/** What a viewer has heard, for the tests of what it draws then. */
#ifndef HEARING_HPP
#define HEARING_HPP

#include "drawn.hpp"

extern "C" {
#include "viewer/picture.h"
}

static const uint32_t DISKS = 3;

/** Resolved, with vectors of its own. */
inline hdr_step a_step(uint8_t kind, uint32_t nx, uint32_t ny, double k, uint32_t first,
                       uint32_t last, double exponent, double error)
{
    hdr_step step = {};
    step.kind = kind, step.nx = nx, step.ny = ny, step.wave_number = k;
    step.resolved = true, step.members = 1;
    step.first_index = first, step.last_index = last;
    step.expected = last - first + 1, step.multiplicity = 0.9 * step.expected;
    step.exponent = exponent, step.std_error = error, step.omega_error = -1.0;
    return step;
}

/** What a viewer has heard, and the arrays of what it hears. */
struct hearing {
    heard h = {};
    std::vector<double> numbers;
    const uint32_t nx[2] = {1, 0}, ny[2] = {0, 1};
    hdr_run_info info = {};
    std::vector<hdr_parameter> parameters;
    std::vector<hdr_step> step;
    mode_choice lowest = {};

    explicit hearing(const char *boundary = "periodic")
    {
        heard_clear(&h);
        for (int k = 0; k < 100; k++) numbers.push_back(0.01 * k);
        set("scene", "a scene"), set("particles", "disks"), set("number", "3"); // DISKS
        set("observables", "spectrum, steps, fields");
        set("boundary_x", "periodic"), set("boundary_y", boundary), set("container", "rectangle");
        info.run_id = "run", info.box_x = info.box_y = 10.0, info.vectors = 9;
        info.wave_nx = {nx, 2}, info.wave_ny = {ny, 2};
        EXPECT_TRUE(heard_run_info(&h, &info));
        EXPECT_FALSE(heard_run_info(&h, &info)); // the same
    }
    ~hearing() { heard_clear(&h); }

    /** Gives a parameter this value in effect. */
    void set(const char *name, const char *value, bool own = false)
    {
        hdr_parameter one = {};
        one.name = name, one.effect = one.value = value, one.unit = "", one.own = own;
        auto at = parameters.begin();
        while (at != parameters.end() && std::string(at->name) != name) ++at;
        if (at == parameters.end()) at = parameters.insert(at, one);
        *at = one;
        info.parameters = {parameters.data(), uint32_t(parameters.size())};
    }

    hdr_doubles array(uint32_t count, uint32_t from = 0) { return {&numbers[from], count, 1}; }

    void steps(bool resolved)
    {
        step = {a_step(HDR_MODE_T, 1, 0, 0.6, 7, 8, 1.5, 0.25),
                a_step(HDR_MODE_LP, 0, 1, 0.6, 5, 6, 1.8, -1.0),
                a_step(HDR_MODE_T, 2, 0, 1.2, 3, 4, 2.9, 0.25)}; // not the lowest
        for (hdr_step &one : step) one.resolved = resolved;
        hdr_steps message = {};
        message.run_id = "run", message.steps = {step.data(), 3};
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
        phases.run_id = "run", phases.phases = {&phase, 1}, phases.sample_time = time;
        phases.sim_time = time + 0.25; // of a later report
        heard_lp_phases(&h, &phases);
    }

    picture drawn() { return picture_of(&h, &lowest, ""); }
};

#endif
