/** Numbers as a physicist prints them. */
#ifndef HDLYAP_NUMBERS_H
#define HDLYAP_NUMBERS_H

#include <stddef.h>

/** 0.61252(67): the error in units of the last digits, two of them, as the tables of hdlyap plot
 * have it; the value alone, with four decimals, while its error is not known (not above 0). */
void number_with_error(char *text, size_t size, double value, double error);
/** Of a fit: 3.49(11), misfit 6.5; without the misfit while that is not known (negative). */
void number_of_fit(char *text, size_t size, double value, double error, double misfit);

/** In as few digits as tell it from every other number. */
void number_text(char *text, size_t size, double value);

#endif
