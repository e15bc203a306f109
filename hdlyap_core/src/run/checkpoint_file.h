/** The file around a checkpoint's arrays. It is whole or not there, and is checked before it is
 * read. */
#ifndef HD_CHECKPOINT_FILE_H
#define HD_CHECKPOINT_FILE_H

#include "base/archive.h"

enum { HD_CHECKPOINT_PATH = 4096 };

/** A checkpoint that is being written. */
typedef struct hd_checkpoint_file {
    const char *path;
    char part[HD_CHECKPOINT_PATH]; /**< where it is written until it is whole */
    FILE *file;
} hd_checkpoint_file;

/* All functions fail with HD_FILE_FAULT and "path: reason" in message. */

/** Writes "path: reason", with only the end of a long path. */
void hd_checkpoint_file_line(char *message, size_t size, const char *path, const char *reason);

/** Opens path.part, empty except for the head, and locks it. A file of this name is replaced only
 * if it is such a part. */
HD_MUST_CHECK hd_status hd_checkpoint_file_begin(hd_checkpoint_file *out, const char *path,
                                                 char *message, size_t size);
/** Makes the part the file, once it is on the disk. If the archive has failed, or this fails,
 * removes the part and leaves the file. */
HD_MUST_CHECK hd_status hd_checkpoint_file_end(hd_checkpoint_file *file, hd_archive *archive,
                                               char *message, size_t size);
/** Removes the part. */
void hd_checkpoint_file_drop(hd_checkpoint_file *file);

/** Opens a file, checks its length and checksum, and stops before its arrays, which have `bytes`
 * bytes. The caller closes it with fclose. */
HD_MUST_CHECK hd_status hd_checkpoint_file_open(FILE **out, uint64_t *bytes, const char *path,
                                                char *message, size_t size);

/** The checksum of a file's head, which stands at byte 44. */
uint32_t hd_checkpoint_head_crc(const void *file);

#endif
