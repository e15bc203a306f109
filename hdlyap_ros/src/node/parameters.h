/** Every parameter of the node, one row each: those of the scene, which the core names, those of
 * the particles that move (particles_now), and those that only the node knows. */
#ifndef HDLYAP_PARAMETERS_NODE_H
#define HDLYAP_PARAMETERS_NODE_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/parameters.h"

/** How a value is read and written. */
typedef enum parameter_kind {
    OF_SCENE,        /**< as the core's row says */
    PARTICLES,       /**< hd_scene_def: the name of a row of dynamics */
    REAL_NUMBER,     /**< double */
    WHOLE_NUMBER,    /**< int; what is allowed depends on the scene */
    NAME,            /**< const char *: a line that is not empty */
    FILE_PATH,       /**< const char *: a line, "" for none */
    TOPICS_OBSERVED, /**< unsigned: a set of topics */
    TOPICS_AWAITED,  /**< unsigned: a set of topics, or all */
    FIELD_CHOICE,    /**< field_choice */
    CHANGES          /**< change_list */
} parameter_kind;

typedef struct parameter {
    const char *name;
    parameter_kind kind;
    size_t offset;       /**< in settings */
    const char *usual;   /**< default: the number, the word, or the items of the list */
    double least, most;  /**< range of a number; none if they are equal */
    const char *allowed; /**< what is allowed, in words; for topics without their names */
    const char *unit;    /**< "" if it has none */
    bool may_differ;     /**< may change when a run goes on from its checkpoint */
    bool live;           /**< may change while the run goes on */
    bool at_once;        /**< changes before the next step, as it makes no difference to results */
    unsigned needs; /**< topics, one of which must be observed unless it has its default; 0: none */
    const char *text;
    const hd_parameter *row; /**< the core's row; NULL if it is not the scene's */
} parameter;

/** Parameters come in the order in which they are read. */
int parameters_count(void);
parameter parameters_at(int k);

/** True if there is one of this name. */
bool parameters_has(const char *name);

/** Room for parameters_unknown. */
enum { PARAMETER_UNKNOWN = 128 };
/** Writes what to say of a name that no parameter has: its new name, or the name that may be meant,
 * from which at most two letters differ. */
void parameters_unknown(char text[PARAMETER_UNKNOWN], const char *name);

/** The parameter of this name, which must exist. */
parameter parameters_named(const char *name);

/** Room for parameter_usual. */
enum { PARAMETER_TEXT = 80 };
/** Writes the default for a message. */
void parameter_usual(char text[PARAMETER_TEXT], const parameter *p);

/** The topics that are allowed in a set of topics. */
unsigned parameter_topics(const parameter *p);

/** Room for parameter_allowed. */
enum { PARAMETER_ALLOWED = 180 };
/** Writes all that is allowed, with names of topics or particles. */
void parameter_allowed(char text[PARAMETER_ALLOWED], const parameter *p);

#endif
