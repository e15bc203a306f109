/** The rows of a scene's parameters: each says the same thing once in numbers and once in words,
 * and none is missing. */
#include "testing.h"

static size_t size_of(const hd_parameter *row)
{
    if (row->kind == HD_PARAMETER_TEXT) return sizeof(hd_text);
    const bool wide = row->kind == HD_PARAMETER_REAL || row->kind == HD_PARAMETER_INTERVAL ||
                      row->kind == HD_PARAMETER_SEED;
    return wide ? 8 : sizeof(int);
}

/** Every byte of a definition belongs to one row, but for what alignment leaves free, and another
 * dynamics with its own. */
TEST(each_member_has_a_row)
{
    unsigned char rows_of[sizeof(hd_scene_def)] = {0};
    int count;
    size_t free_bytes = 0;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++)
        for (size_t byte = 0; byte < size_of(&rows[k]); byte++) rows_of[rows[k].offset + byte]++;
    for (size_t byte = 0; byte < sizeof rows_of; byte++) {
        const size_t into = byte - offsetof(hd_scene_def, dynamics);
        if (into < sizeof(hd_dynamics *) + HD_OWN_MAX * sizeof(hd_own)) rows_of[byte]++;
        assert_true(rows_of[byte] <= 1);
        free_bytes = rows_of[byte] ? 0 : free_bytes + 1;
        assert_true(free_bytes < sizeof(int) + 1);
    }
}

TEST(names_and_words_are_there_once)
{
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const hd_parameter *row = &rows[k];
        assert_true(*row->name && *row->range && *row->text && row->unit);
        assert_true(strlen(row->record) < 40); /* room in a checkpoint */
        assert_string_equal(row->record + strlen("scene "), row->name);
        for (int other = 0; other < k; other++)
            assert_string_not_equal(rows[other].name, row->name);
        for (const hd_parameter_word *w = row->words; w && w->word; w++) {
            int value = 12345;
            assert_non_null(strstr(row->range, w->word));
            assert_true(hd_parameter_value_of(&value, row, w->word));
            assert_int_equal(value, w->value);
            assert_string_equal(hd_parameter_word_of(row, value), w->word);
        }
        assert_false(hd_parameter_value_of(&(int){0}, row, "nothing"));
    }
}

/** "from A .. to B": in words as in numbers. */
TEST(ranges_are_said_in_words)
{
    int count, said = 0;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const hd_parameter *row = &rows[k];
        const char *from = strstr(row->range, "from "), *to = from ? strstr(from, " to ") : NULL;
        if (!to || row->kind == HD_PARAMETER_SEED || row->kind == HD_PARAMETER_EXPONENTS) continue;
        char *end;
        const double most = strtod(to + 4, &end);
        CHECK_CLOSE(strtod(from + 5, NULL), row->min, 0.0);
        if (strcmp(row->name, "density") == 0) /* of spheres of diameter 0.2 */
            CHECK_CLOSE(ceil(1.25e6 * sqrt(2.0)) / 1e4, row->max, 0.0);
        else if (end != to + 4) /* a number */
            CHECK_CLOSE(most, row->max, 0.0);
        said++;
    }
    assert_true(said > 12);
}

TEST(defaults_are_in_range_and_values_come_back)
{
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    const hd_scene_def usual = hd_scene_def_default();
    for (int k = 0; k < count; k++) {
        const hd_parameter *row = &rows[k];
        const bool automatic = row->kind == HD_PARAMETER_INTERVAL &&
                               hd_parameter_is_word(row, row->default_value);
        hd_scene_def def = usual;
        CHECK_CLOSE(hd_parameter_value(row, &usual), row->default_value, 0.0);
        assert_true(automatic ||
                    (row->default_value >= row->min && row->default_value <= row->max));
        hd_parameter_assign(row, &def, row->kind == HD_PARAMETER_SEED ? 1e15 : row->max);
        assert_int_equal(memcmp(&def, &usual, row->offset), 0);
        hd_parameter_assign(row, &def, row->default_value);
        assert_memory_equal(&def, &usual, sizeof def);
    }
}
