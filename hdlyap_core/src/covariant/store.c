/** Numbers -> records in memory, which grow with the need, and back. */
#include "covariant/store.h"

#include "base/check.h"
#include "base/memory.h"

struct hd_store {
    size_t doubles;
    long most;
    double **record; /**< [most], NULL until put */
};

hd_status hd_store_create(hd_store **out, size_t doubles, long most)
{
    HD_ASSERT(doubles >= 1 && most >= 1);
    hd_store *store = hd_memory_alloc(1, sizeof *store);
    *out = NULL;
    if (!store) return HD_NO_MEMORY;
    *store = (hd_store){.doubles = doubles, .most = most};
    store->record = hd_memory_alloc((size_t)most, sizeof *store->record);
    if (!store->record) {
        hd_store_free(store);
        return HD_NO_MEMORY;
    }
    *out = store;
    return HD_OK;
}

void hd_store_free(hd_store *store)
{
    if (!store) return;
    for (long k = 0; store->record && k < store->most; k++) hd_memory_free(store->record[k]);
    hd_memory_free(store->record);
    hd_memory_free(store);
}

double *hd_store_put(hd_store *store, long record)
{
    HD_ASSERT(record >= 0 && record < store->most);
    if (!store->record[record])
        store->record[record] = hd_memory_alloc(store->doubles, sizeof(double));
    return store->record[record];
}

const double *hd_store_fetch(const hd_store *store, long record)
{
    HD_ASSERT(record >= 0 && record < store->most && store->record[record]);
    return store->record[record];
}
