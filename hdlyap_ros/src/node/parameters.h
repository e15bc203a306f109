/** The table of the node's parameters, one row each: those of the scene, from the core; those of
 * the particles that move (particles_are); and those that only the node knows. */
#ifndef HDLYAP_PARAMETERS_NODE_H
#define HDLYAP_PARAMETERS_NODE_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/parameters.h"

/** How a value is read and written: the type of its member in hd_scene_def or settings. */
typedef enum parameter_kind {
    OF_SCENE,        /**< a parameter of the scene: as the core's row says */
    PARTICLES,       /**< hd_scene_def: the name of a row of dynamics */
    REAL_NUMBER,     /**< double */
    WHOLE_NUMBER,    /**< int; what is allowed depends on the scene */
    NAME,            /**< const char *: a line that is not empty */
    FILE_PATH,       /**< const char *: a line, "" for none */
    TOPICS_OBSERVED, /**< unsigned: a set of topics */
    TOPICS_AWAITED,  /**< unsigned: a set of topics, or all */
    FIELD_CHOICE,    /**< field_choice */
    CHOICE,          /**< const char *: one of two words */
    CHANGES          /**< change_list */
} parameter_kind;

typedef struct parameter {
    const char *name;
    parameter_kind kind;
    size_t offset;             /**< in settings */
    const char *default_value; /**< default, as a number, a word, or the items of a list */
    double min, max;           /**< range of a number; there is no range if both are equal */
    const char *range;         /**< what is allowed, in words; for topics without their names */
    const char *unit;          /**< "" if it has none */
    bool may_differ; /**< true if it may change when a run is resumed from its checkpoint */
    bool live;       /**< true if it may change while the run goes on */
    bool at_once; /**< true if a change holds from the next step on, because it makes no difference
                     to results */
    unsigned needs; /**< topics of which at least one must be observed if the value is not the
                       default; 0: none */
    const char *text;
    const hd_parameter *row; /**< the core's row; NULL if it is no parameter of the scene */
} parameter;

/** Parameters come in the order in which they are read. */
int parameters_count(void);
parameter parameters_at(int k);

/** True if there is one of this name. */
bool parameters_has(const char *name);

/** Room for parameters_unknown. */
enum { PARAMETER_UNKNOWN = 128 };
/** Writes what the user is told about a name that no parameter has: that it has a new name, or
 * which name may be meant, if at most two letters differ. */
void parameters_unknown(char text[PARAMETER_UNKNOWN], const char *name);

/** The parameter of this name, which must exist. */
parameter parameters_named(const char *name);

/** Room for parameter_usual. */
enum { PARAMETER_TEXT = 80 };
/** Writes the default as a text for a message. */
void parameter_usual(char text[PARAMETER_TEXT], const parameter *p);

/** The topics that are allowed in a set of topics. */
unsigned parameter_topics(const parameter *p);

/** Room for parameter_allowed. */
enum { PARAMETER_ALLOWED = 180 };
/** Writes which values are allowed, with the names of topics or particles. */
void parameter_allowed(char text[PARAMETER_ALLOWED], const parameter *p);

#endif
