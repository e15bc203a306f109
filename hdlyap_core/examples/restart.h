/** For programs that use hdlyap: a start with settings that suit the processor. */
#ifndef RESTART_H
#define RESTART_H

/** Call this first in main, with the argv of main. On Linux it starts the program again, once, in
 * two cases: OpenBLAS uses routines for an older processor than this one, or idle threads would
 * keep a processor busy while they wait. The new start has OPENBLAS_CORETYPE, and GOMP_SPINCOUNT or
 * OMP_WAIT_POLICY, set in its environment; a value that the user has set is never changed. In all
 * other cases, and on other systems, it returns and has done nothing. */
void restart_if_slow(char **argv);

#endif
