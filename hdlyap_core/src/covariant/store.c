/** Keeps records of numbers in memory that grows as records are added. Small ones share a block. */
#include "covariant/store.h"

#include "base/check.h"
#include "base/memory.h"

/** Bytes of a block, unless a record is larger; an allocation's overhead is small beside it. */
enum { BLOCK = 1 << 15 };

struct hd_store {
    size_t doubles;
    long most, shared; /**< records of a block */
    double **block;    /**< [most / shared, rounded up], NULL until one of its records is put */
};

static long shared_of(size_t doubles)
{
    const size_t records = BLOCK / (doubles * sizeof(double));
    return records > 1 ? (long)records : 1;
}

static long blocks_of(long most, long shared) { return (most + shared - 1) / shared; }

double hd_store_bytes(size_t doubles, long most)
{
    return (double)most * (double)doubles * sizeof(double) +
           (double)blocks_of(most, shared_of(doubles)) * sizeof(double *) + sizeof(hd_store);
}

hd_status hd_store_create(hd_store **out, size_t doubles, long most)
{
    HD_ASSERT(doubles >= 1 && most >= 1);
    hd_store *store = hd_memory_alloc(1, sizeof *store);
    *out = NULL;
    if (!store) return HD_NO_MEMORY;
    *store = (hd_store){.doubles = doubles, .most = most, .shared = shared_of(doubles)};
    store->block = hd_memory_alloc((size_t)blocks_of(most, store->shared), sizeof *store->block);
    if (!store->block) {
        hd_store_free(store);
        return HD_NO_MEMORY;
    }
    *out = store;
    return HD_OK;
}

void hd_store_free(hd_store *store)
{
    if (!store) return;
    const long blocks = blocks_of(store->most, store->shared);
    for (long k = 0; store->block && k < blocks; k++) hd_memory_free(store->block[k]);
    hd_memory_free(store->block);
    hd_memory_free(store);
}

static double *record_in(const hd_store *store, long record)
{
    return store->block[record / store->shared] + (size_t)(record % store->shared) * store->doubles;
}

double *hd_store_put(hd_store *store, long record)
{
    HD_ASSERT(record >= 0 && record < store->most);
    double **block = &store->block[record / store->shared];
    const long first = record / store->shared * store->shared, left = store->most - first;
    const long records = left < store->shared ? left : store->shared;
    if (!*block) *block = hd_memory_alloc((size_t)records * store->doubles, sizeof **block);
    return *block ? record_in(store, record) : NULL;
}

const double *hd_store_fetch(const hd_store *store, long record)
{
    HD_ASSERT(record >= 0 && record < store->most && store->block[record / store->shared]);
    return record_in(store, record);
}
