/** Private parameters -> settings. One table row per parameter; the ranges of the scene itself are
 * the core's, everything that only the node knows is checked here. */
#include "settings.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reader.h"
#include "topic.h"

enum {
    OF_WAVES = TOPICS_OF_MODES | 1u << TOPIC_COVARIANT,
    OF_EXPONENTS = 1u << TOPIC_SPECTRUM | OF_WAVES,
    ALL_PUBLISHED = 1u << TOPICS /**< in a set of topics: whatever the others are */
};

#define OF_WAVES_TEXT "modes, steps, lp_phases, fields, hydro, covariant"
#define OBSERVABLES_TEXT "spectrum, " OF_WAVES_TEXT ", state"

/** Reads into field of settings; a missing parameter leaves the default. False if refused. */
typedef bool (*read_function)(const reader *r, void *field);

static bool read_scene(const reader *r, void *field)
{
    const char **scene = field;
    const hdr_status status = hdr_param_string(r->params, r->name, scene);
    return reader_accepts(r, status, "a string") &&
           ((**scene && is_one_line(*scene)) || reader_refuse(r, "a line that is not empty"));
}

static bool read_boundary(const reader *r, void *field)
{
    hd_boundary *boundary = field;
    const char *text = NULL;
    const hdr_status status = hdr_param_string(r->params, r->name, &text);
    if (status == HDR_MISSING) return true;
    if (status == HDR_OK && strcmp(text, "periodic") == 0) return *boundary = HD_PERIODIC, true;
    if (status == HDR_OK && strcmp(text, "reflecting") == 0) return *boundary = HD_REFLECTING, true;
    return reader_refuse(r, "periodic or reflecting");
}

/** Decimal digits and nothing else, at most `max`. */
static bool parse_unsigned(uint64_t *out, const char *text, uint64_t max)
{
    if (!*text || text[strspn(text, "0123456789")]) return false;
    errno = 0;
    const unsigned long long value = strtoull(text, NULL, 10);
    if (errno || value > max) return false;
    *out = value;
    return true;
}

/** A string, because integers have 32 bits on the parameter server; short ones are taken too. */
static bool read_seed(const reader *r, void *field)
{
    int number;
    const char *text = hdr_param_text(r->params, r->name);
    const hdr_status as_string = hdr_param_string(r->params, r->name, &text);
    if (as_string == HDR_MISSING) return true;
    const bool typed = as_string == HDR_OK || hdr_param_int(r->params, r->name, &number) == HDR_OK;
    return (typed && parse_unsigned(field, text, UINT64_MAX)) ||
           reader_refuse(r, "a string of digits, from \"0\" to \"18446744073709551615\"");
}

static bool read_exponents(const reader *r, void *field)
{
    int *exponents = field;
    const char *text = NULL;
    uint64_t number = 0;
    const hdr_status as_int = hdr_param_int(r->params, r->name, exponents);
    if (as_int == HDR_MISSING || (as_int == HDR_OK && *exponents > 0)) return true;
    if (as_int == HDR_WRONG_TYPE && hdr_param_string(r->params, r->name, &text) == HDR_OK) {
        if (strcmp(text, "positive") == 0) return *exponents = HD_EXPONENTS_POSITIVE, true;
        if (strcmp(text, "all") == 0) return *exponents = HD_EXPONENTS_ALL, true;
        if (strcmp(text, "none") == 0) return *exponents = HD_EXPONENTS_NONE, true;
        if (parse_unsigned(&number, text, INT32_MAX) && number > 0)
            return *exponents = (int)number, true;
    }
    return reader_refuse(r, "positive, all, none or a number from 1 to 4 disks");
}

static bool read_interval(const reader *r, void *field)
{
    double *interval = field;
    const char *text = NULL;
    if (hdr_param_string(r->params, r->name, &text) == HDR_OK && strcmp(text, "auto") == 0)
        return *interval = 0.0, true;
    const hdr_status status = hdr_param_double(r->params, r->name, interval);
    if (status == HDR_MISSING || (status == HDR_OK && *interval > 0.0)) return true;
    return reader_refuse(r, "auto, or a number from 1e-6 to 1e12");
}

/** A set of topics out of `allowed` ones. */
static bool read_topics(const reader *r, unsigned *set, unsigned allowed, const char *allowed_text)
{
    const char *const *names = NULL;
    int count = 0;
    const hdr_status status = hdr_param_string_list(r->params, r->name, &names, &count);
    if (status == HDR_MISSING) return true;
    if (status != HDR_OK) return reader_refuse(r, allowed_text);
    *set = 0;
    for (int k = 0; k < count; k++) {
        const unsigned bit = topic_bit_of(names[k]);
        if (!(bit & allowed)) return reader_refuse(r, allowed_text);
        *set |= bit;
    }
    return true;
}

