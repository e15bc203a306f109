/** A checkpoint's file: whole, or refused with a line that says how it is not; written, or left as
 * it was. */
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include "run/checkpoint_file.h"
#include "bodies.h"
#include "kept.h"
#include "run/run_state.h"

static const char PATH[] = "checkpoint_file.test", PART[] = "checkpoint_file.test.part";

static void expect_refused(const char *word)
{
    hd_run *run;
    char message[512] = "";
    assert_int_equal(hd_run_resume(&run, PATH, NULL, message, sizeof message), HD_FILE_FAULT);
    assert_null(run);
    if (!strstr(message, word)) fail_msg("\"%s\" does not say \"%s\"", message, word);
    assert_null(strchr(message, '\n'));
}

static void file_write(const char *path, const char *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static void expect_as_before(const bytes *before)
{
    const bytes now = kept_file(PATH);
    assert_int_equal(now.size, before->size);
    assert_memory_equal(now.data, before->data, before->size);
    free(now.data);
}

/** A small one: of two disks. */
static bytes checkpoint_bytes(void)
{
    OWNED(hd_run) *run = kept_run(kept_scene(2, 0.3, 1.0, 1, 0));
    char message[512] = "";
    kept_steps(run, 15);
    CHECK_OK(hd_run_save(run, PATH, KEPT_LABEL, message, sizeof message));
    return kept_file(PATH);
}

TEST(a_truncated_file_is_refused)
{
    const bytes whole = checkpoint_bytes();
    for (size_t size = whole.size; size-- > 0;) {
        assert_int_equal(truncate(PATH, (off_t)size), 0);
        expect_refused(size < 24 ? "no checkpoint" : "cut short");
    }
    free(whole.data);
}

/** The first 24 bytes say what the file is. */
TEST(a_flipped_bit_is_noticed)
{
    const bytes whole = checkpoint_bytes();
    const int fd = open(PATH, O_WRONLY);
    for (size_t bit = 0; bit < 8 * whole.size; bit++) {
        const size_t byte = bit / 8;
        const char flipped = (char)(whole.data[byte] ^ 1 << bit % 8);
        assert_int_equal(pwrite(fd, &flipped, 1, (off_t)byte), 1);
        expect_refused(byte < 24 ? "no checkpoint" : "damaged");
        assert_int_equal(pwrite(fd, &whole.data[byte], 1, (off_t)byte), 1);
    }
    close(fd);
    free(whole.data);
}

TEST(what_is_no_checkpoint_is_refused)
{
    const bytes whole = checkpoint_bytes();
    const char text[] = "number: 780\ndensity: 0.8\naspect: 0.867\nboundary_x: periodic\nseed: 1\n";
    file_write(PATH, text, sizeof text);
    expect_refused("no checkpoint");
    char *longer = malloc(whole.size + 1);
    memcpy(longer, whole.data, whole.size);
    longer[whole.size] = 0;
    file_write(PATH, longer, whole.size + 1);
    expect_refused("damaged");
    free(longer);
    free(whole.data);
    remove(PATH);
    expect_refused("No such file");
    assert_int_equal(mkdir(PATH, 0755), 0);
    expect_refused("no regular file");
    rmdir(PATH);
    assert_int_equal(mkfifo(PATH, 0644), 0);
    expect_refused("no regular file");
    remove(PATH);
}

/** As another hdlyap writes it: another format, and a head that is right. */
static void expect_format_refused(uint32_t format, const char *word)
{
    const bytes whole = checkpoint_bytes();
    memcpy(whole.data + 24, &format, sizeof format);
    const uint32_t crc = hd_checkpoint_head_crc(whole.data);
    memcpy(whole.data + 44, &crc, sizeof crc);
    file_write(PATH, whole.data, whole.size);
    expect_refused(word);
    free(whole.data);
}

TEST(another_format_is_refused_as_such)
{
    expect_format_refused(HD_CHECKPOINT_FORMAT + 1, "a newer hdlyap");
    expect_format_refused(HD_CHECKPOINT_FORMAT - 1, "an older hdlyap");
}

static void expect_unwritable(hd_run *run, const char *path, const char *word)
{
    char message[512] = "";
    assert_int_equal(hd_checkpoint_writable(path, message, sizeof message), HD_FILE_FAULT);
    if (!strstr(message, word)) fail_msg("\"%s\" does not say \"%s\"", message, word);
    assert_int_equal(hd_run_save(run, path, KEPT_LABEL, message, sizeof message), HD_FILE_FAULT);
}

TEST(what_cannot_be_written_is_named)
{
    OWNED(hd_run) *run = kept_run(kept_scene(4, 0.3, 1.0, 1, 0));
    char message[512] = "", too_long[5000];
    memset(too_long, 'a', sizeof too_long);
    too_long[sizeof too_long - 1] = 0;
    expect_unwritable(run, "", "No such file");
    expect_unwritable(run, too_long, "too long");
    expect_unwritable(run, "no/such/folder/file", "No such file");
    expect_unwritable(run, ".", "no regular file");
    expect_unwritable(run, "/dev/full", "no regular file");
    assert_int_equal(symlink("somewhere", "checkpoint_file.link"), 0);
    expect_unwritable(run, "checkpoint_file.link", "no regular file");
    remove("checkpoint_file.link");
    assert_int_equal(mkfifo(PART, 0644), 0);
    expect_unwritable(run, PATH, "no regular file");
    remove(PART);
    CHECK_OK(hd_checkpoint_writable(PATH, message, sizeof message));
    assert_int_not_equal(access(PART, F_OK), 0);
}

/** A file may not become larger than a part of it: what is there stays, what was begun goes. */
TEST(a_write_that_fails_leaves_the_file)
{
    OWNED(hd_run) *run = kept_run(kept_scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0));
    hd_run_free(kept_and_resumed(run, PATH, NULL));
    const bytes before = kept_file(PATH);
    struct rlimit limit, few;
    char message[512] = "";
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    signal(SIGXFSZ, SIG_IGN);
    kept_steps(run, 30);
    for (size_t size = 0; size < before.size; size += 1 + before.size / 50) {
        few = (struct rlimit){size, limit.rlim_max};
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &few), 0);
        const hd_status status = hd_run_save(run, PATH, KEPT_LABEL, message, sizeof message);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        assert_int_equal(status, HD_FILE_FAULT);
        assert_non_null(strstr(message, "File too large"));
        assert_int_not_equal(access(PART, F_OK), 0);
        expect_as_before(&before);
    }
    free(before.data);
}

