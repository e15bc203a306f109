/** Wave vectors and modulations against the table of the paper and an enumeration by brute force.
 */
#include "testing.h"

/** A few roundings, relative. */
static const double ROUNDING = 8.0 * DBL_EPSILON;

enum { WAVES_MAX = 4000 };

TEST(components_follow_the_boundary)
{
    const double box[2] = {12.5, 8.0};
    for (int k = 0; k < 4; k++) {
        const hd_boundary x = k & 1 ? R : P, y = k & 2 ? R : P;
        const hd_scene_def def = scene_in_box(40, box[0], box[1], x, y, 1);
        for (int d = 0; d < 2; d++)
            for (int n = 0; n < 5; n++) {
                const double want = def.boundary[d] == P ? 2.0 * PI * n / box[d]
                                                         : PI * n / (box[d] - 1.0);
                CHECK_CLOSE(hd_wave_component(&def, d, n), want, ROUNDING * want);
            }
    }
}

static void check_bits(hd_modulations got, const char *want)
{
    char text[HD_MODULATIONS_MAX + 1] = {0};
    for (int k = 0; k < got.count; k++) text[k] = (char)('0' + got.bits[k]);
    assert_string_equal(text, want);
}

/** Bits as digits: 1 sine in x, 2 sine in y. Behind walls T has sines alone, LP cosines alone. */
TEST(dimensions_follow_the_table)
{
    const struct {
        hd_boundary boundary[2];
        int nx, ny;
        const char *transverse, *pairs;
    } cases[] = {
        {{P, P}, 1, 0, "01", "01"},     {{P, P}, 0, 1, "02", "02"}, {{P, P}, 1, 1, "0123", "0123"},
        {{P, P}, 3, 2, "0123", "0123"}, {{R, R}, 1, 0, "", "0"},    {{R, R}, 0, 1, "", "0"},
        {{R, R}, 1, 1, "3", "0"},       {{R, R}, 2, 3, "3", "0"},   {{P, R}, 1, 0, "", "01"},
        {{P, R}, 0, 1, "2", "0"},       {{P, R}, 1, 1, "23", "01"}, {{R, P}, 1, 0, "1", "0"},
        {{R, P}, 0, 1, "", "02"},       {{R, P}, 1, 1, "13", "02"},
    };
    static hd_wave wave[WAVES_MAX];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        hd_scene_def def = scene_in_box(400, 25, 20, cases[k].boundary[0], cases[k].boundary[1], 1);
        def.max_mode_number = 3;
        const int count = hd_waves(&def, wave, WAVES_MAX);
        int at = 0;
        while (at < count && (wave[at].n[0] != cases[k].nx || wave[at].n[1] != cases[k].ny)) at++;
        assert_true(at < count);
        check_bits(wave[at].transverse, cases[k].transverse);
        check_bits(wave[at].pairs, cases[k].pairs);
    }
}

static bool wanted(const hd_scene_def *def, int nx, int ny)
{
    double box[2];
    hd_scene_box(def, box);
    const int n[2] = {nx, ny};
    const double sampled = PI * sqrt(def->density), above = 1.0 + 1e-12;
    double square = 0.0;
    for (int d = 0; d < 2; d++) {
        const double k = hd_wave_component(def, d, n[d]);
        square += k * k;
        if (n[d] > 0 && box[d] < 2.0) return false;
        if (def->max_mode_number > 0 && n[d] > def->max_mode_number) return false;
    }
    if (def->max_wave_number > 0 && sqrt(square) > def->max_wave_number * above) return false;
    return nx + ny > 0 && sqrt(square) <= sampled * above;
}

static void check_wave(const hd_scene_def *def, const hd_wave *wave)
{
    assert_true(wanted(def, wave->n[0], wave->n[1]));
    for (int d = 0; d < 2; d++) CHECK_CLOSE(wave->k[d], hd_wave_component(def, d, wave->n[d]), 0.0);
    CHECK_CLOSE(wave->number, sqrt(wave->k[0] * wave->k[0] + wave->k[1] * wave->k[1]),
                ROUNDING * wave->number);
}

