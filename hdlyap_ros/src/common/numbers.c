/** Numbers as a physicist prints them. */
#include "common/numbers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PLACES_MAX = 9 }; /* with more, only the size of a number can be read */

void number_with_error(char *text, size_t size, double value, double error)
{
    char rounded[32];
    if (!(error > 0.0 && isfinite(error))) {
        snprintf(text, size, "%.4f", value);
        return;
    }
    snprintf(rounded, sizeof rounded, "%.1e", error); /* 0.00996 is rounded to 0.010 */
    const int places = 1 - (int)floor(log10(strtod(rounded, NULL)));
    if (places > PLACES_MAX)
        snprintf(text, size, "%.1e", value);
    else if (places <= 0)
        snprintf(text, size, "%.0f(%.0f)", value, strtod(rounded, NULL));
    else if (error >= 1.0)
        snprintf(text, size, "%.*f(%.*f)", places, value, places, error);
    else
        snprintf(text, size, "%.*f(%.0f)", places, value, error * pow(10.0, places));
}

void number_of_fit(char *text, size_t size, double value, double error, double misfit)
{
    number_with_error(text, size, value, error);
    const size_t end = strlen(text);
    if (misfit >= 0.0) snprintf(text + end, size - end, ", misfit %.1f", misfit);
}

void number_text(char *text, size_t size, double value)
{
    enum { FEW = 6, ENOUGH = 17 };
    for (int digits = FEW; digits <= ENOUGH; digits++) {
        snprintf(text, size, "%.*g", digits, value);
        if (strtod(text, NULL) == value) return;
    }
}
