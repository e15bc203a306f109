/** Counts and hands on to the core's own allocation. One thread. */
#include "ledger.h"

#include <stdlib.h>

#include "base/memory.h"

enum { BLOCKS_MAX = 10000 };

static struct {
    const void *at;
    size_t bytes;
} blocks[BLOCKS_MAX];
static size_t count;
static ledger book;
static size_t asked, refused_from, refused_count; /* allocations asked for, had or not */

/* The linker puts the ones with __wrap_ where the core calls hd_memory_*, which are __real_. */
void *__real_hd_memory_alloc(size_t number, size_t size);
void __real_hd_memory_free(void *block);

void *__wrap_hd_memory_alloc(size_t number, size_t size)
{
    if (count == BLOCKS_MAX) abort();
    const size_t now = asked++;
    if (now >= refused_from && now - refused_from < refused_count) return NULL;
    void *block = __real_hd_memory_alloc(number, size);
    if (!block) return NULL;
    blocks[count].at = block;
    blocks[count++].bytes = number * size;
    book.allocations++;
    book.live += number * size;
    if (book.live > book.peak) book.peak = book.live;
    return block;
}

void __wrap_hd_memory_free(void *block)
{
    for (size_t k = 0; block && k < count; k++) {
        if (blocks[k].at != block) continue;
        book.live -= blocks[k].bytes;
        blocks[k] = blocks[--count];
        break;
    }
    __real_hd_memory_free(block);
}

ledger ledger_now(void) { return book; }

void ledger_reset_peak(void) { book.peak = book.live; }

void ledger_refuse(size_t first, size_t how_many)
{
    refused_from = asked + first;
    refused_count = how_many;
}
