/** Changes of parameters while the run goes on: those of the parameter `changes`, which were given
 * in advance, and those that a call of ~set asks for. */
#ifndef HDLYAP_CHANGES_H
#define HDLYAP_CHANGES_H

#include "change.h"
#include "hdlyap/run.h"
#include "settings.h"

typedef struct changes {
    change *list; /**< [count] */
    int made; /**< number of changes that have been made, which are the first ones, in their order;
                 the others wait */
    int count;
    double since; /**< simulated time at which the run was resumed; negative: it was not */
} changes;

/** Takes the changes of the settings. If the run is resumed at simulated time `since` (negative: it
 * is not), those up to then are made in the settings. Returns false if there is no memory. */
bool changes_create(changes *out, settings *set, double since);
void changes_clear(changes *all);

/** Changes a parameter, "NAME=VALUE", in the run and in the settings, and writes to `message` from
 * when on it holds. Returns false, with one line that says why, if nothing has changed. */
bool changes_ask(changes *all, settings *set, hd_run *run, const char *assignment, char *message,
                 size_t size);

/** Changes the duration so that the averaging ends as soon as possible. Returns false if
 * changes_ask would, or if the run is not averaging yet. */
bool changes_end(changes *all, settings *set, hd_run *run, char *message, size_t size);

/** Called before the next step: makes the waiting changes whose time has come, and logs those that
 * are refused. Returns true if there were any. */
bool changes_take(changes *all, settings *set, hd_run *run);

#endif
