/** A run in a file: taken up again it is the run that was not interrupted; a file that is not whole is refused. */
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "testing.h"

#include "checkpoint.h"
#include "checkpoint_file.h"
#include "hdlyap/checkpoint.h"
#include "run_state.h"
#include "scenes.h"

static const char PATH[] = "checkpoint.test", LABEL[] = "a label";
enum { ALL = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES };

/* ---- a run's state as bytes ------------------------------------------------------------------- */

typedef struct bytes {
    char *data;
    size_t size;
} bytes;

static bytes bytes_of(hd_run *run)
{
    bytes b = {NULL, 0};
    FILE *file = open_memstream(&b.data, &b.size);
    hd_archive archive = hd_archive_writer(file);
    hd_run_write(run, &archive, LABEL);
    CHECK_OK(hd_archive_end(&archive));
    fclose(file);
    return b;
}

/** What the wall clock says differs between two runs. */
static bool of_the_clock(const char *name)
{
    return strncmp(name, "run wall", 8) == 0 || strcmp(name, "cost") == 0;
}

static size_t element_size(const char *type) { return type[0] == 'S' ? 1 : 8; }

/** All arrays of both, but those. */
static void expect_same_bytes(const bytes *a, const bytes *b)
{
    enum { HEAD = HD_ARCHIVE_NAME + 16 };
    assert_int_equal(a->size, b->size);
    for (size_t at = 0; at < a->size;) {
        int64_t count;
        const char *name = a->data + at;
        memcpy(&count, name + HEAD - 8, sizeof count);
        const size_t size = HEAD + (size_t)count * element_size(name + HD_ARCHIVE_NAME);
        if (!of_the_clock(name) && memcmp(name, b->data + at, size) != 0) fail_msg("%s differs", name);
        at += size;
    }
}

static void expect_same_state(hd_run *a, hd_run *b)
{
    const bytes of_a = bytes_of(a), of_b = bytes_of(b);
    expect_same_bytes(&of_a, &of_b);
    free(of_a.data);
    free(of_b.data);
}

/* ---- the run goes on -------------------------------------------------------------------------- */

static hd_run *run_of(const hd_scene_def *def)
{
    hd_run *run;
    char message[256] = "";
    if (hd_run_create(&run, def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    return run;
}

/** How many were taken: fewer at the end of the run. */
static int steps(hd_run *run, int count)
{
    int taken = 0;
    for (; taken < count && hd_run_phase(run) != HD_FINISHED; taken++) CHECK_OK(hd_run_step(run));
    return taken;
}

static hd_run *saved_and_resumed(hd_run *run, const hd_scene_def *scene)
{
    hd_run *resumed;
    char message[512] = "";
    CHECK_OK(hd_run_save(run, PATH, LABEL, message, sizeof message));
    if (hd_run_resume(&resumed, PATH, scene, message, sizeof message) != HD_OK)
        fail_msg("%s", message);
    return resumed;
}

static hd_scene_def scene(int disks, double density, double aspect, int exponents, unsigned observe)
{
    hd_scene_def def = scene_of(disks, density, aspect, HD_PERIODIC, HD_PERIODIC, 7);
    def.exponents = exponents;
    def.observe = observe;
    def.equilibration = 3.0;
    def.warmup = 20.0;
    def.duration = 20.0;
    def.threads = 1;
    return def;
}

/** Stopped and taken up again every few steps, beside one that is left alone. */
static void expect_uninterrupted(const hd_scene_def *def, int every, int least)
{
    hd_run *alone = run_of(def), *other = run_of(def);
    int times = 0, taken = 0;
    do {
        steps(alone, every);
        taken = steps(other, every);
        hd_run *resumed = saved_and_resumed(other, def);
        hd_run_free(other);
        other = resumed;
        expect_same_state(alone, other);
        times++;
    } while (taken == every);
    assert_int_equal(hd_run_phase(other), HD_FINISHED);
    assert_true(times >= least);
    hd_run_free(alone);
    hd_run_free(other);
}

static void a_resumed_run_is_the_uninterrupted_one(void **state)
{
    (void)state;
    hd_scene_def walls = scene(24, 0.6, 0.5, HD_EXPONENTS_ALL, ALL);
    walls.boundary[0] = walls.boundary[1] = HD_REFLECTING;
    hd_scene_def crowded = scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, ALL | HD_OBSERVE_FIELDS);
    crowded.report_interval = 0.25;
    crowded.threads = 2;
    hd_scene_def looks = scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, ALL);
    looks.report_interval = 0.1;
    hd_scene_def rare = scene(20, 0.05, 1.0, 3, 0);
    rare.report_interval = 7.0;
    const hd_scene_def few = scene(2, 0.3, 1.0, HD_EXPONENTS_ALL, ALL);
    const hd_scene_def none = scene(50, 0.7, 1.0, HD_EXPONENTS_NONE, 0);
    expect_uninterrupted(&walls, 5, 8);
    expect_uninterrupted(&crowded, 37, 4);
    expect_uninterrupted(&looks, 41, 6);
    expect_uninterrupted(&rare, 1, 5);
    expect_uninterrupted(&few, 3, 10);
    expect_uninterrupted(&none, 2, 10);
}

