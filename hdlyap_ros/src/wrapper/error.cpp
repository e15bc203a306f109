/** The text of each thread's last fault. */
#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

#include <boost/system/system_error.hpp>

#include "guard.hpp"

namespace
{
thread_local char error_text[512] = "";
}

bool hdr_error_of_memory(const std::exception &error) noexcept
{
    if (dynamic_cast<const std::bad_alloc *>(&error)) return true;
    int code = 0; /* what creating a thread fails with */
    if (const auto *boosts = dynamic_cast<const boost::system::system_error *>(&error))
        code = boosts->code().value();
    if (const auto *ours = dynamic_cast<const std::system_error *>(&error))
        code = ours->code().value();
    return code == EAGAIN || code == ENOMEM;
}

void hdr_error_keep(const char *text) noexcept
{
    std::snprintf(error_text, sizeof error_text, "%s", text);
}

const char *hdr_error_text(void) { return error_text; }
