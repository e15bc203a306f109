/** Statuses: how a call of the core ended that can fail because of data, numbers or the machine. A
 * bug of the caller gives no status but fails an assertion (hd_assert_handler_replace). */
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

/** Between these two stand declarations that users of the library see, with C linkage in C++. */
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

/** All statuses: X(name, text) for each. */
#define HD_STATUS_LIST(X)                                                                          \
    X(HD_OK, "ok")                                                                                 \
    X(HD_REFUSED, "the scene was refused")                                                         \
    X(HD_NO_MEMORY, "out of memory")                                                               \
    X(HD_NOT_FINITE, "a result is not finite")                                                     \
    X(HD_ILL_CONDITIONED, "the tangent frame became too ill-conditioned to be repaired")           \
    X(HD_OVERLAP, "two particles overlap by more than rounding")                                   \
    X(HD_FILE_FAULT, "a file could not be read or written")                                        \
    X(HD_RANKS_APART, "ranks have computed different trajectories")                                \
    X(HD_ENERGY_LOST, "the energy is not conserved: the time step is too long")                    \
    X(HD_JAMMED, "particles are jammed at walls that shear: they collide without end")             \
    X(HD_DYNAMICS_FAULT, "a function of the row of dynamics did what it must not")

/** How a call ended. HD_MUST_CHECK makes the compiler warn if it is ignored. */
typedef enum hd_status {
#define HD_STATUS_NAME(name, text) name,
    HD_STATUS_LIST(HD_STATUS_NAME)
#undef HD_STATUS_NAME
} hd_status;

/** Text of a status, one line without a final dot; never NULL. */
const char *hd_status_text(hd_status status);

/** What is called if a function finds that its caller has broken its contract: with the condition
 * that does not hold, and the place in the library. It must not return. */
typedef void (*hd_assert_handler)(const char *condition, const char *file, int line);

/** Replaces the handler, for all threads. The default handler, which NULL restores, prints to
 * stderr and aborts. */
void hd_assert_handler_replace(hd_assert_handler handler);

HD_API_END
#endif
