/** Forces that a program gives -> record: motion of particles with H = sum p^2 / 2 + V(q), in time
 * steps of drifts and kicks [T24]. The last drift of a step is done with the first one of the next:
 * until then it is pending, whoever looks at the state in between. One thread computes this. */
#include "hdlyap/hamiltonian.h"

#include <math.h>
#include <string.h>
#include <zlib.h>

#include "base/archive.h"
#include "base/check.h"
#include "base/memory.h"
#include "base/random.h"
#include "dynamics/dynamics.h"
#include "dynamics/soft/integrator.h"
#include "dynamics/trajectory.h"

/** The energy error asked for is this many times the accuracy, which counts as at least LEAST. */
static const double ASKED = 10.0, LEAST = 1e-6;
/** The longest time step; and one that is short for estimates if none is known [time units]. */
static const double LONGEST = 10.0, SHORT = 0.01;

/** The energy is measured after this many time steps. */
enum { LOOK_STEPS = 128 };

/** A part of a kick in the record. All entries of a time step have the time at which it ends, so
 * that no part of a record cuts it in two. */
enum { PART = HD_HAMILTONIAN_ENTRY - 5 };
typedef struct entry {
    double time;
    double before, length, after; /**< flights before and after the kick, and the kick's own time */
    double left; /**< how many of the kept numbers are still to come, those of this part included */
    double kept[PART];
} entry;
_Static_assert(sizeof(entry) == HD_HAMILTONIAN_ENTRY * sizeof(double), "what the header says");

typedef struct motion {
    hd_scene_def scene;
    const hd_hamiltonian *of;
    const hd_integrator *by;
    size_t all, numbers;  /**< coordinates, and kept numbers, of all particles */
    double step, now;     /**< [time units] */
    uint64_t steps;       /**< time steps done so far */
    double energy;        /**< energy at the start */
    double error;         /**< relative error of the energy, see look */
    double *q, *p;        /**< [all]: after the last time step, but for a drift that is pending */
    double *here, *force; /**< [all], [all]: for one computation of forces */
    double *kept;         /**< [numbers], and zeros behind them for a whole part */
    double room[];
} motion;

/* ---- parameters ---------------------------------------------------------------------------- */

static const hd_hamiltonian *hamiltonian_of(const hd_scene_def *scene)
{
    const hd_hamiltonian *of = hd_dynamics_of(scene)->hamiltonian;
    HD_ASSERT(of && of->force && of->growth && of->kept >= 0);
    return of;
}

hd_status hd_hamiltonian_check(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_hamiltonian *of = hamiltonian_of(scene);
    if (scene->number < of->least)
        return hd_refuse(message, size, "number = %d: must be %d or more with particles = %s",
                         scene->number, of->least, hd_dynamics_of(scene)->particles);
    return of->check ? of->check(scene, message, size) : HD_OK;
}

/** The value of an own parameter; `without` if the row does not have it. */
static double own(const hd_scene_def *scene, const char *name, double without)
{
    const hd_dynamics *row = hd_dynamics_of(scene);
    for (int k = 0; k < row->parameters; k++)
        if (strcmp(row->parameter[k].name, name) == 0)
            return hd_parameter_value(&row->parameter[k], scene);
    return without;
}

static const hd_integrator *integrator_of(const hd_scene_def *scene)
{
    const double k = own(scene, "integrator", HD_PEFRL);
    return &hd_integrators[k == HD_VERLET ? HD_VERLET : HD_PEFRL];
}

/** At most what leaves a run twice as far from a lost energy as from what is asked. */
static double accuracy(const hd_scene_def *scene)
{
    return fmin(fmax(scene->accuracy, LEAST), 0.5 * HD_ENERGY_LOST_FROM / ASKED);
}

double hd_hamiltonian_energy_asked(const hd_scene_def *scene) { return ASKED * accuracy(scene); }

double hd_hamiltonian_rate(const hd_scene_def *scene)
{
    return 0.5 * scene->number * hamiltonian_of(scene)->growth(scene);
}

