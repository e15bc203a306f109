/** The rows. */
#include "parameters.h"

#include <stdio.h>
#include <string.h>

#include "particles.h"
#include "settings.h"
#include "topics/topic.h"

static const parameter name_row = {
    .name = "scene",
    .kind = NAME,
    .offset = offsetof(settings, scene),
    .default_value = "paper_periodic", /* with all defaults */
    .range = "a line that is not empty",
    .unit = "",
    .may_differ = true,
    .text = "Name of the scene, for run_info. It chooses no system: at least one of particles, "
            "container, number, density, aspects and boundaries must be given, too.",
};

static const parameter rows[] = {
    {
        .name = "observables",
        .kind = TOPICS_OBSERVED,
        .offset = offsetof(settings, observables),
        .default_value = "spectrum, modes, steps, lp_phases, fields, state",
        .range = "a list out of ",
        .unit = "",
        .text =
            "Topics that can be published, beside run_info, status, cost and /diagnostics. A topic "
            "that nobody listens to is not computed. Without exponents only gas, "
            "averages and state exist. averages are what particles of a program's own tell.",
    },
    {
        .name = "field_indices",
        .kind = FIELD_CHOICE,
        .offset = offsetof(settings, fields),
        .default_value = "steps",
        .range = "steps or a list of integers from 1",
        .unit = "",
        .may_differ = true,
        .needs = 1u << TOPIC_fields,
        .text = "Vectors that are published as fields: one of each step that is found, or those "
                "with these Lyapunov indices.",
    },
    {
        .name = "slow_vectors_rate",
        .kind = REAL_NUMBER,
        .offset = offsetof(settings, slow_vectors_rate),
        .default_value = "10",
        .min = 0.01,
        .max = 100,
        .range = "from 0.01 to 100",
        .unit = "1/s",
        .may_differ = true,
        .text = "Largest number of slow_vectors messages per wall second.",
    },
    {
        .name = "slow_vectors_count",
        .kind = WHOLE_NUMBER,
        .offset = offsetof(settings, slow_vectors_count),
        .default_value = "0",
        .range = "from 0 (the lowest T and LP steps) to the vectors carried",
        .unit = "",
        .may_differ = true,
        .text = "Number of vectors in each message of slow_vectors, those of the smallest positive "
                "exponents. 0: all from the lowest T and LP steps that are found on.",
    },
    {
        .name = "wait_for_subscribers",
        .kind = TOPICS_AWAITED,
        .offset = offsetof(settings, awaited),
        .default_value = "",
        .range = "all or a list out of ",
        .unit = "",
        .may_differ = true,
        .text = "Topics that must have a subscriber before the run starts, so that it misses "
                "nothing. all: run_info, status, cost and the observables.",
    },
    {
        .name = "slow_subscribers",
        .kind = CHOICE,
        .offset = offsetof(settings, slow_subscribers),
        .default_value = "wait",
        .range = "wait or drop",
        .unit = "",
        .may_differ = true,
        .text =
            "What happens when a subscriber reads more slowly than the run publishes. wait: the "
            "run waits for it, unless it has read nothing for 5 s. drop: the run goes on, and "
            "the subscriber loses messages, a recorder too.",
    },
    {
        .name = "pace",
        .kind = REAL_NUMBER,
        .offset = offsetof(settings, pace),
        .default_value = "0",
        .max = 1e12,
        .range = "from 0 (as fast as it goes) to 1e12",
        .unit = "time units/s",
        .may_differ = true,
        .live = true,
        .at_once = true,
        .text = "Largest simulated time per wall second during the averaging. The stages before "
                "it have no limit.",
    },
    {
        .name = "changes",
        .kind = CHANGES,
        .offset = offsetof(settings, changes),
        .default_value = "",
        .range = "a list of texts \"TIME NAME=VALUE\"",
        .unit = "",
        .may_differ = true,
        .text = "Changes of parameters at given simulated times, to repeat a run in which ~set was "
                "used.",
    },
    {
        .name = "checkpoint",
        .kind = FILE_PATH,
        .offset = offsetof(settings, checkpoint),
        .default_value = "",
        .range = "a path in one line",
        .unit = "",
        .may_differ = true,
        .text = "File in which the run is kept so that it can be resumed. Empty: no file.",
    },
    {
        .name = "checkpoint_interval",
        .kind = REAL_NUMBER,
        .offset = offsetof(settings, checkpoint_interval),
        .default_value = "600",
        .max = 1e12,
        .range = "from 0 (only at the end and when asked) to 1e12",
        .unit = "s",
        .may_differ = true,
        .text = "Wall time between two writings of the checkpoint, which is also written at the "
                "end and by ~checkpoint.",
    },
    {
        .name = "resume",
        .kind = FILE_PATH,
        .offset = offsetof(settings, resume),
        .default_value = "",
        .range = "a path in one line, or " RESUME_AUTO,
        .unit = "",
        .may_differ = true,
        .text = "Checkpoint from which the run goes on. auto: the file checkpoint, or a new run as "
                "long as there is none. Empty: a new run.",
    },
    {
        .name = "table",
        .kind = REAL_NUMBER,
        .offset = offsetof(settings, table),
        .default_value = "0",
        .max = 1e12,
        .range = "from 0 (none) to 1e12",
        .unit = "s",
        .may_differ = true,
        .text = "Shortest wall time between two tables of the steps in the log. A table comes when "
                "the averaged time has doubled or more steps are known, and at the end.",
    },
};
enum { ROWS = sizeof rows / sizeof *rows };

