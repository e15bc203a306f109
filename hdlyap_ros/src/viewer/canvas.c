/** Points and texts -> markers. Memory grows to what the largest picture needs, and is kept. */
#include "canvas.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** The largest picture has 53 markers. */
enum { MARKERS_MAX = 64, NAME_SIZE = 32, TEXT_SIZE = 400 };

/** What a marker points to. begin: where its points begin among the points of the canvas. */
typedef struct layer {
    char ns[NAME_SIZE], text[TEXT_SIZE];
    size_t begin;
    bool unlit;
} layer;

struct canvas {
    hdr_marker markers[MARKERS_MAX];
    layer layers[MARKERS_MAX];
    int count;
    hdr_point *points;
    hdr_colour *colours;
    size_t used, room;
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

/** The first marker deletes the picture that a viewer shows, whichever that is if it is slow. */
void canvas_clear(canvas *c)
{
    c->markers[0] = (hdr_marker){.ns = "", .action = HDR_MARKER_DELETE_ALL, .text = ""};
    c->count = 1;
    c->used = 0;
    c->failed = false;
}

static int32_t next_id(const canvas *c, const char *ns)
{
    int32_t id = 0;
    for (int k = 1; k < c->count; k++) id += strcmp(c->layers[k].ns, ns) == 0;
    return id;
}

/** Drops the last marker if it is empty, which rviz would show as an error. */
static void drop_if_empty(canvas *c)
{
    const hdr_marker *last = &c->markers[c->count - 1];
    if (c->count > 1 && last->count == 0 && !*last->text) c->count--;
}

void canvas_layer(canvas *c, const char *ns, int type, hdr_colour colour, double thickness)
{
    const double width = type == HDR_MARKER_TRIANGLE_LIST ? 1.0 : thickness;
    drop_if_empty(c);
    if (c->count == MARKERS_MAX) {
        c->failed = true;
        return;
    }
    layer *l = &c->layers[c->count];
    *l = (layer){.begin = c->used};
    snprintf(l->ns, sizeof l->ns, "%s", ns);
    c->markers[c->count] = (hdr_marker){
        .ns = l->ns,
        .id = next_id(c, l->ns),
        .type = type,
        .action = HDR_MARKER_ADD,
        .scale = {width, width, width},
        .colour = colour,
        .text = l->text,
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

void canvas_point(canvas *c, hdr_point at)
{
    if (c->used == c->room && !c->failed) c->failed = !grow(c);
    if (c->failed) return;
    hdr_marker *m = &c->markers[c->count - 1];
    c->points[c->used] = at;
    c->colours[c->used++] = m->colour;
    m->count++;
}

void canvas_text(canvas *c, const char *ns, hdr_point at, double height, hdr_colour colour,
                 const char *format, ...)
{
    va_list list;
    canvas_layer(c, ns, HDR_MARKER_TEXT, colour, height);
    if (c->failed) return;
    c->markers[c->count - 1].position = (hdr_point){at.x, at.y, at.z + 0.5};
    va_start(list, format);
    vsnprintf(c->layers[c->count - 1].text, TEXT_SIZE, format, list);
    va_end(list);
}

bool canvas_markers(canvas *c, hdr_markers *out, const char *frame_id)
{
    drop_if_empty(c);
    for (int k = 1; k < c->count; k++) {
        const layer *l = &c->layers[k];
        c->markers[k].points = c->points + l->begin;
        c->markers[k].colours = l->unlit ? c->colours + l->begin : NULL;
    }
    *out = (hdr_markers){.frame_id = frame_id, .markers = c->markers, .count = (uint32_t)c->count};
    return !c->failed;
}
