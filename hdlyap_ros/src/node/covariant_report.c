/** Averages over windows of covariant vectors -> Covariant. */
#include "covariant_report.h"

#include <math.h>
#include <stdlib.h>

_Static_assert((int)HD_CENTRE_STABLE == (int)HDR_COVARIANT_ANGLE_CENTRE_STABLE,
               "pairs of spaces as in the core");

/** Of one angle, as the message has them. */
typedef struct histograms {
    uint64_t smallest[HD_ANGLE_BINS], all[HD_ANGLE_BINS];
} histograms;

/** Angles of spaces are known to a thousandth then [rad]. */
static const double SPACES_APART = 1e-3;

struct covariant_report {
    const publishers *to;
    uint32_t vectors, angles, weights; /**< lengths of the arrays below */
    /** In one block at exponents; [vectors] each */
    double *exponents, *std_errors, *local_exponents;
    hdr_covariant_angle angle[HD_PAIRS_OF_SPACES];
    histograms counts[HD_PAIRS_OF_SPACES];
    hdr_covariant_weight *weight;
    long windows, lost; /**< when they were last looked at */
    bool warned;        /**< of a transient that is too short */
};

static uint32_t subspaces_of(const hd_covariant *covariant)
{
    const hd_modes *modes = hd_covariant_half(covariant, 0);
    return modes ? (uint32_t)hd_fields_subspaces(hd_modes_fields(modes)) : 0;
}

bool covariant_report_create(covariant_report **out, const publishers *to, const hd_run *run)
{
    const hd_covariant *covariant = hd_run_covariant(run);
    covariant_report *r = *out = calloc(1, sizeof *r);
    if (!r) return false;
    r->to = to;
    r->windows = hd_covariant_windows(covariant);
    r->vectors = (uint32_t)hd_covariant_vectors(covariant);
    r->weights = subspaces_of(covariant);
    if (hd_splitting_has_spaces(hd_covariant_splitting(covariant))) r->angles = HD_PAIRS_OF_SPACES;
    r->exponents = malloc(3 * (size_t)r->vectors * sizeof *r->exponents);
    r->weight = malloc((r->weights + 1) * sizeof *r->weight);
    if (r->exponents && r->weight) {
        r->std_errors = r->exponents + r->vectors;
        r->local_exponents = r->std_errors + r->vectors;
        return true;
    }
    covariant_report_free(r);
    *out = NULL;
    return false;
}

void covariant_report_free(covariant_report *r)
{
    if (!r) return;
    free(r->exponents);
    free(r->weight);
    free(r);
}

double covariant_report_size(const covariant_report *r)
{
    return (10.0 + 3.0 * r->weights) * r->vectors + 2.0 * HD_ANGLE_BINS * r->angles;
}

/** An error that is not known has one value, as an angle of what is not carried. */
static double known(double value) { return value < 0.0 ? -1.0 : value; }

static void gather_exponents(covariant_report *r, const hd_spectrum *spectrum)
{
    for (uint32_t k = 0; k < r->vectors; k++) {
        r->exponents[k] = hd_spectrum_exponent(spectrum, (int)k);
        r->std_errors[k] = known(hd_spectrum_std_error(spectrum, (int)k));
        r->local_exponents[k] = hd_spectrum_local(spectrum, (int)k);
    }
}

static hdr_counts counted(uint64_t *out, const long *bins)
{
    for (int bin = 0; bin < HD_ANGLE_BINS; bin++) out[bin] = (uint64_t)bins[bin];
    return (hdr_counts){out, HD_ANGLE_BINS};
}

static void gather_angles(covariant_report *r, const hd_splitting *splitting)
{
    for (uint32_t pair = 0; pair < r->angles; pair++) {
        const hd_angle_of_spaces *angle = hd_splitting_angle(splitting, (hd_pair_of_spaces)pair);
        r->angle[pair] = (hdr_covariant_angle){
            .spaces = (uint8_t)pair,
            .last = angle->last,
            .mean = angle->mean,
            .std_error = known(angle->std_error),
            .least = angle->least,
            .mean_of_all = angle->mean_of_all,
            .smallest_counts = counted(r->counts[pair].smallest, angle->smallest),
            .all_counts = counted(r->counts[pair].all, angle->all),
        };
    }
}

static void gather_weights(covariant_report *r, const hd_covariant *covariant)
{
    const hd_modes *dq = hd_covariant_half(covariant, 0), *dp = hd_covariant_half(covariant, 1);
    const hd_modes *frame = hd_covariant_of_frame(covariant);
    for (uint32_t k = 0; k < r->weights; k++) {
        const int s = (int)k;
        const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(dq), s);
        r->weight[k] = (hdr_covariant_weight){
            .kind = (uint8_t)subspace->kind,
            .nx = (uint32_t)subspace->wave.n[0],
            .ny = (uint32_t)subspace->wave.n[1],
            .wave_number = subspace->wave.number,
            .dimension = (uint32_t)subspace->dimension,
            .dq = message_array(hd_modes_average(dq, s, HD_WEIGHT), r->vectors, 1),
            .dp = message_array(hd_modes_average(dp, s, HD_WEIGHT), r->vectors, 1),
            .gram_schmidt = message_array(hd_modes_average(frame, s, HD_WEIGHT), r->vectors, 1),
        };
    }
}

