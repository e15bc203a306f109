/** States of the disks -> the earliest event of each. See hard.c for the scheme.
 * Runs in one thread. */
#include "dynamics/hard/prediction.h"

enum { HD_WALL_CONTACTS = 0 };
#include "dynamics/hard/predict.h"

/** Replaces the prediction of disk i by its earliest contact nearby, if that is earlier. */
static void predict_nearby(hd_motion *m, int32_t i, hd_nearby *near)
{
    double contact[HD_NEARBY_MAX + HD_NEARBY_SPARE];
    const int first = hd_nearby_contacts(contact, near, m->disk, i, m->cells.box, &m->sizes);
    if (first >= 0) (void)predict_contact(m, i, near, first, contact[first]);
    if (first != HD_NEARBY_TIED) return;
    for (int k = 0; k < near->count; k++) (void)predict_contact(m, i, near, k, contact[k]);
}

/** Starts the prediction of disk i with the round wall. Pairs at the same time come before it,
 * because the wall's number as a partner is the highest. */
static void predict_round_wall(hd_motion *m, int32_t i)
{
    m->predicted[i] = (prediction){
        .contact = hd_round_wall_time(hd_motion_wall(m, &m->disk[i]), &m->disk[i]),
        .partner = m->count};
}

void hd_prediction_renew(hd_motion *m, int32_t i)
{
    m->predicted[i].contact = INFINITY;
    m->predicted[i].partner = -1;
    if (m->wall.wait) predict_round_wall(m, i);
    predict_around(m, i);
    schedule(m, i);
}

void hd_prediction_extend(hd_motion *m, int32_t i, int d, int side)
{
    predict_beside(m, i, d, side);
    schedule(m, i);
}
