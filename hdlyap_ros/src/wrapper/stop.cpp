/** Signals -> a flag that the node polls, and a timer that ends a process which does not. */
#include "stop.hpp"

#include <atomic>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <ctime>
#include <system_error>

#include <unistd.h>

#include "hdlyap_ros/node.h"

namespace
{
/** Signal handlers have no argument: what they use has to be static, and lock-free. */
std::atomic<bool> requested{false};
timer_t watchdog;
itimerspec watchdog_time{};

void on_stop(int) { hdr_stop_request(); }
void on_watchdog(int) { _exit(0); }

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
    hdr_node_stop_within(stop_seconds);
    handle(SIGALRM, on_watchdog);
    handle(SIGINT, on_stop);
    handle(SIGTERM, on_stop);
}

void hdr_node_stop_within(double stop_seconds)
{
    watchdog_time.it_value.tv_sec = static_cast<time_t>(stop_seconds);
    watchdog_time.it_value.tv_nsec = static_cast<long>(1e9 * std::fmod(stop_seconds, 1.0));
}

bool hdr_stop_requested(void) { return requested.load(); }

/** A second request must not wind the timer up again. */
void hdr_stop_request(void)
{
    if (!requested.exchange(true)) timer_settime(watchdog, 0, &watchdog_time, nullptr);
}