/** The states that the run above went through are not all the same kind: looks, tracked phases, found steps. */
static void what_was_compared_was_there(void **state)
{
    (void)state;
    hd_scene_def def = scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, ALL);
    def.report_interval = 0.1;
    hd_run *run = run_of(&def);
    steps(run, 1000000);
    int tracked = 0, resolved = 0;
    const hd_phases *phases = hd_run_phases(run);
    for (int k = 0; k < hd_phases_count(phases); k++)
        tracked += hd_phases_phase(phases, k)->state == HD_LP_TRACKED;
    for (int k = 0; k < hd_steps_count(hd_run_steps(run)); k++)
        resolved += hd_steps_step(hd_run_steps(run), k)->resolved;
    assert_true(hd_run_cost(run).looks > 0);
    assert_true(tracked > 0);
    assert_true(resolved > 0);
    hd_run_free(run);
}

/** The log that waits for the next orthonormalisation is in the file. */
static void pending_events_are_kept(void **state)
{
    (void)state;
    hd_scene_def def = scene(100, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0);
    def.report_interval = 0.125;
    hd_run *run = run_of(&def);
    while (hd_run_phase(run) != HD_FINISHED && run->log->count < 100) steps(run, 1);
    hd_run *resumed = saved_and_resumed(run, NULL);
    assert_true(run->log->count >= 100);
    assert_int_equal(resumed->log->count, run->log->count);
    for (size_t k = 0; k < run->log->count; k++)
        assert_memory_equal(&resumed->log->event[k], &run->log->event[k], sizeof(hd_event));
    hd_run_free(run);
    hd_run_free(resumed);
}

static void clocks_and_costs_go_on(void **state)
{
    (void)state;
    const hd_scene_def def = scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0);
    hd_run *run = run_of(&def);
    steps(run, 40);
    const hd_cost before = hd_run_cost(run);
    hd_run *resumed = saved_and_resumed(run, NULL);
    const hd_cost after = hd_run_cost(resumed);
    assert_true(after.wall >= before.wall);
    assert_true(before.orthonormalisations > 0);
    assert_int_equal(after.orthonormalisations, before.orthonormalisations);
    CHECK_CLOSE(after.ortho, before.ortho, 0.0);
    CHECK_CLOSE(after.progress, before.progress, 0.0);
    hd_run_free(run);
    hd_run_free(resumed);
}

/* ---- another duration ------------------------------------------------------------------------- */

/** Rounding of two ways to cut the same time into intervals [T6]: the accuracy that the scene asks for. */
static void a_finished_run_can_be_made_longer(void **state)
{
    (void)state;
    hd_scene_def def = scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, ALL);
    def.duration = 33.3;
    hd_run *run = run_of(&def);
    steps(run, 1000000);
    hd_scene_def longer = def;
    longer.duration = 80.0;
    hd_run *resumed = saved_and_resumed(run, &longer), *once = run_of(&longer);
    assert_int_equal(hd_run_phase(resumed), HD_AVERAGING);
    steps(resumed, 1000000);
    steps(once, 1000000);
    const hd_spectrum *a = hd_run_spectrum(resumed), *b = hd_run_spectrum(once);
    CHECK_CLOSE(hd_spectrum_time(a), 80.0, 1e-9);
    CHECK_CLOSE(hd_run_time(resumed), hd_run_time(once), 0.0);
    for (int col = 0; col < hd_spectrum_vectors(a); col++)
        CHECK_CLOSE(hd_spectrum_exponent(a, col), hd_spectrum_exponent(b, col), def.accuracy);
    assert_int_equal(hd_trajectory_collisions(hd_run_trajectory(resumed)),
                     hd_trajectory_collisions(hd_run_trajectory(once)));
    hd_run_free(run);
    hd_run_free(resumed);
    hd_run_free(once);
}

