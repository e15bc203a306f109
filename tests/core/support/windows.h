/** Covariant windows fed by hand: a forward pass without a run. */
#ifndef HD_WINDOWS_H
#define HD_WINDOWS_H

#include "forward_pass.h"

/** A power of two: sums of it are exact, and looks fall where they are due. */
#define WINDOWS_INTERVAL 0.25

typedef struct windows {
    forward_pass f;
    hd_covariant *c;
} windows;

static inline hd_scene_def windows_scene(int disks, hd_boundary x, hd_boundary y)
{
    return scene(.number = disks, .density = 0.5, .aspect = 0.9, .boundary[0] = x, .boundary[1] = y,
                 .seed = 9, .exponents = HD_EXPONENTS_ALL_INDEPENDENT,
                 .observe = HD_OBSERVE_COVARIANT, .covariant_window = 10.0,
                 .covariant_transient = 20.0, .covariant_sampling = 2.0);
}

/** After `warmup` intervals; begun with room for intervals of this length. */
static inline windows windows_begun(hd_scene_def scene, int warmup, double interval)
{
    windows w = {forward_started(scene, 1), NULL};
    for (int k = 0; k < warmup; k++) forward_interval(&w.f, WINDOWS_INTERVAL);
    CHECK_OK(hd_covariant_create(&w.c, &scene, NULL, 1));
    CHECK_OK(hd_covariant_begin(w.c, hd_trajectory_time(w.f.trajectory), interval));
    return w;
}

static inline void windows_free(windows *w)
{
    forward_pass_free(&w->f);
    hd_covariant_free(w->c);
}

/** One interval of the forward pass; true if there is a way back to go. */
static inline bool windows_forward(windows *w)
{
    forward_interval(&w->f, WINDOWS_INTERVAL);
    const hd_columns columns = hd_frame_columns(w->f.frame);
    CHECK_OK(hd_covariant_add(w->c, w->f.ortho, w->f.frame, w->f.log, 0.0, w->f.log->duration));
    CHECK_OK(hd_covariant_state(w->c, columns, w->f.trajectory));
    return hd_covariant_is_going_back(w->c);
}

static inline void windows_back(windows *w)
{
    while (hd_covariant_is_going_back(w->c)) CHECK_OK(hd_covariant_step(w->c));
}

/** Until so many windows are in the averages. */
static inline void windows_finish(windows *w, long count)
{
    while (hd_covariant_read(w->c).windows < count)
        if (windows_forward(w)) windows_back(w);
}

#endif