int hd_hamiltonian_zeros(const hd_scene_def *scene)
{
    const hd_hamiltonian *of = hamiltonian_of(scene);
    const int of_one = 2 * hd_dynamics_of(scene)->coordinates,
              known = 2 + (of->shifts ? of_one : 0);
    if (of->zero_exponents) return of->zero_exponents(scene);
    return known < of_one * scene->number ? known : of_one * scene->number;
}

static size_t numbers_of(const hd_scene_def *scene)
{
    return (size_t)hamiltonian_of(scene)->kept * (size_t)scene->number;
}

double hd_hamiltonian_entries(const hd_scene_def *scene)
{
    const double parts = fmax(1.0, ceil((double)numbers_of(scene) / PART)),
                 step = hd_hamiltonian_time_step(scene);
    return integrator_of(scene)->kicks * parts / (step > 0 ? step : SHORT);
}

void hd_hamiltonian_momenta(const hd_scene_def *scene, double *p, double energy)
{
    hd_random random = hd_random_seeded(scene->seed, 0);
    const int coordinates = hd_dynamics_of(scene)->coordinates, n = scene->number;
    double square = 0.0;
    for (int k = 0; k < coordinates * n; k++) p[k] = hd_random_symmetric(&random);
    for (int c = 0; c < coordinates; c++) {
        double sum = 0.0;
        for (int i = 0; i < n; i++) sum += p[coordinates * i + c];
        for (int i = 0; i < n && n > 1; i++) p[coordinates * i + c] -= sum / n;
    }
    for (int k = 0; k < coordinates * n; k++) square += p[k] * p[k];
    for (int k = 0; k < coordinates * n; k++) p[k] *= sqrt(2.0 * energy * n / square);
}

/* ---- steps --------------------------------------------------------------------------------- */

/** The drift from the last kick to the end of its time step. */
static double pending(const motion *m)
{
    return m->steps > 0 ? m->by->drift[m->by->kicks] * m->step : 0.0;
}

static double forces_at(motion *m, const double *q)
{
    memset(m->force, 0, m->all * sizeof *m->force);
    return m->of->force(&m->scene, q, m->force, m->kept);
}

static double kinetic_energy(const motion *m)
{
    double twice = 0.0;
    for (size_t k = 0; k < m->all; k++) twice += m->p[k] * m->p[k];
    return 0.5 * twice;
}

/** Measures m->error: the change of the energy over kinetic + |potential| energy. Fails with
 * HD_ENERGY_LOST if it is more than HD_ENERGY_LOST_FROM. */
static hd_status look(motion *m)
{
    const double after = pending(m), kinetic = kinetic_energy(m);
    for (size_t k = 0; k < m->all; k++) m->here[k] = m->q[k] + after * m->p[k];
    const double potential = forces_at(m, m->here), size = kinetic + fabs(potential);
    m->error = size > 0 || isnan(size) ? (kinetic + potential - m->energy) / size : 0.0;
    if (isnan(m->error)) m->error = 1.0; /* where it tends to */
    return fabs(m->error) <= HD_ENERGY_LOST_FROM ? HD_OK : HD_ENERGY_LOST;
}

static hd_status put_kick(const motion *m, hd_record *record, entry *e)
{
    for (size_t done = 0; done == 0 || done < m->numbers; done += PART) {
        e->left = (double)(m->numbers - done);
        memcpy(e->kept, m->kept + done, sizeof e->kept);
        HD_TRY(hd_record_put(record, e));
    }
    return HD_OK;
}

static void add(double *restrict to, double factor, const double *restrict x, size_t count)
{
    for (size_t k = 0; k < count; k++) to[k] += factor * x[k];
}

/** Does a time step. end: when it ends, since the start of the record. */
static hd_status one_step(motion *m, hd_record *record, double end)
{
    const hd_integrator *by = m->by;
    double due = pending(m);
    entry e;
    e.time = end;
    for (int k = 0; k < by->kicks; k++) {
        e.before = by->drift[k] * m->step;
        e.length = by->kick[k] * m->step;
        e.after = k + 1 == by->kicks ? by->drift[k + 1] * m->step : 0.0;
        add(m->q, due + e.before, m->p, m->all);
        forces_at(m, m->q);
        add(m->p, e.length, m->force, m->all);
        if (record) HD_TRY(put_kick(m, record, &e));
        due = 0.0;
    }
    m->steps++;
    return HD_OK;
}