static bool read_observables(const reader *r, void *field)
{
    return read_topics(r, field, TOPICS_OBSERVABLE, "a list out of " OBSERVABLES_TEXT);
}

static bool read_awaited(const reader *r, void *field)
{
    unsigned *awaited = field;
    const char *text = NULL;
    if (hdr_param_string(r->params, r->name, &text) == HDR_OK && strcmp(text, "all") == 0)
        return *awaited = ALL_PUBLISHED, true;
    return read_topics(r, awaited, TOPICS_OBSERVABLE | TOPICS_ALWAYS,
                       "all or a list out of run_info, " OBSERVABLES_TEXT ", cost");
}

/** The range is known only with the scene. */
static bool read_field_indices(const reader *r, void *field)
{
    field_choice *choice = field;
    const char *text = NULL;
    if (hdr_param_string(r->params, r->name, &text) == HDR_OK && strcmp(text, "steps") == 0)
        return true;
    const hdr_status status = hdr_param_int_list(r->params, r->name, &choice->index,
                                                 &choice->count);
    if (status == HDR_MISSING) return true;
    choice->text = hdr_param_text(r->params, r->name);
    return (status == HDR_OK && choice->count > 0) ||
           reader_refuse(r, "steps or a list of integers from 1");
}

/** Of a file; "" for none. */
static bool read_path(const reader *r, void *field)
{
    const char **path = field;
    const hdr_status status = hdr_param_string(r->params, r->name, path);
    return reader_accepts(r, status, "a string") &&
           (is_one_line(*path) || reader_refuse(r, "a path in one line"));
}

static const char *const storage_names[] = {
    [HD_STORAGE_MEMORY] = "memory", [HD_STORAGE_RECOMPUTE] = "recompute"};

const char *settings_storage_name(hd_storage storage) { return storage_names[storage]; }

static bool read_storage(const reader *r, void *field)
{
    hd_storage *storage = field;
    const char *text = NULL;
    const hdr_status status = hdr_param_string(r->params, r->name, &text);
    if (status == HDR_MISSING) return true;
    for (hd_storage s = HD_STORAGE_MEMORY; status == HDR_OK && s <= HD_STORAGE_RECOMPUTE; s++)
        if (strcmp(text, storage_names[s]) == 0) return *storage = s, true;
    return reader_refuse(r, "memory or recompute");
}

/** GB of a parameter, bytes of the core. */
static bool read_gigabytes(const reader *r, void *field)
{
    double *bytes = field, gigabytes = 0.0;
    const hdr_status status = hdr_param_double(r->params, r->name, &gigabytes);
    if (status == HDR_MISSING) return true;
    *bytes = gigabytes * BYTES_PER_GB;
    return (status == HDR_OK && gigabytes >= 1e-3 && gigabytes <= 1e6) ||
           reader_refuse(r, "from 0.001 to 1e6 [GB]");
}

static const struct parameter {
    const char *name;
    read_function read;
    size_t offset;
} parameters[] = {
    {"scene", read_scene, offsetof(settings, scene)},
    {"disks", read_int, offsetof(settings, def.disks)},
    {"density", read_double, offsetof(settings, def.density)},
    {"aspect", read_double, offsetof(settings, def.aspect)},
    {"boundary_x", read_boundary, offsetof(settings, def.boundary[0])},
    {"boundary_y", read_boundary, offsetof(settings, def.boundary[1])},
    {"seed", read_seed, offsetof(settings, def.seed)},
    {"exponents", read_exponents, offsetof(settings, def.exponents)},
    {"equilibration", read_double, offsetof(settings, def.equilibration)},
    {"warmup", read_double, offsetof(settings, def.warmup)},
    {"duration", read_double, offsetof(settings, def.duration)},
    {"target_std_error", read_double, offsetof(settings, def.target_std_error)},
    {"interval", read_interval, offsetof(settings, def.interval)},
    {"accuracy", read_double, offsetof(settings, def.accuracy)},
    {"report_interval", read_double, offsetof(settings, def.report_interval)},
    {"max_wave_number", read_double, offsetof(settings, def.max_wave_number)},
    {"max_mode_number", read_int, offsetof(settings, def.max_mode_number)},
    {"covariant_window", read_double, offsetof(settings, def.covariant_window)},
    {"covariant_transient", read_double, offsetof(settings, def.covariant_transient)},
    {"covariant_sampling", read_double, offsetof(settings, def.covariant_sampling)},
    {"covariant_memory", read_gigabytes, offsetof(settings, def.covariant_memory)},
    {"covariant_storage", read_storage, offsetof(settings, def.covariant_storage)},
    {"field_indices", read_field_indices, offsetof(settings, fields)},
    {"slow_vectors_rate", read_double, offsetof(settings, slow_vectors_rate)},
    {"slow_vectors_count", read_int, offsetof(settings, slow_vectors_count)},
    {"field_interval", read_double, offsetof(settings, field_interval)},
    {"observables", read_observables, offsetof(settings, observables)},
    {"threads", read_int, offsetof(settings, def.threads)},
    {"wait_for_subscribers", read_awaited, offsetof(settings, awaited)},
    {"pace", read_double, offsetof(settings, pace)},
    {"checkpoint", read_path, offsetof(settings, checkpoint)},
    {"checkpoint_interval", read_double, offsetof(settings, checkpoint_interval)},
    {"resume", read_path, offsetof(settings, resume)},
};

