/** Parameters that are changed while the run goes on: those that were asked for in advance, by the
 * parameter `changes`, and those that ~set asks for. */
#ifndef HDLYAP_CHANGES_H
#define HDLYAP_CHANGES_H

#include "change.h"
#include "hdlyap/run.h"
#include "settings.h"

typedef struct changes {
    change *list; /**< [count] */
    int made;     /**< the first of them, in the order in which they were made; the others wait */
    int count;
} changes;

/** Those of the settings. Of a run that goes on from a simulated time (negative: of none) the
 * settings are as those up to then have made them. False without memory. */
bool changes_create(changes *out, settings *set, double since);
void changes_clear(changes *all);

/** Changes a parameter, "NAME=VALUE", in the run and in the settings, and says in `message` since
 * when it holds. False, and nothing has changed, with one line that says why not. */
bool changes_ask(changes *all, settings *set, hd_run *run, const char *assignment, char *message,
                 size_t size);

/** Changes the duration so that the averaging ends as soon as it can. False as changes_ask, and
 * before the averaging. */
bool changes_end(changes *all, settings *set, hd_run *run, char *message, size_t size);

/** Makes those that wait whose time has come, before the next step. True if there were any; what is
 * refused now is in the log. */
bool changes_take(changes *all, settings *set, hd_run *run);

#endif