/** Time steps end at multiples of their length, whatever t_end is. */
static hd_status step_until(motion *m, hd_record *record, double begin, double t_end)
{
    for (double end; (end = (double)(m->steps + 1) * m->step) <= t_end;) {
        HD_TRY(one_step(m, record, end - begin));
        if (m->steps % LOOK_STEPS == 0) HD_TRY(look(m));
    }
    return look(m);
}

hd_status hd_hamiltonian_advance(void *state, hd_record *record, double t_end)
{
    motion *m = state;
    const double begin = record ? m->now - hd_record_duration(record) : 0.0;
    const hd_status status = step_until(m, record, begin, t_end);
    m->now = t_end;
    if (record) hd_record_end(record, t_end - begin);
    return status;
}

/* ---- creation, and the time step ----------------------------------------------------------- */

static hd_status allocate(motion **out, const hd_scene_def *scene)
{
    const size_t all = (size_t)hd_dynamics_of(scene)->coordinates * (size_t)scene->number,
                 numbers = numbers_of(scene);
    motion *m = *out = hd_memory_alloc(1, sizeof *m + (4 * all + numbers + PART) * sizeof *m->room);
    if (!m) return HD_NO_MEMORY;
    m->scene = *scene;
    m->of = hamiltonian_of(scene);
    m->by = integrator_of(scene);
    m->all = all;
    m->numbers = numbers;
    m->q = m->room;
    m->p = m->q + all;
    m->here = m->p + all;
    m->force = m->here + all;
    m->kept = m->force + all;
    return HD_OK;
}

static hd_status begin(motion *m, double step)
{
    m->step = step;
    m->now = 0.0;
    m->steps = 0;
    memset(m->q, 0, 2 * m->all * sizeof *m->q); /* p, too */
    if (m->of->start)
        m->of->start(&m->scene, m->q, m->p);
    else
        hd_hamiltonian_momenta(&m->scene, m->p, own(&m->scene, "energy", 1.0));
    m->energy = forces_at(m, m->q) + kinetic_energy(m);
    return isfinite(m->energy) ? HD_OK : HD_NOT_FINITE;
}

/** Whether steps keep the energy to `aim` over this span from the start, and over 256 steps; of
 * very many particles over less, about a second of wall time. */
static bool keeps_energy(motion *m, double step, double aim, double span)
{
    const double least = 256.0, most = fmax(least, ldexp(1.0, 26) / (double)m->all);
    const double steps = fmin(fmax(least, span / step), most);
    if (begin(m, step) != HD_OK) return true; /* as at any other step */
    while ((double)m->steps < steps)
        if (one_step(m, NULL, 0.0) != HD_OK || look(m) != HD_OK || !(fabs(m->error) <= aim))
            return false;
    return true;
}

/** Halves a power of two until it is short enough, and adds quarters of it. So the choice does not
 * depend on the last bits of a machine. */
static double step_chosen(motion *m)
{
    const double growth = m->of->growth(&m->scene), aim = accuracy(&m->scene),
                 longest = fmin(LONGEST, growth > 0 ? 1.0 / growth : LONGEST);
    double step = exp2(floor(log2(longest)));
    for (int k = 0; k < 64 && !keeps_energy(m, step, aim, longest); k++) step *= 0.5;
    for (int quarters = 7; quarters > 4; quarters--)
        if (keeps_energy(m, 0.25 * quarters * step, aim, longest)) return 0.25 * quarters * step;
    return step;
}

/** 0, as it is asked, of a scene that is not checked and refused, or if there is no memory. */
double hd_hamiltonian_time_step(const hd_scene_def *scene)
{
    const double asked = own(scene, "time_step", 0.0);
    motion *m;
    if (asked > 0 || scene->number < 1 || scene->number > 1000000) return asked;
    if (hd_hamiltonian_check(scene, NULL, 0) != HD_OK || allocate(&m, scene) != HD_OK) return asked;
    const double step = step_chosen(m);
    hd_memory_free(m);
    return step;
}

