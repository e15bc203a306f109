/** A node of particles that the core does not know: a chain by hand; the same chain that loses its
 * energy, as a row may say without having a time step, or has no name, or that tells averages; a
 * ring whose maps are not symplectic; and rows of long names that share parameters of their own. */
#include <hdlyap_ros/main.h>
#include <string.h>

#include "../core/support/chain_by_hand.h"
#include "../core/support/isokinetic.h"

/** Time after which the energy is lost. */
static const double LOST = 20.0;

static hd_status advance_and_lose(void *state, hd_record *record, double t_end)
{
    const hd_status status = advance(state, record, t_end);
    return status == HD_OK && t_end > LOST ? HD_ENERGY_LOST : status;
}

/** Kinetic energy of a particle, and how far it is from its neighbour. */
static void measure(const hd_scene_def *scene, const double *q, const double *p, double *mean)
{
    const int n = scene->number;
    mean[0] = mean[1] = 0.0;
    for (int i = 0; i < n; i++) {
        mean[0] += 0.5 * p[i] * p[i] / n;
        mean[1] += (q[(i + 1) % n] - q[i]) * (q[(i + 1) % n] - q[i]) / n;
    }
}

int main(int argc, char **argv)
{
    enum { SHARING = 5 };
    static const hd_average told[] = {{"kinetic", "energy"}, {"stretch", ""}};
    static const char *const names[SHARING] = {
        "chains_of_a_name_of_31_letters1", "chains_of_a_name_of_31_letters2",
        "chains_of_a_name_of_31_letters3", "chains_of_a_name_of_31_letters4",
        "chains_of_a_name_of_31_letters5"};
    hd_dynamics lossy = of_chain, telling = of_chain, sharing[SHARING];
    hd_parameter shared[PARAMETERS];
    const hd_dynamics *rows[3 + SHARING + 1] = {&of_chain, &lossy, &of_ring};
    lossy.particles = getenv("HDLYAP_NAMELESS") ? NULL : "lossy_chain";
    lossy.advance = advance_and_lose;
    telling.particles = "telling_chain";
    telling.average = told;
    telling.averages = 2;
    telling.measure = measure;
    rows[3 + SHARING] = &telling;
    memcpy(shared, parameters, sizeof shared);
    for (int k = 0; k < SHARING; k++) {
        sharing[k] = of_chain;
        sharing[k].particles = names[k];
        sharing[k].parameter = shared;
        rows[3 + k] = &sharing[k];
    }
    return hdlyap_node_main(argc, argv, rows, 4 + SHARING);
}
