/** The parameters of a scene as a table: name, kind, range, default, unit and text of each. A
 * program can go through it to read, check and write parameters by name. Its rows are made from
 * parameters.inc. */
#ifndef HDLYAP_PARAMETERS_H
#define HDLYAP_PARAMETERS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"

HD_API_BEGIN

/** What the member of hd_scene_def for a parameter holds, and how a user writes it. */
typedef enum hd_parameter_kind {
    HD_PARAMETER_INT,       /**< an int, written as a number */
    HD_PARAMETER_REAL,      /**< a double, written as a number */
    HD_PARAMETER_WORD,      /**< an enumeration or an int, written as one of the row's words */
    HD_PARAMETER_SEED,      /**< a uint64_t, written as a string of digits */
    HD_PARAMETER_EXPONENTS, /**< an int, written as a number or a word; its largest value depends on
                               the particles */
    HD_PARAMETER_INTERVAL,  /**< a double, written as a number or a word */
    HD_PARAMETER_TEXT,      /**< an hd_text, written as a string */
    HD_PARAMETER_SET /**< an unsigned set of bits (HD_OBSERVE_*), written as a list of names */
} hd_parameter_kind;

/** When a parameter may change: never; when a run is resumed; also while a run goes on. */
enum { HD_AS_BEFORE = 0, HD_MAY_DIFFER = 1, HD_LIVE = 2 };

/** A word that a user can write for a value. */
typedef struct hd_parameter_word {
    const char *word;
    int value;
} hd_parameter_word;

/** One parameter. All texts last as long as the process or the user's row. */
typedef struct hd_parameter {
    /** Name, as users write it. */
    const char *name;
    hd_parameter_kind kind;
    /** Its words, behind the last of which stands an entry with word = NULL; NULL if it has no
     * words. */
    const hd_parameter_word *words;
    size_t offset;        /**< offset in bytes of its member in hd_scene_def */
    double default_value; /**< default value; 0 for a text */
    /** Smallest and largest value that is allowed; words may stand for values outside. */
    double min, max;
    const char *range; /**< the allowed values in words, for messages */
    const char *unit;  /**< unit, as time units; "" if it has none */
    bool may_differ;   /**< true if a resumed run may have another value than its checkpoint */
    bool live;         /**< true if it may change while the run goes on (hd_run_change) */
    /** Observables (a set of HD_OBSERVE_*) of which the scene must ask for at least one if the
     * value is not the default; 0 if the value needs none. */
    unsigned needs;
    const char *text;   /**< what the parameter means, for users */
    const char *record; /**< name of its array in a checkpoint; NULL means that it is `name` */
    /** Returns the value if it is not automatic, otherwise the number that it stands for in this
     * scene. NULL if the parameter has no automatic value, or none that is known without a run. */
    double (*resolve)(const hd_scene_def *def);
    /** True if the value means nothing in this scene, and results are not told of it: how large
     * particles of the second kind are where there are none. NULL: never. */
    bool (*idle)(const hd_scene_def *def);
} hd_parameter;

/** Returns the parameters that every scene has, and writes their number to *count. Parameters that
 * only one dynamics has are in hd_dynamics.parameter. */
const hd_parameter *hd_scene_parameters(int *count);

/** True if the parameter says something about a box, which not all particles have. */
bool hd_parameter_is_of_box(const hd_parameter *row);

/** Value of a parameter in a scene as a number. A seed above 2^53 is rounded; a text gives 0 if it
 * is empty, otherwise 1. */
double hd_parameter_value(const hd_parameter *row, const hd_scene_def *def);
/** As hd_parameter_value, but for an automatic value the number that it stands for, if the row has
 * hd_parameter.resolve. */
double hd_parameter_effect(const hd_parameter *row, const hd_scene_def *def);
/** Sets a parameter of *def to a number, which must be one that its kind can hold. A text becomes
 * empty, whatever the number. */
void hd_parameter_assign(const hd_parameter *row, hd_scene_def *def, double value);
/** Sets a parameter of kind HD_PARAMETER_REAL or HD_PARAMETER_TEXT from what a user wrote. Returns
 * false, and changes nothing, if the parameter is of another kind, the text is not a number from
 * end to end, or it is too long for an hd_text. Ranges are not checked: see hd_scene_check. */
bool hd_parameter_read(const hd_parameter *row, hd_scene_def *def, const char *text);

/** The word that stands for a value; NULL if there is none. */
const char *hd_parameter_word_of(const hd_parameter *row, int value);
/** True if a word stands for this value, so that users write it instead of the number. */
bool hd_parameter_is_word(const hd_parameter *row, double value);
/** Writes the value for which a word stands to *value. Returns false, and writes nothing, if the
 * row has no such word. */
bool hd_parameter_value_of(int *value, const hd_parameter *row, const char *word);

HD_API_END
#endif
