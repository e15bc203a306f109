/** How many there are in a scene of what messages list: what their sizes follow from. */
#ifndef HDLYAP_EXTENT_H
#define HDLYAP_EXTENT_H

#include "hdlyap/run.h"
#include "node/settings.h"
#include "topics/topic.h"

typedef struct extent {
    double disks, vectors;
    double waves;             /**< of structure */
    double subspaces, angles; /**< of covariant: fields of each wave vector, pairs of spaces */
    double steps;             /**< in both halves of the spectrum */
    double fields, pairs;     /**< published at one time at most, and their LP pairs in all */
    double phases, t_phases;  /**< followed */
    double responses;         /**< of hydro */
} extent;

/** Of a scene, whose run it is; or of which it is a smaller one, with the same waves. */
extent extent_of(const settings *set, const hd_run *run);

/** Bytes of a topic's messages, without texts. */
typedef struct topic_size {
    double report;   /**< that come with every report */
    double fields;   /**< and with fields, when these are due */
    double window;   /**< and with each window of covariant vectors */
    double messages; /**< that come at one time; 0 stands for 1 */
} topic_size;

/** By its row. */
topic_size topic_size_of(topic t, const extent *e);

#endif
