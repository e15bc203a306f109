/** hdlyap_node --check: what a scene file will cost, without a master and without a run. */
#ifndef HDLYAP_CHECK_H
#define HDLYAP_CHECK_H

/** arguments[count]: the file, then name:=value. To standard output; a line to standard error if it
 * is refused, as the node would say it. The node's exit status. */
int check_scene(int count, char *const *arguments);

/** Prints the averaged time from which its errors are stated; the same arguments and statuses. */
int check_errors(int count, char *const *arguments);

#endif
