/** Scene -> events without cells, queue or stale predictions: every pair through every image that
 * the two can reach before the epoch's end, then a plain search for the least (t, kind, i, j). With
 * the trajectory it shares the separation of contact.h and what defines the bits: the formula for a
 * contact (here for one pair at a time), epochs, folding into the box, and the exchange of momenta.
 */
#include "twin.h"
#include "one_contact.h"

/** Images that come this close to touching [sigma] are tried: far above rounding, and harmless. */
static const double IMAGE_MARGIN = 1e-6;

enum { PAIR, WALL };

typedef struct contact {
    double t;
    int32_t image[2]; /**< box edges to add to the position of the disk of higher index */
} contact;

struct twin {
    int n;
    double box[2];
    hd_boundary boundary[2];
    double epoch_length, epoch_start;
    hd_disk *disk;
    contact *pair; /**< [i * n + j], i < j */
};

typedef struct candidate {
    double t;
    int kind;
    int32_t i, j;
} candidate;

/* ---- prediction ---------------------------------------------------------------------------- */

static contact contact_through(const twin *t, int i, int j, int32_t mx, int32_t my)
{
    const double shift[2] = {mx * t->box[0], my * t->box[1]};
    const double time = one_contact(&t->disk[i], &t->disk[j], shift);
    return time < INFINITY ? (contact){time, {mx, my}} : (contact){.t = INFINITY};
}

static bool sooner(const contact *a, const contact *b)
{
    if (a->t != b->t) return a->t < b->t;
    if (a->image[1] != b->image[1]) return a->image[1] < b->image[1];
    return a->image[0] < b->image[0];
}

typedef struct line {
    /** Separation along one direction at the window's zero, and its velocity */
    double r, p;
    double from, to; /**< window of time */
    double box;
    hd_boundary boundary;
} line;

/** Images m for which r + p t + m box touches [-1, 1] within the window. */
static void image_range(int32_t range[2], const line *l)
{
    const double a = l->r + l->p * l->from, b = l->r + l->p * l->to;
    range[0] = range[1] = 0;
    if (l->boundary == R) return;
    range[0] = (int32_t)ceil((-1.0 - IMAGE_MARGIN - fmax(a, b)) / l->box);
    range[1] = (int32_t)floor((1.0 + IMAGE_MARGIN - fmin(a, b)) / l->box);
}

/** The part [from, to] of the window [0, length] in which |r + p t| <= 1. */
static void touching_window(double window[2], double r, double p, double length)
{
    const double reach = 1.0 + IMAGE_MARGIN;
    window[0] = 0;
    window[1] = length;
    if (p == 0) return;
    const double in = (-copysign(reach, p) - r) / p, out = (copysign(reach, p) - r) / p;
    window[0] = fmin(fmax(in, 0.0), length);
    window[1] = fmin(fmax(out, 0.0), length);
}

static void predict_pair(twin *t, int i, int j)
{
    const hd_disk *a = &t->disk[i], *b = &t->disk[j];
    const double now = fmax(a->t, b->t), length = t->epoch_length - now;
    contact *best = &t->pair[i * t->n + j];
    *best = (contact){.t = INFINITY};
    const double here[2] = {0, 0};
    double r[2];
    hd_contact_separation(r, a, b, here, now);
    const line x = {r[0], b->p[0] - a->p[0], 0, length, t->box[0], t->boundary[0]};
    int32_t mx[2], my[2];
    image_range(mx, &x);
    for (int32_t m = mx[0]; m <= mx[1]; m++) {
        double window[2];
        touching_window(window, r[0] + m * t->box[0], x.p, length);
        const line y = {r[1], b->p[1] - a->p[1], window[0], window[1], t->box[1], t->boundary[1]};
        image_range(my, &y);
        for (int32_t k = my[0]; k <= my[1]; k++) {
            const contact found = contact_through(t, i, j, m, k);
            if (sooner(&found, best)) *best = found;
        }
    }
}

static void predict_all_of(twin *t, int i)
{
    for (int j = 0; j < i; j++) predict_pair(t, j, i);
    for (int j = i + 1; j < t->n; j++) predict_pair(t, i, j);
}

static double wall_at(const twin *t, const hd_disk *disk, int d)
{
    return disk->p[d] > 0 ? t->box[d] - 0.5 : 0.5;
}

static double wall_time(const twin *t, const hd_disk *disk, int d)
{
    if (t->boundary[d] != R || disk->p[d] == 0) return INFINITY;
    return disk->t + fmax((wall_at(t, disk, d) - disk->q[d]) / disk->p[d], 0.0);
}

/* ---- search -------------------------------------------------------------------------------- */

static bool before(const candidate *a, const candidate *b)
{
    if (a->t != b->t) return a->t < b->t;
    if (a->kind != b->kind) return a->kind < b->kind;
    if (a->i != b->i) return a->i < b->i;
    if (a->kind == WALL) return a->j > b->j; /* a disk in a corner: HD_WALL_X, then HD_WALL_Y */
    return a->j < b->j;
}

