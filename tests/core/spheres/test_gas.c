/** The gas of spheres: what is conserved, sums over the events, an exact mean, and the equation of
 * state of Carnahan and Starling. Seeds are fixed: what is Z standard errors off passes or fails
 * for good. */
#include "interval.h"
#include "testing.h"

static const double Z = 3.0;

static double dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** After 100 collisions of each sphere. */
static hd_trajectory *equilibrated(const hd_scene_def *def)
{
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create(&tr, def));
    CHECK_OK(hd_trajectory_extend(tr, NULL, 50.0 * def->disks / hd_trajectory_collision_rate(tr)));
    return tr;
}

/** By samples of about `each` collisions of a sphere. */
static hd_gas_means averaged(const hd_scene_def *def, int samples, double each)
{
    OWNED(hd_trajectory) *tr = equilibrated(def);
    const double dt = 0.5 * each * def->disks / hd_trajectory_collision_rate(tr);
    MADE(hd_gas, gas, def, 0.0);
    hd_gas_begin(gas, tr);
    for (int k = 0; k < samples; k++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, hd_trajectory_time(tr) + dt));
        hd_gas_add(gas, tr);
    }
    return hd_gas_read(gas);
}

/* ---- events --------------------------------------------------------------------------------- */

/** Momentum along periodic directions is nothing, energy N, each to the rounding of its events. */
TEST(momentum_and_energy_stay)
{
    for (int walls = 0; walls < 8; walls++) {
        const hd_scene_def def = box_of(50, 0.5, 0.9, 1.2, walls, 3);
        OWNED(hd_trajectory) *tr = equilibrated(&def);
        double sum[3];
        hd_trajectory_momentum(tr, sum);
        const double events = (double)(hd_trajectory_collisions(tr) +
                                       hd_trajectory_wall_events(tr));
        const double rounding = 16.0 * DBL_EPSILON * sqrt(events);
        assert_true(events > 2000);
        for (int d = 0; d < 3; d++)
            if (def.boundary[d] == P) CHECK_CLOSE(sum[d], 0.0, 50 * rounding);
        CHECK_CLOSE(hd_trajectory_kinetic_energy(tr), 50.0, 50 * rounding);
        CHECK_CLOSE(hd_trajectory_overlap(tr), 0.0, hd_trajectory_overlap_rounding(tr));
    }
}

/** What the log says of a stretch of time. */
typedef struct sums {
    double pairs, virial[3], impulse[3];
} sums;

static sums summed(const hd_record *log)
{
    sums s = {0};
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *e = &events_in(log)[k];
        const double b = dot3(e->p, e->n);
        if (e->j < 0) s.impulse[-1 - e->j] += 2.0 * fabs(b);
        if (e->j < 0) continue;
        s.pairs++;
        for (int d = 0; d < 3; d++) s.virial[d] -= b * e->n[d] * e->n[d];
    }
    return s;
}

/** The published numbers are sums over the events, direction by direction. */
TEST(numbers_are_sums_over_the_events)
{
    for (int walls = 0; walls < 8; walls++) {
        const hd_scene_def def = box_of(40, 0.4, 0.8, 1.3, walls, 5);
        const double n = 40.0, t = 30.0, rounding = 1e-11;
        double box[3], momenta[3], volume = 1.0, all = 0.0;
        OWNED(hd_trajectory) *tr = equilibrated(&def);
        OWNED(hd_record) *log = new_log();
        MADE(hd_gas, gas, &def, 0.0);
        hd_gas_begin(gas, tr);
        CHECK_OK(trajectory_to(tr, log, hd_trajectory_time(tr) + t));
        hd_gas_add(gas, tr);
        const hd_gas_means m = hd_gas_read(gas);
        const sums s = summed(log);
        hd_scene_box(&def, box);
        for (int d = 0; d < 3; d++) {
            momenta[d] = n - (def.boundary[d] == P);
            all += momenta[d];
            volume *= box[d] - (def.boundary[d] == R);
        }
        assert_true(s.pairs > 500);
        CHECK_CLOSE(hd_gas_temperature(&def), 2.0 * n / all, rounding);
        CHECK_CLOSE(hd_gas_area(&def), volume, rounding * volume);
        CHECK_CLOSE(m.collision_rate, 2.0 * s.pairs / (n * t), rounding);
        for (int d = 0; d < 3; d++)
            CHECK_CLOSE(m.pressure_of[d], (momenta[d] * 2.0 * n / all + s.virial[d] / t) / volume,
                        rounding);
        CHECK_CLOSE(m.pressure,
                    (2.0 * n + (s.virial[0] + s.virial[1] + s.virial[2]) / t) / (3.0 * volume),
                    rounding);
        CHECK_CLOSE(m.compressibility, 1.5 * m.pressure * volume / n, rounding);
    }
}

