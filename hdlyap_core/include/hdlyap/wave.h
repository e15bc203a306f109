/** Wave vectors of the box, and the modulations A(x, y) or A(x, y, z) of a wave [T10], [T22]: the
 * sines and cosines on which fields of modes are built. */
#ifndef HDLYAP_WAVE_H
#define HDLYAP_WAVE_H

#include <stdbool.h>

#include "hdlyap/scene.h"

HD_API_BEGIN

/** Bits of a modulation in a box. A is a product of one function of each coordinate: a sine if the
 * bit is set, otherwise a cosine (which is 1 for mode number 0). */
enum { HD_SIN_X = 1, HD_SIN_Y = 2, HD_SIN_Z = 4 };

/** In space each A has up to two transverse fields; this bit, added to A's, is the second one. */
enum { HD_SECOND = 8 };

/** Modulations in a circle: a function of r times cos(m theta), or times sin(m theta). */
enum { HD_COS_M = 16, HD_SIN_M = 17 };

/** Largest numbers at one wave vector: modulations, transverse fields, and fields of one kind (LP
 * has two for each modulation). */
enum {
    HD_MODULATIONS_MAX = 1 << HD_DIMENSION_MAX,
    HD_TRANSVERSE_MAX = HD_MODULATIONS_MAX * (HD_DIMENSION_MAX - 1),
    HD_FIELDS_MAX = 2 * HD_MODULATIONS_MAX
};
/** Such largest numbers in a space of this dimension, 2 or 3. */
#define HD_MODULATIONS_IN(dimension) (1 << (dimension))
#define HD_TRANSVERSE_IN(dimension) (HD_MODULATIONS_IN(dimension) * ((dimension)-1))
#define HD_FIELDS_IN(dimension) (2 * HD_MODULATIONS_IN(dimension))

/** The modulations of one kind of field at a wave vector: bits as above, ascending. */
typedef struct hd_modulations {
    int count; /**< for LP 0 .. HD_MODULATIONS_MAX, for T 0 .. HD_TRANSVERSE_MAX */
    unsigned char bits[HD_TRANSVERSE_MAX];
} hd_modulations;

/** A wave vector. */
typedef struct hd_wave {
    /** Mode numbers along each direction, not all 0. In a circle n[0] is m and n[1] the number of
     * the root of J_m(k r): T and LP fields have different roots, so each has waves of its own. */
    int n[HD_DIMENSION_MAX];
    double k[HD_DIMENSION_MAX]; /**< components of the wave vector, >= 0; in a circle |k| and 0
                                   [1/sigma] */
    double number;              /**< |k| [1/sigma] */
    /** Modulations of the T fields. Along a reflecting direction they have a sine and n >= 1; in
     * space see [T22]. */
    hd_modulations transverse;
    hd_modulations pairs; /**< modulations of the LP pairs: a cosine along a reflecting direction */
    /** In space: unit vectors of the T fields, across[0] without and across[1] with HD_SECOND; 0 if
     * there is no such field [T22]. */
    double across[2][HD_DIMENSION_MAX];
} hd_wave;

/** Component of the wave vector along direction d of a box for mode number n: 2 pi n / L if it is
 * periodic, pi n / (L - 1) if it is reflecting. */
double hd_wave_component(const hd_scene_def *def, int d, int n);

/** Which waves a scene may ask for. */
typedef struct hd_wave_limits {
    double
        smallest; /**< wave number of the longest wave in the box; above largest if there is none */
    double largest; /**< largest wave number that the particles sample: its wave length is two mean
                       distances, pi sqrt(density), in space pi cbrt(density) */
    int node;       /**< largest mode number n_x, n_y or n_z of waves up to `largest`; 0: no wave */
} hd_wave_limits;

/** Writes the wave vectors that the scene asks for to out[capacity] in ascending k, and returns
 * their number; with capacity 0 it only counts. */
int hd_waves(const hd_scene_def *def, hd_wave *out, int capacity);

HD_API_END
#endif
