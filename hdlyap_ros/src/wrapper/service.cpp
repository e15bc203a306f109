/** Offers services: roscpp's requests -> C callbacks. */
#include "hdlyap_ros/service.h"

#include <functional>

#include <hdlyap/Set.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "guard.hpp"
#include "node.hpp"

namespace
{
/** answer(request, message, size) returns success. */
template <class Service, class Answer>
hdr_status advertise(hdr_node *node, const char *name, const Answer &answer)
{
    using request = typename Service::Request;
    using response = typename Service::Response;
    const boost::function<bool(request &, response &)> serve = [answer](request &in,
                                                                        response &out) {
        char message[256] = "";
        out.success = answer(in, message, sizeof message);
        out.message = message;
        return true;
    };
    return hdr_guard([&] {
        const std::string full = ros::names::resolve(name);
        node->services.push_back(
            master_registered([&] { return node->handle.advertiseService(full, serve); }));
        node->watch->service_is(full);
    });
}
} // namespace

hdr_status hdr_service_set_bool(hdr_node *node, const char *name, hdr_set_bool_callback callback,
                                void *context)
{
    return advertise<std_srvs::SetBool>(
        node, name, [=](const std_srvs::SetBool::Request &in, char *message, size_t size) {
            return callback(context, in.data, message, size);
        });
}

hdr_status hdr_service_trigger(hdr_node *node, const char *name, hdr_trigger_callback callback,
                               void *context)
{
    return advertise<std_srvs::Trigger>(
        node, name, [=](const std_srvs::Trigger::Request &, char *message, size_t size) {
            return callback(context, message, size);
        });
}

hdr_status hdr_service_set(hdr_node *node, const char *name, hdr_set_callback callback,
                           void *context)
{
    return advertise<hdlyap::Set>(
        node, name, [=](const hdlyap::Set::Request &in, char *message, size_t size) {
            return callback(context, in.assignment.c_str(), message, size);
        });
}
