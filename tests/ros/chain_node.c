/** The example of a dynamics of one's own, as a node. */
#include <math.h>
#define main chain_main /* which prints exponents */
#include "../../hdlyap_core/examples/chain.c"
#undef main
#include "../downstream/chain_main.c"
