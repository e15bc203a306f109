/** Aligned, zeroed, counted allocation. The counter is the core's only global: it counts, it steers
 * nothing. */
#define _DEFAULT_SOURCE /* madvise */
#include "base/memory.h"

#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

enum { CACHE_LINE = 64, HUGE_PAGE = 1 << 21 };

static atomic_size_t allocations;

void *hd_memory_alloc(size_t count, size_t size)
{
    if (size != 0 && count > (SIZE_MAX - HUGE_PAGE) / size) return NULL;
    const size_t wanted = count * size;
    const size_t align = wanted >= HUGE_PAGE / 2 ? HUGE_PAGE : CACHE_LINE;
    const size_t bytes = (wanted + align) / align * align; /* never 0 */
    void *block = aligned_alloc(align, bytes);
    if (!block) return NULL;
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (align == HUGE_PAGE) (void)madvise(block, bytes, MADV_HUGEPAGE); /* a hint; may fail */
#endif
    memset(block, 0, bytes);
    atomic_fetch_add(&allocations, 1);
    return block;
}

void hd_memory_free(void *block) { free(block); }

size_t hd_memory_allocations(void) { return atomic_load(&allocations); }