/** Each wanted wave once, ascending in k, then in n_y. */
static void check_waves(const hd_scene_def *def)
{
    static hd_wave wave[WAVES_MAX];
    const int count = hd_waves(def, wave, WAVES_MAX);
    int want = 0;
    for (int ny = 0; ny < 100; ny++)
        for (int nx = 0; nx < 100; nx++) want += wanted(def, nx, ny);
    assert_int_equal(count, want);
    assert_int_equal(hd_waves(def, NULL, 0), want);
    assert_true(count <= WAVES_MAX);
    for (int w = 0; w < count; w++) {
        check_wave(def, &wave[w]);
        if (w == 0) continue;
        const hd_wave *before = &wave[w - 1];
        assert_true(before->number < wave[w].number ||
                    (before->number == wave[w].number && before->n[1] < wave[w].n[1]));
    }
}

TEST(every_wave_within_the_limits_once)
{
    for (int k = 0; k < 4; k++) {
        hd_scene_def def = scene_of(300, 0.6, k < 2 ? 0.7 : 1.0, k & 1 ? R : P, k & 2 ? R : P, 1);
        const hd_wave_limits limits = hd_wave_limits_of(&def);
        const int nodes[] = {1, 3, limits.node};
        for (int m = 0; m < 3; m++) {
            def.max_mode_number = nodes[m];
            check_waves(&def);
        }
        def.max_mode_number = 0;
        for (int m = 0; m <= 8; m++) {
            def.max_wave_number = limits.smallest + m / 8.0 * (limits.largest - limits.smallest);
            check_waves(&def);
        }
    }
}

/** If the scene does not say, the eight longest of all that are sampled, and those as long as the
 * last of them: in a long box all lie along it. */
TEST(the_longest_waves_are_usual)
{
    for (int k = 0; k < 12; k++) {
        const double aspect[] = {1.0, 0.867, 0.1};
        hd_scene_def def = scene_of(k < 8 ? 120 : 12, 0.7, aspect[k % 3], k & 1 ? R : P, P, 1);
        static hd_wave usual[WAVES_MAX], all[WAVES_MAX];
        const int count = hd_waves(&def, usual, WAVES_MAX);
        def.max_wave_number = hd_wave_limits_of(&def).largest;
        const int sampled = hd_waves(&def, all, WAVES_MAX);
        assert_true(sampled <= WAVES_MAX && count >= (sampled < 8 ? sampled : 8));
        assert_memory_equal(usual, all, (size_t)count * sizeof *all);
        for (int w = 8; w < count; w++)
            CHECK_CLOSE(usual[w].number, usual[7].number, ROUNDING * usual[7].number);
        assert_true(count == sampled || all[count].number > usual[count - 1].number);
    }
    hd_wave wave[8];
    const hd_scene_def first = scene_of(120, 0.7, 0.1, P, P, 1);
    assert_int_equal(hd_waves(&first, wave, 8), 8);
    for (int w = 0; w < 8; w++) assert_true(wave[w].n[0] == w + 1 && wave[w].n[1] == 0);
}

/** A limit that is the wave number itself counts, whatever its rounding. */
TEST(the_limit_itself_is_within)
{
    for (int disks = 20; disks < 200; disks++) {
        hd_scene_def def = scene_of(disks, 0.5, 0.9, P, P, 1);
        def.max_wave_number = 2.0 * PI / sqrt(disks / (0.5 * 0.9)); /* of (1,0) */
        hd_wave wave[4];
        assert_int_equal(hd_waves(&def, wave, 4), 1);
        assert_int_equal(wave[0].n[0], 1);
        assert_int_equal(wave[0].n[1], 0);
    }
}

TEST(the_paper_s_scene)
{
    const int n[][2] = {{1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}, {3, 0}};
    const hd_scene_def def = hd_scene_def_default();
    hd_wave wave[8];
    assert_int_equal(hd_waves(&def, wave, 8), 8);
    for (int w = 0; w < 8; w++) {
        assert_int_equal(wave[w].n[0], n[w][0]);
        assert_int_equal(wave[w].n[1], n[w][1]);
    }
    CHECK_CLOSE(wave[0].number, 2.0 * PI / 33.535, 1e-5); /* edges as printed, five digits */
    CHECK_CLOSE(wave[1].number, 2.0 * PI / 29.074, 1e-5);
}

