/** Arrays <-> a file that is whole or not there.
 *
 * Head, 48 bytes: "hdlyap checkpoint" and zeros (24); format, and 0x01020304 in the machine's byte
 * order (4 each); length of the file (8); CRC-32 of everything after the head, and of the head so
 * far (4 each). PATH.part is written first, with only the first 24 bytes of the head; the rest of
 * the head is written last. Then the file is forced to the disk and renamed, so that at every
 * moment the name belongs to a whole file or to none. */
#define _POSIX_C_SOURCE 200809L
#include "run/checkpoint_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "hdlyap/checkpoint.h"

static const char MAGIC[24] = "hdlyap checkpoint";
static const uint32_t BYTE_ORDER_HERE = 0x01020304;

typedef struct head {
    char magic[sizeof MAGIC];
    uint32_t format, order;
    uint64_t length;
    uint32_t crc, head_crc; /**< checksums of what follows the head, and of the head before it */
} head;

uint32_t hd_checkpoint_head_crc(const void *file)
{
    return (uint32_t)crc32_z(0, file, offsetof(head, head_crc));
}

void hd_checkpoint_file_line(char *message, size_t size, const char *path, const char *reason)
{
    enum { PATH_SHOWN = 200 };
    const size_t length = strlen(path), skipped = length > PATH_SHOWN ? length - PATH_SHOWN : 0;
    if (message && size > 0)
        snprintf(message, size, "%s%s: %s", skipped ? "..." : "", path + skipped, reason);
}

static hd_status fault(char *message, size_t size, const char *path, const char *format, ...)
{
    char reason[256];
    va_list list;
    va_start(list, format);
    vsnprintf(reason, sizeof reason, format, list);
    va_end(list);
    hd_checkpoint_file_line(message, size, path, reason);
    return HD_FILE_FAULT;
}

/* ---- writing ------------------------------------------------------------------------------- */

/** Sets the name of the part, if the path can be that of a file. */
static hd_status name_part(hd_checkpoint_file *f, char *message, size_t size)
{
    struct stat now;
    const int length = snprintf(f->part, sizeof f->part, "%s.part", f->path);
    if (!*f->path || length >= (int)sizeof f->part)
        return fault(message, size, f->path, "%s", strerror(*f->path ? ENAMETOOLONG : ENOENT));
    if (lstat(f->path, &now) == 0 && !S_ISREG(now.st_mode))
        return fault(message, size, f->path, "exists, but is no regular file");
    return HD_OK;
}

/** Locks the part; true if nobody else writes it. The name may have passed to another file before
 * the lock was there. */
static int lock_part(int fd, const char *part)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    struct stat opened, named;
    return fcntl(fd, F_SETLK, &whole) == 0 && fstat(fd, &opened) == 0 && stat(part, &named) == 0 &&
           opened.st_ino == named.st_ino && S_ISREG(opened.st_mode);
}

/** Whether a killed process may have left this file: it is empty or has the head of a part, and it
 * has no other name. */
static bool is_left_over(int fd)
{
    static const char nothing[sizeof MAGIC];
    char found[sizeof MAGIC];
    struct stat opened;
    const ssize_t count = pread(fd, found, sizeof found, 0);
    if (fstat(fd, &opened) != 0 || opened.st_nlink != 1) return false;
    return count == 0 || (count == sizeof found && (memcmp(found, MAGIC, sizeof found) == 0 ||
                                                    memcmp(found, nothing, sizeof found) == 0));
}

