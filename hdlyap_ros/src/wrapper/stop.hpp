/** Stopping by signal; private to the wrapper. */
#pragma once

/** SIGINT and SIGTERM become hdr_stop_request; stop_seconds after it the process is ended with status
 *  0. Throws std::system_error. */
void stop_handlers_install(double stop_seconds);
