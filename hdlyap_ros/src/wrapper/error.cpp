/** The text of the last fault, one per thread. */
#include <cstdio>

#include "guard.hpp"

namespace
{
thread_local char error_text[512] = "";
}

void hdr_error_keep(const char *text) noexcept
{
    std::snprintf(error_text, sizeof error_text, "%s", text);
}

const char *hdr_error_text(void) { return error_text; }
