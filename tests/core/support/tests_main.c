/** main of the programs that have none of their own. Usage: test_NAME [TEST], which may have '*'.
 */
#include "testing.h"

int main(int argc, char **argv) { return tests_run(argc > 1 ? argv[1] : NULL); }
