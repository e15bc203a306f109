/** The line that no exception crosses: runs a body and turns what it throws into HDR_FAULT. */
#pragma once

#include <exception>

#include "hdlyap_ros/status.h"

/** Keeps text for hdr_error_text of this thread. */
void hdr_error_keep(const char *text) noexcept;

template <class Body> hdr_status hdr_guard(const Body &body) noexcept
{
    try {
        body();
        return HDR_OK;
    } catch (const std::exception &error) {
        hdr_error_keep(error.what());
    } catch (...) {
        hdr_error_keep("an exception without a text");
    }
    return HDR_FAULT;
}
