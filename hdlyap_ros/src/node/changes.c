/** Changes -> other values in the run and in the settings. Only the thread that steps the run calls
 * these functions. */
#include "changes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/numbers.h"
#include "hdlyap_ros/node.h"
#include "parameters.h"

/** Two times are the same if they differ by less than this part: a repetition may round
 * differently. */
static const double CLOSE = 1e-9;

/* ---- list ---------------------------------------------------------------------------------- */

void changes_clear(changes *all) { free(all->list); }

/** Moves change k, which waits, to the end of the changes that are made. */
static void put_to_made(changes *all, int k)
{
    const change made = all->list[k];
    memmove(all->list + all->made + 1, all->list + all->made,
            (size_t)(k - all->made) * sizeof made);
    all->list[all->made++] = made;
}

/** Assigns the value in the settings. A live parameter is a text or a real number. */
static void assign(change *c, settings *set, const parameter *p)
{
    char *field = (char *)set + p->offset + (p->row ? p->row->offset : 0);
    if (p->row && p->row->kind == HD_PARAMETER_TEXT)
        snprintf(c->before, sizeof c->before, "%s", field);
    else
        number_text(c->before, sizeof c->before, *(double *)field);
    if (p->row)
        (void)hd_parameter_read(p->row, &set->def, c->value);
    else
        *(double *)field = strtod(c->value, NULL);
}

/** The first waiting change whose time is not later than this; -1 if there is none. */
static int first_until(const changes *all, double time)
{
    int first = -1;
    for (int k = all->made; k < all->count; k++)
        if (all->list[k].time <= time && (first < 0 || all->list[k].time < all->list[first].time))
            first = k;
    return first;
}

bool changes_create(changes *out, settings *set, double since)
{
    char message[256];
    const int count = set->changes.count;
    *out = (changes){.list = calloc((size_t)count + 1, sizeof *out->list), .since = since};
    if (!out->list) return false;
    for (; out->count < count; out->count++)
        (void)change_parse_timed(&out->list[out->count], set->changes.text[out->count], message,
                                 sizeof message);
    for (int k; (k = first_until(out, since * (1.0 + CLOSE))) >= 0;) {
        const parameter p = parameters_named(out->list[k].name);
        assign(&out->list[k], set, &p);
        put_to_made(out, k);
    }
    return true;
}

/* ---- made ---------------------------------------------------------------------------------- */

static bool is_ended(const hd_run *run, char *message, size_t size, const char *name)
{
    return hd_run_stage(run) == HD_FINISHED &&
           !change_refuse(message, size, name, "the run has ended");
}

/** Makes a change in the run; fills in its time and the value before. */
static bool make(change *c, settings *set, hd_run *run, char *message, size_t size)
{
    const parameter p = parameters_named(c->name);
    if (is_ended(run, message, size, c->name)) return false;
    c->time = p.at_once ? hd_run_time(run) : hd_run_change_time(run);
    if (p.row && hd_run_change(run, p.row, c->value, message, size) != HD_OK) return false;
    assign(c, set, &p);
    snprintf(message, size, "%s = %s from simulated time %.6g on, was %s", c->name, c->value,
             c->time, *c->before ? c->before : "none");
    return true;
}

bool changes_ask(changes *all, settings *set, hd_run *run, const char *assignment, char *message,
                 size_t size)
{
    change asked;
    if (!change_parse(&asked, assignment, message, size)) return false;
    change *longer = realloc(all->list, ((size_t)all->count + 1) * sizeof *longer);
    if (!longer) return change_refuse(message, size, assignment, "out of memory");
    all->list = longer;
    if (!make(&asked, set, run, message, size)) return false;
    all->list[all->count++] = asked;
    put_to_made(all, all->count - 1);
    return true;
}

bool changes_end(changes *all, settings *set, hd_run *run, char *message, size_t size)
{
    char assignment[64];
    const double duration = hd_run_shortest_duration(run);
    if (is_ended(run, message, size, "~stop")) return false;
    if (isnan(duration))
        return change_refuse(message, size, "~stop",
                             "nothing has been averaged yet; rosnode kill ends the node at once");
    snprintf(assignment, sizeof assignment, "duration=%.17g", duration);
    if (!changes_ask(all, set, run, assignment, message, size)) return false;
    snprintf(message, size, "ends at simulated time %.6g", all->list[all->made - 1].time);
    return true;
}

static bool is_due(const change *c, const hd_run *run)
{
    const parameter p = parameters_named(c->name);
    const double now = p.at_once ? hd_run_time(run) : hd_run_change_time(run);
    return c->time <= now * (1.0 + CLOSE);
}

bool changes_take(changes *all, settings *set, hd_run *run)
{
    const int made = all->made;
    for (int k = all->made; k < all->count;) {
        char message[3 * HD_TEXT];
        if (!is_due(&all->list[k], run)) {
            k++;
        } else if (make(&all->list[k], set, run, message, sizeof message)) {
            hdr_log(HDR_INFO, "changes: %s", message);
            put_to_made(all, k++);
        } else {
            hdr_log(HDR_WARN, "changes: %s", message);
            memmove(all->list + k, all->list + k + 1,
                    (size_t)(--all->count - k) * sizeof *all->list);
        }
    }
    return all->made > made;
}
