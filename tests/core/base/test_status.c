/** Status texts, and contracts that do not compile away. */
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#include "base/check.h"
#include "testing.h"

static const hd_status ALL[] = {
#define NAME(name, text) name,
    HD_STATUS_LIST(NAME)
#undef NAME
};
enum { STATUSES = sizeof ALL / sizeof *ALL };

TEST(every_status_has_its_own_text)
{
    for (int k = 0; k < STATUSES; k++) {
        const char *text = hd_status_text(ALL[k]);
        assert_true(text != NULL && strlen(text) > 1 && !strchr(text, '\n'));
        for (int other = 0; other < k; other++)
            assert_string_not_equal(text, hd_status_text(ALL[other]));
    }
    assert_string_equal(hd_status_text(HD_OK), "ok");
    assert_int_equal(HD_OK, 0);
}

TEST(unknown_status_has_a_text)
{
    assert_string_equal(hd_status_text((hd_status)STATUSES), "unknown status");
    assert_string_equal(hd_status_text((hd_status)12345), "unknown status");
}

TEST(a_refusal_is_one_line)
{
    char message[64];
    assert_int_equal(hd_refuse(message, sizeof message, "target = %s: no", "a\nb\x1b[2J\x7f"),
                     HD_REFUSED);
    assert_string_equal(message, "target = a?b?[2J?: no");
}

static hd_status pass_on(hd_status status, int *went_on)
{
    HD_TRY(status);
    *went_on = 1;
    return HD_OK;
}

TEST(try_returns_what_failed)
{
    for (int k = 0; k < STATUSES; k++) {
        int went_on = 0;
        assert_int_equal(pass_on(ALL[k], &went_on), ALL[k]);
        assert_int_equal(went_on, ALL[k] == HD_OK);
    }
}

static jmp_buf caught;
static const char *seen_condition, *seen_file;
static int seen_line;

static void remember(const char *condition, const char *file, int line)
{
    seen_condition = condition;
    seen_file = file;
    seen_line = line;
    longjmp(caught, 1);
}

TEST(handler_is_told_condition_and_place)
{
    const int line = __LINE__ + 4;
    hd_assert_handler_replace(remember);
    if (setjmp(caught) == 0) {
        HD_ASSERT(1 + 1 == 2);
        HD_ASSERT(1 + 1 == 3);
        fail_msg("a broken contract went on");
    }
    hd_assert_handler_replace(NULL);
    assert_string_equal(seen_condition, "1 + 1 == 3");
    assert_non_null(strstr(seen_file, "test_status.c"));
    assert_int_equal(seen_line, line);
}

static void returns(const char *condition, const char *file, int line)
{
    (void)condition;
    (void)file;
    (void)line;
}

static void break_contract(hd_assert_handler handler)
{
    if (!freopen("/dev/null", "w", stderr)) _exit(2);
    signal(SIGABRT, SIG_DFL);
    hd_assert_handler_replace(handler);
    HD_ASSERT(0);
    _exit(0);
}

/** With the default handler, and with one that returns in spite of what it promised. */
TEST(broken_contract_never_goes_on)
{
    const hd_assert_handler handlers[] = {NULL, returns};
    for (int k = 0; k < 2; k++) {
        const pid_t child = fork();
        int status = 0;
        assert_true(child >= 0);
        if (child == 0) break_contract(handlers[k]);
        assert_true(waitpid(child, &status, 0) == child);
        assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
    }
}