TEST(a_run_that_is_no_number_is_not_written)
{
    OWNED(hd_run) *run = kept_run(kept_scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0));
    hd_run_free(kept_and_resumed(run, PATH, NULL));
    const bytes before = kept_file(PATH);
    char message[512] = "";
    hd_frame_data(run->carrier.frame)[17] = NAN;
    assert_int_equal(hd_run_save(run, PATH, KEPT_LABEL, message, sizeof message), HD_NOT_FINITE);
    assert_non_null(strstr(message, "frame vectors: a number is not finite"));
    expect_as_before(&before);
    free(before.data);
}

typedef struct broken {
    double *number;
    double value;
    const char *word;
} broken;

/** What resuming would refuse is refused when it is written: the good file stays. */
TEST(what_no_run_could_resume_is_not_written)
{
    OWNED(hd_run) *run = kept_run(kept_scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0));
    kept_steps(run, 30);
    hd_run_free(kept_and_resumed(run, PATH, NULL));
    const bytes before = kept_file(PATH);
    const broken cases[] = {
        {&run->agenda.in_force.field_interval, -1.0, "run fields: it is negative"},
        {&run->agenda.interval_end, 1.0, "run interval end: it does not fit the time"},
        {&run->advance.plan.begin, 1e9, "run advance end: it does not fit the time"},
        {&run->advance.longest, 0.0, "run advance longest: it is not positive"},
        {&run->agenda.start, 1e9, "schedule: its times do not fit the time of the checkpoint"},
        {&run->carrier.interval.last, -1.0, "interval: it is negative"},
        {&events_in(run->carrier.record)[0].t, 1e9, "log: an entry comes after the end"},
        {&hard_in(run->advance.trajectory)->now, 1e9, "trajectory: the time is outside the epoch"},
        {&hard_in(run->advance.trajectory)->motion.disk[0].p[0], 9.0, "trajectory: "},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char message[512] = "";
        const double good = *cases[k].number;
        *cases[k].number = cases[k].value;
        const hd_status status = hd_run_save(run, PATH, KEPT_LABEL, message, sizeof message);
        if (status != HD_FILE_FAULT || !strstr(message, cases[k].word))
            fail_msg("%d, \"%s\" without \"%s\"", status, message, cases[k].word);
        *cases[k].number = good;
        expect_as_before(&before);
    }
    hd_run_free(kept_and_resumed(run, PATH, NULL));
    free(before.data);
}

