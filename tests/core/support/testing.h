/** What the core's tests share: cmocka, comparisons that print both numbers and fail on NaN,
 * scenes, and objects that a block gives back where it ends. */
#ifndef HD_TESTING_H
#define HD_TESTING_H

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "hdlyap/hdlyap.h"
#include "inside.h"
#include "records.h"
#include "scenes.h"

static const double PI = 3.14159265358979323846;
static const hd_boundary P = HD_PERIODIC, R = HD_REFLECTING;

static inline void check_close(double got, double want, double tolerance, const char *what,
                               const char *file, int line)
{
    if (fabs(got - want) <= tolerance) return;
    print_error("%s: got %.17g, want %.17g +- %.3g, off by %.3g\n", what, got, want, tolerance,
                got - want);
    _fail(file, line);
}

/** |got - want| <= tolerance, false for NaN. */
#define CHECK_CLOSE(got, want, tolerance)                                                          \
    check_close((got), (want), (tolerance), #got, __FILE__, __LINE__)

static inline void check_within(double got, double least, double most, const char *what,
                                const char *file, int line)
{
    if (got >= least && got <= most) return;
    print_error("%s: got %.17g, want %.17g to %.17g\n", what, got, least, most);
    _fail(file, line);
}

/** From least to most; false for NaN. */
#define CHECK_WITHIN(got, least, most)                                                             \
    check_within((got), (least), (most), #got, __FILE__, __LINE__)

/** The call returned HD_OK. */
#define CHECK_OK(call) assert_string_equal(hd_status_text(call), hd_status_text(HD_OK))

/** In the second tier a test tries as many cases of a kind as it has; in the first one some of
 * them. tests/run.sh --all sets the variable. */
static inline bool second_tier(void) { return getenv("HDLYAP_SECOND_TIER") != NULL; }

/** A test of this program, TEST(what_it_says) { .. }: it runs in its turn, by being there. */
#define TEST(name)                                                                                 \
    static void name(void **state_);                                                               \
    __attribute__((constructor)) static void name##_is_there(void) { tests_add(#name, name); }     \
    static void name(void **state_ __attribute__((unused)))

/** Given back at the end of the block: by hd_run_free(run), world_free(&w), free(v).
 *
 *   OWNED(hd_run) *run = created(scene);
 *   MADE(hd_frame, frame, scene, vectors, seed, threads);   an hd_frame *frame, made of these
 *   HELD(world) w = world_create(scene, vectors, 1);
 *   HEAP double *v = malloc(size);
 *
 * A test that fails gives nothing back: its process ends. */
#define OWNED(type) __attribute__((cleanup(type##_given_back))) type
#define HELD(type) __attribute__((cleanup(type##_free))) type
#define HEAP __attribute__((cleanup(heap_given_back)))
#define MADE(type, name, ...)                                                                      \
    OWNED(type) *name = NULL;                                                                      \
    CHECK_OK(type##_create(&name, __VA_ARGS__))

/** Of the types that can be OWNED. */
#define OWNABLE(type)                                                                              \
    static inline void type##_given_back(type **object) { type##_free(*object); }
OWNABLE(hd_covariant)
OWNABLE(hd_record)
OWNABLE(hd_fields)
OWNABLE(hd_frame)
OWNABLE(hd_gas)
OWNABLE(hd_hydro)
OWNABLE(hd_localization)
OWNABLE(hd_modes)
OWNABLE(hd_ortho)
OWNABLE(hd_phases)
OWNABLE(hd_pmode)
OWNABLE(hd_run)
OWNABLE(hd_spectrum)
OWNABLE(hd_splitting)
OWNABLE(hd_structure)
OWNABLE(hd_trajectory)

static inline void heap_given_back(void *pointer) { free(*(void **)pointer); }

static inline hd_record *new_log(void)
{
    hd_record *log;
    CHECK_OK(hd_record_create(&log, DYNAMICS->entry));
    return log;
}

void tests_add(const char *name, CMUnitTestFunction test);
/** All of them, or those whose name fits; the number of failures. */
int tests_run(const char *filter);

#endif
