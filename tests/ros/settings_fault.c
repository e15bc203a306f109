/** Parameters -> settings that can be run, or one line that names what is refused. */
#include "settings_fault.h"

#include <string.h>

#include "fake_params.h"
#include "settings.h"
#include "topic.h"

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
    const int vectors = hd_scene_vectors(&set->def);
    if (!set->fields.text || set->fields.count < 0) return "no choice of fields";
    for (int k = 0; k < set->fields.count; k++)
        if (set->fields.index[k] < 1 || set->fields.index[k] > vectors) return "no such vector";
    return NULL;
}

static const char *accepted_fault(const settings *set)
{
    const unsigned published = set->observables | TOPICS_ALWAYS;
    if (hd_scene_check(&set->def, NULL, 0) != HD_OK) return "accepted, and no scene";
    if (!set->scene || !*set->scene || has_control_character(set->scene))
        return "a scene without name";
    if (!memchr(set->seed, '\0', sizeof set->seed)) return "the seed has no end";
    if (!memchr(set->exponents, '\0', sizeof set->exponents)) return "exponents have no end";
    if (set->observables & ~(unsigned)TOPICS_OBSERVABLE) return "no such observable";
    if (set->awaited & ~published) return "waits for what is not published";
    if (set->def.observe != topic_stages(set->observables)) return "other stages than topics";
    if (set->def.observe && hd_scene_vectors(&set->def) == 0) return "modes without vectors";
    return set->pace >= 0.0 && set->pace <= 1e12 ? fields_fault(set) : "no pace";
}

const char *settings_fault(const hdr_params *params, size_t room, char line[SETTINGS_ROOM_MAX])
{
    settings set;
    memset(line, '#', SETTINGS_ROOM_MAX);
    line[0] = '\0'; /* an accepted set writes nothing */
    const bool accepted = settings_read(&set, params, line, room);
    for (size_t k = room; k < SETTINGS_ROOM_MAX; k++)
        if (line[k] != '#') return "writes behind its room";
    if (!memchr(line, '\0', room)) return "the line has no end";
    if (accepted) return *line ? "accepted with a word" : accepted_fault(&set);
    return line_fault(params, line, room);
}
