/** The table of observables: a row that is off takes no memory and is never called. */
#define _GNU_SOURCE
#include "kept.h"
#include "runs.h"

static const hd_observable *const *rows = hd_observable_rows;
static const unsigned *bits = hd_observable_bits;
#define OF(row) (1u << HD_OBSERVED_##row)

/** A narrow channel, whose steps are soon known: after 50 time units of averages. */
static hd_scene_def channel(unsigned observe)
{
    hd_scene_def scene = scene(.number = 40, .density = 0.5, .aspect = 0.08, .threads = 1,
                               .exponents = HD_EXPONENTS_ALL_INDEPENDENT, .equilibration = 20.0,
                               .warmup = 50.0, .duration = 1000.0, .observe = observe);
    if (!(observe & HD_OBSERVE_COVARIANT)) return scene;
    scene.covariant_window = scene.covariant_transient = 5.0;
    scene.covariant_sampling = 1.0;
    return scene;
}

/** What is measured, reported or followed is kept in a file, and begins anew where averages do; all
 * rows can be made, freed and counted. */
TEST(rows_are_whole)
{
    for (int k = 0; k < HD_OBSERVED; k++) {
        const hd_observable *row = rows[k];
        assert_true(row->create && row->free && row->bytes);
        if (row->measure || row->add || row->report || k == HD_OBSERVED_covariant)
            assert_true(row->clear && row->archive);
    }
}

/** A run of these observables has these parts, and no bytes but theirs. */
static void has_parts(unsigned observe, unsigned wanted)
{
    const hd_scene_def scene = channel(observe);
    OWNED(hd_run) *run = created(scene);
    unsigned parts = 0, needs = 0;
    double sum = 0.0;
    for (int k = 0; k < HD_OBSERVED; k++) {
        parts |= (unsigned)(hd_observables_part(&run->observables, (hd_observed)k) != NULL) << k;
        if (wanted >> k & 1) sum += rows[k]->bytes(&scene, 1), needs |= rows[k]->needs;
    }
    assert_int_equal(parts, wanted);
    if (needs & HD_NEEDS_STATE) sum += 4.0 * scene.number * sizeof(double); /* q and p */
    CHECK_CLOSE(hd_observables_bytes(&scene, 1), sum, 1e-6);
    assert_int_equal(run->observables.q != NULL, (needs & HD_NEEDS_STATE) != 0);
}

static unsigned rows_of(unsigned set)
{
    unsigned found = 0;
    for (int k = 0; k < HD_OBSERVED; k++) found |= (unsigned)((set & bits[k]) != 0) << k;
    return found;
}

TEST(a_run_has_what_it_needs)
{
    const unsigned steps = OF(modes) | OF(steps);
    const struct {
        unsigned observe, parts;
    } cases[] = {{0, 0},
                 {HD_OBSERVE_MODES, steps},
                 {HD_OBSERVE_STEPS, steps},
                 {HD_OBSERVE_PHASES, steps | OF(phases)},
                 {HD_OBSERVE_FIELDS, steps | OF(fields)},
                 {HD_OBSERVE_HYDRO, steps | OF(hydro)},
                 {HD_OBSERVE_T_PHASES, steps | OF(t_phases)},
                 {HD_OBSERVE_STRUCTURE, steps | OF(structure)},
                 {HD_OBSERVE_ALL, rows_of(HD_OBSERVE_ALL)}};
    unsigned tried = 0;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        has_parts(cases[c].observe, cases[c].parts);
        if (cases[c].observe != HD_OBSERVE_ALL) tried |= cases[c].observe;
    }
    for (int k = 0; k < HD_OBSERVED; k++) /* others need none */
        if (HD_OBSERVE_ALL & ~tried & bits[k]) has_parts(bits[k], 1u << k);
}

/** Its arrays; none of what disks do not have. */
static bytes archived(const hd_run *run, int k)
{
    bytes b = {NULL, 0};
    if (!run->observables.part[k]) return b;
    FILE *file = open_memstream(&b.data, &b.size);
    hd_archive archive = hd_archive_writer(file);
    const hd_moment now = {.trajectory = hd_run_trajectory(run), .archive = &archive};
    rows[k]->archive(run->observables.part[k], &now);
    CHECK_OK(hd_archive_end(&archive));
    fclose(file);
    return b;
}

/** This one, and all that it comes with. */
static unsigned without(unsigned bit)
{
    unsigned set = bit;
    for (int k = 0; k < HD_OBSERVED; k++)
        if (hd_observables_with(bits[k]) & bit) set |= bits[k];
    return set;
}

/** One observable after the other is not looked at for a while: in a checkpoint the arrays of all
 * rows that nothing else asks for stay as they were, and all others change. Fields keep none. */
