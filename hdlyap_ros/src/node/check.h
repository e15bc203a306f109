/** hdlyap_node --check: what a run of a scene file will cost, without a master and without that
 * run. */
#ifndef HDLYAP_CHECK_H
#define HDLYAP_CHECK_H

/** Prints the estimates to standard output. arguments[count]: the scene file, then name:=value. If
 * the scene is refused, prints the node's line to standard error. Returns the node's exit status.
 */
int check_scene(int count, char *const *arguments);

/** Prints the averaged time from which errors are stated; arguments and exit status as check_scene.
 */
int check_errors(int count, char *const *arguments);

/** Tests whether the functions of the row of the scene's particles do what they say
 * (hd_dynamics_test): prints ok, or the line to standard error; likewise. */
int check_dynamics(int count, char *const *arguments);

#endif
