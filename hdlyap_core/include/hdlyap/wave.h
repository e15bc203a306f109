/** Wave vectors of the box, and the modulations A(x, y), of spheres A(x, y, z), that live on them
 * [T10], [T22]. */
#ifndef HDLYAP_WAVE_H
#define HDLYAP_WAVE_H

#include <stdbool.h>

#include "hdlyap/scene.h"

HD_API_BEGIN

/** A is a product of a function of each coordinate; a set bit: sine, otherwise cosine (1 for n =
 * 0).
 */
enum { HD_SIN_X = 1, HD_SIN_Y = 2, HD_SIN_Z = 4 };

/** Of spheres each A has up to two transverse fields: with this bit, the second one. */
enum { HD_SECOND = 8 };

/** Or A is a function of r times cos(m theta) or sin(m theta) in a circle. */
enum { HD_COS_M = 16, HD_SIN_M = 17 };

/** Products; transverse fields of them; fields of the largest subspace, of LP two for each A. */
enum {
    HD_MODULATIONS_MAX = 1 << HD_DIMENSION_MAX,
    HD_TRANSVERSE_MAX = HD_MODULATIONS_MAX * (HD_DIMENSION_MAX - 1),
    HD_FIELDS_MAX = 2 * HD_MODULATIONS_MAX
};
/** The same in a space of two directions or three. */
#define HD_MODULATIONS_IN(dimension) (1 << (dimension))
#define HD_TRANSVERSE_IN(dimension) (HD_MODULATIONS_IN(dimension) * ((dimension)-1))
#define HD_FIELDS_IN(dimension) (2 * HD_MODULATIONS_IN(dimension))

/** Bits of the modulations of one kind of field at a wave vector, or HD_COS_M and HD_SIN_M;
 * ascending. */
typedef struct hd_modulations {
    int count; /**< of LP 0 .. HD_MODULATIONS_MAX, of T 0 .. HD_TRANSVERSE_MAX */
    unsigned char bits[HD_TRANSVERSE_MAX];
} hd_modulations;

/** In a box of n[d] nodes along each direction, not all 0; in a circle J_m(k r) of m =
 * n[0] with the n[1]th root of its kind at the wall: T and LP fields have waves of their own. */
typedef struct hd_wave {
    int n[HD_DIMENSION_MAX];
    double k[HD_DIMENSION_MAX]; /**< components of the wave vector, >= 0; in a circle |k|, 0
                                   [1/sigma] */
    double number;              /**< |k| [1/sigma] */
    /** Of the transverse fields: sine and n >= 1 along a reflecting direction; of spheres see
     * [T22].
     */
    hd_modulations transverse;
    hd_modulations pairs; /**< of the LP pairs: cosine along a reflecting direction */
    /** Of spheres unit vectors of the transverse fields, without HD_SECOND and with it; zeros where
     * there are none [T22]. */
    double across[2][HD_DIMENSION_MAX];
} hd_wave;

/** k along direction d of a box for n nodes: 2 pi n / L periodic, pi n / (L - 1) reflecting.
 */
double hd_wave_component(const hd_scene_def *def, int d, int n);

/** What a scene may ask for. */
typedef struct hd_wave_limits {
    double
        smallest; /**< wave number of the longest wave in the box; above largest if there is none */
    double largest; /**< wave number that the disks still sample: wave length two mean distances,
                          pi sqrt(density), of spheres pi cbrt(density) */
    int node; /**< largest number of nodes along a direction within that; 0 if there is no wave */
} hd_wave_limits;

/** Writes the wave vectors that the scene asks for to out[capacity], in ascending k, and returns
 * their number; with capacity 0 only counts. */
int hd_waves(const hd_scene_def *def, hd_wave *out, int capacity);

HD_API_END
#endif
