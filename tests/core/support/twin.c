/** Scene -> events without cells, queue or stale predictions: every pair through every image that
 * the two can reach before the epoch's end, then a plain search for the least (t, kind, i, j). With
 * the trajectory it shares the separation of contact.h and what defines the bits: the formula for a
 * contact (here for one pair at a time), epochs, folding into the box, and the exchange of momenta.
 */
#include "twin.h"
#include "one_contact.h"
#include "scene/ends.h"

/** Images that come this close to touching [sigma] are tried: far above rounding, and harmless. */
static const double IMAGE_MARGIN = 1e-6;

enum { PAIR, WALL };

typedef struct contact {
    double t;
    int32_t image[DIM]; /**< box edges to add to the position of the disk of higher index */
} contact;

struct twin {
    int n;
    double box[DIM];
    hd_boundary boundary[DIM];
    hd_scene_def scene;
    double epoch_length, epoch_start;
    int first;       /**< disks of the first kind; the others are of the second one */
    double of[2][2]; /**< radius and share of the impulse that the other kind gives, by kind */
    hd_disk *disk;
    contact *pair; /**< [i * n + j], i < j */
};

typedef struct candidate {
    double t;
    int kind;
    int32_t i, j;
} candidate;

enum { RADIUS, SHARE };

static double radius(const twin *t, int i) { return t->of[i >= t->first][RADIUS]; }

/** Of i, when it meets j. */
static double share(const twin *t, int i, int j)
{
    return (i >= t->first) == (j >= t->first) ? 1.0 : t->of[i >= t->first][SHARE];
}

/* ---- prediction ---------------------------------------------------------------------------- */

/** Of images that touch at the same time the lower one in the last direction is first. */
static bool sooner(const contact *a, const contact *b)
{
    int d = DIM - 1;
    if (a->t != b->t) return a->t < b->t;
    while (d > 0 && a->image[d] == b->image[d]) d--;
    return a->image[d] < b->image[d];
}

/** Two disks, and what is known of their images so far. */
typedef struct encounter {
    const twin *t;
    const hd_disk *a, *b;
    double touching;       /**< the distance at which they do */
    double r[DIM], p[DIM]; /**< separation at the window's zero, and its velocity */
    contact now, *best;
} encounter;

/** Images m for which r + p t + m box touches [-touching, touching] along d within the window. */
static void image_range(int32_t range[2], const encounter *e, int d, const double window[2])
{
    const double a = e->r[d] + e->p[d] * window[0], b = e->r[d] + e->p[d] * window[1];
    range[0] = range[1] = 0;
    if (e->t->boundary[d] != P) return;
    range[0] = (int32_t)ceil((-e->touching - IMAGE_MARGIN - fmax(a, b)) / e->t->box[d]);
    range[1] = (int32_t)floor((e->touching + IMAGE_MARGIN - fmin(a, b)) / e->t->box[d]);
}

/** The part of the window in which |r + p t| <= reach. */
static void touching_window(double part[2], double r, double p, const double window[2],
                            double reach)
{
    memcpy(part, window, 2 * sizeof *part);
    if (p == 0) return;
    part[0] = fmin(fmax((-copysign(reach, p) - r) / p, window[0]), window[1]);
    part[1] = fmin(fmax((copysign(reach, p) - r) / p, window[0]), window[1]);
}

/** Every image along d and the directions behind it. */
static void try_images(encounter *e, int d, const double window[2])
{
    int32_t m[2];
    if (d == DIM) {
        double shift[DIM];
        for (int c = 0; c < DIM; c++) shift[c] = e->now.image[c] * e->t->box[c];
        e->now.t = one_contact(e->a, e->b, shift, e->touching);
        if (e->now.t < INFINITY && sooner(&e->now, e->best)) *e->best = e->now;
        return;
    }
    image_range(m, e, d, window);
    for (int32_t k = m[0]; k <= m[1]; k++) {
        double part[2];
        touching_window(part, e->r[d] + k * e->t->box[d], e->p[d], window,
                        e->touching + IMAGE_MARGIN);
        e->now.image[d] = k;
        try_images(e, d + 1, part);
    }
}

static void predict_pair(twin *t, int i, int j)
{
    encounter e = {.t = t,
                   .a = &t->disk[i],
                   .b = &t->disk[j],
                   .touching = radius(t, i) + radius(t, j),
                   .best = &t->pair[i * t->n + j]};
    const double now = fmax(e.a->t, e.b->t), here[DIM] = {0},
                 window[2] = {0, t->epoch_length - now};
    *e.best = (contact){.t = INFINITY};
    hd_contact_separation(e.r, e.a, e.b, here, now);
    for (int d = 0; d < DIM; d++) e.p[d] = e.b->p[d] - e.a->p[d];
    try_images(&e, 0, window);
}

static void predict_all_of(twin *t, int i)
{
    for (int j = 0; j < i; j++) predict_pair(t, j, i);
    for (int j = i + 1; j < t->n; j++) predict_pair(t, i, j);
}

