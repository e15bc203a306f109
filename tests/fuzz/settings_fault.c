/** Parameters -> settings that can be run, or one line that names what is refused. */
#include "settings_fault.h"

#include <string.h>

#include "fake_params.h"
#include "node/settings.h"
#include "topics/topic.h"

static bool has_control_character(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 0x7f) return true;
    return false;
}

static const char *line_fault(const hdr_params *params, const char *line, size_t room)
{
    const size_t name_and_value = 300; /* less may end within the name */
    if (!*line) return room > 1 ? "refused without a word" : NULL;
    if (has_control_character(line)) return "refused in more than one line";
    if (room < name_and_value) return NULL;
    if (!fake_params_is_about(params, line)) return "refused without a name";
    return strstr(line, " = ") ? NULL : "refused without a value";
}

static const char *fields_fault(const settings *set)
{
    const int vectors = hd_scene_counts(&set->def).vectors;
    if (!set->fields.text || set->fields.count < 0) return "no choice of fields";
    for (int k = 0; k < set->fields.count; k++)
        if (set->fields.index[k] < 1 || set->fields.index[k] > vectors) return "no such vector";
    return NULL;
}

static const char *accepted_fault(const settings *set)
{
    const unsigned published = set->observables | topics_that_are(TOPIC_ALWAYS);
    if (hd_scene_check(&set->def, NULL, 0) != HD_OK) return "accepted, and no scene";
    if (set->observables & ~topics_that_are(TOPIC_OBSERVABLE)) return "no such observable";
    if (set->awaited & ~published) return "waits for what is not published";
    if (set->def.observe != topic_stages(set->observables)) return "other stages than topics";
    if (set->def.observe && hd_scene_counts(&set->def).vectors == 0) return "modes without vectors";
    if (!(set->def.field_interval >= 0.0 && set->def.field_interval <= 1e12)) return "no time";
    if (!(set->checkpoint_interval >= 0.0 && set->checkpoint_interval <= 1e12)) return "no time";
    return set->pace >= 0.0 && set->pace <= 1e12 ? fields_fault(set) : "no pace";
}

static const char *texts_fault(const settings *set)
{
    const char *const texts[] = {set->scene, set->checkpoint, set->resume};
    for (int k = 0; k < 3; k++)
        if (!texts[k] || has_control_character(texts[k])) return "a text that is no line";
    if (!*set->scene) return "a scene without name";
    if (!memchr(set->seed, '\0', sizeof set->seed)) return "the seed has no end";
    return memchr(set->exponents, '\0', sizeof set->exponents) ? NULL : "exponents have no end";
}

const char *settings_fault(const hdr_params *params, bool resumed, size_t room,
                           char line[SETTINGS_ROOM_MAX])
{
    settings set;
    hd_checkpoint kept = {.scene = hd_scene_def_default(), .label = "kept", .time = 1.0};
    kept.scene.observe = HD_OBSERVE_MODES | HD_OBSERVE_STEPS;
    memset(line, '#', SETTINGS_ROOM_MAX);
    line[0] = '\0'; /* an accepted set writes nothing */
    const char *path;
    const bool accepted = settings_resume(&path, params, line, room) &&
                          settings_read(&set, params, resumed ? &kept : NULL, line, room);
    for (size_t k = room; k < SETTINGS_ROOM_MAX; k++)
        if (line[k] != '#') return "writes behind its room";
    if (!memchr(line, '\0', room)) return "the line has no end";
    if (!accepted) return line_fault(params, line, room);
    if (*line) return "accepted with a word";
    const char *fault = texts_fault(&set);
    return fault ? fault : accepted_fault(&set);
}
