/** Wave vectors of the box, and the modulations of a wave [T10], [T22]: the functions A(x, y), in
 * space A(x, y, z), which are products of sines and cosines and from which the fields of modes are
 * made. Tags as [T10] are those of equations in THEORY.md. */
#ifndef HDLYAP_WAVE_H
#define HDLYAP_WAVE_H

#include <stdbool.h>

#include "hdlyap/scene.h"

HD_API_BEGIN

/** Bits of a modulation in a box. A is a product of one function for each direction: sin(k_d x_d)
 * if the bit of the direction is set, otherwise cos(k_d x_d), which is 1 for mode number 0. */
enum { HD_SIN_X = 1, HD_SIN_Y = 2, HD_SIN_Z = 4 };

/** In space each A has up to two T fields. The bits of the second one are those of A and this bit.
 */
enum { HD_SECOND = 8 };

/** Modulations in a circle: a function of r times cos(m theta), or the same times sin(m theta). */
enum { HD_COS_M = 16, HD_SIN_M = 17 };

/** Largest numbers that one wave vector can have: of modulations; of T fields; and of fields of one
 * kind, of which LP has two for each modulation. */
enum {
    HD_MODULATIONS_MAX = 1 << HD_DIMENSION_MAX,
    HD_TRANSVERSE_MAX = HD_MODULATIONS_MAX * (HD_DIMENSION_MAX - 1),
    HD_FIELDS_MAX = 2 * HD_MODULATIONS_MAX
};
/** The same numbers for a space of this dimension, 2 or 3. */
#define HD_MODULATIONS_IN(dimension) (1 << (dimension))
#define HD_TRANSVERSE_IN(dimension) (HD_MODULATIONS_IN(dimension) * ((dimension)-1))
#define HD_FIELDS_IN(dimension) (2 * HD_MODULATIONS_IN(dimension))

/** The modulations of the fields of one kind at a wave vector, as bits (above), in ascending order.
 */
typedef struct hd_modulations {
    int count; /**< number of modulations: for LP 0 .. HD_MODULATIONS_MAX, for T 0 ..
                  HD_TRANSVERSE_MAX */
    unsigned char bits[HD_TRANSVERSE_MAX];
} hd_modulations;

/** A wave vector with its modulations. */
typedef struct hd_wave {
    /** Mode number along each direction, 0 or above, not all 0. In a circle n[0] is the angular
     * number m, and n[1] the number of the root of J_m(k r); T and LP fields have different roots
     * there, so each has waves of its own. */
    int n[HD_DIMENSION_MAX];
    double k[HD_DIMENSION_MAX]; /**< components of the wave vector, 0 or above [1/sigma]; in a
                                   circle |k| and 0 */
    double number;              /**< wave number |k| [1/sigma] */
    /** Modulations of the T fields. Along a reflecting direction they have a sine, so that its mode
     * number is at least 1; for space see [T22]. */
    hd_modulations transverse;
    /** Modulations of the L and P fields. Along a reflecting direction they have a cosine. */
    hd_modulations pairs;
    /** In space: the unit vector e of T fields, whose component along direction d is e_d times a
     * function of the position [T22]; across[0] of fields without and across[1] of those with
     * HD_SECOND. 0 if there is no such field. */
    double across[2][HD_DIMENSION_MAX];
} hd_wave;

/** Component of the wave vector along direction d of a box for mode number n: 2 pi n / L if the
 * direction is periodic, pi n / (L - 1) if it is reflecting, with L its edge [1/sigma]. */
double hd_wave_component(const hd_scene_def *def, int d, int n);

/** Limits of the waves that a scene may ask for. */
typedef struct hd_wave_limits {
    /** Wave number of the longest wave in the box [1/sigma]; larger than `largest` if the box has
     * no wave that particles can show. */
    double smallest;
    double largest; /**< largest wave number that the particles can show, whose wave is two mean
                       distances long: pi sqrt(density) in the plane, pi cbrt(density) in space
                       [1/sigma] */
    int node; /**< largest mode number along any direction among waves up to `largest`; 0 if there
                 is none */
} hd_wave_limits;

/** Writes the waves that a checked scene asks for to out[capacity], in ascending wave number, and
 * returns their number. If there are more than capacity, only some of them are written, in any
 * order; with capacity 0, `out` may be NULL and the call only counts. */
int hd_waves(const hd_scene_def *def, hd_wave *out, int capacity);

HD_API_END
#endif
