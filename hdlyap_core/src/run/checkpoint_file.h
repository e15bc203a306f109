/** The file around a checkpoint's arrays: whole or not there, and known to be undamaged before it
 * is read. */
#ifndef HD_CHECKPOINT_FILE_H
#define HD_CHECKPOINT_FILE_H

#include "base/archive.h"

enum { HD_CHECKPOINT_PATH = 4096 };

/** One that is being written. */
typedef struct hd_checkpoint_file {
    const char *path;
    char part[HD_CHECKPOINT_PATH]; /**< where it is written until it is whole */
    FILE *file;
} hd_checkpoint_file;

/* HD_FILE_FAULT with "path: reason" in message for all of them. */

/** "path: reason"; of a long path the end. */
void hd_checkpoint_file_line(char *message, size_t size, const char *path, const char *reason);

/** Opens path.part, empty but for the head, and keeps others from writing it. What is there already
 * goes only if it is such a part. */
HD_MUST_CHECK hd_status hd_checkpoint_file_begin(hd_checkpoint_file *out, const char *path,
                                                 char *message, size_t size);
/** The part becomes the file, once it is on the disk; if the archive has failed, or this does, the
 * part goes and the file stays. */
HD_MUST_CHECK hd_status hd_checkpoint_file_end(hd_checkpoint_file *file, hd_archive *archive,
                                               char *message, size_t size);
/** The part goes. */
void hd_checkpoint_file_drop(hd_checkpoint_file *file);

/** Opens a file whose length and checksum are right, before its arrays, of so many bytes. To be
 * closed with fclose. */
HD_MUST_CHECK hd_status hd_checkpoint_file_open(FILE **out, uint64_t *bytes, const char *path,
                                                char *message, size_t size);

/** Checksum of the head of a file, which has it at byte 44. */
uint32_t hd_checkpoint_head_crc(const void *file);

#endif