static double wall_at(const twin *t, const hd_disk *disk, int d)
{
    const double reach = radius(t, (int)(disk - t->disk));
    return disk->p[d] > 0 ? t->box[d] - reach : reach;
}

static double wall_time(const twin *t, const hd_disk *disk, int d)
{
    if (t->boundary[d] == P || disk->p[d] == 0) return INFINITY;
    return disk->t + fmax((wall_at(t, disk, d) - disk->q[d]) / disk->p[d], 0.0);
}

/* ---- search -------------------------------------------------------------------------------- */

static bool before(const candidate *a, const candidate *b)
{
    if (a->t != b->t) return a->t < b->t;
    if (a->kind != b->kind) return a->kind < b->kind;
    if (a->i != b->i) return a->i < b->i;
    if (a->kind == WALL) return a->j > b->j; /* a disk in a corner: HD_WALL_X first */
    return a->j < b->j;
}

static candidate earliest(const twin *t)
{
    candidate best = {.t = INFINITY};
    for (int i = 0; i < t->n; i++) {
        for (int d = 0; d < DIM; d++) {
            const candidate wall = {wall_time(t, &t->disk[i], d), WALL, i, HD_WALL_X - d};
            if (before(&wall, &best)) best = wall;
        }
        for (int j = i + 1; j < t->n; j++) {
            const candidate pair = {t->pair[i * t->n + j].t, PAIR, i, j};
            if (before(&pair, &best)) best = pair;
        }
    }
    return best;
}

/* ---- motion -------------------------------------------------------------------------------- */

static void move(hd_disk *disk, double to)
{
    for (int d = 0; d < DIM; d++) disk->q[d] += disk->p[d] * (to - disk->t);
    disk->t = to;
}

static void fold(const twin *t, hd_disk *disk)
{
    for (int d = 0; d < DIM; d++)
        if (t->boundary[d] == P) disk->q[d] -= floor(disk->q[d] / t->box[d]) * t->box[d];
}

/** r.r - s2 as a double and the correction lost in it, added last; over s2. */
static double excess_of(const double r[DIM], double s2)
{
    double all = r[0] * r[0], lost = 0.0;
    for (int d = 1; d < DIM; d++) {
        const double square = r[d] * r[d], sum = all + square, part = sum - all;
        lost += (all - (sum - part)) + (square - part);
        all = sum;
    }
    for (int d = 0; d < DIM; d++) lost += fma(r[d], r[d], -(r[d] * r[d]));
    return ((all - s2) + lost) / s2;
}

/** An approach by less than this is rounding of the momenta. */
static double lost_by(const hd_disk *a, const hd_disk *b)
{
    double size = 0.0;
    for (int k = 0; k < 2 * DIM; k++) size += fabs(k < DIM ? a->p[k] : b->p[k - DIM]);
    return 8.0 * DBL_EPSILON * size;
}

/** The longest component of r alone, as a unit vector. */
static void longest_of(double u[DIM], const double r[DIM])
{
    int most = 0;
    for (int d = 1; d < DIM; d++) most = fabs(r[d]) > fabs(r[most]) ? d : most;
    for (int d = 0; d < DIM; d++) u[d] = d == most ? copysign(1.0, r[d]) : 0.0;
}

static void push(twin *t, int i, int j, const double along[DIM], double impulse)
{
    for (int d = 0; d < DIM; d++) {
        t->disk[i].p[d] += share(t, i, j) * (impulse * along[d]);
        t->disk[j].p[d] -= share(t, j, i) * (impulse * along[d]);
    }
}

/** False if the two only grazed within rounding. */
static bool collide(twin *t, hd_event *event, const candidate *c)
{
    hd_disk *a = &t->disk[c->i], *b = &t->disk[c->j];
    const contact *how = &t->pair[c->i * t->n + c->j];
    double shift[DIM], r[DIM], u[DIM];
    for (int d = 0; d < DIM; d++) shift[d] = how->image[d] * t->box[d];
    move(a, c->t);
    move(b, c->t);
    hd_contact_separation(r, a, b, shift, c->t);
    const double distance = sqrt(hd_contact_dot(r, r));
    for (int d = 0; d < DIM; d++) {
        event->n[d] = r[d] / distance;
        event->p[d] = b->p[d] - a->p[d];
    }
    const double touching = radius(t, c->i) + radius(t, c->j), s2 = touching * touching;
    const double approach = hd_contact_dot(event->p, r) / s2, lost = lost_by(a, b);
    const bool exchanged = approach * touching < -lost;
    longest_of(u, r);
    if (exchanged)
        push(t, c->i, c->j, r, approach - approach * excess_of(r, s2));
    else if (approach < 0)
        push(t, c->i, c->j, u, -lost);
    fold(t, a);
    fold(t, b);
    predict_all_of(t, c->i);
    predict_all_of(t, c->j);
    return exchanged;
}

