/** Contents of a checkpoint that no run has, with a checksum that is right: refused, or survived.
 */
#define _POSIX_C_SOURCE 200809L
#include "kept.h"
#include "run/run_state.h"

/** Where an element of the first array of that name lies. */
static char *element(const bytes *b, const char *name, size_t index)
{
    for (size_t at = 0; at < b->size; at += kept_array_size(b->data + at))
        if (strcmp(b->data + at, name) == 0)
            return b->data + at + KEPT_HEAD +
                   index * kept_element_size(b->data + at + HD_ARCHIVE_NAME);
    fail_msg("there is no %s", name);
    return NULL;
}

typedef struct nonsense_case {
    const char *array;
    size_t index;
    double real;  /**< to be put there, unless it is an integer */
    long integer; /**< likewise */
    const char *word;
} nonsense_case;

static void expect_nonsense_refused(const bytes *b, const nonsense_case *c)
{
    char message[512] = "", before[8], *at = element(b, c->array, c->index);
    hd_run *run = NULL;
    const int64_t integer = c->integer;
    memcpy(before, at, sizeof before);
    memcpy(at, c->real != 0 ? (const void *)&c->real : (const void *)&integer, sizeof before);
    const hd_status status = kept_read(&run, b, NULL, message, sizeof message);
    if (status != HD_FILE_FAULT || run || !strstr(message, c->word))
        fail_msg("%s[%zu]: %d, \"%s\" without \"%s\"", c->array, c->index, status, message,
                 c->word);
    memcpy(at, before, sizeof before);
}

/** Each of the conditions that is asked for, broken by itself. */
TEST(contents_that_no_run_has_are_refused)
{
    OWNED(hd_run) *run = kept_run(scene_from(
        kept_scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, KEPT_ALL), .report_interval = 0.1)),
                  *again = NULL;
    char message[512] = "";
    while (hd_run_time(run) < 42.0 || run->carrier.record->count < 10) kept_steps(run, 1);
    const bytes b = kept_bytes(run);
    static const nonsense_case cases[] = {
        {"scene number", 0, 0, 61, "another array"},
        {"scene number", 0, 0, 1000000, "too short"},
        {"scene number", 0, 0, 1, "in a rectangle"},
        {"scene density", 0, NAN, 0, "not finite"},
        {"scene density", 0, 5.0, 0, "density"},
        {"scene observe", 0, 0, 1 << 30, "out of its range"},
        {"scene threads", 0, 0, 5000, "out of its range"},
        {"run threads", 0, 0, 0, "out of its range"},
        {"time", 0, 1.0, 0, "that of the trajectory"},
        {"run observe", 0, 0, 1 << 30, "out of its range"},
        {"run interval end", 0, 1.0, 0, "interval end"},
        {"run target", 0, 0, 0x4141414141414141, "cannot be reached"},
        {"run fields", 0, -1.0, 0, "negative"},
        {"run changing", 0, 0, 2, "out of its range"},
        {"run advance longest", 0, -1.0, 0, "advance longest"},
        {"run advance begin", 0, 1e9, 0, "advance end"},
        {"run advance end", 0, 1e9, 0, "advance end"},
        {"run advance events", 0, 0, -1, "advance events"},
        {"cost limit", 0, 0, 99, "cost limit"},
        {"trajectory epoch start", 0, 1e9, 0, "epoch"},
        {"trajectory q p t", 0, 1e3, 0, "cell"},
        {"trajectory q p t", 2, 1.5, 0, "energy"},
        {"trajectory q p t", 4, 1e9, 0, "later time"},
        {"trajectory wrap cell", 0, 0, 1000, "cell"},
        {"trajectory wrap cell", 1, 0, 1000, "out of its range"},
        {"gas last time", 0, 1e9, 0, "gas last time"},
        {"gas time", 0, -1.0, 0, "gas time"},
        {"shape samples", 0, 0, -1, "out of its range"},
        {"schedule stage", 0, 0, 4, "out of its range"},
        {"schedule start", 0, 1e9, 0, "schedule"},
        {"schedule reports", 0, 0, 0, "schedule"},
        {"schedule duration", 0, -1.0, 0, "negative"},
        {"interval last", 0, -1.0, 0, "interval"},
        {"interval slope", 0, -1.0, 0, "interval"},
        {"log duration", 0, 1e9, 0, "log duration"},
        {"log count", 0, 0, 1000000000, "out of its range"},
        {"log entries", 0, 1e3, 0, "log"},
        {"log entries", 1, 60.0, 0, "a particle that does not exist"},
        {"log entries", 2, 0.5, 0, "a particle that does not exist"},
        {"frame vectors", 5, INFINITY, 0, "not finite"},
        {"spectrum time", 0, -1.0, 0, "spectrum time"},
        {"blocks count", 0, 0, 96, "out of its range"},
        {"blocks length", 0, -1.0, 0, "not positive"},
        {"blocks weight", 0, -1.0, 0, "not positive"},
        {"modes samples", 0, 0, -1, "out of its range"},
        {"step col", 0, 0, 116, "its vectors are too few"},
        {"step count", 0, 0, 1, "its vectors are too few"},
        {"steps of vector", 0, 0, 1000, "out of its range"},
        {"rotor count", 0, 0, 64, "rotor"},
        {"rotor time", 0, 1e9, 0, "rotor time"},
        {"rotor slots", 0, 0, 0, "out of its range"},
        {"phase state", 0, 0, 4, "out of its range"},
        {"phase col", 0, 0, 117, "out of its range"},
        {"phase sums", 0, 1e9, 0, "phase"},
        {"phase sums", 1, 1e9, 0, "phase"},
        {"fluctuations follow", 0, 0, 2, "out of its range"},
        {"times count", 0, 0, -1, "out of its range"},
        {"times passed", 0, -1.0, 0, "it is negative"},
        {"times begun", 0, -1.0, 0, "it is negative"},
        {"times sum", 5, NAN, 0, "not finite"},
    };
    CHECK_OK(kept_read(&again, &b, NULL, message, sizeof message));
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        expect_nonsense_refused(&b, &cases[k]);
    free(b.data);
}