TEST(square_boxes_have_every_wave_twice)
{
    for (int k = 0; k < 2; k++) {
        hd_scene_def def = scene_of(200, 0.7, 1.0, k ? R : P, k ? R : P, 1);
        hd_wave wave[8];
        def.max_mode_number = 2;
        assert_int_equal(hd_waves(&def, wave, 8), 8);
        const int n[][2] = {{1, 0}, {0, 1}, {1, 1}, {2, 0}, {0, 2}, {2, 1}, {1, 2}, {2, 2}};
        for (int w = 0; w < 8; w++) {
            assert_int_equal(wave[w].n[0], n[w][0]);
            assert_int_equal(wave[w].n[1], n[w][1]);
        }
        CHECK_CLOSE(wave[0].number, wave[1].number, 0.0);
        CHECK_CLOSE(wave[5].number, wave[6].number, 0.0);
    }
}

/** Nothing is written behind the end. */
TEST(capacity_is_kept)
{
    const hd_scene_def def = hd_scene_def_default();
    hd_wave wave[4] = {{.number = -1.0}, {.number = -1.0}, {.number = -1.0}, {.number = -1.0}};
    assert_int_equal(hd_waves(&def, wave, 3), 8);
    CHECK_CLOSE(wave[3].number, -1.0, 0.0);
}

TEST(limits_are_those_of_the_disks)
{
    const hd_scene_def def = scene_in_box(100, 20.0, 10.0, R, P, 1);
    const hd_wave_limits limits = hd_wave_limits_of(&def);
    CHECK_CLOSE(limits.largest, PI * sqrt(0.5), ROUNDING * limits.largest);
    CHECK_CLOSE(limits.smallest, PI / 19.0, ROUNDING);
    assert_int_equal(limits.node, 13); /* floor(19 sqrt(0.5)) along x, 3 along y */
}

static void check_narrow(hd_boundary x, hd_boundary y, double narrow, int along)
{
    const double length = 40.0;
    hd_scene_def def = along == 0 ? scene_in_box(20, length, narrow, x, y, 1)
                                  : scene_in_box(20, narrow, length, x, y, 1);
    const hd_wave_limits limits = hd_wave_limits_of(&def);
    CHECK_CLOSE(limits.smallest, hd_wave_component(&def, along, 1), 0.0);
    def.max_mode_number = 3;
    hd_wave wave[3];
    assert_int_equal(hd_waves(&def, wave, 3), 3);
    for (int w = 0; w < 3; w++) {
        assert_int_equal(wave[w].n[along], w + 1);
        assert_int_equal(wave[w].n[1 - along], 0);
    }
}

TEST(narrow_boxes_have_waves_along_them_alone)
{
    for (int k = 0; k < 8; k++) {
        check_narrow(k & 1 ? R : P, k & 2 ? R : P, 1.5, k >> 2);
        check_narrow(k & 1 ? R : P, k & 2 ? R : P, 1.99, k >> 2);
    }
    hd_scene_def def = scene_in_box(4, 1.8, 1.8, P, P, 1); /* nothing is asked of 4 disks in it */
    hd_wave_limits limits = hd_wave_limits_of(&def);
    assert_int_equal(limits.node, 0);
    assert_true(limits.smallest > limits.largest);
    assert_int_equal(hd_waves(&def, NULL, 0), 0);
    def = scene_in_box(40, 20.0, 2.2, R, R, 1); /* wide enough: k = pi / 1.2 of at most 2.995 */
    def.max_wave_number = hd_wave_component(&def, 1, 1);
    check_waves(&def);
    hd_wave wave[64];
    const int count = hd_waves(&def, wave, 64);
    assert_int_equal(wave[count - 1].n[1], 1);
}