static void expect_refused(const hd_scene_def *asked, hd_status expected, const char *word)
{
    hd_run *run;
    char message[512] = "";
    assert_int_equal(hd_run_resume(&run, PATH, asked, message, sizeof message), expected);
    assert_null(run);
    if (!strstr(message, word)) fail_msg("\"%s\" does not say \"%s\"", message, word);
    assert_null(strchr(message, '\n'));
}

static void what_cannot_change_is_refused_by_name(void **state)
{
    (void)state;
    const hd_scene_def def = scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, ALL);
    hd_run *run = run_of(&def);
    while (hd_run_phase(run) != HD_AVERAGING || hd_run_time(run) < 25.0) steps(run, 1);
    hd_run_free(saved_and_resumed(run, &def));
#define EXPECT_REFUSED(field, value, word)                                                         \
    do {                                                                                           \
        hd_scene_def asked = def;                                                                  \
        asked.field = (value);                                                                     \
        expect_refused(&asked, HD_REFUSED, word);                                                  \
    } while (0)
    EXPECT_REFUSED(disks, 31, "disks");
    EXPECT_REFUSED(density, 0.71, "density");
    EXPECT_REFUSED(aspect, 0.9, "aspect");
    EXPECT_REFUSED(boundary[0], HD_REFLECTING, "boundary_x");
    EXPECT_REFUSED(boundary[1], HD_REFLECTING, "boundary_y");
    EXPECT_REFUSED(seed, 8, "seed");
    EXPECT_REFUSED(exponents, 5, "exponents");
    EXPECT_REFUSED(equilibration, 4.0, "equilibration");
    EXPECT_REFUSED(warmup, 4.0, "warmup");
    EXPECT_REFUSED(interval, 0.5, "interval");
    EXPECT_REFUSED(accuracy, 1e-7, "accuracy");
    EXPECT_REFUSED(report_interval, 2.0, "report_interval");
    EXPECT_REFUSED(max_wave_number, 1.5, "max_wave_number");
    EXPECT_REFUSED(max_node, 1, "max_node");
    EXPECT_REFUSED(observe, HD_OBSERVE_MODES, "observables");
    EXPECT_REFUSED(duration, 0.5, "duration");
#undef EXPECT_REFUSED
    hd_scene_def free_to_change = def;
    free_to_change.duration = 0.0;
    free_to_change.target_std_error = 0.01;
    free_to_change.threads = 2;
    hd_run_free(saved_and_resumed(run, &free_to_change));
    hd_run_free(run);
}

static void it_says_whose_it_is(void **state)
{
    (void)state;
    const hd_scene_def def = scene(30, 0.7, 1.0, 4, 0);
    hd_run *run = run_of(&def);
    hd_checkpoint found;
    char long_label[200] = "", message[512] = "";
    steps(run, 12);
    memset(long_label, 'x', sizeof long_label - 1);
    CHECK_OK(hd_run_save(run, PATH, long_label, message, sizeof message));
    CHECK_OK(hd_checkpoint_read(&found, PATH, message, sizeof message));
    assert_int_equal(strlen(found.label), HD_CHECKPOINT_LABEL - 1);
    CHECK_OK(hd_run_save(run, PATH, LABEL, message, sizeof message));
    CHECK_OK(hd_checkpoint_read(&found, PATH, message, sizeof message));
    assert_string_equal(found.label, LABEL);
    assert_int_equal(found.scene.disks, def.disks);
    assert_int_equal(found.scene.exponents, def.exponents);
    CHECK_CLOSE(found.scene.warmup, def.warmup, 0.0);
    CHECK_CLOSE(found.time, hd_run_time(run), 0.0);
    hd_run_free(run);
}

/* ---- files that are not whole ----------------------------------------------------------------- */

static bytes file_read(const char *path)
{
    struct stat found;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &found), 0);
    bytes b = {malloc((size_t)found.st_size), (size_t)found.st_size};
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

