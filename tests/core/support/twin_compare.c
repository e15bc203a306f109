/** Follows a trajectory and its twin side by side, interval by interval. */
#include "bodies.h"
#include "twin.h"

/** Intervals are cut unevenly so that their ends fall anywhere in an epoch. */
static const double PIECES[] = {0.37, 2.9, 0.011, 11.3};
enum { PIECE_KINDS = sizeof PIECES / sizeof *PIECES };

static void print_event(const char *whose, const hd_event *e)
{
    print_error("  %s t %.17g i %g j %g", whose, e->t, e->i, e->j);
    for (int d = 0; d < DIM; d++) print_error(" n %.17g p %.17g", e->n[d], e->p[d]);
    print_error("\n");
}

static void fail_at(const hd_scene_def *def, size_t number, const hd_event *got,
                    const hd_event *want)
{
    print_error("N %d density %.17g aspect %.17g %.17g boundary %d %d %d, event %zu:\n",
                def->number, def->density, def->aspect, def->aspect_z, (int)def->boundary[0],
                (int)def->boundary[1], (int)def->boundary[2], number);
    print_event("got ", got);
    print_event("want", want);
    fail();
}

static void compare_interval(const hd_scene_def *def, twin *slow, const hd_record *log,
                             size_t before, double t_begin, double t_end)
{
    hd_event want;
    for (size_t k = 0; k < log->count; k++) {
        if (!twin_next(slow, &want, t_begin, t_end))
            fail_msg("event %zu is not in the twin's log", before + k);
        if (memcmp(&events_in(log)[k], &want, sizeof want) != 0)
            fail_at(def, before + k, &events_in(log)[k], &want);
    }
    if (twin_next(slow, &want, t_begin, t_end))
        fail_msg("event %zu is missing", before + log->count);
}

size_t twin_follow(hd_trajectory *fast, const hd_scene_def *def, size_t events, int pieces)
{
    HEAP double *q = calloc(2 * DIM * (size_t)def->number, sizeof *q);
    double *p = q + DIM * def->number;
    assert_non_null(q);
    hd_trajectory_state(fast, q, NULL);
    for (int k = 0; k < DIM * def->number; k++)
        p[k] = hard_in(fast)->motion.disk[k / DIM].p[k % DIM];
    twin *slow = twin_create(def, q, p);
    assert_non_null(slow);
    OWNED(hd_record) *log = new_log();
    /* between close walls or near closest packing events may be 1e9 times denser than the estimate
     * of the collision rate: the pieces grow from far below it */
    double unit = 1e-9 / hd_trajectory_totals(fast).expected, t = 0;
    size_t count = 0;
    for (int k = 0; count < events && k < pieces; k++) {
        const double t_end = t + unit * PIECES[k % PIECE_KINDS];
        CHECK_OK(trajectory_to(fast, log, t_end));
        compare_interval(def, slow, log, count, t, t_end);
        count += log->count;
        unit *= log->count > events / 16 ? 0.5 : 2.0;
        t = t_end;
    }
    twin_free(slow);
    return count;
}

void twin_compare(hd_trajectory *fast, const hd_scene_def *def, size_t events)
{
    const size_t count = twin_follow(fast, def, events, 10000);
    if (count < events) fail_msg("only %zu of %zu events", count, events);
    hd_trajectory_free(fast);
}