/** Of what cannot be written for another reason than the file, the status says why. */
TEST(a_fault_without_words_is_named)
{
    hd_checkpoint_file file;
    char message[512] = "";
    CHECK_OK(hd_checkpoint_file_begin(&file, PATH, message, sizeof message));
    hd_archive archive = hd_archive_writer(file.file);
    hd_archive_fail(&archive, HD_NO_MEMORY, "frame vectors", NULL);
    assert_int_equal(hd_checkpoint_file_end(&file, &archive, message, sizeof message),
                     HD_NO_MEMORY);
    assert_non_null(strstr(message, "frame vectors: out of memory"));
}

/** What a killed process has left is written over; what somebody else has there, stays. */
TEST(only_a_part_is_written_over)
{
    static const char begun[30] = "hdlyap checkpoint", zeros[30];
    char message[512] = "";
    const char *const left[] = {begun, zeros, begun};
    const size_t sizes[] = {sizeof begun, sizeof zeros, 0};
    for (int k = 0; k < 3; k++) {
        file_write(PART, left[k], sizes[k]);
        CHECK_OK(hd_checkpoint_writable(PATH, message, sizeof message));
    }
    file_write(PART, "notes of somebody, longer than a head", 37);
    assert_int_equal(hd_checkpoint_writable(PATH, message, sizeof message), HD_FILE_FAULT);
    assert_non_null(strstr(message, "no part of a checkpoint"));
    bytes now = kept_file(PART);
    assert_int_equal(now.size, 37);
    free(now.data);
    file_write(PART, begun, sizeof begun);
    (void)remove("other.name");
    assert_int_equal(link(PART, "other.name"), 0);
    assert_int_equal(hd_checkpoint_writable(PATH, message, sizeof message), HD_FILE_FAULT);
    now = kept_file("other.name");
    assert_int_equal(now.size, sizeof begun);
    free(now.data);
    (void)remove("other.name");
    (void)remove(PART);
}

/** While another process holds the part. */
TEST(nobody_writes_into_anothers_part)
{
    int ready[2], done[2];
    char byte = 0, message[512] = "";
    hd_checkpoint_file file;
    assert_int_equal(pipe(ready) | pipe(done), 0);
    const pid_t child = fork();
    if (child == 0) {
        byte = hd_checkpoint_file_begin(&file, PATH, message, sizeof message) == HD_OK;
        if (write(ready[1], &byte, 1) != 1 || read(done[0], &byte, 1) != 1) _exit(1);
        _exit(0);
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    assert_int_equal(byte, 1);
    assert_int_equal(hd_checkpoint_writable(PATH, message, sizeof message), HD_FILE_FAULT);
    assert_non_null(strstr(message, "another process"));
    assert_int_equal(write(done[1], &byte, 1), 1);
    assert_int_equal(waitpid(child, NULL, 0), child);
    CHECK_OK(hd_checkpoint_writable(PATH, message, sizeof message));
}
