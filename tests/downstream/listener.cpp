// A node in C++: prints the exponents of one hdlyap/Spectrum and ends.
#include <cstdio>

#include <ros/ros.h>

#include <hdlyap/Spectrum.h>

int main(int argc, char **argv)
{
    ros::init(argc, argv, "listener");
    const auto message = ros::topic::waitForMessage<hdlyap::Spectrum>("spectrum");
    if (!message) return 1;
    for (const double exponent : message->exponents) std::printf("%.3f\n", exponent);
    return 0;
}
