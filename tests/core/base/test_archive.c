/** Archives: what is written is read again; what cannot be is refused, by the array's name and the
 * reason. */
#include "base/archive.h"
#include "testing.h"

enum { MOST = 3, TEXT = 8 };

/** One of each kind. */
typedef struct sample {
    double x[2];
    int whole; /* -MOST .. MOST */
    long large;
    uint64_t bits;
    size_t count; /* of doubles still to come */
    char text[TEXT];
} sample;

static const sample EXAMPLE = {{1.5, -2.25}, MOST, -MOST, 1ULL << 63, 2, "seven.."};

static void pass(hd_archive *a, sample *s)
{
    hd_archive_doubles(a, "x", s->x, 2);
    hd_archive_int(a, "whole", &s->whole, -MOST, MOST);
    hd_archive_long(a, "large", &s->large, -MOST, MOST);
    hd_archive_bits(a, "bits", &s->bits);
    hd_archive_text(a, "text", s->text, TEXT);
    hd_archive_count(a, "count", &s->count, sizeof(double));
    hd_archive_doubles(a, "x", s->x, 2);
}

static hd_archive written(FILE *file, sample s)
{
    hd_archive a = hd_archive_writer(file);
    pass(&a, &s);
    return a;
}

TEST(what_is_written_is_read)
{
    FILE *file = tmpfile();
    hd_archive a = written(file, EXAMPLE);
    assert_int_equal(a.status, HD_OK);
    assert_int_equal(a.bytes, ftell(file));
    sample got = {.whole = 0};
    rewind(file);
    a = hd_archive_reader(file, a.bytes);
    pass(&a, &got);
    CHECK_OK(hd_archive_end(&a));
    assert_memory_equal(got.x, EXAMPLE.x, sizeof got.x);
    assert_memory_equal(got.text, EXAMPLE.text, TEXT);
    assert_true(got.whole == MOST && got.large == -MOST && got.bits == EXAMPLE.bits &&
                got.count == 2);
    fclose(file);
}

/** Reads the sample with so many bytes more, and bytes of its file changed. */
static hd_archive read_changed(sample s, int more, long place, const void *bytes, size_t size)
{
    FILE *file = tmpfile();
    hd_archive a = written(file, s);
    char rest[16] = "";
    fwrite(rest, 1, sizeof rest, file);
    fseek(file, place, SEEK_SET);
    fwrite(bytes, 1, size, file);
    rewind(file);
    sample got = {.whole = 0};
    a = hd_archive_reader(file, a.bytes + (uint64_t)more);
    pass(&a, &got);
    (void)!hd_archive_end(&a);
    fclose(file);
    return a;
}

TEST(what_is_wrong_is_named)
{
    enum { HEAD = HD_ARCHIVE_NAME + 16, WHOLE = HEAD + 16 + HEAD, LARGE = WHOLE + 8 + HEAD };
    enum { END_OF_TEXT = LARGE + 8 + HEAD + 8 + HEAD + TEXT - 1, COUNT = END_OF_TEXT + 1 + HEAD };
    const double nan = NAN;
    const int64_t three = 3, four = MOST + 1, minus = -MOST - 1;
    const struct {
        int more;
        long place;
        const void *bytes;
        size_t size;
        const char *name, *fault;
    } cases[] = {
        {1, 0, "x", 1, "end", "bytes follow the last array"},
        {8, 0, "x", 1, "end", "bytes follow the last array"},
        {-1, 0, "x", 1, "x", "it ends too early"},
        {0, 0, "y", 1, "x", "another array is found in its place"},
        {0, HD_ARCHIVE_NAME, "i", 1, "x", "another array is found in its place"},
        {0, HEAD - 8, &three, 8, "x", "another array is found in its place"},
        {0, HEAD + 8, &nan, 8, "x", "a number is not finite"},
        {0, WHOLE, &four, 8, "whole", "a number is out of its range"},
        {0, WHOLE, &minus, 8, "whole", "a number is out of its range"},
        {0, LARGE, &four, 8, "large", "a number is out of its range"},
        {0, END_OF_TEXT, "x", 1, "text", "a text has no end"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const hd_archive a = read_changed(EXAMPLE, cases[k].more, cases[k].place, cases[k].bytes,
                                          cases[k].size);
        assert_int_equal(a.status, HD_FILE_FAULT);
        assert_string_equal(a.name, cases[k].name);
        assert_string_equal(a.fault, cases[k].fault);
    }
    /* at most as many as there is room for in what is left before it is read */
    enum { ROOM = (HEAD + 8 + HEAD + 16) / 8 };
    for (int64_t count = ROOM; count <= ROOM + 1; count++) {
        const hd_archive a = read_changed(EXAMPLE, 0, COUNT, &count, 8);
        assert_int_equal(a.status, count == ROOM ? HD_OK : HD_FILE_FAULT);
    }
}

TEST(what_is_no_number_is_not_written)
{
    FILE *file = tmpfile();
    sample bad = EXAMPLE;
    bad.x[1] = INFINITY;
    hd_archive a = written(file, bad);
    assert_int_equal(hd_archive_end(&a), HD_NOT_FINITE);
    assert_string_equal(a.name, "x");
    fclose(file);
}
