/** States of the dumbbells -> the earliest event of each. Runs in one thread. */
#include "dynamics/dumbbells/dumbbells.h"

enum { HD_WALL_CONTACTS = 1 };
#include "dynamics/hard/predict.h"

static void predict_pair(hd_molecules *m, int32_t i, const hd_nearby *near, int k)
{
    const prediction *next = m->hard.motion.predicted;
    const int32_t j = near->disk[k], first = i < j ? i : j, second = i + j - first;
    const double until = fmin(next[i].contact, next[j].contact);
    int32_t image[2], which; /* relative to `first` */
    if (j == i) return;
    for (int d = 0; d < 2; d++) {
        const int32_t seen = near->image[d][k] - m->hard.motion.disk[j].wrap[d];
        image[d] = i == first ? seen : -seen;
    }
    const double t = hd_meeting_of_pair(m, first, second, image, fmin(until, m->hard.epoch_length),
                                        &which);
    if (predict_contact(&m->hard.motion, i, near, k, t)) m->which[i] = which;
}

static void predict_nearby(hd_motion *motion, int32_t i, hd_nearby *near)
{
    for (int k = 0; k < near->count; k++) predict_pair((hd_molecules *)motion, i, near, k);
}

static void predict_wall(hd_molecules *m, int32_t i, int d)
{
    prediction *best = &m->hard.motion.predicted[i];
    int32_t which;
    if (m->hard.motion.cells.boundary[d] != HD_REFLECTING) return;
    const double t = hd_meeting_of_wall(m, i, d, fmin(best->contact, m->hard.epoch_length), &which);
    if (!(t < best->contact)) return;
    *best = (prediction){.contact = t, .partner = -1 - d};
    m->which[i] = which;
}

void hd_next_renew(hd_molecules *m, int32_t i)
{
    m->hard.motion.predicted[i] = (prediction){.contact = INFINITY, .partner = -1};
    predict_around(&m->hard.motion, i);
    for (int d = 0; d < 2; d++) predict_wall(m, i, d);
    schedule(&m->hard.motion, i);
}

void hd_next_extend(hd_molecules *m, int32_t i, int d, int side)
{
    predict_beside(&m->hard.motion, i, d, side);
    schedule(&m->hard.motion, i);
}

void hd_next_restart(hd_molecules *m)
{
    prediction *next = m->hard.motion.predicted;
    hd_queue_restart(&m->hard.motion.queue);
    for (int32_t i = 0; i < m->hard.motion.count; i++) next[i].contact = INFINITY;
    for (int32_t i = 0; i < m->hard.motion.count; i++) hd_next_renew(m, i);
}
