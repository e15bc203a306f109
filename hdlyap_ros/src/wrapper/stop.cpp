/** Signals -> a flag that the node polls, and a timer that ends a process which does not;
 * exceptions that nobody catches -> an exit status. */

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
/** Signal handlers have no argument: what they use has to be static, and lock-free. */
std::atomic<bool> requested{false};
timer_t watchdog;
itimerspec watchdog_time{};
int stop_event =
    -1; /**< can be read from the request on: it is never read, and wakes everybody who waits */
int status_without_memory;
int status_late; /**< of a process that has not ended in time */

void on_stop(int) { hdr_stop_request(); }
/** SIGALRM of somebody else's is none of ours. */
void on_watchdog(int)
{
    if (hdr_stop_requested()) _exit(status_late);
}

bool is_ignored(int signal)
{
    struct sigaction action = {};
    return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/** Allocates nothing. */
[[noreturn]] void end_without_memory(const char *what)
{
    char line[256];
    timespec now = {};
    clock_gettime(CLOCK_REALTIME, &now);
    const int length = std::snprintf(line, sizeof line, "[FATAL] [%ld.%09ld]: out of memory: %s\n",
                                     static_cast<long>(now.tv_sec), now.tv_nsec, what);
    const auto written = write(STDERR_FILENO, line, static_cast<size_t>(length));
    static_cast<void>(written); /* nobody is left to be told */
    _exit(status_without_memory);
}

/** Any other exception that nobody catches is a bug. */
void on_terminate()
{
    try {
        if (std::current_exception()) throw;
    } catch (const std::exception &error) {
        if (hdr_error_of_memory(error)) end_without_memory(error.what());
        std::fprintf(stderr, "hdlyap: lost exception: %s\n", error.what());
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
    handle(SIGXFSZ, SIG_IGN);                         /* writing says so too */
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

/** A second request must not wind the timer up again. What a signal interrupts keeps its errno. */
void hdr_stop_request(void)
{
    const int kept = errno;
    const uint64_t one = 1;
    if (requested.exchange(true)) return;
    timer_settime(watchdog, 0, &watchdog_time, nullptr);
    const auto written = write(stop_event, &one, sizeof one);
    static_cast<void>(written); /* -1 before there is a node */
    errno = kept;
}

bool hdr_node_wait(double seconds)
{
    using clock = std::chrono::steady_clock;
    const double longest = 1e6; /* that a timespec surely holds */
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
