/** The text of the last fault, one per thread. */
#include <cerrno>
#include <cstdio>
#include <new>

#include <boost/system/system_error.hpp>

#include "guard.hpp"

namespace
{
thread_local char error_text[512] = "";
}

bool hdr_error_of_memory(const std::exception &error) noexcept
{
    if (dynamic_cast<const std::bad_alloc *>(&error)) return true;
    const auto *system = dynamic_cast<const boost::system::system_error *>(&error); /* threads */
    return system && (system->code().value() == EAGAIN || system->code().value() == ENOMEM);
}

void hdr_error_keep(const char *text) noexcept
{
    std::snprintf(error_text, sizeof error_text, "%s", text);
}

const char *hdr_error_text(void) { return error_text; }