static void reflect(twin *t, hd_event *event, const candidate *c)
{
    hd_disk *disk = &t->disk[c->i];
    const int d = HD_WALL_X - c->j;
    move(disk, c->t);
    disk->q[d] = wall_at(t, disk, d);
    event->n[d] = 1.0; /* unless its rule says otherwise */
    memcpy(event->p, disk->p, sizeof event->p);
    const hd_ends *wall = hd_ends_of(t->boundary[d]);
    if (wall->meet) {
        event->j = HD_WALL_RULED(t->boundary[d], d);
        (void)wall->meet(&t->scene, disk->p, event->n, d);
    } else {
        disk->p[d] = -disk->p[d];
    }
    fold(t, disk);
    predict_all_of(t, c->i);
}

static void turn_epoch(twin *t)
{
    for (int i = 0; i < t->n; i++) {
        move(&t->disk[i], t->epoch_length);
        t->disk[i].t = 0;
        fold(t, &t->disk[i]);
    }
    t->epoch_start += t->epoch_length;
    for (int i = 0; i < t->n; i++)
        for (int j = i + 1; j < t->n; j++) predict_pair(t, i, j);
}

bool twin_next(twin *t, hd_event *event, double t_begin, double t_end)
{
    for (;;) {
        const double end = t_end - t->epoch_start, log_start = t_begin - t->epoch_start;
        const candidate c = earliest(t);
        if (c.t < end && c.t < t->epoch_length) {
            *event = (hd_event){.t = fmax(c.t - log_start, 0.0), .i = c.i, .j = c.j};
            if (c.kind == PAIR && !collide(t, event, &c)) continue;
            if (c.kind == WALL) reflect(t, event, &c);
            return true;
        }
        if (end <= t->epoch_length) return false;
        turn_epoch(t);
    }
}

/* ---- creation ------------------------------------------------------------------------------ */

/** Collisions of a disk in a time unit: Enskog's rate [T2], of spheres with what Carnahan and
 * Starling say of a contact. */
static double enskog(double density)
{
    const double eta = DIM == 2 ? fmin(PI * density / 4.0, 0.9) : PI * density / 6.0;
    const double free = 1.0 - eta;
    if (DIM == 2) return 2.0 * sqrt(PI) * density * (1.0 - 7.0 * eta / 16.0) / (free * free);
    return 4.0 * sqrt(PI * 2.0 / 3.0) * density * (1.0 - 0.5 * eta) / (free * free * free);
}

/** The least power of two that holds 32 of a disk's collisions; of a thin gas it is shorter. */
static double epoch_for(const hd_scene_def *def)
{
    int exponent;
    hd_kind kind[HD_KINDS_MAX];
    const bool alike = hd_scene_kinds(def, kind) == 1 && kind[0].diameter == 1;
    const double rate = alike
                            ? enskog(def->density) /* what theory says of mixtures, gas is asked */
                            : 2.0 * hd_dynamics_of(def)->collision_rate(def) / def->number;
    const double part = frexp(fmin(32.0 / rate, 16384.0), &exponent);
    return ldexp(1.0, part == 0.5 ? exponent - 1 : exponent);
}

/** A parameter that only disks and spheres have. */
static double second_of(const hd_scene_def *def, const char *name)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    for (int k = 0; k < of->parameters; k++)
        if (strcmp(of->parameter[k].name, name) == 0)
            return hd_parameter_value(&of->parameter[k], def);
    return NAN;
}

/** Sizes, and shares that add up to 2 to the last bit: the larger one is rounded. */
static void kinds_of(twin *t, const hd_scene_def *def)
{
    hd_kind kind[HD_KINDS_MAX];
    const int kinds = hd_scene_kinds(def, kind);
    const double mass = kinds == 1 ? 1.0 : second_of(def, "second_mass");
    const double larger = mass < 1 ? 2.0 / (1.0 + mass) : 2.0 * mass / (1.0 + mass);
    t->first = kind[0].number;
    for (int k = 0; k < 2; k++) {
        t->of[k][RADIUS] = 0.5 * kind[k < kinds ? k : 0].diameter;
        t->of[k][SHARE] = (k == 0) == (mass < 1) ? 2.0 - larger : larger;
    }
}

twin *twin_create(const hd_scene_def *def, const double *q, const double *p)
{
    const size_t n = (size_t)def->number;
    twin *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    t->n = def->number;
    t->scene = *def;
    memcpy(t->boundary, def->boundary, sizeof t->boundary);
    hd_scene_box(def, t->box);
    kinds_of(t, def);
    t->epoch_length = epoch_for(def);
    t->disk = calloc(n, sizeof *t->disk);
    t->pair = calloc(n * n, sizeof *t->pair);
    if (!t->disk || !t->pair) {
        twin_free(t);
        return NULL;
    }
    for (size_t k = 0; k < DIM * n; k++) {
        t->disk[k / DIM].q[k % DIM] = q[k];
        t->disk[k / DIM].p[k % DIM] = p[k];
    }
    for (int i = 0; i < t->n; i++) predict_all_of(t, i);
    return t;
}

void twin_free(twin *t)
{
    if (!t) return;
    free(t->disk);
    free(t->pair);
    free(t);
}