TEST(what_nobody_looks_at_stays)
{
    OWNED(hd_run) *run = created(channel(HD_OBSERVE_ALL));
    until_time(run, 120.0);
    for (int off = 0; off < HD_OBSERVED; off++) {
        const unsigned looked_at = HD_OBSERVE_ALL & ~without(bits[off]);
        bytes before[HD_OBSERVED] = {{NULL, 0}};
        CHECK_OK(hd_run_settle(run)); /* as kept_bytes does */
        hd_run_observe(run, looked_at);
        for (int k = 0; k < HD_OBSERVED; k++)
            if (rows[k]->archive) before[k] = archived(run, k);
        until_time(run, hd_run_time(run) + 20.0);
        const bytes after = kept_bytes(run);
        for (int k = 0; k < HD_OBSERVED; k++) {
            const bool goes_on = looked_at & bits[k] || !(rows[k]->needs & HD_NEEDS_FRAME);
            const void *kept = before[k].data
                                   ? memmem(after.data, after.size, before[k].data, before[k].size)
                                   : NULL;
            if (before[k].data && goes_on == (kept != NULL))
                fail_msg("row %d without row %d: %s", k, off, goes_on ? "stays" : "changes");
            free(before[k].data);
        }
        free(after.data);
        hd_run_observe(run, HD_OBSERVE_ALL);
    }
}

static bool is_resolved(const hd_run *run, hd_mode_kind kind)
{
    const hd_steps *steps = hd_run_steps(run);
    for (int k = 0; k < hd_steps_count(steps); k++)
        if (hd_steps_step(steps, k)->kind == kind && hd_steps_step(steps, k)->resolved) return true;
    return false;
}

/** All that there is, averaged until LP and T steps are known. */
static hd_run *with_everything(double aspect)
{
    hd_run *run = created(scene_from(channel(HD_OBSERVE_ALL), .aspect = aspect));
    until_time(run, 130.0);
    assert_true(is_resolved(run, HD_MODE_LP) && is_resolved(run, HD_MODE_T));
    return run;
}

/** Phases of one kind want the next state sooner than those of the other: here LP, there T. */
TEST(the_next_state_comes_as_soon_as_one_kind_of_phases_needs_it)
{
    const double aspect[] = {0.08, 0.04};
    for (int k = 0; k < 2; k++) {
        OWNED(hd_run) *run = with_everything(aspect[k]);
        const double lp = hd_phases_sampling(hd_run_phases(run), hd_run_steps(run));
        const double t = hd_phases_sampling(hd_run_t_phases(run), hd_run_steps(run));
        assert_true(k == 0 ? lp < 0.9 * t : t < 0.9 * lp);
        CHECK_CLOSE(hd_observables_sampling(&run->observables), fmin(lp, t), 0.0);
    }
}

static double steps_resolved(const hd_run *run)
{
    int resolved = 0;
    for (int k = 0; k < hd_steps_count(hd_run_steps(run)); k++)
        resolved += hd_steps_step(hd_run_steps(run), k)->resolved;
    return resolved;
}

static double responses_found(const hd_hydro *hydro)
{
    int found = 0;
    for (int k = 0; k < hd_hydro_count(hydro); k++) found += hd_hydro_at(hydro, k)->col >= 0;
    return found;
}

/** What each has averaged of: samples, time units, .. */
enum { AVERAGES = 10 };
static void read_averages(const hd_run *run, double of[AVERAGES])
{
    const double now[AVERAGES] = {hd_gas_read(hd_run_gas(run)).time,
                                  (double)hd_modes_samples(hd_run_modes(run)),
                                  steps_resolved(run),
                                  (double)hd_structure_samples(hd_run_structure(run)),
                                  hd_phases_velocity(hd_run_phases(run)).phases,
                                  hd_phases_velocity(hd_run_t_phases(run)).phases,
                                  (double)hd_localization_samples(hd_run_localization(run)),
                                  responses_found(hd_run_hydro(run)),
                                  (double)hd_covariant_read(hd_run_covariant(run)).windows,
                                  hd_fluctuations_times(hd_run_fluctuations(run))};
    memcpy(of, now, sizeof now);
}

/** Whatever else is looked at no more, and again. */
TEST(what_is_looked_at_goes_on)
{
    OWNED(hd_run) *run = with_everything(0.08);
    const int tracked = hd_phases_velocity(hd_run_phases(run)).phases;
    assert_true(tracked > 0);
    hd_run_observe(run, HD_OBSERVE_ALL & ~(unsigned)HD_OBSERVE_HYDRO);
    hd_run_observe(run, HD_OBSERVE_ALL);
    assert_int_equal(hd_phases_velocity(hd_run_phases(run)).phases, tracked);
}

TEST(a_reset_forgets_all_averages)
{
    for (int looked_at = 0; looked_at < 2; looked_at++) {
        OWNED(hd_run) *run = with_everything(0.08);
        double before[AVERAGES], after[AVERAGES];
        bytes kept[HD_OBSERVED] = {{NULL, 0}};
        read_averages(run, before);
        for (int k = 0; k < HD_OBSERVED; k++)
            if (rows[k]->clear) kept[k] = archived(run, k);
        if (!looked_at) hd_run_observe(run, 0);
        CHECK_OK(hd_run_reset_average(run));
        read_averages(run, after);
        for (int k = 0; k < HD_OBSERVED; k++) {
            const bytes now = rows[k]->clear ? archived(run, k) : (bytes){NULL, 0};
            if (now.data && now.size == kept[k].size) /* a row that is in no list, too */
                assert_memory_not_equal(now.data, kept[k].data, now.size);
            free(now.data), free(kept[k].data);
        }
        for (int k = 0; k < AVERAGES; k++) {
            assert_true(before[k] > 0);
            CHECK_CLOSE(after[k], 0.0, 0.0);
        }
    }
}
