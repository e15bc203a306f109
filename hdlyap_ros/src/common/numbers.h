/** Numbers as a physicist prints them. */
#ifndef HDLYAP_NUMBERS_H
#define HDLYAP_NUMBERS_H

#include <stddef.h>

/** Writes 0.61252(67): two digits of the error, in units of the last digits, as the tables of
 * hdlyap plot do; or the value alone, with four decimals, if its error is not known (not above 0).
 */
void number_with_error(char *text, size_t size, double value, double error);
/** Writes the result of a fit, as 3.49(11), misfit 6.5; without the misfit if that is negative,
 * which means not known. */
void number_of_fit(char *text, size_t size, double value, double error, double misfit);

/** Writes a number in as few digits as distinguish it from every other number. */
void number_text(char *text, size_t size, double value);

#endif
