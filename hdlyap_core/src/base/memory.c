/** Aligned, zeroed, counted allocation. The counter is the core's only global variable; nothing
 * depends on it. */
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
    const size_t bytes = count * size, huge = bytes / HUGE_PAGE * HUGE_PAGE;
    void *block;
    if (posix_memalign(&block, huge > 0 ? HUGE_PAGE : CACHE_LINE, bytes > 0 ? bytes : 1) != 0)
        return NULL;
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    /* a hint, which may fail; not for the rest, which would take a whole huge page */
    if (huge > 0) (void)madvise(block, huge, MADV_HUGEPAGE);
#endif
    memset(block, 0, bytes);
    atomic_fetch_add(&allocations, 1);
    return block;
}

void hd_memory_free(void *block) { free(block); }

size_t hd_memory_allocations(void) { return atomic_load(&allocations); }
