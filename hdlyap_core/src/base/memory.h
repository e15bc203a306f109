/** The only place that allocates: 64-byte aligned, zeroed, counted. */
#ifndef HD_MEMORY_H
#define HD_MEMORY_H

#include <stddef.h>

/** Allocates count * size bytes, zeroed and aligned to a cache line. A large block uses huge pages
 * where it fills them, so that it takes no more than asked. NULL if there is no memory or the
 * product overflows. */
void *hd_memory_alloc(size_t count, size_t size);
void hd_memory_free(void *block);

/** Number of allocations since the program started; a test asserts that the main loop makes none.
 */
size_t hd_memory_allocations(void);

#endif
