/** Averages of covariant vectors over windows -> message Covariant. */
#include "topics/moment.h"

#include <math.h>

_Static_assert((int)HD_CENTRE_STABLE == (int)HDR_COVARIANT_ANGLE_CENTRE_STABLE,
               "pairs of spaces as in the core");

/** The histograms of one angle, with the types of the message. */
typedef struct histograms {
    uint64_t smallest[HD_ANGLE_BINS], all[HD_ANGLE_BINS];
} histograms;

/** If the spaces of two starts are at most this far apart, their angles are known well [rad]. */
static const double SPACES_APART = 1e-3;

/** The memory of a message's arrays. */
typedef struct arrays {
    double *exponents, *std_errors, *local_exponents; /**< [vectors] each */
    hdr_covariant_weight *weight;                     /**< [weights] */
    hdr_covariant_angle angle[HD_PAIRS_OF_SPACES];
    histograms counts[HD_PAIRS_OF_SPACES];
    hdr_growth_order order[HD_TIMES_MAX];
    uint32_t vectors, weights, angles;
} arrays;

/** Takes the memory. Returns false if there is none. */
static bool arrays_take(arrays *a, const moment *now, const hd_covariant_results *seen)
{
    const hd_modes *dq = seen->half[0]; /* NULL without positions in a box */
    const size_t n = (size_t)seen->vectors;
    a->vectors = (uint32_t)n;
    a->weights = dq ? (uint32_t)hd_fields_subspaces(hd_modes_fields(dq)) : 0;
    a->angles = seen->splitting.has_spaces ? HD_PAIRS_OF_SPACES : 0;
    a->exponents = moment_take(now, 3 * n, sizeof *a->exponents);
    a->weight = moment_take(now, a->weights, sizeof *a->weight);
    if (!a->exponents || !a->weight) return false;
    a->std_errors = a->exponents + n;
    a->local_exponents = a->std_errors + n;
    return true;
}

static void gather_exponents(arrays *r, const hd_covariant_results *seen)
{
    const hd_spectrum *spectrum = seen->spectrum;
    for (uint32_t k = 0; k < r->vectors; k++) {
        r->exponents[k] = hd_spectrum_exponent(spectrum, (int)k);
        r->std_errors[k] = hd_covariant_std_error(seen, (int)k);
        r->local_exponents[k] = hd_spectrum_local(spectrum, (int)k);
    }
}

static hdr_counts counted(uint64_t *out, const long *bins)
{
    for (int bin = 0; bin < HD_ANGLE_BINS; bin++) out[bin] = (uint64_t)bins[bin];
    return (hdr_counts){out, HD_ANGLE_BINS};
}

static void gather_angles(arrays *r, const hd_splitting_results *splitting)
{
    for (uint32_t pair = 0; pair < r->angles; pair++) {
        const hd_angle_of_spaces *angle = &splitting->angle[pair];
        r->angle[pair] = (hdr_covariant_angle){
            .spaces = (uint8_t)pair,
            .last = angle->last,
            .mean = angle->mean,
            .std_error = angle->std_error,
            .least = angle->least,
            .mean_of_all = angle->mean_of_all,
            .smallest_counts = counted(r->counts[pair].smallest, angle->smallest),
            .all_counts = counted(r->counts[pair].all, angle->all),
        };
    }
}

static void gather_weights(arrays *r, const hd_covariant_results *seen)
{
    const hd_modes *dq = seen->half[0], *dp = seen->half[1];
    const hd_modes *frame = seen->of_frame;
    for (uint32_t k = 0; k < r->weights; k++) {
        const int s = (int)k;
        const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(dq), s);
        r->weight[k] = (hdr_covariant_weight){
            .kind = (uint8_t)subspace->kind,
            NODES(subspace->wave),
            .wave_number = subspace->wave.number,
            .dimension = (uint32_t)subspace->dimension,
            .dq = message_array(hd_modes_average(dq, s, HD_WEIGHT), r->vectors, 1),
            .dp = message_array(hd_modes_average(dp, s, HD_WEIGHT), r->vectors, 1),
            .gram_schmidt = message_array(hd_modes_average(frame, s, HD_WEIGHT), r->vectors, 1),
        };
    }
}

