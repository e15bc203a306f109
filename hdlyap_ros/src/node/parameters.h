/** Every parameter of the node, one row each: those of the scene, which the core names, those of
 * the particles that move (particles_now), and those that only the node knows. */
#ifndef HDLYAP_PARAMETERS_NODE_H
#define HDLYAP_PARAMETERS_NODE_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/parameters.h"

/** How a value is said and read. */
typedef enum parameter_kind {
    OF_SCENE,        /**< as the scene's row says */
    PARTICLES,       /**< of the scene, too: by the name of their row */
    REAL_NUMBER,     /**< double */
    WHOLE_NUMBER,    /**< int; what is allowed depends on the scene */
    NAME,            /**< const char *: a line that is not empty */
    FILE_PATH,       /**< const char *: a line, "" for none */
    TOPICS_OBSERVED, /**< unsigned: a set of topics */
    TOPICS_AWAITED,  /**< the same, or all */
    FIELD_CHOICE,    /**< field_choice */
    CHANGES          /**< change_list */
} parameter_kind;

typedef struct parameter {
    const char *name;
    parameter_kind kind;
    size_t offset;       /**< in settings */
    const char *usual;   /**< default: the number, the word, or the items of the list */
    double least, most;  /**< of a number */
    const char *allowed; /**< in words; of topics it ends where their names begin */
    const char *unit;    /**< "" if it has none */
    bool may_differ;     /**< of a run that goes on from its checkpoint */
    bool live;           /**< may change while the run goes on */
    bool at_once;   /**< and does so before the next step, as it makes no difference to results */
    unsigned needs; /**< topics of which one must be observed for another value; 0: none */
    const char *text;
    const hd_parameter *row; /**< NULL unless it is the scene's */
} parameter;

/** In the order in which they are read. */
int parameters_count(void);
parameter parameters_at(int k);

/** True if there is one of this name. */
bool parameters_has(const char *name);

/** Room for parameters_unknown. */
enum { PARAMETER_UNKNOWN = 128 };
/** What to say of a name that is none; with the one that may be meant, a slip or two of the keys
 * away. */
void parameters_unknown(char text[PARAMETER_UNKNOWN], const char *name);

/** The row of a name, which there must be. */
parameter parameters_named(const char *name);

/** Room for parameter_usual. */
enum { PARAMETER_TEXT = 80 };
/** The default as it is said in a message. */
void parameter_usual(char text[PARAMETER_TEXT], const parameter *p);

/** Topics that a set of them may have. */
unsigned parameter_topics(const parameter *p);

/** Room for parameter_allowed. */
enum { PARAMETER_ALLOWED = 180 };
/** What is allowed, whole. */
void parameter_allowed(char text[PARAMETER_ALLOWED], const parameter *p);

#endif
