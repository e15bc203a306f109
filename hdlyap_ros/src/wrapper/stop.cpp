/** Signals -> a flag that the node polls, and a timer that ends the process if the node does not
 * end; exceptions that nobody catches -> an exit status. */

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <system_error>

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "guard.hpp"
#include "node.hpp"
#include "hdlyap_ros/node.h"

namespace
{
/** Signal handlers have no argument, so all that they use has to be static and lock-free. */
std::atomic<bool> requested{false};
timer_t watchdog;
itimerspec watchdog_time{};
int stop_event =
    -1; /**< readable once a stop is requested; nobody reads it, so it wakes all who wait */
int status_without_memory;
int status_late; /**< exit status if the process has not ended in time */

void on_stop(int) { hdr_stop_request(); }
/** Ends the process, but ignores a SIGALRM that somebody else has sent. */
void on_watchdog(int)
{
    if (hdr_stop_requested()) _exit(status_late);
}

bool is_ignored(int signal)
{
    struct sigaction action = {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/** Ends the process with a line in the log. Allocates no memory. */
[[noreturn]] void end_without_memory(const char *what)
{
    char line[256];
    timespec now = {};
    clock_gettime(CLOCK_REALTIME, &now);
    const int length = std::snprintf(line, sizeof line, "[FATAL] [%ld.%09ld]: out of memory: %s\n",
                                     static_cast<long>(now.tv_sec), now.tv_nsec, what);
    const auto written = write(STDERR_FILENO, line, static_cast<size_t>(length));
    static_cast<void>(written); /* if it fails there is no other way to tell */
    _exit(status_without_memory);
}

/** Aborts: an exception that nobody catches is a bug, unless memory is missing. */
void on_terminate()
{
    try {
        if (std::current_exception()) throw;
    } catch (const std::exception &error) {
        if (hdr_error_of_memory(error)) end_without_memory(error.what());
        std::fprintf(stderr, "hdlyap: exception that nothing handles: %s\n", error.what());
    } catch (...) {
    }
    std::abort();
}

timespec timespec_of(double seconds)
{
    timespec time = {};
    time.tv_sec = static_cast<time_t>(seconds);
    time.tv_nsec = static_cast<long>(1e9 * std::fmod(seconds, 1.0));
    return time;
}

void handle(int signal, void (*handler)(int))
{
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    if (sigaction(signal, &action, nullptr))
        throw std::system_error(errno, std::generic_category(), "sigaction");
}
} // namespace

void stop_handlers_install(double stop_seconds)
{
    sigevent event = {};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGALRM;
    if (timer_create(CLOCK_MONOTONIC, &event, &watchdog))
        throw std::system_error(errno, std::generic_category(), "timer_create");
    hdr_node_stop_within(stop_seconds, 0);
    stop_event = eventfd(0, EFD_CLOEXEC);
    if (stop_event < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    handle(SIGALRM, on_watchdog);
    handle(SIGINT, on_stop);
    handle(SIGTERM, on_stop);
    if (!is_ignored(SIGHUP)) handle(SIGHUP, on_stop); /* nohup ignores it */
    handle(SIGXFSZ, SIG_IGN);                         /* write() fails then, which is handled */
}

void stop_without_memory(int status) noexcept
{
    status_without_memory = status;
    std::set_terminate(on_terminate);
}

void hdr_node_stop_within(double stop_seconds, int status)
{
    status_late = status;
    watchdog_time.it_value = timespec_of(stop_seconds);
}

bool hdr_stop_requested(void) { return requested.load(); }

/** A second request does not restart the timer. errno is restored, because a signal handler may
 * call this. */
void hdr_stop_request(void)
{
    const int kept = errno;
    const uint64_t one = 1;
    if (requested.exchange(true)) return;
    timer_settime(watchdog, 0, &watchdog_time, nullptr);
    const auto written = write(stop_event, &one, sizeof one);
    static_cast<void>(written); /* fails before there is a node, which does not matter */
    errno = kept;
}

bool hdr_node_wait(double seconds)
{
    using clock = std::chrono::steady_clock;
    const double longest = 1e6; /* a timespec can hold it */
    const auto began = clock::now();
    double left = seconds;
    while (!hdr_stop_requested() && left > 0.0) {
        pollfd stop = {stop_event, POLLIN, 0};
        const timespec wait = timespec_of(std::min(left, longest));
        ppoll(&stop, 1, &wait, nullptr);
        left = seconds - std::chrono::duration<double>(clock::now() - began).count();
    }
    return !hdr_stop_requested();
}
