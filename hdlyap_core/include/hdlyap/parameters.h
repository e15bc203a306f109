/** What a scene is asked for with: each parameter's name, kind, range, default, unit and text. The
 * rows themselves stand in parameters.inc. */
#ifndef HDLYAP_PARAMETERS_H
#define HDLYAP_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"

HD_API_BEGIN

/** What is stored in hd_scene_def, and how a user says it. */
typedef enum hd_parameter_kind {
    HD_PARAMETER_INT,
    HD_PARAMETER_REAL,
    HD_PARAMETER_WORD,      /**< an enumeration, by words */
    HD_PARAMETER_SEED,      /**< a uint64_t, by its digits */
    HD_PARAMETER_EXPONENTS, /**< an int or a word; what is allowed depends on the disks */
    HD_PARAMETER_INTERVAL,  /**< a double or a word */
    HD_PARAMETER_TEXT,      /**< an hd_text */
    HD_PARAMETER_SET        /**< a set of bits; the user says it in another way */
} hd_parameter_kind;

/** Whether a resumed run may have another value than its checkpoint; the last: and a running one
 * another value than at its start. */
enum { HD_AS_BEFORE = 0, HD_MAY_DIFFER = 1, HD_LIVE = 2 };

/** A value that has a name. */
typedef struct hd_parameter_word {
    const char *word;
    int value;
} hd_parameter_word;

typedef struct hd_parameter {
    const char *name;
    hd_parameter_kind kind;
    const hd_parameter_word *words; /**< up to one without a word; NULL if there are none */
    size_t offset;                  /**< of the value in hd_scene_def */
    double usual;                   /**< default */
    double least, most;
    const char *allowed; /**< in words */
    const char *unit;    /**< "" if it has none */
    bool may_differ;     /**< of a resumed run from its checkpoint */
    bool live;           /**< may change while it runs, see hd_run_change */
    unsigned needs; /**< HD_OBSERVE_* of which one must be there for another value than usual */
    const char *text;
    const char *record; /**< name in a checkpoint; NULL: the same */
    /** What stands for it in a scene; NULL: its value. */
    double (*chosen)(const hd_scene_def *def);
} hd_parameter;

/** All of them, [count]. */
const hd_parameter *hd_scene_parameters(int *count);

/** Value in a scene; of a seed it may be rounded, of a text it is 0 if that is empty, else 1. */
double hd_parameter_value(const hd_parameter *row, const hd_scene_def *def);
/** The same, or what is chosen for it. */
double hd_parameter_effect(const hd_parameter *row, const hd_scene_def *def);
/** The row's kind must be able to hold the value; a text becomes empty. */
void hd_parameter_assign(const hd_parameter *row, hd_scene_def *def, double value);
/** The value that a number of this text is, from end to end, or a text; false if it is none, or too
 * long. Of a row that is live. */
bool hd_parameter_read(const hd_parameter *row, hd_scene_def *def, const char *text);

/** The word for a value; NULL if it has none. */
const char *hd_parameter_word_of(const hd_parameter *row, int value);
/** True if a word stands for this value: it is no number then. */
bool hd_parameter_is_word(const hd_parameter *row, double value);
/** False if there is no such word. */
bool hd_parameter_value_of(int *value, const hd_parameter *row, const char *word);

HD_API_END
#endif
