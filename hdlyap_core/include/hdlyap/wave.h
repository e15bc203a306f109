/** Wave vectors of the box, and the modulations A(x, y) that live on them [T10]. */
#ifndef HDLYAP_WAVE_H
#define HDLYAP_WAVE_H

#include <stdbool.h>

#include "hdlyap/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A is a product of a function of x and one of y; a set bit: sine, otherwise cosine (1 for n = 0).
 */
enum { HD_SIN_X = 1, HD_SIN_Y = 2 };

/** Or of a function of r and cos(m theta) or sin(m theta) in a circle. */
enum { HD_COS_M = 4, HD_SIN_M = 5 };

enum { HD_MODULATIONS_MAX = 4 };

/** Bits of the modulations of one kind of field at a wave vector, or HD_COS_M and HD_SIN_M;
 * ascending. */
typedef struct hd_modulations {
    int count; /**< 0 .. 4 */
    unsigned char bits[HD_MODULATIONS_MAX];
} hd_modulations;

/** In a rectangle of n[0] nodes along x and n[1] along y, not both 0; in a circle J_m(k r) of m =
 * n[0] with the n[1]th root of its kind at the wall: T and LP fields have waves of their own. */
typedef struct hd_wave {
    int n[HD_DIM];
    double k[HD_DIM]; /**< components of the wave vector, >= 0; in a circle |k|, 0 [1/sigma] */
    double number;    /**< |k| [1/sigma] */
    /** Of the transverse fields: sine and n >= 1 along a reflecting direction. */
    hd_modulations transverse;
    hd_modulations pairs; /**< of the LP pairs: cosine along a reflecting direction */
} hd_wave;

/** k along direction d of a rectangle for n nodes: 2 pi n / L periodic, pi n / (L - 1) reflecting.
 */
double hd_wave_component(const hd_scene_def *def, int d, int n);

/** What a scene may ask for. */
typedef struct hd_wave_limits {
    double
        smallest; /**< wave number of the longest wave in the box; above largest if there is none */
    double largest; /**< wave number that the disks still sample: wave length two mean distances,
                          pi sqrt(density) */
    int node; /**< largest number of nodes along a direction within that; 0 if there is no wave */
} hd_wave_limits;
hd_wave_limits hd_wave_limits_of(const hd_scene_def *def);

/** Writes the wave vectors that the scene asks for to out[capacity], in ascending k, and returns
 * their number; with capacity 0 only counts. */
int hd_waves(const hd_scene_def *def, hd_wave *out, int capacity);

#ifdef __cplusplus
}
#endif
#endif
