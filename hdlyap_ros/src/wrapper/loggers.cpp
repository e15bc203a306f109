/** ~get_loggers in place of roscpp's: that one makes rosconsole delete the repository of all
 * loggers with a log4cxx such as Debian 12's, and its second call kills the process. */
#include "node.hpp"

#if __has_include(<log4cxx/logmanager.h>)
#include <log4cxx/logger.h>
#include <log4cxx/logmanager.h>
#include <ros/service_manager.h>
#include <roscpp/GetLoggers.h>

namespace
{
/** The name of a level as roscpp writes it; also of one between its five. */
const char *level_name(const log4cxx::LevelPtr &level)
{
    static const struct {
        int least;
        const char *name;
    } names[] = {{log4cxx::Level::FATAL_INT, "fatal"},
                 {log4cxx::Level::ERROR_INT, "error"},
                 {log4cxx::Level::WARN_INT, "warn"},
                 {log4cxx::Level::INFO_INT, "info"}};
    for (const auto &row : names)
        if (level->toInt() >= row.least) return row.name;
    return "debug";
}

bool on_get_loggers(roscpp::GetLoggers::Request &, roscpp::GetLoggers::Response &out)
{
    for (const log4cxx::LoggerPtr &logger : log4cxx::LogManager::getCurrentLoggers()) {
        roscpp::Logger one;
        one.name = logger->getName();
        one.level = level_name(logger->getEffectiveLevel());
        out.loggers.push_back(one);
    }
    return true;
}
} // namespace

void loggers_advertise(hdr_node *node)
{
    const std::string name = ros::names::resolve("~get_loggers");
    ros::ServiceManager::instance()->unadvertiseService(name);
    node->services.push_back(
        master_registered([&] { return node->handle.advertiseService(name, on_get_loggers); }));
}
#else /* rosconsole has another library for its log */
void loggers_advertise(hdr_node *) {}
#endif
