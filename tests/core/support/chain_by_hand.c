/** The chain by hand for tests that have a chain of their own. */
#include "chain_by_hand.h"

extern const hd_dynamics *const chain_by_hand;
const hd_dynamics *const chain_by_hand = &of_chain;