/** Force on each of six walls over its area: the pressure along its direction. Seen over blocks. */
TEST(walls_feel_the_pressure)
{
    enum { BLOCKS = 40 };
    const hd_scene_def def = box_of(60, 0.3, 0.8, 1.3, 7, 6);
    const double t = HD_SANITIZED ? 10.0 : 60.0;
    double box[3], off[3] = {0}, square[3] = {0}, pressure = 0.0;
    OWNED(hd_trajectory) *tr = equilibrated(&def);
    OWNED(hd_record) *log = new_log();
    hd_scene_box(&def, box);
    const double volume = hd_gas_area(&def);
    for (int k = 0; k < BLOCKS; k++) {
        CHECK_OK(trajectory_to(tr, log, hd_trajectory_time(tr) + t));
        const sums s = summed(log);
        for (int d = 0; d < 3; d++) {
            const double at_walls = s.impulse[d] * (box[d] - 1.0) / (2.0 * volume * t);
            const double inside = (40.0 + s.virial[d] / t) / volume; /* 2 N / 3 */
            off[d] += (at_walls - inside) / BLOCKS;
            square[d] += pow(at_walls - inside, 2.0) / BLOCKS;
            pressure += inside / (3 * BLOCKS);
        }
    }
    for (int d = 0; d < 3; d++) {
        const double error = sqrt((square[d] - off[d] * off[d]) / (BLOCKS - 1.0));
        assert_true(HD_SANITIZED || error < 0.005 * pressure);
        CHECK_CLOSE(off[d], 0.0, Z * error);
    }
}

/* ---- exact means ---------------------------------------------------------------------------- */

/** <|p.n|> over collisions: the M free momenta are uniform on a sphere of radius R = sqrt(2 N), and
 * p.n is sqrt(2) times one of them, x; contacts come in proportion to |p.n|, so that it is sqrt(2)
 * <x^2> / <|x|>, with <x^2> = R^2 / M and <|x|> = R Gamma(M / 2) / (sqrt(pi) Gamma((M + 1) / 2)).
 * Behind walls the free momenta are more, and x is one of them all the same where N is large. */
static double exact_impact(const hd_scene_def *def)
{
    const double m = 3.0 * def->disks - 3.0;
    return sqrt(4.0 * PI * def->disks) / m * exp(lgamma(0.5 * m + 0.5) - lgamma(0.5 * m));
}

