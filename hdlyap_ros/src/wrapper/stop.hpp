/** How the process ends; private to the wrapper. */
#pragma once

/** SIGINT and SIGTERM, and SIGHUP unless it is ignored, become hdr_stop_request; stop_seconds after
 * it the process is ended with status 0. Throws std::system_error. */
void stop_handlers_install(double stop_seconds);

/** Where a thread of roscpp finds no memory, the process ends with this status instead of a crash.
 */
void stop_without_memory(int status) noexcept;
