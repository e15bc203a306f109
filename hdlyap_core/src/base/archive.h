/** Named arrays in a file. Each part of a run has one function that both writes and reads its
 * state, so that the two cannot differ.
 *
 * Each array is a record: name (HD_ARCHIVE_NAME bytes, zeros behind it), type (8 bytes: f8, i8 or
 * S1 with zeros behind it, as numpy calls them), number of elements (i8), and the elements; in the
 * byte order of the machine. */
#ifndef HD_ARCHIVE_H
#define HD_ARCHIVE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "hdlyap/archive.h"

enum { HD_ARCHIVE_NAME = 40 };

struct hd_archive {
    FILE *file;
    bool writing;
    uint64_t bytes;    /**< writing: bytes so far; reading: bytes that are left */
    uint32_t crc;      /**< CRC-32 of the bytes so far */
    hd_status status;  /**< the first failure; after it nothing is read or written any more */
    const char *name;  /**< the array at which it failed */
    const char *fault; /**< why it failed; NULL: error says it */
    int error;         /**< errno of a failed write */
};

hd_archive hd_archive_writer(FILE *file);
/** Reads exactly `bytes`; hd_archive_end checks that none is left. */
hd_archive hd_archive_reader(FILE *file, uint64_t bytes);

/** What was read may be used only if this returns HD_OK. Else it returns HD_FILE_FAULT,
 * HD_NO_MEMORY, or HD_NOT_FINITE for a number that is not finite; name and fault say where and why.
 * The same conditions hold for reading and writing. */
HD_MUST_CHECK hd_status hd_archive_end(hd_archive *archive);

/** Marks the archive as failed, with this reason, unless it has failed before. */
void hd_archive_fail(hd_archive *archive, hd_status status, const char *name, const char *fault);

/** hd_archive_refuse unless the condition holds. */
void hd_archive_expect(hd_archive *archive, bool condition, const char *name, const char *fault);

/** True while what is read can be relied on. */
static inline bool hd_archive_good(const hd_archive *archive) { return archive->status == HD_OK; }

/* Whole arrays. Numbers are finite, integers from min to max, or the archive fails. */

void hd_archive_double(hd_archive *archive, const char *name, double *x);
void hd_archive_int(hd_archive *archive, const char *name, int *x, int min, int max);
void hd_archive_long(hd_archive *archive, const char *name, long *x, long min, long max);
/** Reads or writes 64 bits of any value. */
void hd_archive_bits(hd_archive *archive, const char *name, uint64_t *x);
/** Reads or writes the number of elements of `size` bytes that follow. */
void hd_archive_count(hd_archive *archive, const char *name, size_t *x, size_t size);
/** Reads or writes a text in `size` bytes, padded with zeros. */
void hd_archive_text(hd_archive *archive, const char *name, char *text, size_t size);

/* An array in parts: its head, then all of its elements. */

void hd_archive_of_doubles(hd_archive *archive, const char *name, size_t count);
void hd_archive_of_ints(hd_archive *archive, const char *name, size_t count);
void hd_archive_next_doubles(hd_archive *archive, double *x, size_t count);
void hd_archive_next_int(hd_archive *archive, int *x, int min, int max);

#endif
