/** Rows -> a complete scene file, and the table of the reference. */
#ifndef HDLYAP_PARAMETERS_TEXT_H
#define HDLYAP_PARAMETERS_TEXT_H

/** Prints to standard output how the program is called. Returns 0, or 1 if it cannot be written. */
int parameters_print_help(void);
int parameters_print_version(void);
/** Prints a scene file with all defaults to standard output. Returns 0, or 1 if it cannot be
 * written. */
int parameters_print_scene(void);
/** Prints all parameters as rows of a Markdown table. Returns 0, or 1 if it cannot be written. */
int parameters_print_table(void);

#endif
