#include "master.hpp"

#include <ros/network.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

void master_address_check(int argc, const char *const *argv)
{
    static const std::string option = "__master:=";
    setenv("ROS_MASTER_URI", "http://localhost:11311", 0); // rospy's; not every roscpp has one
    std::string address = std::getenv("ROS_MASTER_URI"), host, name = "ROS_MASTER_URI";
    uint32_t port = 0;
    for (int k = 1; k < argc; k++) {
        const std::string argument = argv[k];
        if (argument.compare(0, option.size(), option) != 0) continue;
        address = argument.substr(option.size());
        name = "__master";
    }
    const bool http = address.compare(0, 7, "http://") == 0;
    if (!http || !ros::network::splitURI(address, host, port) || host.empty() || port < 1 ||
        port > 65535)
        throw std::invalid_argument(name + " = '" + address + "': must be http://HOST:PORT");
}
