/** State <-> named arrays in a file. See archive.h for the format. */
#include "base/archive.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <zlib.h>

enum { TYPE_SIZE = 8 };

hd_archive hd_archive_writer(FILE *file) { return (hd_archive){.file = file, .writing = true}; }

hd_archive hd_archive_reader(FILE *file, uint64_t bytes)
{
    return (hd_archive){.file = file, .bytes = bytes};
}

void hd_archive_fail(hd_archive *archive, hd_status status, const char *name, const char *fault)
{
    if (archive->status != HD_OK) return;
    archive->status = status;
    archive->name = name;
    archive->fault = fault;
}

void hd_archive_refuse(hd_archive *archive, const char *name, const char *fault)
{
    hd_archive_fail(archive, HD_FILE_FAULT, name, fault);
}

void hd_archive_expect(hd_archive *archive, bool condition, const char *name, const char *fault)
{
    if (!condition) hd_archive_refuse(archive, name, fault);
}

hd_status hd_archive_end(hd_archive *archive)
{
    hd_archive_expect(archive, archive->writing || archive->bytes == 0, "end",
                      "bytes follow the last array");
    return archive->status;
}

/* ---- bytes --------------------------------------------------------------------------------- */

static void put(hd_archive *archive, const void *data, size_t size)
{
    if (archive->status != HD_OK || size == 0) return; /* crc32 of no bytes starts it anew */
    if (fwrite(data, 1, size, archive->file) != size) {
        archive->error = errno;
        hd_archive_fail(archive, HD_FILE_FAULT, archive->name, NULL);
    }
    archive->crc = (uint32_t)crc32_z(archive->crc, data, size);
    archive->bytes += size;
}

/** Reads bytes; after a failure it fills in zeros, so that nothing stays undefined. */
static void take(hd_archive *archive, void *data, size_t size)
{
    if (archive->status == HD_OK && size > archive->bytes)
        hd_archive_refuse(archive, archive->name, "it ends too early");
    if (archive->status == HD_OK && fread(data, 1, size, archive->file) != size)
        hd_archive_refuse(archive, archive->name, "it cannot be read");
    if (archive->status != HD_OK)
        memset(data, 0, size);
    else
        archive->bytes -= size;
}

/** Reads or writes the data; writing does not change them. */
static void pass(hd_archive *archive, void *data, size_t size)
{
    if (archive->writing)
        put(archive, data, size);
    else
        take(archive, data, size);
}

typedef struct head {
    char name[HD_ARCHIVE_NAME], type[TYPE_SIZE];
    int64_t count;
} head;

static void pass_head(hd_archive *archive, const char *name, const char *type, size_t count)
{
    head expected = {.count = (int64_t)count}, found;
    if (archive->status != HD_OK) return;
    strncpy(expected.name, name, sizeof expected.name - 1);
    strncpy(expected.type, type, sizeof expected.type - 1);
    archive->name = name;
    found = expected;
    pass(archive, &found, sizeof found);
    hd_archive_expect(archive, memcmp(&found, &expected, sizeof found) == 0, name,
                      "another array is found in its place");
}

/* ---- elements ------------------------------------------------------------------------------ */

static int64_t pass_integer(hd_archive *archive, int64_t value, int64_t min, int64_t max)
{
    pass(archive, &value, sizeof value);
    if (value >= min && value <= max) return value;
    hd_archive_refuse(archive, archive->name, "a number is out of its range");
    return archive->writing ? value : min;
}

void hd_archive_next_int(hd_archive *archive, int *x, int min, int max)
{
    *x = (int)pass_integer(archive, *x, min, max);
}

void hd_archive_next_doubles(hd_archive *archive, double *x, size_t count)
{
    double sum = 0.0;
    pass(archive, x, count * sizeof *x);
    for (size_t k = 0; k < count; k++) sum += 0.0 * x[k]; /* NaN unless all are finite */
    if (!isnan(sum)) return;
    hd_archive_fail(archive, archive->writing ? HD_NOT_FINITE : HD_FILE_FAULT, archive->name,
                    "a number is not finite");
    if (!archive->writing) memset(x, 0, count * sizeof *x);
}

void hd_archive_of_doubles(hd_archive *archive, const char *name, size_t count)
{
    pass_head(archive, name, "f8", count);
}

void hd_archive_of_ints(hd_archive *archive, const char *name, size_t count)
{
    pass_head(archive, name, "i8", count);
}

/* ---- whole arrays -------------------------------------------------------------------------- */

void hd_archive_doubles(hd_archive *archive, const char *name, double *x, size_t count)
{
    hd_archive_of_doubles(archive, name, count);
    hd_archive_next_doubles(archive, x, count);
}

void hd_archive_double(hd_archive *archive, const char *name, double *x)
{
    hd_archive_doubles(archive, name, x, 1);
}

void hd_archive_int(hd_archive *archive, const char *name, int *x, int min, int max)
{
    hd_archive_of_ints(archive, name, 1);
    hd_archive_next_int(archive, x, min, max);
}

void hd_archive_long(hd_archive *archive, const char *name, long *x, long min, long max)
{
    hd_archive_of_ints(archive, name, 1);
    *x = (long)pass_integer(archive, *x, min, max);
}

void hd_archive_bits(hd_archive *archive, const char *name, uint64_t *x)
{
    hd_archive_of_ints(archive, name, 1);
    pass(archive, x, sizeof *x);
}

void hd_archive_count(hd_archive *archive, const char *name, size_t *x, size_t size)
{
    const uint64_t most = archive->writing ? INT64_MAX : archive->bytes / size;
    hd_archive_of_ints(archive, name, 1);
    *x = (size_t)pass_integer(archive, (int64_t)*x, 0, (int64_t)most);
}

void hd_archive_text(hd_archive *archive, const char *name, char *text, size_t size)
{
    pass_head(archive, name, "S1", size);
    pass(archive, text, size);
    hd_archive_expect(archive, memchr(text, 0, size), name, "a text has no end");
    if (!archive->writing) text[size - 1] = 0;
}