static int scene_count(void)
{
    int count;
    (void)hd_scene_parameters(&count);
    return count - 1; /* without observe, for which there are observables */
}

static parameter of_row(const hd_parameter *row)
{
    return (parameter){.name = row->name,
                       .kind = row->offset == offsetof(hd_scene_def, particles) ? PARTICLES
                                                                                : OF_SCENE,
                       .offset = offsetof(settings, def),
                       .range = row->range,
                       .unit = row->unit,
                       .may_differ = row->may_differ,
                       .live = row->live,
                       .needs = topics_of_stages(row->needs),
                       .text = row->text,
                       .row = row};
}

static parameter of_scene(int k)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    for (; k > 0 || row->kind == HD_PARAMETER_SET; row++) k -= row->kind != HD_PARAMETER_SET;
    return of_row(row);
}

int parameters_count(void) { return 1 + scene_count() + particles_now()->parameters + ROWS; }

parameter parameters_at(int k)
{
    const hd_dynamics *of = particles_now();
    const int own = k - 1 - scene_count();
    if (k == 0) return name_row;
    if (own < 0) return of_scene(k - 1);
    return own < of->parameters ? of_row(&of->parameter[own]) : rows[own - of->parameters];
}

bool parameters_has(const char *name)
{
    for (int k = 0; k < parameters_count(); k++)
        if (strcmp(parameters_at(k).name, name) == 0) return true;
    return false;
}

/** Letters to put in, leave out or replace until `name` is `other` (Levenshtein). */
static size_t slips(const char *name, const char *other)
{
    enum { LETTERS = 63 };
    size_t row[LETTERS + 1];
    const size_t letters = strnlen(other, LETTERS);
    for (size_t j = 0; j <= letters; j++) row[j] = j;
    for (size_t i = 0; name[i]; i++) {
        size_t corner = i;
        row[0] = i + 1;
        for (size_t j = 1; j <= letters; j++) {
            const size_t replaced = corner + (name[i] != other[j - 1]);
            const size_t added = 1 + (row[j] < row[j - 1] ? row[j] : row[j - 1]);
            corner = row[j];
            row[j] = replaced < added ? replaced : added;
        }
    }
    return row[letters];
}

void parameters_unknown(char text[PARAMETER_UNKNOWN], const char *name)
{
    static const struct {
        const char *name, *now;
    } before[] = {{"target_std_error", "it is written target: smallest 0.01 now"},
                  {"dimensions", "it is called particles now: disks or spheres"},
                  {"disks", "it is called number now"}};
    const char *meant = NULL;
    size_t fewest = 3;
    for (size_t k = 0; k < sizeof before / sizeof *before; k++) {
        if (strcmp(name, before[k].name) != 0) continue;
        snprintf(text, PARAMETER_UNKNOWN, "no such parameter; %s", before[k].now);
        return;
    }
    for (int k = 0; k < parameters_count(); k++) {
        const char *other = parameters_at(k).name;
        const size_t n = slips(name, other);
        if (n >= fewest || 2 * n >= strlen(other)) continue;
        fewest = n;
        meant = other;
    }
    snprintf(text, PARAMETER_UNKNOWN, "no such parameter%s%s%s", meant ? "; is " : "",
             meant ? meant : "", meant ? " meant?" : "");
}

parameter parameters_named(const char *name)
{
    int k = 0;
    while (strcmp(parameters_at(k).name, name) != 0) k++;
    return parameters_at(k);
}

void parameter_usual(char text[PARAMETER_TEXT], const parameter *p)
{
    const hd_scene_def first = particles_usual(), usual = hd_scene_def_of(particles_now());
    const double value = p->row ? hd_parameter_value(p->row, &usual) : 0.0;
    const char *word = p->row ? hd_parameter_word_of(p->row, (int)value) : p->default_value;
    if (p->kind == PARTICLES) word = hd_dynamics_of(&first)->particles;
    if (p->row && p->row->kind == HD_PARAMETER_TEXT) word = "";
    if (p->kind == TOPICS_OBSERVED)
        topic_names(text, PARAMETER_TEXT,
                    topics_named(p->default_value) & topics_of_particles(particles_now()));
    else if (word)
        snprintf(text, PARAMETER_TEXT, "%s", word);
    else
        snprintf(text, PARAMETER_TEXT, "%.15g", value);
}

unsigned parameter_topics(const parameter *p)
{
    if (p->kind == TOPICS_OBSERVED) return topics_that_are(TOPIC_OBSERVABLE);
    return p->kind == TOPICS_AWAITED ? topics_that_are(TOPIC_OBSERVABLE | TOPIC_ALWAYS) : 0;
}

void parameter_allowed(char text[PARAMETER_ALLOWED], const parameter *p)
{
    if (p->kind == PARTICLES)
        particles_names(text, PARAMETER_ALLOWED);
    else
        snprintf(text, PARAMETER_ALLOWED, "%s", p->range);
    const size_t length = strlen(text);
    topic_names(text + length, PARAMETER_ALLOWED - length, parameter_topics(p));
}
