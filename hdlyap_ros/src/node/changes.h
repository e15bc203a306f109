/** Parameters that change while the run goes on: those of the parameter `changes`, in advance, and
 * those that ~set asks for. */
#ifndef HDLYAP_CHANGES_H
#define HDLYAP_CHANGES_H

#include "change.h"
#include "hdlyap/run.h"
#include "settings.h"

typedef struct changes {
    change *list; /**< [count] */
    int made;     /**< how many are made: the first ones, in their order; the others wait */
    int count;
} changes;

/** Creates the changes of the settings. For a run that is resumed at simulated time `since`
 * (negative: it is not), makes those up to then in the settings. False if there is no memory. */
bool changes_create(changes *out, settings *set, double since);
void changes_clear(changes *all);

/** Changes a parameter, "NAME=VALUE", in the run and in the settings, and says in `message` since
 * when it holds. False, and nothing has changed, with one line that says why not. */
bool changes_ask(changes *all, settings *set, hd_run *run, const char *assignment, char *message,
                 size_t size);

/** Changes the duration so that the averaging ends as soon as possible. False if changes_ask would
 * fail, or before the averaging. */
bool changes_end(changes *all, settings *set, hd_run *run, char *message, size_t size);

/** Makes, before the next step, the waiting changes whose time has come. True if there were any;
 * the log has those that are refused now. */
bool changes_take(changes *all, settings *set, hd_run *run);

#endif