static candidate earliest(const twin *t)
{
    candidate best = {.t = INFINITY};
    for (int i = 0; i < t->n; i++) {
        for (int d = 0; d < 2; d++) {
            const candidate wall = {wall_time(t, &t->disk[i], d), WALL, i,
                                    d ? HD_WALL_Y : HD_WALL_X};
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
    for (int d = 0; d < 2; d++) disk->q[d] += disk->p[d] * (to - disk->t);
    disk->t = to;
}

static void fold(const twin *t, hd_disk *disk)
{
    for (int d = 0; d < 2; d++)
        if (t->boundary[d] == P) disk->q[d] -= floor(disk->q[d] / t->box[d]) * t->box[d];
}

/** r.r - 1 as a double and the correction lost in it, added last. */
static double excess_of(const double r[2])
{
    const double xx = r[0] * r[0], yy = r[1] * r[1], sum = xx + yy, back = sum - xx;
    const double lost = (xx - (sum - back)) + (yy - back);
    return (sum - 1.0) + (lost + fma(r[0], r[0], -xx) + fma(r[1], r[1], -yy));
}

/** An approach by less than this is rounding of the momenta. */
static double lost_by(const hd_disk *a, const hd_disk *b)
{
    return 8.0 * DBL_EPSILON * (fabs(a->p[0]) + fabs(a->p[1]) + fabs(b->p[0]) + fabs(b->p[1]));
}

static void push(hd_disk *a, hd_disk *b, const double along[2], double impulse)
{
    for (int d = 0; d < 2; d++) {
        a->p[d] += impulse * along[d];
        b->p[d] -= impulse * along[d];
    }
}

/** False if the two only grazed within rounding. */
static bool collide(twin *t, hd_event *event, const candidate *c)
{
    hd_disk *a = &t->disk[c->i], *b = &t->disk[c->j];
    const contact *how = &t->pair[c->i * t->n + c->j];
    const double shift[2] = {how->image[0] * t->box[0], how->image[1] * t->box[1]};
    move(a, c->t);
    move(b, c->t);
    double r[2];
    hd_contact_separation(r, a, b, shift, c->t);
    const double distance = sqrt(r[0] * r[0] + r[1] * r[1]);
    for (int d = 0; d < 2; d++) {
        event->n[d] = r[d] / distance;
        event->p[d] = b->p[d] - a->p[d];
    }
    const double approach = event->p[0] * r[0] + event->p[1] * r[1];
    const double lost = lost_by(a, b);
    const bool exchanged = approach < -lost;
    if (exchanged)
        push(a, b, r, approach - approach * excess_of(r));
    else if (approach < 0)
        push(a, b,
             fabs(r[1]) > fabs(r[0]) ? (const double[2]){0, copysign(1, r[1])}
                                     : (const double[2]){copysign(1, r[0]), 0},
             -lost);
    fold(t, a);
    fold(t, b);
    predict_all_of(t, c->i);
    predict_all_of(t, c->j);
    return exchanged;
}

static void reflect(twin *t, hd_event *event, const candidate *c)
{
    hd_disk *disk = &t->disk[c->i];
    const int d = c->j == HD_WALL_Y;
    move(disk, c->t);
    disk->q[d] = wall_at(t, disk, d);
    event->n[d] = 1.0;
    event->p[0] = disk->p[0];
    event->p[1] = disk->p[1];
    disk->p[d] = -disk->p[d];
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

/** The least power of two that holds 32 of a disk's collisions at Enskog's rate [T2]. */
static double epoch_for(const hd_scene_def *def)
{
    const double pi = 3.14159265358979323846, eta = fmin(pi * def->density / 4.0, 0.9);
    const double at_contact = (1.0 - 7.0 * eta / 16.0) / ((1.0 - eta) * (1.0 - eta));
    int exponent;
    const double collisions = 32.0 / (2.0 * sqrt(pi) * def->density * at_contact);
    const double part = frexp(fmin(collisions, 16384.0),
                              &exponent); /* a thin gas: shorter epochs */
    return ldexp(1.0, part == 0.5 ? exponent - 1 : exponent);
}

twin *twin_create(const hd_scene_def *def, const double *q, const double *p)
{
    const size_t n = (size_t)def->disks;
    twin *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    *t = (twin){.n = def->disks, .boundary = {def->boundary[0], def->boundary[1]}};
    hd_scene_box(def, t->box);
    t->epoch_length = epoch_for(def);
    t->disk = calloc(n, sizeof *t->disk);
    t->pair = calloc(n * n, sizeof *t->pair);
    if (!t->disk || !t->pair) {
        twin_free(t);
        return NULL;
    }
    for (size_t k = 0; k < 2 * n; k++) {
        t->disk[k / 2].q[k % 2] = q[k];
        t->disk[k / 2].p[k % 2] = p[k];
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