static hdr_covariant message_of(covariant_report *r, const hd_run *run)
{
    const hd_covariant *covariant = hd_run_covariant(run);
    const hd_splitting *splitting = hd_covariant_splitting(covariant);
    const hd_covariant_mismatch apart = hd_covariant_start_mismatch(covariant);
    const uint32_t n = r->vectors;
    gather_exponents(r, hd_covariant_spectrum(covariant));
    gather_angles(r, splitting);
    gather_weights(r, covariant);
    return (hdr_covariant){
        .header = message_header(),
        .run_id = r->to->run_id,
        .sim_time = hd_covariant_window_end(covariant),
        .averaged_time = hd_spectrum_time(hd_covariant_spectrum(covariant)),
        .windows = (uint32_t)hd_covariant_windows(covariant),
        .lost_windows = (uint32_t)hd_covariant_lost(covariant),
        .samples = (uint32_t)hd_splitting_samples(splitting),
        .seconds = hd_run_cost(run).covariant,
        .first_index = 1,
        .exponents = message_array(r->exponents, n, 1),
        .std_errors = message_array(r->std_errors, n, 1),
        .local_exponents = message_array(r->local_exponents, n, 1),
        .start_mismatch = message_array(hd_covariant_start_mismatch_each(covariant), n, 1),
        .neighbour_angles = message_array(hd_splitting_neighbours(splitting), n - 1, 1),
        .least_neighbour_angles = message_array(hd_splitting_neighbours_least(splitting), n - 1, 1),
        .violations = message_array(hd_splitting_violations(splitting), n - 1, 1),
        .domination_violations = message_array(hd_splitting_domination_violations(splitting), n - 1,
                                               1),
        .widths = message_array(hd_covariant_widths(covariant), n, 1),
        .cos_theta = message_array(hd_covariant_cosines(covariant), n, 1),
        .centre_start_mismatch = known(apart.centre),
        .stable_start_mismatch = known(apart.stable),
        .null_angle = known(hd_covariant_null(covariant)),
        .largest_null_angle = known(hd_covariant_null_most(covariant)),
        .angles = {r->angle, r->angles},
        .weights = {r->weight, r->weights},
    };
}

static bool is_finite(const hdr_covariant *v)
{
    const hdr_doubles arrays[] = {v->exponents,        v->std_errors, v->local_exponents,
                                  v->start_mismatch,   v->violations, v->domination_violations,
                                  v->neighbour_angles, v->widths,     v->least_neighbour_angles,
                                  v->cos_theta};
    const double scalars[] = {v->sim_time,
                              v->averaged_time,
                              v->seconds,
                              v->centre_start_mismatch,
                              v->stable_start_mismatch,
                              v->null_angle,
                              v->largest_null_angle};
    bool finite = message_finite(scalars, sizeof scalars / sizeof *scalars);
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
        finite = finite && message_finite(arrays[a].data, arrays[a].count);
    for (uint32_t k = 0; k < v->angles.count; k++) {
        const hdr_covariant_angle *angle = &v->angles.data[k];
        finite = finite && isfinite(angle->last + angle->mean + angle->std_error + angle->least +
                                    angle->mean_of_all);
    }
    for (uint32_t k = 0; k < v->weights.count; k++) {
        const hdr_covariant_weight *weight = &v->weights.data[k];
        finite = finite && message_finite(weight->dq.data, weight->dq.count) &&
                 message_finite(weight->dp.data, weight->dp.count) &&
                 message_finite(weight->gram_schmidt.data, weight->gram_schmidt.count);
    }
    return finite;
}

/** Spaces that have not met are those of the random starts; windows that find no room are missed.
 */
static void warn(covariant_report *r, const hd_run *run)
{
    const hd_covariant *covariant = hd_run_covariant(run);
    const hd_covariant_mismatch apart = hd_covariant_start_mismatch(covariant);
    const double worst = fmax(apart.centre, apart.stable);
    const long lost = hd_covariant_lost(covariant);
    if (worst > SPACES_APART && !r->warned)
        hdr_log(HDR_WARN,
                "covariant_transient = %g: too short, spaces of two starts are %.2g rad apart "
                "where a window ends",
                hd_run_scene(run)->covariant_transient, worst);
    if (lost > r->lost)
        hdr_log(HDR_WARN,
                "covariant vectors: a window found no room, orthonormalisations have become more "
                "frequent "
                "(%ld so far)",
                lost);
    r->warned = worst > SPACES_APART;
    r->lost = lost;
}

hd_status covariant_report_publish(covariant_report *r, const hd_run *run)
{
    const long before = r->windows;
    hdr_publisher *publisher = r->to->publisher[TOPIC_COVARIANT];
    r->windows = hd_covariant_windows(hd_run_covariant(run));
    warn(r, run);
    /* a reset takes them back to none */
    if (r->windows == 0 || r->windows == before || hdr_publisher_subscribers(publisher) == 0)
        return HD_OK;
    const hdr_covariant message = message_of(r, run);
    if (!is_finite(&message)) return HD_NOT_FINITE;
    return publishers_sent(hdr_covariant_publish(publisher, &message), TOPIC_COVARIANT);
}
