/** Any bytes as a checkpoint: refused with a line, or a run that goes on, whatever becomes of it.
 *
 * The head of the file is read as it is; behind it the arrays are read without a look at the
 * checksum, which would keep everything else out. Half of the changes are made to elements of the
 * arrays alone: others are mostly refused for the name of an array. */
#define _GNU_SOURCE /* memfd_create */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "run/checkpoint.h"

/** Of a file before its arrays; of an array before its elements, with their number in the last
 * eight bytes. */
enum { FILE_HEAD = 48, ARRAY_HEAD = HD_ARCHIVE_NAME + 16, ELEMENT = 8 };
enum { STEPS_MAX = 8 };

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *bytes, size_t size, size_t most);

static void require(int condition, const char *what, const char *line)
{
    if (condition) return;
    fprintf(stderr, "%s: %s\n", what, line);
    abort();
}

static void check_line(hd_status status, const char *line)
{
    require(!strchr(line, '\n'), "more than one line", line);
    require(status == HD_OK || status == HD_NO_MEMORY || *line, "refused without a word", line);
}

/** As a file, from its head on. */
static void read_file(const uint8_t *bytes, size_t size)
{
    hd_checkpoint checkpoint;
    char path[64], line[256] = "";
    const int fd = memfd_create("checkpoint", 0);
    require(fd >= 0 && write(fd, bytes, size) == (ssize_t)size, "no file", "");
    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
    check_line(hd_checkpoint_read(&checkpoint, path, NULL, 0, line, sizeof line), line);
    close(fd);
}

/** A run out of a file may end in any of the documented ways, but does not crash, and does not
 * stand still: until its modes have been looked at twice, as what is followed needs. */
static void go_on(hd_run *run)
{
    for (int step = 0, looks = 0; step < STEPS_MAX && looks < 2; step++) {
        const double before = hd_run_time(run), followed = hd_run_phase_time(run);
        const hd_stage phase = hd_run_stage(run);
        if (phase == HD_FINISHED || hd_run_advance(run) != HD_OK) return;
        require(hd_run_time(run) >= before, "the time goes back", "");
        require(isfinite(hd_run_time(run)), "the time is no number", "");
        looks += hd_run_phase_time(run) != followed;
    }
}

static void read_arrays(const uint8_t *bytes, size_t size)
{
    char line[256] = "";
    hd_run *run = NULL;
    FILE *file = fmemopen((void *)(uintptr_t)bytes, size, "rb");
    require(file != NULL, "no file", "");
    hd_archive archive = hd_archive_reader(file, size);
    const hd_status status = hd_run_read(&run, &archive, NULL, NULL, line, sizeof line);
    require((status == HD_OK) == (run != NULL), "a run against its status", line);
    check_line(status, line);
    if (run) go_on(run);
    hd_run_free(run);
    fclose(file);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    read_file(bytes, size);
    if (size > FILE_HEAD) read_arrays(bytes + FILE_HEAD, size - FILE_HEAD);
    return 0;
}

/* ---- changes ------------------------------------------------------------------------------- */

/** Elements of the array at `at`, as far as the file goes. */
static size_t elements_of(const uint8_t *bytes, size_t size, size_t at)
{
    uint64_t count;
    memcpy(&count, bytes + at + ARRAY_HEAD - sizeof count, sizeof count);
    const size_t room = (size - at - ARRAY_HEAD) / ELEMENT;
    return count < room ? (size_t)count : room;
}

static size_t next_array(const uint8_t *bytes, size_t size, size_t at)
{
    const int text = bytes[at + HD_ARCHIVE_NAME] == 'S';
    const size_t count = elements_of(bytes, size, at);
    return at + ARRAY_HEAD + (text ? 64 : ELEMENT * count);
}

/** First element of an array somewhere in the file; 0 if there is none. */
static size_t some_element(const uint8_t *bytes, size_t size, unsigned *seed)
{
    size_t array[512], count = 0;
    for (size_t at = FILE_HEAD; at + ARRAY_HEAD + ELEMENT <= size && count < 512;
         at = next_array(bytes, size, at))
        array[count++] = at;
    if (count == 0) return 0;
    const size_t at = array[(size_t)rand_r(seed) % count];
    const size_t elements = elements_of(bytes, size, at);
    return at + ARRAY_HEAD + (elements ? ELEMENT * ((size_t)rand_r(seed) % elements) : 0);
}

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t most, unsigned seed)
{
    static const double reals[] = {0.0,    -0.0,  1.0,  -1.0,     1e-300,
                                   5e-324, 1e300, 1e12, INFINITY, NAN};
    static const int64_t wholes[] = {0,    1,         -1,        2,         3,        7,
                                     1000, INT32_MAX, INT32_MIN, INT64_MAX, INT64_MIN};
    const size_t at = rand_r(&seed) % 2 ? some_element(bytes, size, &seed) : 0;
    if (at == 0) return LLVMFuzzerMutate(bytes, size, most);
    switch (rand_r(&seed) % 4) {
    case 0: memcpy(bytes + at, &reals[(size_t)rand_r(&seed) % 10], ELEMENT); break;
    case 1: memcpy(bytes + at, &wholes[(size_t)rand_r(&seed) % 11], ELEMENT); break;
    default: LLVMFuzzerMutate(bytes + at, ELEMENT, ELEMENT); break;
    }
    return size;
}