enum { PARAMETERS = sizeof parameters / sizeof *parameters };

static bool is_known(const char *name)
{
    for (size_t k = 0; k < PARAMETERS; k++)
        if (strcmp(parameters[k].name, name) == 0) return true;
    return false;
}

/** Where what was a parameter once is now. */
static const char *place_now(const char *name)
{
    if (strcmp(name, "marker_rate") == 0) return "removed: it is slow_vectors_rate now";
    if (strcmp(name, "marker_modes") == 0)
        return "removed: it is modes of the viewer now (rviz.launch modes:=..)";
    return "removed: there is no parameter of this name";
}

static bool check_names(reader *r)
{
    for (int k = 0; k < hdr_params_count(r->params); k++) {
        r->name = hdr_params_name(r->params, k);
        if (!is_known(r->name)) return reader_refuse(r, place_now(r->name));
    }
    return true;
}

static bool read_all(settings *out, reader *r)
{
    for (size_t k = 0; k < PARAMETERS; k++) {
        const struct parameter *p = &parameters[k];
        r->name = p->name;
        if (!p->read(r, (char *)out + p->offset)) return false;
    }
    return true;
}

/** Those that the scene does not know of. */
static bool check_times(const settings *set, reader *r)
{
    const double most = 1e12;
    r->name = "field_interval";
    if (!(set->field_interval >= 0.0 && set->field_interval <= most))
        return reader_refuse(r, "from 0 (with every report) to 1e12");
    r->name = "pace";
    if (!(set->pace >= 0.0 && set->pace <= most))
        return reader_refuse(r, "from 0 (as fast as it goes) to 1e12");
    r->name = "slow_vectors_rate";
    if (!(set->slow_vectors_rate >= 0.01 && set->slow_vectors_rate <= 100.0))
        return reader_refuse(r, "from 0.01 to 100");
    r->name = "checkpoint_interval";
    return (set->checkpoint_interval >= 0.0 && set->checkpoint_interval <= most) ||
           reader_refuse(r, "from 0 (only at the end and when asked) to 1e12");
}

/** Without exponents the defaults that need them go silently. */
static bool check_observables(settings *set, reader *r)
{
    r->name = "observables";
    if (set->def.exponents == HD_EXPONENTS_NONE && (set->observables & OF_EXPONENTS)) {
        if (*hdr_param_text(r->params, r->name))
            return reader_refuse(r, "[state] or [] when exponents = none");
        set->observables &= ~(unsigned)OF_EXPONENTS;
    }
    set->def.observe = topic_stages(set->observables);
    return true;
}

static bool check_awaited(settings *set, reader *r)
{
    const unsigned published = set->observables | TOPICS_ALWAYS;
    r->name = "wait_for_subscribers";
    if (set->awaited == ALL_PUBLISHED) set->awaited = published;
    return !(set->awaited & ~published) ||
           reader_refuse(r, "out of run_info, cost and the observables");
}

/** What is asked for of modes that nobody observes. */
static bool check_modes(const settings *set, reader *r)
{
    const char *const allowed = "0 without an observable out of " OF_WAVES_TEXT;
    const bool observed = set->observables & OF_WAVES;
    r->name = "max_wave_number";
    if (set->def.max_wave_number != 0.0 && !observed) return reader_refuse(r, allowed);
    r->name = "max_mode_number";
    if (set->def.max_mode_number != 0 && !observed) return reader_refuse(r, allowed);
    r->name = "field_indices";
    return set->fields.count == 0 || (set->observables & topic_bit(TOPIC_FIELDS)) ||
           reader_refuse(r, "steps unless fields is an observable");
}

