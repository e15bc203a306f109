/** The parameters of a scene: name, kind, range, default, unit and text of each. Their rows are in
 * parameters.inc. */
#ifndef HDLYAP_PARAMETERS_H
#define HDLYAP_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"

HD_API_BEGIN

/** Type of a parameter in hd_scene_def, and how a user writes it. */
typedef enum hd_parameter_kind {
    HD_PARAMETER_INT,
    HD_PARAMETER_REAL,
    HD_PARAMETER_WORD,      /**< an enumeration, written as a word */
    HD_PARAMETER_SEED,      /**< a uint64_t, written in digits */
    HD_PARAMETER_EXPONENTS, /**< an int or a word; the range depends on the particles */
    HD_PARAMETER_INTERVAL,  /**< a double or a word */
    HD_PARAMETER_TEXT,      /**< an hd_text */
    HD_PARAMETER_SET        /**< a set of bits, which the user gives in another way */
} hd_parameter_kind;

/** When a parameter may change: never; when a run is resumed; also while it runs. */
enum { HD_AS_BEFORE = 0, HD_MAY_DIFFER = 1, HD_LIVE = 2 };

/** The word for a value. */
typedef struct hd_parameter_word {
    const char *word;
    int value;
} hd_parameter_word;

typedef struct hd_parameter {
    const char *name;
    hd_parameter_kind kind;
    const hd_parameter_word *words; /**< its words, then an entry with NULL; NULL if it has none */
    size_t offset;                  /**< offset of the value in hd_scene_def */
    double usual;                   /**< default */
    double least, most;
    const char *allowed; /**< what is allowed, in words */
    const char *unit;    /**< unit; "" if there is none */
    bool may_differ;     /**< a resumed run may have another value than the checkpoint */
    bool live;           /**< may change while the run goes on, see hd_run_change */
    unsigned needs; /**< HD_OBSERVE_* of which a value other than the default needs one; 0: none */
    const char *text;   /**< what the parameter means */
    const char *record; /**< name in a checkpoint; NULL: the same name */
    /** Gives the value that an automatic one stands for in a scene; NULL: there is no automatic
     * one. */
    double (*chosen)(const hd_scene_def *def);
} hd_parameter;

/** All parameters that every scene has, [count]. */
const hd_parameter *hd_scene_parameters(int *count);

/** Value of a parameter in a scene. A seed may be rounded; a text gives 0 if it is empty, else 1.
 */
double hd_parameter_value(const hd_parameter *row, const hd_scene_def *def);
/** Value of a parameter in a scene, or the value that was chosen for an automatic one. */
double hd_parameter_effect(const hd_parameter *row, const hd_scene_def *def);
/** Sets a parameter to a value that its kind can hold; a text becomes empty. */
void hd_parameter_assign(const hd_parameter *row, hd_scene_def *def, double value);
/** Sets a live parameter from a text: a number, or a text. Returns false if the text is not a
 * number from end to end, or too long. */
bool hd_parameter_read(const hd_parameter *row, hd_scene_def *def, const char *text);

/** The word for a value; NULL if there is none. */
const char *hd_parameter_word_of(const hd_parameter *row, int value);
/** True if users write this value as a word instead of a number. */
bool hd_parameter_is_word(const hd_parameter *row, double value);
/** Writes the value of a word; returns false if there is no such word. */
bool hd_parameter_value_of(int *value, const hd_parameter *row, const char *word);

HD_API_END
#endif
