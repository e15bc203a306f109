#include "testing.h"

enum { TESTS_MAX = 64 };
static struct CMUnitTest tests[TESTS_MAX];
static size_t count;

void tests_add(const char *name, CMUnitTestFunction test)
{
    if (count < TESTS_MAX) tests[count] = (struct CMUnitTest){.name = name, .test_func = test};
    count++;
}

int tests_run(const char *filter)
{
    if (count == 0 || count > TESTS_MAX) return 1;
    if (filter) cmocka_set_test_filter(filter);
    return _cmocka_run_group_tests("tests", tests, count, NULL, NULL);
}