static void file_write(const char *path, const char *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

/** A small one: of two disks. */
static bytes checkpoint_bytes(void)
{
    const hd_scene_def def = scene(2, 0.3, 1.0, 1, 0);
    hd_run *run = run_of(&def);
    char message[512] = "";
    steps(run, 15);
    CHECK_OK(hd_run_save(run, PATH, LABEL, message, sizeof message));
    hd_run_free(run);
    return file_read(PATH);
}

static void a_truncated_file_is_refused(void **state)
{
    (void)state;
    const bytes whole = checkpoint_bytes();
    for (size_t size = whole.size; size-- > 0;) {
        assert_int_equal(truncate(PATH, (off_t)size), 0);
        expect_refused(NULL, HD_FILE_FAULT, size < 24 ? "no checkpoint" : "cut short");
    }
    free(whole.data);
}

/** The first 24 bytes say what the file is. */
static void a_flipped_bit_is_noticed(void **state)
{
    (void)state;
    const bytes whole = checkpoint_bytes();
    const int fd = open(PATH, O_WRONLY);
    for (size_t bit = 0; bit < 8 * whole.size; bit++) {
        const size_t byte = bit / 8;
        const char flipped = (char)(whole.data[byte] ^ 1 << bit % 8);
        assert_int_equal(pwrite(fd, &flipped, 1, (off_t)byte), 1);
        expect_refused(NULL, HD_FILE_FAULT, byte < 24 ? "no checkpoint" : "damaged");
        assert_int_equal(pwrite(fd, &whole.data[byte], 1, (off_t)byte), 1);
    }
    close(fd);
    free(whole.data);
}

static void what_is_no_checkpoint_is_refused(void **state)
{
    (void)state;
    const bytes whole = checkpoint_bytes();
    const char text[] = "disks: 780\ndensity: 0.8\naspect: 0.867\nboundary_x: periodic\nseed: 1\n";
    file_write(PATH, text, sizeof text);
    expect_refused(NULL, HD_FILE_FAULT, "no checkpoint");
    char *longer = malloc(whole.size + 1);
    memcpy(longer, whole.data, whole.size);
    longer[whole.size] = 0;
    file_write(PATH, longer, whole.size + 1);
    expect_refused(NULL, HD_FILE_FAULT, "damaged");
    free(longer);
    free(whole.data);
    remove(PATH);
    expect_refused(NULL, HD_FILE_FAULT, "No such file");
    assert_int_equal(mkdir(PATH, 0755), 0);
    expect_refused(NULL, HD_FILE_FAULT, "no regular file");
    rmdir(PATH);
    assert_int_equal(mkfifo(PATH, 0644), 0);
    expect_refused(NULL, HD_FILE_FAULT, "no regular file");
    remove(PATH);
}

/** As a later hdlyap will write it: another format, and a head that is right. */
static void a_newer_format_is_refused_as_such(void **state)
{
    (void)state;
    const bytes whole = checkpoint_bytes();
    uint32_t format = HD_CHECKPOINT_FORMAT + 1;
    memcpy(whole.data + 24, &format, sizeof format);
    const uint32_t crc = hd_checkpoint_head_crc(whole.data);
    memcpy(whole.data + 44, &crc, sizeof crc);
    file_write(PATH, whole.data, whole.size);
    expect_refused(NULL, HD_FILE_FAULT, "newer hdlyap");
    free(whole.data);
}

/** Each number of a file replaced by another one, with a checksum that is right: the run is refused, or goes on. */
static void nonsense_is_survived(void **state)
{
    (void)state;
    static const uint64_t nonsense[] = {0, 1, 5, UINT64_MAX, 0x7ff8000000000000, 0x7ff0000000000000,
                                        0x3ff0000000000000, 0x7fefffffffffffff, 0xc08f400000000000, 1 << 20};
    const hd_scene_def def = scene(4, 0.3, 0.3, HD_EXPONENTS_ALL, ALL);
    hd_run *run = run_of(&def);
    steps(run, 60);
    const bytes whole = bytes_of(run);
    hd_run_free(run);
    long refused = 0, accepted = 0;
    for (size_t at = 0; at + 8 <= whole.size; at += HD_SANITIZED ? 56 : 8)
        for (size_t k = 0; k < sizeof nonsense / sizeof *nonsense; k++) {
            char before[8], message[512] = "";
            memcpy(before, whole.data + at, sizeof before);
            memcpy(whole.data + at, &nonsense[k], sizeof before);
            FILE *file = fmemopen(whole.data, whole.size, "rb");
            hd_archive archive = hd_archive_reader(file, whole.size);
            const hd_status status = hd_run_read(&run, &archive, NULL, message, sizeof message);
            assert_true(status == HD_OK || (!run && *message));
            for (int step = 0; run && step < 20; step++)
                if (hd_run_step(run) != HD_OK) break;
            accepted += status == HD_OK;
            refused += status != HD_OK;
            hd_run_free(run);
            fclose(file);
            memcpy(whole.data + at, before, sizeof before);
        }
    assert_true(refused > accepted / 10 && accepted > refused / 10);
    free(whole.data);
}

/* ---- files that cannot be written ------------------------------------------------------------- */

static void expect_unwritable(hd_run *run, const char *path, const char *word)
{
    char message[512] = "";
    assert_int_equal(hd_checkpoint_writable(path, message, sizeof message), HD_FILE_FAULT);
    if (!strstr(message, word)) fail_msg("\"%s\" does not say \"%s\"", message, word);
    assert_int_equal(hd_run_save(run, path, LABEL, message, sizeof message), HD_FILE_FAULT);
}

static void what_cannot_be_written_is_named(void **state)
{
    (void)state;
    const hd_scene_def def = scene(4, 0.3, 1.0, 1, 0);
    hd_run *run = run_of(&def);
    char message[512] = "", too_long[5000];
    memset(too_long, 'a', sizeof too_long);
    too_long[sizeof too_long - 1] = 0;
    expect_unwritable(run, "", "No such file");
    expect_unwritable(run, too_long, "too long");
    expect_unwritable(run, "no/such/folder/file", "No such file");
    expect_unwritable(run, ".", "no regular file");
    expect_unwritable(run, "/dev/full", "no regular file");
    assert_int_equal(symlink("somewhere", "checkpoint.link"), 0);
    expect_unwritable(run, "checkpoint.link", "no regular file");
    remove("checkpoint.link");
    assert_int_equal(mkfifo("checkpoint.test.part", 0644), 0);
    expect_unwritable(run, PATH, "No such device");
    remove("checkpoint.test.part");
    CHECK_OK(hd_checkpoint_writable(PATH, message, sizeof message));
    assert_int_not_equal(access("checkpoint.test.part", F_OK), 0);
    hd_run_free(run);
}

/** A file may not become larger than a part of it: what is there stays, what was begun goes. */
static void a_write_that_fails_leaves_the_file(void **state)
{
    (void)state;
    const hd_scene_def def = scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0);
    hd_run *run = run_of(&def);
    hd_run_free(saved_and_resumed(run, NULL));
    const bytes before = file_read(PATH);
    struct rlimit limit, few;
    char message[512] = "";
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    signal(SIGXFSZ, SIG_IGN);
    steps(run, 30);
    for (size_t size = 0; size < before.size; size += 1 + before.size / 50) {
        few = (struct rlimit){size, limit.rlim_max};
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &few), 0);
        const hd_status status = hd_run_save(run, PATH, LABEL, message, sizeof message);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        assert_int_equal(status, HD_FILE_FAULT);
        assert_non_null(strstr(message, "File too large"));
        assert_int_not_equal(access("checkpoint.test.part", F_OK), 0);
        const bytes after = file_read(PATH);
        assert_int_equal(after.size, before.size);
        assert_memory_equal(after.data, before.data, before.size);
        free(after.data);
    }
    free(before.data);
    hd_run_free(run);
}