hd_status hd_hamiltonian_create(void **state, const hd_scene_def *scene)
{
    const double asked = own(scene, "time_step", 0.0);
    motion *m;
    hd_status status = allocate(&m, scene);
    if (status == HD_OK) status = begin(m, asked > 0 ? asked : step_chosen(m));
    *state = status == HD_OK ? m : NULL;
    if (status != HD_OK) hd_memory_free(m);
    return status;
}

void hd_hamiltonian_free(void *state) { hd_memory_free(state); }

/* ---- state --------------------------------------------------------------------------------- */

double hd_hamiltonian_time(const void *state) { return ((const motion *)state)->now; }

/** Folds the positions of particles that have a box into it. */
static void fold(double *q, const motion *m)
{
    const hd_dynamics *row = hd_dynamics_of(&m->scene);
    double box[HD_DIMENSION_MAX];
    if (row->dimension == 0) return;
    hd_scene_box(&m->scene, box);
    for (size_t k = 0; k < m->all; k++) {
        const size_t c = k % (size_t)row->coordinates;
        if (c < (size_t)row->dimension) q[k] -= box[c] * floor(q[k] / box[c]);
    }
}

void hd_hamiltonian_state(const void *state, double *q, double *p)
{
    const motion *m = state;
    for (size_t k = 0; k < m->all && q; k++) q[k] = m->q[k] + pending(m) * m->p[k];
    if (q) fold(q, m);
    if (p) memcpy(p, m->p, m->all * sizeof *p);
}

void hd_hamiltonian_examine(const void *state, hd_invariants *examined)
{
    const motion *m = state;
    const size_t coordinates = m->all / (size_t)m->scene.number;
    *examined = (hd_invariants){.kinetic_energy = kinetic_energy(m),
                                .energy_error = m->error,
                                .energy_rounding = HD_ENERGY_LOST_FROM};
    for (size_t k = 0; k < m->all && m->of->shifts; k++)
        if (k % coordinates < HD_DIMENSION_MAX) examined->momentum[k % coordinates] += m->p[k];
}

void hd_hamiltonian_archive(void *state, hd_archive *archive)
{
    motion *m = state;
    hd_archive_double(archive, "trajectory time", &m->now);
    hd_archive_bits(archive, "trajectory steps", &m->steps);
    hd_archive_double(archive, "trajectory energy", &m->energy);
    hd_archive_doubles(archive, "trajectory q", m->q, m->all);
    hd_archive_doubles(archive, "trajectory p", m->p, m->all);
    if (!hd_archive_good(archive)) return;
    const double since = m->now - (double)m->steps * m->step;
    const char *fault = NULL;
    if (look(m) != HD_OK) fault = "the energy is not that of the positions and momenta";
    if (!(since >= 0 && since < 2.0 * m->step))
        fault = "the time does not fit the number of time steps";
    if (fault) hd_archive_refuse(archive, "trajectory", fault);
}

uint32_t hd_hamiltonian_fingerprint(const void *state)
{
    const motion *m = state;
    return (uint32_t)crc32_z(0, (const Bytef *)m->q, 2 * m->all * sizeof *m->q); /* p, too */
}

/** Two states, one of which chooses the time step. */
double hd_hamiltonian_bytes(const hd_scene_def *scene)
{
    const double all = (double)scene->number * hd_dynamics_of(scene)->coordinates,
                 states = own(scene, "time_step", 0.0) > 0 ? 1.0 : 2.0;
    return states *
           (sizeof(motion) + (4.0 * all + (double)numbers_of(scene) + PART) * sizeof(double));
}

/* ---- null vectors -------------------------------------------------------------------------- */

/** Writes the flow (p, F) into a column. Fails with HD_NO_MEMORY. */
static hd_status write_flow(double *column, const hd_scene_def *scene, const double *q,
                            const double *p)
{
    const size_t coordinates = (size_t)hd_dynamics_of(scene)->coordinates;
    motion *m;
    HD_TRY(allocate(&m, scene));
    forces_at(m, q);
    for (size_t k = 0; k < m->all; k++) {
        double *one = column + 2 * coordinates * (k / coordinates) + k % coordinates;
        one[0] = p[k];
        one[coordinates] = m->force[k];
    }
    hd_memory_free(m);
    return HD_OK;
}

