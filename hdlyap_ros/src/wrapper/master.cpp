#include "node.hpp"

#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <string>

void master_address_check(int argc, const char *const *argv)
{
    static const std::string option = "__master:=";
    setenv("ROS_MASTER_URI", "http://localhost:11311", 0); // rospy's; not every roscpp has one
    std::string address = std::getenv("ROS_MASTER_URI"), name = "ROS_MASTER_URI";
    std::smatch found;
    for (int k = 1; k < argc; k++) {
        const std::string argument = argv[k];
        if (argument.compare(0, option.size(), option) != 0) continue;
        address = argument.substr(option.size());
        name = "__master";
    }
    /* roscpp itself reads as many digits as there are, and skips a path, which rospy does not */
    const std::regex form("http://[^/:@\\s]+:([0-9]{1,5})/?");
    const bool formed = std::regex_match(address, found, form);
    const int port = formed ? std::stoi(found[1]) : 0;
    if (port < 1 || port > 65535)
        throw std::invalid_argument(name + " = '" + address + "': must be http://HOST:PORT");
}
