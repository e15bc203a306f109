/** Scenes of dumbbells, and their gaps by another way than the core's: with libm, one at a time. */
#ifndef TEST_DUMBBELL_H
#define TEST_DUMBBELL_H

#include "testing.h"

enum { D = 3, MOLECULES_MAX = 64, DUMBBELL_ROWS = 2 * D };

typedef struct molecules {
    double q[D * MOLECULES_MAX], p[D * MOLECULES_MAX];
} molecules;

static inline hd_scene_def usual_dumbbells(void)
{
    const hd_scene_def core = {.particles = HD_DUMBBELLS};
    return hd_scene_def_of(hd_dynamics_of(&core));
}

/** walls: 1 of x, 2 of y; inertia 0: of two disks, -1: of two points. */
static inline hd_scene_def dumbbells_in_box(int count, double lx, double ly, double bond,
                                            double inertia, int walls, uint64_t seed)
{
    hd_scene_def def = usual_dumbbells();
    def.number = count;
    def.density = count / (lx * ly);
    def.aspect = ly / lx;
    def.boundary[0] = (hd_boundary)(walls & 1);
    def.boundary[1] = (hd_boundary)(walls >> 1);
    def.own[0].real = bond;
    def.own[1].real = inertia;
    def.seed = seed;
    return def;
}

static inline double root_of(const hd_scene_def *def)
{
    const double bond = def->own[0].real, given = def->own[1].real;
    return sqrt(given > 0 ? given : 0.25 * bond * bond + (given < 0 ? 0.0 : 0.125));
}

/** What can meet: molecule i with the image of molecule j, or with a wall (j = -1 .. -4: low x,
 * low y, high x, high y), by one of the disks of each. */
typedef struct facing {
    int i, j, image[2], disk[2];
} facing;

static inline double sign_of(int disk) { return disk ? 1.0 : -1.0; }

/** Arm of a disk of molecule i, after a flight of h. */
static inline void arm_then(double arm[2], const hd_scene_def *def, const molecules *s, int i,
                            int disk, double h)
{
    const double angle = (s->q[D * i + 2] + h * s->p[D * i + 2]) / root_of(def);
    arm[0] = sign_of(disk) * 0.5 * def->own[0].real * cos(angle);
    arm[1] = sign_of(disk) * 0.5 * def->own[0].real * sin(angle);
}

/** Gap after a flight of h. gradient[6], or NULL: of i, then of j, in scaled coordinates. */
static inline double gap_then(double *gradient, const hd_scene_def *def, const molecules *s,
                              const facing *f, double h)
{
    double box[2], arm[2][2] = {{0}}, r[2], n[2] = {0.0}, gap;
    const double root = root_of(def);
    const int i = D * f->i, j = D * f->j;
    hd_scene_box(def, box);
    arm_then(arm[0], def, s, f->i, f->disk[0], h);
    if (f->j >= 0) {
        arm_then(arm[1], def, s, f->j, f->disk[1], h);
        for (int d = 0; d < 2; d++)
            r[d] = s->q[j + d] + h * s->p[j + d] + f->image[d] * box[d] + arm[1][d] - s->q[i + d] -
                   h * s->p[i + d] - arm[0][d];
        const double distance = hypot(r[0], r[1]);
        n[0] = r[0] / distance, n[1] = r[1] / distance;
        gap = distance - 1.0;
    } else {
        const int d = (-1 - f->j) % 2, far = (-1 - f->j) / 2;
        const double at = s->q[i + d] + h * s->p[i + d] + arm[0][d];
        n[d] = far ? 1.0 : -1.0; /* minus the gradient at i, as of a pair */
        gap = (far ? box[d] - at : at) - 0.5;
    }
    if (!gradient) return gap;
    for (int k = 0; k < 2; k++) {
        const double side = k == 0 ? -1.0 : f->j >= 0 ? 1.0 : 0.0;
        gradient[D * k] = side * n[0];
        gradient[D * k + 1] = side * n[1];
        gradient[D * k + 2] = side * (n[1] * arm[k][0] - n[0] * arm[k][1]) / root;
    }
    return gap;
}

/** Its rate. */
static inline double rate_then(const hd_scene_def *def, const molecules *s, const facing *f,
                               double h)
{
    double gradient[2 * D], rate = 0.0;
    (void)gap_then(gradient, def, s, f, h);
    for (int d = 0; d < D; d++) {
        rate += gradient[d] * s->p[D * f->i + d];
        if (f->j >= 0) rate += gradient[D + d] * s->p[D * f->j + d];
    }
    return rate;
}

/** p' = p - 2 (p.w) w / w^2. */
static inline void bounce(const hd_scene_def *def, molecules *s, const facing *f)
{
    double w[2 * D], square = 0.0;
    const double rate = rate_then(def, s, f, 0.0);
    (void)gap_then(w, def, s, f, 0.0);
    for (int k = 0; k < 2 * D; k++) square += w[k] * w[k];
    for (int d = 0; d < D; d++) {
        s->p[D * f->i + d] -= 2.0 * rate / square * w[d];
        if (f->j >= 0) s->p[D * f->j + d] -= 2.0 * rate / square * w[D + d];
    }
}

static inline void fly_for(molecules *s, int count, double h)
{
    for (int k = 0; k < D * count; k++) s->q[k] += h * s->p[k];
}

/** All that can meet within `reach` of the images that are there; their number. */
static inline int facings_of(facing *out, int most, const hd_scene_def *def, const molecules *s,
                             double reach)
{
    double box[2];
    int count = 0, far[2];
    hd_scene_box(def, box);
    for (int d = 0; d < 2; d++)
        far[d] = def->boundary[d] == HD_PERIODIC ? 1 + (int)((reach + 1.0) / box[d]) : 0;
    for (int i = 0; i < def->number; i++) {
        for (int disk = 0; disk < 2; disk++)
            for (int wall = 0; wall < 4; wall++)
                if (def->boundary[wall % 2] == HD_REFLECTING && count < most)
                    out[count++] = (facing){i, -1 - wall, {0, 0}, {disk, 0}};
        for (int j = i + 1; j < def->number; j++)
            for (int x = -far[0]; x <= far[0]; x++)
                for (int y = -far[1]; y <= far[1]; y++) {
                    const double rx = s->q[D * j] - s->q[D * i] + x * box[0],
                                 ry = s->q[D * j + 1] - s->q[D * i + 1] + y * box[1];
                    for (int which = 0; which < 4 && hypot(rx, ry) < reach; which++)
                        if (count < most)
                            out[count++] = (facing){i, j, {x, y}, {which & 1, which >> 1}};
                }
    }
    assert_true(count < most);
    return count;
}

static inline double least_gap_of(const hd_scene_def *def, const molecules *s)
{
    enum { MOST = 40000 };
    HEAP facing *all = malloc(MOST * sizeof *all);
    const int count = facings_of(all, MOST, def, s, 2.0 + def->own[0].real);
    double least = INFINITY;
    for (int k = 0; k < count; k++) least = fmin(least, gap_then(NULL, def, s, &all[k], 0.0));
    return least;
}

static inline molecules molecules_now(const hd_trajectory *tr)
{
    molecules s;
    hd_trajectory_state(tr, s.q, s.p);
    return s;
}

static inline hd_record *new_dumbbell_log(const hd_scene_def *def)
{
    hd_record *log;
    CHECK_OK(hd_record_create(&log, hd_dynamics_of(def)->entry));
    return log;
}

#endif
