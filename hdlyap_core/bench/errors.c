/** Whether the standard errors that a run states are true: many seeds of several boxes, each number
 * read at three lengths of its run; its scatter over the seeds against its stated errors. Usage:
 * hdlyap_errors [--seeds N] [--box NAME] [--out FOLDER] [--quick]; 100 seeds; prints the kinds of
 * numbers, and writes each of them to errors.csv.
 * As many runs side by side as there are cores, one thread each. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "agreement.h"
#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "sample.h"
#include "table.h"
#include "timing.h"

enum { LENGTHS = 3 };

static const double LENGTH[LENGTHS] = {50, 200, 800};

typedef struct box {
    const char *name;
    int disks;
    double density, aspect;
    hd_boundary boundary;
    bool covariant; /**< and all 4N vectors */
    double cost;    /**< about, of a run, against the others */
} box;

static const box BOXES[] = {{"long", 200, 0.7, 0.2, HD_PERIODIC, false, 7.0},
                            {"periodic", 144, 0.7, 0.867, HD_PERIODIC, false, 2.0},
                            {"square", 100, 0.7, 1.0, HD_PERIODIC, false, 0.7},
                            {"reflecting", 100, 0.7, 0.5, HD_REFLECTING, false, 1.2},
                            {"narrow", 60, 0.8, 0.03, HD_PERIODIC, false, 0.5},
                            {"channel", 44, 0.7, 0.03, HD_PERIODIC, false, 0.3},
                            {"tiny", 24, 0.7, 0.13, HD_PERIODIC, true, 1.0}};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES };

/** What the seeds of one box found. */
typedef struct harvest {
    const box *box;
    int seeds, rows, stride;
    row_of_numbers row[NUMBER_ROWS_MAX];
    number *numbers[LENGTHS]; /**< [seeds][stride] */
    int *first_of_modes;      /**< [seeds], at the end */
    hd_run *run;              /**< of the first seed: it knows the steps' names */
} harvest;

static hd_scene_def scene_of(const box *b, int seed)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = b->disks;
    scene.density = b->density;
    scene.aspect = b->aspect;
    scene.boundary[0] = scene.boundary[1] = b->boundary;
    scene.seed = (uint64_t)seed + 1;
    scene.equilibration = 50.0;
    scene.warmup = 50.0;
    scene.duration = LENGTH[LENGTHS - 1];
    scene.threads = 1;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    if (!b->covariant) return scene;
    scene.exponents = HD_EXPONENTS_ALL;
    scene.observe |= HD_OBSERVE_COVARIANT;
    scene.covariant_window = scene.covariant_transient = 20.0;
    scene.covariant_sampling = 2.0;
    return scene;
}

/* ---- running ------------------------------------------------------------------------------- */

static harvest harvest_create(const box *b, int seeds)
{
    const hd_scene_def scene = scene_of(b, 0);
    harvest h = {.box = b, .seeds = seeds, .run = created(&scene)};
    h.rows = numbers_rows(h.run, h.row);
    h.stride = h.row[h.rows - 1].first + h.row[h.rows - 1].count;
    for (int k = 0; k < LENGTHS; k++)
        h.numbers[k] = room((size_t)seeds * (size_t)h.stride, sizeof(number));
    h.first_of_modes = room((size_t)seeds, sizeof *h.first_of_modes);
    return h;
}

static void harvest_free(harvest *h)
{
    for (int k = 0; k < LENGTHS; k++) free(h->numbers[k]);
    free(h->first_of_modes);
    hd_run_free(h->run);
}

static void follow(harvest *h, int seed)
{
    const hd_scene_def scene = scene_of(h->box, seed);
    hd_run *run = created(&scene);
    while (hd_run_stage(run) < HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    const double start = hd_run_time(run);
    for (int k = 0; k < LENGTHS;) {
        require(hd_run_advance(run), h->box->name);
        const bool there = hd_run_report_due(run) && hd_run_time(run) - start >= LENGTH[k] - 1e-6;
        if (!there && hd_run_stage(run) != HD_FINISHED) continue;
        numbers_read(run, h->numbers[k++] + (size_t)seed * (size_t)h->stride);
    }
    h->first_of_modes[seed] = numbers_first_of_modes(run);
    hd_run_free(run);
}

/** The longest runs first. */
static void follow_all(harvest *h, int boxes, int seeds)
{
    double total = 0.0;
    for (int b = 0; b < boxes; b++) total += seeds * h[b].box->cost;
    progress p = progress_begin("errors", total);
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < boxes * seeds; k++) {
        follow(&h[k / seeds], k % seeds);
#pragma omp critical
        progress_add(&p, h[k / seeds].box->cost);
    }
    progress_end();
}

/* ---- telling ------------------------------------------------------------------------------- */

static const char *const HEADER =
    "quantity,from,box,length [time units],seeds,stated,mean,stated error,scatter / stated,"
    "least of the row,most of the row,within one error,within two errors,"
    "smallest error / median of its own,smallest error / mean of its neighbours'";

/** One line of the printed table: a kind of number in one box, at each length. */
typedef struct line {
    agreement at[LENGTHS];
} line;

/** A dash where it is not known. */
static void print_known(const char *format, int width, double value)
{
    if (value < 0)
        printf(" %*s", width, "-");
    else
        printf(format, width, value);
}

static void print_heading(int seeds)
{
    printf("%d seeds of each box, read after", seeds);
    for (int k = 0; k < LENGTHS; k++) printf(" %g", LENGTH[k]);
    printf(" time units; *: not as the rule says\n%-19s %-10s |%*s |%*s |%*s |%*s\n", "quantity",
           "box", 6 * LENGTHS, "scatter / stated", 4 * LENGTHS, "% within 1", 4 * LENGTHS,
           "within 2", 5 * LENGTHS, "smallest error");
}

