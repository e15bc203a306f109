/** An exact synchronizer of message_filters calls back at each report for any two of its topics. */
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>

extern "C" {
#include "hdlyap/dynamics.h"
#include "topics/topic.h"
}

namespace
{
/** Any message of the node, as far as all are alike. */
struct beginning {
    std_msgs::Header header;
    std::string run_id;
    double sim_time;
};
} // namespace

namespace ros
{
namespace message_traits
{
template <> struct MD5Sum<beginning> {
    static const char *value() { return "*"; }
};
template <> struct DataType<beginning> {
    static const char *value() { return "*"; }
};
template <> struct HasHeader<beginning> : TrueType {
};
} // namespace message_traits
namespace serialization
{
template <> struct Serializer<beginning> {
    template <class Stream> static void read(Stream &stream, beginning &out)
    {
        stream.next(out.header);
        stream.next(out.run_id);
        stream.next(out.sim_time);
    }
};
} // namespace serialization
} // namespace ros

namespace
{
using message = boost::shared_ptr<const beginning>;
const uint32_t queue = 1000;

struct heard {
    std::string name;
    message_filters::Subscriber<beginning> subscriber;
    std::set<double> times;
    heard(ros::NodeHandle &node, const std::string &of) : name(of)
    {
        subscriber.subscribe(node, "/hdlyap/" + of, queue);
        subscriber.registerCallback<message>(
            [this](const message &m) { times.insert(m->sim_time); });
    }
};

struct met {
    heard &a, &b;
    message_filters::TimeSynchronizer<beginning, beginning> both;
    std::vector<double> times;
    met(heard &one, heard &other) : a(one), b(other), both(one.subscriber, other.subscriber, queue)
    {
        both.registerCallback(&met::add, this);
    }
    void add(const message &one, const message &other)
    {
        EXPECT_EQ(one->sim_time, other->sim_time);
        times.push_back(one->sim_time);
    }
};

std::vector<std::unique_ptr<heard>> all_of_reports(ros::NodeHandle &node)
{
    const hd_scene_def disks = hd_scene_def_default();
    const unsigned of_disks = topics_of_particles(hd_dynamics_of(&disks)),
                   absent = topics_that_are(TOPIC_OBSERVABLE) & ~of_disks,
                   rare = topics_that_are(TOPIC_FOR_VIEWERS | TOPIC_OF_WINDOWS);
    std::vector<std::unique_ptr<heard>> all;
    for (int t = 0; t < TOPICS; t++) {
        const unsigned bit = topic_bit(topic(t));
        if (t != TOPIC_run_info && !(bit & (absent | rare)))
            all.emplace_back(new heard(node, topic_name(topic(t))));
    }
    return all;
}

TEST(Synchronized, eachTwoTopicsMeetAtEachReport)
{
    ros::NodeHandle node;
    const auto topics = all_of_reports(node);
    std::vector<std::unique_ptr<met>> pairs;
    for (size_t a = 0; a < topics.size(); a++)
        for (size_t b = 0; b < a; b++) pairs.emplace_back(new met(*topics[a], *topics[b]));
    ASSERT_GE(pairs.size(), 14u * 13u / 2u);
    const auto &any = topics.front()->subscriber.getSubscriber();
    const auto end = ros::WallTime::now() + ros::WallDuration(100.0);
    while (topics.front()->times.empty() || any.getNumPublishers() > 0) {
        ASSERT_LT(ros::WallTime::now(), end);
        ros::spinOnce();
        ros::WallDuration(0.01).sleep();
    }
    ros::WallDuration(0.5).sleep();
    ros::spinOnce();
    for (const auto &pair : pairs) {
        const std::set<double> &a = pair->a.times, &b = pair->b.times;
        std::vector<double> wanted;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(wanted));
        EXPECT_GE(wanted.size(), 6u) << pair->a.name << ", " << pair->b.name;
        EXPECT_EQ(pair->times, wanted) << pair->a.name << ", " << pair->b.name;
    }
}
} // namespace

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    ros::init(argc, argv, "synchronized");
    return RUN_ALL_TESTS();
}
