/** Every block that the core asks for: the linker puts it before the core's allocation. */
#ifndef HD_LEDGER_H
#define HD_LEDGER_H

#include <stddef.h>

typedef struct ledger {
    size_t allocations; /**< so far */
    size_t live, peak;  /**< bytes asked for and not given back: now, and at most so far */
} ledger;

ledger ledger_now(void);

/** The peak begins anew, at what is live. */
void ledger_reset_peak(void);

/** Memory is out for so many allocations, after `first` more of them; none for how_many = 0. */
void ledger_refuse(size_t first, size_t how_many);

#endif
