/** Texts of the statuses and the handler of broken contracts. */
#include "base/check.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

const char *hd_status_text(hd_status status)
{
    switch (status) {
#define HD_STATUS_CASE(name, text)                                                                 \
    case name: return text;
        HD_STATUS_LIST(HD_STATUS_CASE)
#undef HD_STATUS_CASE
    }
    return "unknown status";
}

hd_status hd_refuse(char *message, size_t size, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const bool told = message && size > 0 && vsnprintf(message, size, format, list) >= 0;
    va_end(list);
    for (char *c = message; told && *c; c++) /* what is refused may have anything in it */
        if ((unsigned char)*c < ' ' || *c == 127) *c = '?';
    return HD_REFUSED;
}

static void print_and_abort(const char *condition, const char *file, int line)
{
    fprintf(stderr, "hdlyap: %s:%d: contract broken: %s\n", file, line, condition);
    abort();
}

static hd_assert_handler assert_handler = print_and_abort;

void hd_assert_handler_replace(hd_assert_handler handler)
{
    assert_handler = handler ? handler : print_and_abort;
}

void hd_assert_fail(const char *condition, const char *file, int line)
{
    assert_handler(condition, file, line);
    abort(); /* the caller must not go on even if the handler returns */
}