TEST(structure_that_no_run_has_is_refused)
{
    OWNED(hd_run) *run = kept_run(kept_scene(10, 0.5, 0.3, HD_EXPONENTS_POSITIVE, KEPT_AT_REPORTS));
    while (hd_structure_samples(hd_run_structure(run)) < 3) assert_int_equal(kept_steps(run, 1), 1);
    const bytes b = kept_bytes(run);
    static const nonsense_case cases[] = {
        {"structure samples", 0, 0, -1, "out of its range"},
        {"structure mean", 1, -1.0, 0, "negative"},
        {"structure mean", 1, NAN, 0, "not finite"},
        {"structure peak", 0, 0, 1000, "out of its range"},
        {"hydro col", 0, 0, 20, "out of its range"},
        {"fields", 0, 1.1, 0, "longer than 1"},
        {"error trend first", 0, -1.0, 0, "negative"},
        {"error trend", 1, -1.0, 0, "negative"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        expect_nonsense_refused(&b, &cases[k]);
    free(b.data);
}

/** Where nothing is pending: found by tests/fuzz. */
TEST(reports_are_not_passed_twice)
{
    OWNED(hd_run) *run = kept_run(kept_scene(4, 0.3, 0.3, HD_EXPONENTS_ALL, 0)), *again = NULL;
    char message[512] = "";
    while (hd_run_stage(run) < HD_AVERAGING || run->agenda.reports == 0 ||
           run->carrier.record->duration > 0)
        kept_steps(run, 1);
    const bytes b = kept_bytes(run);
    const nonsense_case backwards = {"log duration", 0, -1.0, 0, "log duration"};
    const nonsense_case twice = {"schedule reports", 0, 0, run->agenda.reports - 1, "schedule"};
    expect_nonsense_refused(&b, &backwards);
    expect_nonsense_refused(&b, &twice);
    const double endless = 1e300;
    memcpy(element(&b, "run advance longest", 0), &endless, sizeof endless);
    CHECK_OK(kept_read(&again, &b, NULL, message, sizeof message));
    assert_true(again->advance.longest <= again->advance.bound);
    free(b.data);
}

/** Number `at` of the file is the first of its array, or one of the numbers behind it. */
static size_t place_in_array(const bytes *b, size_t at)
{
    size_t begin = 0;
    while (begin + kept_array_size(b->data + begin) <= at)
        begin += kept_array_size(b->data + begin);
    return at < begin + KEPT_HEAD ? 0 : (at - begin - KEPT_HEAD) / 8;
}

/** Each number of a file replaced by another one, with a checksum that is right: the run is
 * refused, or goes on. Each tries half of the kinds of nonsense, in long arrays a fifth, in turns;
 * in the second tier all. */
TEST(nonsense_is_survived)
{
    static const uint64_t nonsense[] = {0,
                                        1,
                                        5,
                                        UINT64_MAX,
                                        0x7ff8000000000000,
                                        0x7ff0000000000000,
                                        0x3ff0000000000000,
                                        0x7fefffffffffffff,
                                        0xc08f400000000000,
                                        1 << 20};
    hd_run *run = kept_run(kept_scene(4, 0.3, 0.3, HD_EXPONENTS_ALL, KEPT_ALL));
    kept_steps(run, 60);
    const bytes whole = kept_bytes(run);
    hd_run_free(run);
    long refused = 0, accepted = 0;
    for (size_t at = 0; at + 8 <= whole.size; at += HD_SANITIZED ? 56 : 8) {
        const size_t place = place_in_array(&whole, at);
        for (size_t k = 0; k < sizeof nonsense / sizeof *nonsense; k++) {
            const size_t turns = place < 4 ? 2 : 5;
            if ((at / 8 + k) % turns && !second_tier()) continue;
            char before[8], message[512] = "";
            memcpy(before, whole.data + at, sizeof before);
            memcpy(whole.data + at, &nonsense[k], sizeof before);
            const hd_status status = kept_read(&run, &whole, NULL, message, sizeof message);
            assert_true(status == HD_OK || (!run && *message));
            for (int step = 0; run && step < 20; step++)
                if (hd_run_advance(run) != HD_OK) break;
            accepted += status == HD_OK;
            refused += status != HD_OK;
            hd_run_free(run);
            memcpy(whole.data + at, before, sizeof before);
        }
    }
    assert_true(refused > accepted / 10 && accepted > refused / 10);
    free(whole.data);
}