/** What is given of covariant vectors that nobody observes; defaults may be. */
static bool check_covariant(const settings *set, reader *r)
{
    const hd_scene_def usual = hd_scene_def_default(), *def = &set->def;
    const struct {
        const char *name;
        bool changed;
        const char *allowed;
    } table[] = {
#define UNLESS " unless covariant is an observable"
        {"covariant_window", def->covariant_window != usual.covariant_window, "50" UNLESS},
        {"covariant_transient", def->covariant_transient != usual.covariant_transient,
         "100" UNLESS},
        {"covariant_sampling", def->covariant_sampling != usual.covariant_sampling, "5" UNLESS},
        {"covariant_memory", def->covariant_memory != usual.covariant_memory, "4" UNLESS},
        {"covariant_storage", def->covariant_storage != usual.covariant_storage, "memory" UNLESS},
#undef UNLESS
    };
    if (set->observables & topic_bit(TOPIC_COVARIANT)) return true;
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        r->name = table[k].name;
        if (table[k].changed && *hdr_param_text(r->params, r->name))
            return reader_refuse(r, table[k].allowed);
    }
    return true;
}

/** Of a scene that is right. */
static bool check_field_indices(const settings *set, reader *r)
{
    const int vectors = hd_scene_vectors(&set->def);
    char allowed[80];
    r->name = "field_indices";
    snprintf(allowed, sizeof allowed,
             "steps or a list of integers from 1 to %d, the vectors carried", vectors);
    for (int k = 0; k < set->fields.count; k++)
        if (set->fields.index[k] < 1 || set->fields.index[k] > vectors)
            return reader_refuse(r, allowed);
    return true;
}

/** Of a scene that is right. */
static bool check_slow_vectors(const settings *set, reader *r)
{
    const int vectors = hd_scene_vectors(&set->def);
    char allowed[80];
    r->name = "slow_vectors_count";
    snprintf(allowed, sizeof allowed,
             "from 0 (the lowest T and LP steps) to %d, the vectors carried", vectors);
    return (set->slow_vectors_count >= 0 && set->slow_vectors_count <= vectors) ||
           reader_refuse(r, allowed);
}

static void write_texts(settings *out)
{
    const int exponents = out->def.exponents;
    snprintf(out->seed, sizeof out->seed, "%" PRIu64, out->def.seed);
    snprintf(out->exponents, sizeof out->exponents, "%d", exponents);
    if (exponents == HD_EXPONENTS_POSITIVE) strcpy(out->exponents, "positive");
    if (exponents == HD_EXPONENTS_ALL) strcpy(out->exponents, "all");
    if (exponents == HD_EXPONENTS_NONE) strcpy(out->exponents, "none");
}

bool settings_resume(const char **path, const hdr_params *params, char *message, size_t size)
{
    const reader r = {.params = params, .name = "resume", .message = message, .size = size};
    *path = "";
    return read_path(&r, path);
}

/** What the stages of a checkpoint are published as, and what needs none. */
static unsigned topics_of(unsigned stages)
{
    unsigned set = TOPICS_OBSERVABLE;
    for (topic t = 0; t < TOPICS; t++)
        if (topic_stages(topic_bit(t)) & ~stages) set &= ~topic_bit(t);
    return set;
}

static settings defaults(const hd_checkpoint *kept)
{
    settings set = {
        .def = hd_scene_def_default(),
        .scene = "paper_periodic",
        .observables = TOPICS_OBSERVABLE & ~topic_bit(TOPIC_HYDRO) & ~topic_bit(TOPIC_COVARIANT),
        .fields = {.text = "steps"},
        .slow_vectors_rate = 10.0,
        .field_interval = 10.0,
        .checkpoint = "",
        .checkpoint_interval = 600.0,
        .resume = "",
    };
    if (!kept) return set;
    set.def = kept->scene;
    set.scene = kept->label;
    set.observables = topics_of(kept->scene.observe);
    return set;
}

bool settings_read(settings *out, const hdr_params *params, const hd_checkpoint *kept,
                   char *message, size_t size)
{
    reader r = {.params = params, .message = message, .size = size};
    *out = defaults(kept);
    if (!check_names(&r) || !read_all(out, &r)) return false;
    if (!check_times(out, &r) || !check_observables(out, &r) || !check_awaited(out, &r))
        return false;
    if (!check_modes(out, &r) || !check_covariant(out, &r)) return false;
    write_texts(out);
    return hd_scene_check(&out->def, message, size) == HD_OK && check_field_indices(out, &r) &&
           check_slow_vectors(out, &r);
}
