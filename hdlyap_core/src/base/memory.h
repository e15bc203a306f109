/** The only place that allocates: 64-byte aligned, zeroed, counted. */
#ifndef HD_MEMORY_H
#define HD_MEMORY_H

#include <stddef.h>

/** count * size bytes, zeroed, on a cache line (of large ones what fills huge pages on these: no
 * more is taken than is asked for); NULL when out of memory or when the product overflows. */
void *hd_memory_alloc(size_t count, size_t size);
void hd_memory_free(void *block);

/** Allocations since the start of the program; a test holds the main loop to none. */
size_t hd_memory_allocations(void);

#endif
