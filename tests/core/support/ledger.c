/** Counts and hands on to the core's own allocation, the next of that name. One thread. */
#include "ledger.h"

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { BLOCKS_MAX = 10000 };

static struct {
    const void *at;
    size_t bytes;
} blocks[BLOCKS_MAX];
static size_t count;
static ledger book;
static size_t asked, refused_from, refused_count; /* allocations asked for, had or not */

/** The core's own function of that name, into the pointer that `function` is the address of. */
static void next(void *function, const char *name)
{
    void *found = dlsym(RTLD_NEXT, name);
    if (!found || count == BLOCKS_MAX) abort();
    memcpy(function, &found, sizeof found);
}

void *hd_memory_alloc(size_t number, size_t size)
{
    void *(*real)(size_t, size_t);
    next(&real, "hd_memory_alloc");
    const size_t now = asked++;
    if (now >= refused_from && now - refused_from < refused_count) return NULL;
    void *block = real(number, size);
    if (!block) return NULL;
    blocks[count].at = block;
    blocks[count++].bytes = number * size;
    book.allocations++;
    book.live += number * size;
    if (book.live > book.peak) book.peak = book.live;
    return block;
}

void hd_memory_free(void *block)
{
    void (*real)(void *);
    next(&real, "hd_memory_free");
    for (size_t k = 0; block && k < count; k++) {
        if (blocks[k].at != block) continue;
        book.live -= blocks[k].bytes;
        blocks[k] = blocks[--count];
        break;
    }
    real(block);
}

ledger ledger_now(void) { return book; }

void ledger_reset_peak(void) { book.peak = book.live; }

void ledger_refuse(size_t first, size_t how_many)
{
    refused_from = asked + first;
    refused_count = how_many;
}
