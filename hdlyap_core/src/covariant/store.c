/** Numbers -> records in memory (blocks that grow with the need) or in a file, and back. */
#define _GNU_SOURCE /* O_TMPFILE, posix_fallocate */
#include "covariant/store.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "base/check.h"
#include "base/memory.h"

struct hd_store {
    size_t doubles;
    long most;
    double **record; /**< [most], NULL until put; NULL with a file */
    int file;        /**< -1 in memory */
};

/** A file of that folder that nobody else can open; -1. */
static int nameless_file(const char *folder)
{
    char path[4096];
    const int file = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) return file;
    /* a file system that has none of those */
    if ((size_t)snprintf(path, sizeof path, "%s/hdlyap.XXXXXX", folder) >= sizeof path) {
        errno = ENAMETOOLONG;
        return -1;
    }
    const int named = mkostemp(path, O_CLOEXEC);
    if (named >= 0) (void)unlink(path);
    return named;
}

double hd_store_folder_room(const char *folder)
{
    struct statvfs about;
    const int file = nameless_file(folder);
    if (file < 0) return -1.0;
    const int status = fstatvfs(file, &about);
    (void)close(file);
    return status == 0 ? (double)about.f_bavail * (double)about.f_frsize : -1.0;
}

static hd_status open_file(hd_store *store, const char *folder)
{
    const double bytes = (double)store->most * (double)store->doubles * sizeof(double);
    if (bytes > 9e18) {
        errno = EFBIG;
        return HD_FILE_FAULT;
    }
    store->file = nameless_file(folder);
    if (store->file < 0) return HD_FILE_FAULT;
    errno = posix_fallocate(store->file, 0, (off_t)bytes);
    return errno == 0 ? HD_OK : HD_FILE_FAULT;
}

hd_status hd_store_create(hd_store **out, size_t doubles, long most, const char *folder)
{
    HD_ASSERT(doubles >= 1 && most >= 1);
    hd_store *store = hd_memory_alloc(1, sizeof *store);
    hd_status status = HD_OK;
    *out = NULL;
    if (!store) return HD_NO_MEMORY;
    *store = (hd_store){.doubles = doubles, .most = most, .file = -1};
    if (folder)
        status = open_file(store, folder);
    else if (!(store->record = hd_memory_alloc((size_t)most, sizeof *store->record)))
        status = HD_NO_MEMORY;
    if (status == HD_OK) {
        *out = store;
    } else {
        const int fault = errno;
        hd_store_free(store);
        errno = fault;
    }
    return status;
}

void hd_store_free(hd_store *store)
{
    if (!store) return;
    for (long k = 0; store->record && k < store->most; k++) hd_memory_free(store->record[k]);
    hd_memory_free(store->record);
    if (store->file >= 0) (void)close(store->file);
    hd_memory_free(store);
}

long hd_store_most(const hd_store *store) { return store->most; }

/** All of a record, into memory or (that is NULL) from there: one call may do a part of it. */
static hd_status transfer(const hd_store *store, char *into, const char *from, long record)
{
    const size_t bytes = store->doubles * sizeof(double);
    const off_t start = (off_t)record * (off_t)bytes;
    for (size_t at = 0; at < bytes;) {
        const off_t place = start + (off_t)at;
        const ssize_t done = into ? pread(store->file, into + at, bytes - at, place)
                                  : pwrite(store->file, from + at, bytes - at, place);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) {
            if (done == 0) errno = EIO;
            return HD_FILE_FAULT;
        }
        at += (size_t)done;
    }
    return HD_OK;
}

hd_status hd_store_put(hd_store *store, long record, const double *data)
{
    HD_ASSERT(record >= 0 && record < store->most);
    if (store->file >= 0) return transfer(store, NULL, (const char *)data, record);
    if (!store->record[record])
        store->record[record] = hd_memory_alloc(store->doubles, sizeof(double));
    if (!store->record[record]) return HD_NO_MEMORY;
    memcpy(store->record[record], data, store->doubles * sizeof(double));
    return HD_OK;
}

hd_status hd_store_fetch(hd_store *store, double *data, long record)
{
    HD_ASSERT(record >= 0 && record < store->most);
    if (store->file >= 0) return transfer(store, (char *)data, NULL, record);
    HD_ASSERT(store->record[record]);
    memcpy(data, store->record[record], store->doubles * sizeof(double));
    return HD_OK;
}
