/** Checks of contracts, which are in every build, and how a status is passed on. */
#ifndef HD_CHECK_H
#define HD_CHECK_H

#include <stddef.h>

#include "hdlyap/status.h"

void hd_assert_fail(const char *condition, const char *file, int line);

#define HD_ASSERT(condition)                                                                       \
    do {                                                                                           \
        if (!(condition)) hd_assert_fail(#condition, __FILE__, __LINE__);                          \
    } while (0)

/** Writes the line that says why something is refused, if there is room; returns HD_REFUSED. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
hd_status
hd_refuse(char *message, size_t size, const char *format, ...);

/** Returns from the calling function with the status of `call` unless it is HD_OK. */
#define HD_TRY(call)                                                                               \
    do {                                                                                           \
        const hd_status hd_try_status = (call);                                                    \
        if (hd_try_status != HD_OK) return hd_try_status;                                          \
    } while (0)

#endif
