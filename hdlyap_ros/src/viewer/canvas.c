/** Points and texts -> markers. Everything grows to what the largest picture needs, and stays. */
#include "canvas.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** The largest picture has 43. */
enum { LAYERS_MAX = 64, SEEN_MAX = 300, NAME_SIZE = 32, TEXT_SIZE = 400 };

/** One marker; its points are [begin, begin + count) of the canvas. */
typedef struct layer {
    char ns[NAME_SIZE], text[TEXT_SIZE];
    hdr_marker marker;
    size_t begin;
    bool unlit;
} layer;

typedef struct name {
    char ns[NAME_SIZE];
    int32_t id;
} name;

struct canvas {
    layer layers[LAYERS_MAX];
    int count;
    name seen[SEEN_MAX]; /**< whatever was drawn in any picture */
    int seen_count;
    hdr_marker markers[LAYERS_MAX + SEEN_MAX];
    hdr_point *points;
    hdr_colour *colours;
    size_t used, room;
    double level;
    bool failed;
};

bool canvas_create(canvas **out) { return (*out = calloc(1, sizeof **out)); }

void canvas_free(canvas *c)
{
    if (!c) return;
    free(c->points);
    free(c->colours);
    free(c);
}

void canvas_clear(canvas *c)
{
    c->count = 0;
    c->used = 0;
    c->level = 0.0;
    c->failed = false;
}

void canvas_level(canvas *c, double z) { c->level = z; }

static int32_t next_id(const canvas *c, const char *ns)
{
    int32_t id = 0;
    for (int k = 0; k < c->count; k++) id += strcmp(c->layers[k].ns, ns) == 0;
    return id;
}

void canvas_layer(canvas *c, const char *ns, int type, hdr_colour colour, double thickness)
{
    if (c->count == LAYERS_MAX) {
        c->failed = true;
        return;
    }
    layer *l = &c->layers[c->count];
    const bool is_list = type == HDR_MARKER_TRIANGLE_LIST;
    const double width = is_list ? 1.0 : thickness;
    snprintf(l->ns, sizeof l->ns, "%s", ns);
    l->text[0] = '\0';
    l->begin = c->used;
    l->unlit = false;
    l->marker = (hdr_marker){
        .id = next_id(c, l->ns),
        .type = type,
        .action = HDR_MARKER_ADD,
        .scale = {width, width, width},
        .colour = colour,
    };
    c->count++;
}

void canvas_unlit(canvas *c) { c->layers[c->count - 1].unlit = true; }

static bool grow(canvas *c)
{
    const size_t room = 2 * c->room + 1024;
    hdr_point *points = realloc(c->points, room * sizeof *points);
    if (points) c->points = points;
    hdr_colour *colours = realloc(c->colours, room * sizeof *colours);
    if (colours) c->colours = colours;
    if (points && colours) c->room = room;
    return points && colours;
}

void canvas_point(canvas *c, double x, double y, double z)
{
    if (c->used == c->room && !c->failed) c->failed = !grow(c);
    if (c->failed) return;
    hdr_marker *m = &c->layers[c->count - 1].marker;
    c->points[c->used] = (hdr_point){x, y, z};
    c->colours[c->used++] = m->colour;
    m->count++;
}

void canvas_line(canvas *c, double x0, double y0, double x1, double y1)
{
    canvas_point(c, x0, y0, c->level);
    canvas_point(c, x1, y1, c->level);
}

void canvas_text(canvas *c, const char *ns, double x, double y, double height, hdr_colour colour,
                 const char *format, ...)
{
    va_list list;
    canvas_layer(c, ns, HDR_MARKER_TEXT, colour, height);
    if (c->failed) return;
    layer *l = &c->layers[c->count - 1];
    l->marker.position = (hdr_point){x, y, c->level + 0.5};
    va_start(list, format);
    vsnprintf(l->text, sizeof l->text, format, list);
    va_end(list);
}

/** rviz takes an empty list for an error. */
static bool is_drawn(const layer *l)
{
    return l->marker.type == HDR_MARKER_TEXT ? *l->text != '\0' : l->marker.count > 0;
}

static bool is_named(const layer *l, const name *of)
{
    return l->marker.id == of->id && strcmp(l->ns, of->ns) == 0;
}

static bool is_in(const canvas *c, const name *of)
{
    for (int k = 0; k < c->count; k++)
        if (is_named(&c->layers[k], of) && is_drawn(&c->layers[k])) return true;
    return false;
}

/** In every picture anew: who is slow misses some. */
static uint32_t gather_deleted(const canvas *c, hdr_marker *out)
{
    uint32_t count = 0;
    for (int k = 0; k < c->seen_count; k++)
        if (!is_in(c, &c->seen[k]))
            out[count++] = (hdr_marker){
                .ns = c->seen[k].ns,
                .id = c->seen[k].id,
                .action = HDR_MARKER_DELETE,
                .text = "",
            };
    return count;
}

static void note(canvas *c, const layer *l)
{
    for (int k = 0; k < c->seen_count; k++)
        if (is_named(l, &c->seen[k])) return;
    if (c->seen_count == SEEN_MAX) return;
    name *seen = &c->seen[c->seen_count++];
    memcpy(seen->ns, l->ns, sizeof seen->ns);
    seen->id = l->marker.id;
}

static uint32_t gather_drawn(canvas *c, hdr_marker *out)
{
    uint32_t count = 0;
    for (int k = 0; k < c->count; k++) {
        layer *l = &c->layers[k];
        if (!is_drawn(l)) continue;
        l->marker.ns = l->ns;
        l->marker.text = l->text;
        l->marker.points = c->points + l->begin;
        l->marker.colours = l->unlit ? c->colours + l->begin : NULL;
        out[count++] = l->marker;
    }
    return count;
}

bool canvas_markers(canvas *c, hdr_markers *out, const char *frame_id)
{
    if (c->failed) return false;
    uint32_t count = gather_deleted(c, c->markers);
    count += gather_drawn(c, c->markers + count);
    for (int k = 0; k < c->count; k++)
        if (is_drawn(&c->layers[k])) note(c, &c->layers[k]);
    *out = (hdr_markers){.frame_id = frame_id, .markers = c->markers, .count = count};
    return true;
}
