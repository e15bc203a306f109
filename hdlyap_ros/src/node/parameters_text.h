/** Rows -> a complete scene file, and the table of the reference. */
#ifndef HDLYAP_PARAMETERS_TEXT_H
#define HDLYAP_PARAMETERS_TEXT_H

/** To standard output, as the next ones: how it is called. 0, or 1 if it cannot be written. */
int parameters_print_help(void);
int parameters_print_version(void);
/** To standard output, with the defaults. 0, or 1 if it cannot be written. */
int parameters_print_scene(void);
/** The same as rows of a Markdown table. */
int parameters_print_table(void);

#endif