static void gather_orders(arrays *r, const hd_covariant_results *seen)
{
    for (int k = 0; k < seen->times; k++) r->order[k] = growth_order(seen->order[k], r->vectors);
}

static hdr_covariant message_of(arrays *r, const hd_run *run, const hd_covariant_results *seen)
{
    const hd_splitting_results *splitting = &seen->splitting;
    const hd_covariant_mismatch apart = seen->start_mismatch;
    const uint32_t n = r->vectors;
    gather_exponents(r, seen);
    gather_angles(r, splitting);
    gather_weights(r, seen);
    gather_orders(r, seen);
    return (hdr_covariant){
        .sim_time = seen->window_end,
        .averaged_time = hd_spectrum_time(seen->spectrum),
        .windows = (uint32_t)seen->windows,
        .lost_windows = (uint32_t)seen->lost,
        .samples = (uint32_t)splitting->samples,
        .seconds = hd_run_cost(run).following,
        .first_index = 1,
        .exponents = message_array(r->exponents, n, 1),
        .std_errors = message_array(r->std_errors, n, 1),
        .local_exponents = message_array(r->local_exponents, n, 1),
        .start_mismatch = message_array(seen->start_mismatch_each, n, 1),
        .neighbour_angles = message_array(splitting->neighbours, n - 1, 1),
        .least_neighbour_angles = message_array(splitting->neighbours_least, n - 1, 1),
        .violations = message_array(seen->order[0].violations, n - 1, 1),
        .domination_violations = message_array(seen->order[0].domination_violations, n - 1, 1),
        .orders = {r->order, (uint32_t)seen->times},
        .widths = message_array(seen->widths, n, 1),
        .cos_theta = message_array(seen->cosines, n, 1),
        .centre_start_mismatch = apart.centre,
        .stable_start_mismatch = apart.stable,
        .null_angle = seen->null,
        .largest_null_angle = seen->null_most,
        .angles = {r->angle, r->angles},
        .weights = {r->weight, r->weights},
    };
}

/** Warns if the spaces of the two random starts still differ at the window's end, because they are
 * then not the covariant ones; and if a window was left out for want of memory. */
static void warn(covariant_said *before, const hd_run *run, const hd_covariant_results *seen)
{
    const hd_covariant_mismatch apart = seen->start_mismatch;
    const double worst = fmax(apart.centre, apart.stable);
    const long lost = seen->lost;
    if (worst > SPACES_APART && !before->warned)
        hdr_log(HDR_WARN,
                "covariant_transient = %g: too short, spaces of two random starts still differ by "
                "%.2g rad at the end of a window",
                hd_run_scene(run)->covariant_transient, worst);
    if (lost > before->lost)
        hdr_log(
            HDR_WARN,
            "covariant_memory = %g: too small for orthonormalisations as frequent as these; %ld "
            "windows are left out so far",
            hd_run_scene(run)->covariant_memory, lost);
    before->warned = worst > SPACES_APART;
    before->lost = lost;
}

/** Publishes only if a window has ended since the last message. It may be called after any step or
 * checkpoint. */
hd_status topic_publish_covariant(const moment *now)
{
    covariant_said *last = &now->kept->covariant;
    arrays a = {0};
    const hd_covariant_results seen = hd_covariant_read(hd_run_parts(now->run).covariant);
    const long windows = seen.windows, before = last->known ? last->windows : windows;
    last->known = true;
    last->windows = windows;
    warn(last, now->run, &seen);
    /* after a reset there are none */
    if (windows == 0 || windows == before ||
        !(publishers_subscribed(now->out) & topic_bit(TOPIC_covariant)) ||
        !arrays_take(&a, now, &seen))
        return HD_OK;
    hdr_covariant message = message_of(&a, now->run, &seen);
    return topic_send_covariant(now->out, &message);
}