static void print_line(const char *name, const char *box_name, const line *l)
{
    bool published = false;
    for (int k = 0; k < LENGTHS; k++) published |= l->at[k].taken > 0;
    if (!published) return;
    printf("%-19s %-10s |", name, box_name);
    for (const agreement *a = l->at; a < l->at + LENGTHS; a++) {
        print_known(" %*.2f", 4, a->ratio);
        printf(a->ratio < 0 || agreement_holds(a, a->stated) ? " " : "*");
    }
    for (int part = 0; part < 2; part++) {
        printf(" |");
        for (int k = 0; k < LENGTHS; k++) print_known(" %*.0f", 3, 100.0 * l->at[k].within[part]);
    }
    printf(" |");
    for (int k = 0; k < LENGTHS; k++) print_known(" %*.2f", 4, l->at[k].least_error);
    printf("\n");
}

static line line_of(const harvest *h, const row_of_numbers *row)
{
    line l;
    for (int k = 0; k < LENGTHS; k++)
        l.at[k] = agreement_of(h->numbers[k], h->seeds, h->stride, row->first, row->count);
    return l;
}

static void write_row(const harvest *h, table *t, const row_of_numbers *row, const agreement *a,
                      int length)
{
    const double neighbours = strstr(row->name, "exponents")
                                  ? agreement_with_neighbours(h->numbers[length], h->seeds,
                                                              h->stride, row->first, row->count)
                                  : -1.0;
    char from[256];
    if (a->taken == 0) return;
    numbers_name(h->run, a->of, from, sizeof from);
    table_row(t, "%s,%s,%s,%g,%d,%d,%.8g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g", row->name,
              from[0] ? from : "-", h->box->name, LENGTH[length], a->taken, a->stated, a->mean,
              a->error, a->ratio, a->least_ratio, a->most_ratio, a->within[0], a->within[1],
              a->least_error, neighbours);
}

/** Those in columns that belong to modes in most seeds. */
static row_of_numbers exponents_of_modes(const harvest *h)
{
    sample first = {0};
    for (int s = 0; s < h->seeds; s++) sample_add(&first, h->first_of_modes[s]);
    const int col = (int)sample_median(&first);
    return (row_of_numbers){"exponents of modes", col, h->row[0].count - col};
}

/** Steps, and angular velocities, of all waves are one kind. */
static const char *kind_of(const row_of_numbers *row)
{
    if (!strchr(row->name, '(')) return row->name;
    return strncmp(row->name, "omega", 5) == 0 ? "omega" : "steps";
}

/** Rows of one kind follow each other: the first of them, made longer. */
static row_of_numbers whole_kind(const harvest *h, int *k)
{
    const row_of_numbers *first = &h->row[*k];
    row_of_numbers whole = {.first = first->first};
    snprintf(whole.name, sizeof whole.name, "%s", kind_of(first));
    for (; *k < h->rows && strcmp(kind_of(&h->row[*k]), whole.name) == 0; ++*k)
        whole.count += h->row[*k].count;
    return whole;
}

static void print_kind(const harvest *h, const row_of_numbers *row)
{
    const line l = line_of(h, row);
    print_line(row->name, h->box->name, &l);
}

static void write_lengths(const harvest *h, table *t, const row_of_numbers *row)
{
    const line l = line_of(h, row);
    for (int length = 0; length < LENGTHS; length++) write_row(h, t, row, &l.at[length], length);
}

static void tell_box(const harvest *h, table *t)
{
    const row_of_numbers of_modes = exponents_of_modes(h);
    for (int k = 0; k < h->rows; k++) write_lengths(h, t, &h->row[k]);
    if (of_modes.count > 0) write_lengths(h, t, &of_modes);
    for (int k = 0; k < h->rows;) {
        const row_of_numbers whole = whole_kind(h, &k);
        print_kind(h, &whole);
        if (whole.first == 0 && of_modes.count > 0) print_kind(h, &of_modes);
    }
}

/* ---- the program --------------------------------------------------------------------------- */

typedef struct asked {
    int seeds;
    const char *box, *out;
    bool quick;
} asked;

static asked read_options(int argc, char **argv)
{
    asked a = {.seeds = 100, .out = "."};
    const option list[] = {{"--seeds", .count = &a.seeds, .least = 2, .most = SAMPLE_MAX},
                           {"--box", .text = &a.box},
                           {"--out", .text = &a.out},
                           {"--quick", .flag = &a.quick},
                           {0}};
    options_read(argc, argv, list);
    if (a.quick) a.seeds = 12, a.box = "narrow";
    return a;
}

/** The boxes that are asked for. */
static int choose(const asked *a, harvest *h)
{
    int count = 0;
    for (const box *b = BOXES; b < BOXES + BOXES_ALL; b++)
        if (!a->box || strcmp(a->box, b->name) == 0) h[count++] = harvest_create(b, a->seeds);
    if (count > 0) return count;
    fprintf(stderr, "hdlyap_errors: --box = %s: must be one of", a->box);
    for (const box *b = BOXES; b < BOXES + BOXES_ALL; b++) fprintf(stderr, " %s", b->name);
    fprintf(stderr, "\n");
    exit(2);
}

int main(int argc, char **argv)
{
    const asked a = read_options(argc, argv);
    harvest h[BOXES_ALL];
    hd_blas_restart_if_slow(argv);
    const int boxes = choose(&a, h);
    table *t = table_create(a.out, "errors", HEADER);
    follow_all(h, boxes, a.seeds);
    print_heading(a.seeds);
    for (int k = 0; k < boxes; k++) {
        tell_box(&h[k], t);
        harvest_free(&h[k]);
    }
    table_write(t, argv, gemm_once());
    return 0;
}
