/** Records of hard bodies, looked into. */
#ifndef TEST_RECORDS_H
#define TEST_RECORDS_H

#include "dynamics/dynamics.h"
#include "scene/dynamics.h"
#include "dynamics/hard/event.h"
#include "dynamics/record.h"

/** Of the particles that this test is of. */
#if HD_DIM == 2
#define DYNAMICS (&hd_disks_row)
#else
#define DYNAMICS (&hd_spheres_row)
#endif

/** A scene of so many of them, as a frame takes it. */
#define PARTICLES(count) (&(const hd_scene_def){.dynamics = DYNAMICS, .number = (count)})

static inline hd_event *events_in(const hd_record *record) { return record->entry; }

/** Of events that somebody else keeps. */
static inline hd_record record_of(hd_event *event, size_t count, double duration)
{
    return (hd_record){.entry = event,
                       .size = sizeof *event,
                       .count = count,
                       .capacity = count,
                       .duration = duration};
}

#endif
