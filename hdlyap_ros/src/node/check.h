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

#endif
