/** Parameters that are set while the node runs: the master tells roscpp of them, which is looked at
 * now and then. */
#include <map>
#include <memory>

#include <ros/ros.h>

#include "guard.hpp"
#include "hdlyap_ros/params.h"
#include "node.hpp"

namespace
{
const double look_seconds = 0.5;

using texts = std::map<std::string, std::string>;

texts texts_of(const hdr_params *params)
{
    texts known;
    for (int k = 0; k < hdr_params_count(params); k++) {
        const char *name = hdr_params_name(params, k);
        known[name] = hdr_param_text(params, name);
    }
    return known;
}

/** The first look tells the master that this node wants to know. */
void look(const std::string &name, texts &known, hdr_param_callback changed, void *context)
{
    XmlRpc::XmlRpcValue all;
    if (hdr_stop_requested() || !ros::param::getCached(name, all) ||
        all.getType() != XmlRpc::XmlRpcValue::TypeStruct)
        return;
    for (auto &member : all) {
        const std::string text = param_text(member.second);
        const auto found = known.find(member.first);
        if (found != known.end() && found->second == text) continue;
        known[member.first] = text;
        changed(context, member.first.c_str(), text.c_str());
    }
}
} // namespace

hdr_status hdr_params_watch(const hdr_params *params, hdr_node *node, hdr_param_callback changed,
                            void *context)
{
    return hdr_guard([&] {
        const auto known = std::make_shared<texts>(texts_of(params));
        const std::string name = node->name;
        /* now: later, another node of this name may have taken over, which would have to end */
        look(name, *known, changed, context);
        node->watch = node->handle.createWallTimer(
            ros::WallDuration(look_seconds), [=](const ros::WallTimerEvent &) {
                const hdr_status status = hdr_guard([&] { look(name, *known, changed, context); });
                if (status != HDR_OK) hdr_log(HDR_WARN, "parameters: %s", hdr_error_text());
            });
    });
}