/** Those of shifts: all particles, all momenta along a coordinate; and the flow. */
int hd_hamiltonian_null(const hd_scene_def *scene, const double *q, const double *p, double *column)
{
    const int of_one = 2 * hd_dynamics_of(scene)->coordinates, rows = of_one * scene->number,
              zeros = hd_hamiltonian_zeros(scene);
    int known = 0;
    for (; hamiltonian_of(scene)->shifts && known < of_one && known < zeros; known++)
        for (int row = 0; row < rows; row++)
            column[(size_t)known * (size_t)rows + (size_t)row] = row % of_one == known;
    if (known == zeros) return known;
    const hd_status written = write_flow(column + (size_t)known * (size_t)rows, scene, q, p);
    return written == HD_OK ? known + 1 : -1;
}

/* ---- record and maps ----------------------------------------------------------------------- */

const char *hd_hamiltonian_fault(const hd_record *record, const hd_scene_def *scene)
{
    const double numbers = (double)numbers_of(scene);
    double left = 0.0, time = 0.0; /* of the kick before, after its last entry */
    for (size_t k = 0; k < hd_record_count(record); k++) {
        const entry *e = hd_record_entry(record, k);
        if (e->left != (left > 0 ? left : numbers)) return "an entry has a wrong place in its kick";
        if (left > 0 && e->time != time) return "the entries of a kick have different times";
        left = fmax(0.0, e->left - PART);
        time = e->time;
    }
    return left > 0 ? "the last kick is not complete" : NULL;
}

double hd_hamiltonian_record_bytes(double entries)
{
    return hd_record_bytes_twice(entries, sizeof(entry));
}

typedef struct maps {
    hd_kicks kicks; /**< what is carried through; it begins the maps */
    double *flight, *length, *kept;
    size_t room; /**< entries for which there is memory */
} maps;

hd_status hd_kicks_create(void **out, const hd_scene_def *scene)
{
    maps *made = *out = hd_memory_alloc(1, sizeof *made);
    if (!made) return HD_NO_MEMORY;
    made->kicks.particles = scene->number;
    return HD_OK;
}

static void release(maps *made)
{
    hd_memory_free(made->flight);
    hd_memory_free(made->length);
    hd_memory_free(made->kept);
    made->flight = made->length = made->kept = NULL;
    made->room = 0;
}

void hd_kicks_free(void *made)
{
    if (made) release(made);
    hd_memory_free(made);
}

/** Makes room for so many entries, each of which may be a kick. */
static hd_status reserve(maps *made, size_t entries)
{
    size_t room = HD_RECORD_FIRST; /* doubled as a record's room is */
    if (entries < made->room) return HD_OK;
    while (room <= entries) room *= 2;
    release(made);
    made->flight = hd_memory_alloc(room, sizeof *made->flight);
    made->length = hd_memory_alloc(room, sizeof *made->length);
    made->kept = hd_memory_alloc(room, PART * sizeof *made->kept);
    if (!made->flight || !made->length || !made->kept) return HD_NO_MEMORY;
    made->room = room;
    return HD_OK;
}

hd_status hd_kicks_fill(void *to, const hd_record *record, double t_begin, double t_end)
{
    maps *made = to;
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    HD_TRY(reserve(made, those.end - those.first));
    size_t count = 0, numbers = 0, left = 0;
    double flight = 0.0, *kept = made->kept;
    for (size_t k = those.first; k < those.end; k++) {
        const entry *e = hd_record_entry(record, k);
        if (left == 0) { /* the first entry of a kick */
            left = numbers = (size_t)e->left;
            made->flight[count] = flight + e->before;
            made->length[count++] = e->length;
            flight = e->after;
        }
        const size_t part = left < PART ? left : PART;
        memcpy(kept, e->kept, sizeof e->kept); /* the next part replaces what is too much */
        kept += part;
        left -= part;
    }
    made->flight[count] = flight;
    made->kicks = (hd_kicks){made->kicks.particles, count,        numbers,
                             made->flight,          made->length, made->kept};
    return HD_OK;
}