/** Opens the part; does not wait at a pipe or a device. */
static hd_status open_part(hd_checkpoint_file *f, char *message, size_t size)
{
    const int fd = open(f->part, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (fd < 0) return fault(message, size, f->part, "%s", strerror(errno));
    if (!lock_part(fd, f->part)) {
        close(fd);
        return fault(message, size, f->part,
                     "is being written by another process, or is no regular file");
    }
    if (!is_left_over(fd)) {
        close(fd);
        return fault(message, size, f->part,
                     "exists, but is no part of a checkpoint: it is not overwritten");
    }
    f->file = ftruncate(fd, 0) == 0 ? fdopen(fd, "wb") : NULL;
    if (f->file) return HD_OK;
    const int error = errno;
    close(fd);
    unlink(f->part);
    return fault(message, size, f->part, "%s", strerror(error));
}

hd_status hd_checkpoint_file_begin(hd_checkpoint_file *out, const char *path, char *message,
                                   size_t size)
{
    head begun = {.format = 0};
    memcpy(begun.magic, MAGIC, sizeof MAGIC);
    *out = (hd_checkpoint_file){.path = path};
    hd_status status = name_part(out, message, size);
    if (status == HD_OK) status = open_part(out, message, size);
    if (status != HD_OK || fwrite(&begun, sizeof begun, 1, out->file) == 1) return status;
    status = fault(message, size, out->part, "%s", strerror(errno));
    hd_checkpoint_file_drop(out);
    return status;
}

void hd_checkpoint_file_drop(hd_checkpoint_file *f)
{
    unlink(f->part);
    if (f->file) (void)fclose(f->file);
    f->file = NULL;
}

/** Forces the folder's new entry to the disk, on file systems that can. */
static void sync_folder(const char *path)
{
    char folder[HD_CHECKPOINT_PATH] = ".";
    const char *end = strrchr(path, '/');
    if (end) snprintf(folder, sizeof folder, "%.*s", (int)(end - path) + 1, path);
    const int fd = open(folder, O_RDONLY | O_CLOEXEC);
    if (fd < 0) return;
    (void)fsync(fd);
    close(fd);
}

static int write_head(FILE *file, const hd_archive *archive)
{
    head h = {.format = HD_CHECKPOINT_FORMAT,
              .order = BYTE_ORDER_HERE,
              .length = sizeof h + archive->bytes,
              .crc = archive->crc};
    memcpy(h.magic, MAGIC, sizeof MAGIC);
    h.head_crc = hd_checkpoint_head_crc(&h);
    return fseek(file, 0, SEEK_SET) == 0 && fwrite(&h, sizeof h, 1, file) == 1;
}

/** Forces the part to the disk and gives it its name. */
static int finish(hd_checkpoint_file *f, const hd_archive *archive)
{
    const int whole = write_head(f->file, archive) && fflush(f->file) == 0 &&
                      fsync(fileno(f->file)) == 0 && rename(f->part, f->path) == 0;
    if (!whole) return 0;
    (void)fclose(f->file); /* nothing is left to be written */
    f->file = NULL;
    sync_folder(f->path);
    return 1;
}

hd_status hd_checkpoint_file_end(hd_checkpoint_file *f, hd_archive *archive, char *message,
                                 size_t size)
{
    if (hd_archive_good(archive) && finish(f, archive)) return HD_OK;
    const int error = hd_archive_good(archive) ? errno : archive->error;
    const hd_status status = error ? HD_FILE_FAULT : archive->status;
    if (error)
        (void)fault(message, size, f->part, "%s", strerror(error));
    else
        (void)fault(message, size, f->part, "%s: %s", archive->name,
                    archive->fault ? archive->fault : hd_status_text(status));
    hd_checkpoint_file_drop(f);
    return status;
}

/* ---- reading ------------------------------------------------------------------------------- */

/** CRC-32 of the rest of a file, and its length. */
static uint32_t rest_crc(FILE *file, uint64_t *bytes)
{
    unsigned char buffer[1 << 16];
    uLong crc = 0;
    *bytes = 0;
    for (size_t count; (count = fread(buffer, 1, sizeof buffer, file)) > 0; *bytes += count)
        crc = crc32_z(crc, buffer, count);
    return (uint32_t)crc;
}

/** Checks a file; if it has several faults, the first one that is checked is named. */
static hd_status verify(FILE *file, uint64_t *bytes, const char *path, char *message, size_t size)
{
    head h;
    const size_t found = fread(&h, 1, sizeof h, file);
    if (found < sizeof h.magic || memcmp(h.magic, MAGIC, sizeof MAGIC) != 0)
        return fault(message, size, path, "is no checkpoint of hdlyap");
    if (found < sizeof h)
        return fault(message, size, path, "is cut short: %zu of at least %zu bytes", found,
                     sizeof h);
    if (h.order != BYTE_ORDER_HERE && h.head_crc == hd_checkpoint_head_crc(&h))
        return fault(message, size, path, "was written on a machine with another byte order");
    if (h.head_crc != hd_checkpoint_head_crc(&h))
        return fault(message, size, path, "is damaged: the checksum of its head is wrong");
    if (h.format != HD_CHECKPOINT_FORMAT)
        return fault(message, size, path,
                     "has format %u, that of %s hdlyap; this one reads format %d",
                     (unsigned)h.format, h.format > HD_CHECKPOINT_FORMAT ? "a newer" : "an older",
                     HD_CHECKPOINT_FORMAT);
    const uint32_t crc = rest_crc(file, bytes);
    const uint64_t length = sizeof h + *bytes;
    if (ferror(file)) return fault(message, size, path, "%s", strerror(EIO));
    if (length != h.length)
        return fault(message, size, path, "is %s: %llu bytes of %llu",
                     length < h.length ? "cut short" : "damaged", (unsigned long long)length,
                     (unsigned long long)h.length);
    if (crc != h.crc) return fault(message, size, path, "is damaged: its checksum is wrong");
    return HD_OK;
}

hd_status hd_checkpoint_file_open(FILE **out, uint64_t *bytes, const char *path, char *message,
                                  size_t size)
{
    struct stat found;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    *out = NULL;
    if (fd < 0) return fault(message, size, path, "%s", strerror(errno));
    if (fstat(fd, &found) != 0 || !S_ISREG(found.st_mode)) {
        close(fd);
        return fault(message, size, path, "is no regular file");
    }
    FILE *file = fdopen(fd, "rb");
    if (!file) {
        close(fd);
        return fault(message, size, path, "%s", strerror(ENOMEM));
    }
    hd_status status = verify(file, bytes, path, message, size);
    if (status == HD_OK && fseek(file, (long)sizeof(head), SEEK_SET) != 0)
        status = fault(message, size, path, "%s", strerror(errno));
    if (status == HD_OK)
        *out = file;
    else
        (void)fclose(file);
    return status;
}
