/** The outcome of each call of the core that can fail because of data, numbers or the machine.
 * Bugs of the caller are not statuses but assertions (see hd_assert_handler_replace). */
#ifndef HDLYAP_STATUS_H
#define HDLYAP_STATUS_H

#if defined(__GNUC__)
#define HD_MUST_CHECK __attribute__((warn_unused_result))
#define HD_VISIBLE _Pragma("GCC visibility push(default)")
#define HD_VISIBLE_END _Pragma("GCC visibility pop")
#else
#define HD_MUST_CHECK
#define HD_VISIBLE
#define HD_VISIBLE_END
#endif

/** Declarations between these are visible to users of the library, with C linkage in C++. */
/* clang-format off */
#ifdef __cplusplus
#define HD_API_BEGIN HD_VISIBLE extern "C" {
#define HD_API_END } HD_VISIBLE_END
#else
#define HD_API_BEGIN HD_VISIBLE
#define HD_API_END HD_VISIBLE_END
#endif
/* clang-format on */

HD_API_BEGIN

/** X(name, text) for each status. */
#define HD_STATUS_LIST(X)                                                                          \
    X(HD_OK, "ok")                                                                                 \
    X(HD_REFUSED, "the scene was refused")                                                         \
    X(HD_NO_MEMORY, "out of memory")                                                               \
    X(HD_NOT_FINITE, "a result is not finite")                                                     \
    X(HD_ILL_CONDITIONED, "the tangent frame became too ill-conditioned to be repaired")           \
    X(HD_OVERLAP, "two particles overlap by more than rounding")                                       \
    X(HD_FILE_FAULT, "a file could not be read or written")                                        \
    X(HD_NO_ROOM, "windows of covariant vectors do not fit covariant_memory")                      \
    X(HD_RANKS_APART, "ranks have computed different trajectories")                                \
    X(HD_ENERGY_LOST, "the energy is not conserved: the time step is too long")

typedef enum hd_status {
#define HD_STATUS_NAME(name, text) name,
    HD_STATUS_LIST(HD_STATUS_NAME)
#undef HD_STATUS_NAME
} hd_status;

/** Text of a status in one line; never NULL. */
const char *hd_status_text(hd_status status);

/** What is called when the caller of a function breaks its contract, with the condition that failed
 * and its place. It must not return. */
typedef void (*hd_assert_handler)(const char *condition, const char *file, int line);

/** Replaces the handler. The default, which NULL restores, prints to stderr and aborts. */
void hd_assert_handler_replace(hd_assert_handler handler);

HD_API_END
#endif