/** Counted, and as the pressure and the rate say. */
TEST(impact_is_exact)
{
    enum { BLOCKS = 40 };
    static const int disks[] = {2, 4, 16, 100};
    static const double density[] = {0.3, 0.2, 0.8, 0.5};
    for (int k = 0; k < 4; k++) {
        const hd_scene_def def = box_of(disks[k], density[k], 1.0, 0.9, 0, 23);
        double mean = 0.0, square = 0.0, rates = 0.0;
        OWNED(hd_trajectory) *tr = equilibrated(&def);
        OWNED(hd_record) *log = new_log();
        const double t = (HD_SANITIZED ? 200 : 4000) / hd_trajectory_collision_rate(tr);
        MADE(hd_gas, gas, &def, 0.0);
        hd_gas_begin(gas, tr);
        for (int b = 0; b < BLOCKS; b++) {
            CHECK_OK(trajectory_to(tr, log, hd_trajectory_time(tr) + t));
            const sums s = summed(log);
            const double impact = (s.virial[0] + s.virial[1] + s.virial[2]) / s.pairs;
            mean += impact / BLOCKS;
            square += impact * impact / BLOCKS;
        }
        hd_gas_add(gas, tr);
        const hd_gas_means m = hd_gas_read(gas);
        rates = 4.0 * (m.compressibility - 1.0) /
                m.collision_rate; /* weighs blocks by their pairs */
        const double error = sqrt((square - mean * mean) / (BLOCKS - 1.0));
        assert_true(HD_SANITIZED || error < 3e-3 * mean);
        CHECK_CLOSE(mean, exact_impact(&def), Z * error);
        CHECK_CLOSE(rates, exact_impact(&def), Z * error);
    }
}

/* ---- literature ----------------------------------------------------------------------------- */

/** Good to 0.3 % below freezing (0.943); N spheres differ from infinitely many by some 1 / N, and
 * their kT = 2/3 N / (N - 1). */
TEST(carnahan_and_starling)
{
    static const double density[] = {0.1, 0.5, 0.9, 0.3, 0.7};
    for (int k = 0; k < (second_tier() ? 5 : 3); k++) {
        const hd_scene_def def = box_of(500, density[k], 1.0, 1.0, 0, 21);
        const double eta = PI * density[k] / 6.0, cube = pow(1.0 - eta, 3.0), allowed = 0.01;
        const double kt = 2.0 / 3.0 * 500 / 499, contact = (1.0 - 0.5 * eta) / cube;
        const double rate = 4.0 * sqrt(PI * kt) * density[k] * contact;
        const double z = (1.0 + eta + eta * eta - eta * eta * eta) / cube;
        const hd_gas_means m = averaged(&def, 48, HD_SANITIZED ? 4.0 : 24.0);
        assert_true(HD_SANITIZED || Z * m.pressure_error < allowed * m.pressure);
        CHECK_CLOSE(m.collision_rate, rate, allowed * rate);
        CHECK_CLOSE(m.compressibility, z, allowed * z);
        CHECK_CLOSE(m.pressure, 2.0 / 3.0 * density[k] * z, allowed * m.pressure);
        for (int d = 0; d < 3; d++)
            CHECK_CLOSE(m.pressure_of[d], m.pressure,
                        Z * hypot(m.pressure_of_error[d], m.pressure_error));
        MADE(hd_trajectory, tr, &def);
        CHECK_CLOSE(hd_trajectory_collision_rate(tr), 250.0 * rate, 0.01 * 250.0 * rate);
        /* mean speed sqrt(8 kT / pi), of collisions */
        CHECK_CLOSE(hd_scene_mean_free_path(&def), sqrt(8.0 * kt / PI) / rate,
                    0.002 * hd_scene_mean_free_path(&def));
    }
}

/** Of a thin gas sqrt(5/3 kT); of a dense one by differences of the equation of state. */
TEST(sound_crosses_the_longest_edge)
{
    for (double density = 1e-4; density < 1.0; density += 0.2) {
        const hd_scene_def def = box_of(500, density, 0.5, 3.0, 0, 1);
        double box[3], z[3];
        for (int k = 0; k < 3; k++) {
            const double eta = PI / 6.0 * density * (1.0 + (k - 1) * 1e-5);
            z[k] = (1.0 + eta + eta * eta - eta * eta * eta) / pow(1.0 - eta, 3.0);
        }
        hd_scene_box(&def, box);
        const double slope = z[1] + (z[2] - z[0]) / 2e-5; /* of rho Z */
        const double c = sqrt(2.0 / 3.0 * (slope + 2.0 / 3.0 * z[1] * z[1]));
        CHECK_CLOSE(hd_scene_sound_crossing(&def), box[2] / c, 1e-6 * box[2] / c);
    }
}