static void a_run_that_is_no_number_is_not_written(void **state)
{
    (void)state;
    const hd_scene_def def = scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0);
    hd_run *run = run_of(&def);
    hd_run_free(saved_and_resumed(run, NULL));
    const bytes before = file_read(PATH);
    char message[512] = "";
    hd_frame_data(run->frame)[17] = NAN;
    assert_int_equal(hd_run_save(run, PATH, LABEL, message, sizeof message), HD_NOT_FINITE);
    assert_non_null(strstr(message, "frame vectors: a number is not finite"));
    const bytes after = file_read(PATH);
    assert_int_equal(after.size, before.size);
    assert_memory_equal(after.data, before.data, before.size);
    free(before.data);
    free(after.data);
    hd_run_free(run);
}

/** While another process holds the part. */
static void nobody_writes_into_anothers_part(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_resumed_run_is_the_uninterrupted_one),
        cmocka_unit_test(what_was_compared_was_there),
        cmocka_unit_test(pending_events_are_kept),
        cmocka_unit_test(clocks_and_costs_go_on),
        cmocka_unit_test(a_finished_run_can_be_made_longer),
        cmocka_unit_test(what_cannot_change_is_refused_by_name),
        cmocka_unit_test(it_says_whose_it_is),
        cmocka_unit_test(a_truncated_file_is_refused),
        cmocka_unit_test(a_flipped_bit_is_noticed),
        cmocka_unit_test(what_is_no_checkpoint_is_refused),
        cmocka_unit_test(a_newer_format_is_refused_as_such),
        cmocka_unit_test(nonsense_is_survived),
        cmocka_unit_test(what_cannot_be_written_is_named),
        cmocka_unit_test(a_write_that_fails_leaves_the_file),
        cmocka_unit_test(a_run_that_is_no_number_is_not_written),
        cmocka_unit_test(nobody_writes_into_anothers_part),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
