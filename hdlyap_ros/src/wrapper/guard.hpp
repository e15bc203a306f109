/** Keeps exceptions away from C: runs a body and turns what it throws into a status. */
#pragma once

#include <exception>

#include "hdlyap_ros/status.h"

/** Whether this was thrown because no memory or no thread is left. */
bool hdr_error_of_memory(const std::exception &error) noexcept;

/** Keeps a text, which hdr_error_text returns to this thread. */
void hdr_error_keep(const char *text) noexcept;

template <class Body> hdr_status hdr_guard(const Body &body) noexcept
{
    try {
        body();
        return HDR_OK;
    } catch (const std::exception &error) {
        hdr_error_keep(error.what());
        if (hdr_error_of_memory(error)) return HDR_NO_MEMORY;
    } catch (...) {
        hdr_error_keep("an exception without a text");
    }
    return HDR_FAULT;
}
