/** Subscribers with roscpp read messages from their socket at once, into a queue that may be short
 * (100 messages of each topic in rosbag), and drop a message if that queue is full; so their socket
 * never makes the sender wait. They say how much they have read (getBusStats). Here no more
 * messages are sent than fit into that queue beyond those that a subscriber had read a moment ago.
 * Subscribers with rospy, and others, read only what they have room for: for them the queue fills
 * that roscpp keeps here, one for each. */
#include "readers.hpp"

#include <algorithm>
#include <deque>
#include <thread>
#include <utility>

#include <ros/network.h>
#include <ros/publication.h>
#include <ros/topic_manager.h>
#include <ros/xmlrpc_manager.h>

#include "guard.hpp"
#include "node.hpp"
#include "outbox.hpp"

namespace
{
using clock_type = std::chrono::steady_clock;

/** How many messages a subscriber may be behind: rosbag's queue, less a few for messages with which
 * a topic begins. */
const int window = 96;
/** A subscriber is asked again after this many further messages, so that its answer comes long
 * before the window is full. */
const int ask_every = 12;
/** After this time a message that was read has left the subscriber's queue, too [s]. Threads of a
 * busy machine stand still for some hundredths of a second. */
const double settle_seconds = 0.1;
/** How long the node waits for a subscriber that does not read [s]. */
const double patience_seconds = 5.0;
/** A subscriber for which the node has waited this long is named, and again after twice that, four
 * times that and so on [s]. */
const double say_seconds = 3.0;
const std::chrono::milliseconds poll_time{2};
/** Pause before each question. */
const std::chrono::milliseconds rest_time{1};
const size_t readers_max = 64;

double seconds_since(clock_type::time_point begin)
{
    return std::chrono::duration<double>(clock_type::now() - begin).count();
}
} // namespace

/** Somebody for whom a publisher may have to wait. */
struct hdr_readers::awaited {
    std::string name;
    bool is_deaf = false;                             /**< nobody waits for it any more */
    clock_type::time_point moved = clock_type::now(); /**< when it was last seen to have read */
    double waited = 0.0;                              /**< how long publishers have waited for it */
    double said_at = say_seconds;                     /**< it is named when `waited` reaches this */
};

struct hdr_readers::reader : awaited {
    /** A reader's connection to one topic. */
    struct link {
        int id = -1;
        int64_t before = 0; /**< messages published before the connection was made */
        int64_t asked_at = 0;
        int received = 0, settled = 0, lost = 0;
        /** When the reader said how much it had received; the last settle_seconds. */
        std::deque<std::pair<clock_type::time_point, int>> answers;
    };
    std::map<std::string, link> links; /**< known connections, by topic */
    std::condition_variable asked_for;
    bool asked = true, answered = false; /**< answered: the last question */
    bool asked_at_end = false;           /**< once all messages were handed over */
};

/** A queue that roscpp keeps for one connection. */
struct hdr_readers::queue : awaited {
    int64_t before = INT64_MAX; /**< messages published before the connection was made */
    uint64_t delivered = 0;     /**< see hdr_outbox */
};

struct hdr_readers::common {
    struct watched {
        std::shared_ptr<hdr_backlog> backlog;
        int window;
        std::map<int, queue> queues; /**< by connection */
    };
    std::mutex lock, finding;
    std::condition_variable answered;
    std::map<std::string, watched> topics;
    std::map<std::string, std::shared_ptr<reader>> readers;
    std::map<std::string, std::map<std::string, int>> lost; /**< by topic and reader */
    bool ended = false;
};

namespace
{
using common = hdr_readers::common;
using reader = hdr_readers::reader;
using queue = hdr_readers::queue;
using awaited = hdr_readers::awaited;

/** Finds the connection of a node to a topic: its id, and how many messages it was given. Returns
 * false if there is none. */
bool find_link(int &id, int &given, const std::string &topic, const std::string &name)
{
    XmlRpc::XmlRpcValue info;
    const ros::PublicationPtr publication = ros::TopicManager::instance()->lookupPublication(topic);
    if (!publication) return false;
    info.setSize(0);
    publication->getInfo(info);
    XmlRpc::XmlRpcValue stats = publication->getStats()[1];
    for (int k = 0; k < info.size(); k++)
        for (int j = 0; j < stats.size(); j++) {
            id = info[k][0];
            given = stats[j][3];
            if (std::string(info[k][1]) == name && id == int(stats[j][0])) return true;
        }
    return false;
}

void note_loss(common &all, reader &one, const std::string &topic, int lost)
{
    int &known = all.lost[topic][one.name];
    const int more = lost - one.links[topic].lost;
    if (more > 0 && known == 0)
        hdr_log(HDR_WARN, "%s loses messages of %s: its own queue was full", one.name.c_str(),
                topic.c_str());
    known += more;
    one.links[topic].lost = lost;
}

/** Takes a reader's answer about one topic. links: the reader's list of its connections. A reader
 * with rospy cannot say what it has dropped: nobody waits for it here. The caller holds the lock.
 */
void take_topic(common &all, reader &one, const std::string &topic, XmlRpc::XmlRpcValue &links)
{
    int id = -1, given = 0;
    if (links.size() == 0) return;
    const int received = links[0][2], lost = links[0][3];
    if (lost < 0 || !find_link(id, given, topic, one.name) || given < received) return;
    const common::watched &watched = all.topics[topic];
    const int64_t published = watched.backlog->look().published;
    reader::link &link = one.links[topic];
    if (id != link.id) {
        link = reader::link();
        link.id = id;
        link.before = published - given;
    }
    link.before = std::min(link.before, published - given); /* roscpp may not have given all yet */
    link.asked_at = published;
    if (received != link.received) {
        one.moved = clock_type::now();
        link.answers.emplace_back(one.moved, received);
    }
    link.received = received;
    note_loss(all, one, topic, lost);
}

/** How many messages of a topic a reader has not read. The caller holds the lock. */
int64_t unread(const common &all, const std::string &topic, const reader::link &link)
{
    return all.topics.at(topic).backlog->look().published - link.before - link.received;
}

/** Whether a reader has read all messages but `but` of each topic. The caller holds the lock. */
bool has_read(const common &all, const reader &one, int but)
{
    return std::all_of(one.links.begin(), one.links.end(), [&](const auto &link) {
        return unread(all, link.first, link.second) <= but;
    });
}

/** Takes the answer to getBusStats: [publishers, subscribers]; clients other than roscpp give
 * [status, text, [publishers, subscribers]]. The caller holds the lock. */
void take(common &all, reader &one, XmlRpc::XmlRpcValue &answer)
{
    const bool is_bare = answer[0].getType() == XmlRpc::XmlRpcValue::TypeArray;
    XmlRpc::XmlRpcValue &subscribed = is_bare ? answer[1] : answer[2][1];
    for (int k = 0; k < subscribed.size(); k++) {
        const std::string topic = subscribed[k][0];
        if (all.topics.count(topic)) take_topic(all, one, topic, subscribed[k][1]);
    }
    if (one.is_deaf && has_read(all, one, window / 2)) {
        one.is_deaf = false;
        hdr_log(HDR_WARN, "%s reads again", one.name.c_str());
    }
}

/** Finds the address of a node. One thread at a time does so, because roscpp keeps as many
 * connections to the master as it ever used at once. */
bool find(common &all, std::string &host, uint32_t &port, const std::string &name)
{
    const std::lock_guard<std::mutex> guard(all.finding);
    XmlRpc::XmlRpcValue request, response, uri;
    request[0] = ros::this_node::getName();
    request[1] = name;
    return ros::master::execute("lookupNode", request, response, uri, false) &&
           ros::network::splitURI(uri, host, port);
}

/** Asks a reader whenever somebody wants to know, until the reader is gone. */
void ask(common &all, reader &one)
{
    std::string host;
    uint32_t port;
    XmlRpc::XmlRpcValue request;
    request[0] = ros::this_node::getName();
    if (!find(all, host, port, one.name)) return;
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
    std::unique_lock<std::mutex> guard(all.lock);
    for (;;) {
        while (!one.asked && !all.ended) one.asked_for.wait(guard);
        if (all.ended) return;
        one.asked = false;
        guard.unlock();
        std::this_thread::sleep_for(rest_time);
        XmlRpc::XmlRpcValue answer;
        const bool said = client.execute("getBusStats", request, answer) && !client.isFault();
        guard.lock();
        if (all.ended || !said) return;
        take(all, one, answer);
        one.answered = !one.asked;
        all.answered.notify_all();
    }
}

/** Runs as the thread of a reader. At its end the reader is forgotten: if its node connects later,
 * that is a new reader. */
void follow(const std::shared_ptr<common> &all, const std::shared_ptr<reader> &one)
{
    hdr_guard([&] { ask(*all, *one); });
    const std::lock_guard<std::mutex> guard(all->lock);
    const auto found = all->readers.find(one->name);
    if (found != all->readers.end() && found->second == one) all->readers.erase(found);
    all->answered.notify_all();
}

/** Makes a reader's thread ask. The caller holds the lock. */
void ask_soon(reader &one)
{
    one.asked = true;
    one.answered = false;
    one.asked_for.notify_one();
}

/** How many messages of a topic may have been published before a reader has to be waited for. The
 * caller holds the lock. */
int64_t allowed(const common &all, const std::string &topic, reader::link &link)
{
    while (!link.answers.empty() && seconds_since(link.answers.front().first) >= settle_seconds) {
        link.settled = link.answers.front().second;
        link.answers.pop_front();
    }
    return link.before + link.settled + all.topics.at(topic).window;
}

/** A reader that has not read enough of a topic, or NULL. Also makes the threads of readers ask
 * whose answer is old or who have to be waited for. The caller holds the lock. */
reader *slowest(common &all, const std::string &topic, int64_t published)
{
    reader *slow = nullptr;
    for (const auto &named : all.readers) {
        reader &one = *named.second;
        const auto found = one.links.find(topic);
        if (found == one.links.end()) continue;
        const bool is_slow = !one.is_deaf && published >= allowed(all, topic, found->second);
        const bool is_due = published >= found->second.asked_at + ask_every;
        if (is_due || (is_slow && unread(all, topic, found->second) > 0)) ask_soon(one);
        if (is_slow) slow = &one;
    }
    return slow;
}

/** Takes what roscpp says of a queue. Returns whether a further message would push one out that its
 * subscriber might still read. The caller holds the lock. */
bool is_full(queue &one, const hdr_outbox &now, const hdr_publisher &publisher, int64_t published)
{
    one.name = now.name;
    /* roscpp puts messages into queues a little later */
    one.before = std::min(one.before, published - now.given);
    const int64_t waiting = now.waiting + published - one.before - now.given;
    const bool has_read = now.delivered != one.delivered || waiting == 0;
    one.delivered = now.delivered;
    if (has_read) one.moved = clock_type::now();
    if (has_read && one.is_deaf && waiting < publisher.queue) {
        one.is_deaf = false;
        hdr_log(HDR_WARN, "%s reads %s again", one.name.c_str(), publisher.topic.c_str());
    }
    return waiting >= publisher.queue && !one.is_deaf;
}

/** A queue of a topic that is full, or NULL. The caller holds the lock. */
queue *fullest(common &all, const hdr_publisher &publisher, int64_t published)
{
    std::map<int, queue> &queues = all.topics.at(publisher.topic).queues, left;
    queue *full = nullptr;
    left.swap(queues);
    for (const hdr_outbox &now : hdr_outboxes(publisher.topic)) {
        queue &one = queues[now.connection] = left[now.connection];
        const auto asked = all.readers.find(now.name);
        const bool is_known_deaf = asked != all.readers.end() && asked->second->is_deaf;
        if (is_full(one, now, publisher, published) && !is_known_deaf) full = &one;
    }
    return full;
}

/** Whether somebody is still worth waiting for, who has not read since then. The caller holds the
 * lock. */
bool waits_for(awaited &one, clock_type::time_point since, const std::string &topic)
{
    if (seconds_since(since) < patience_seconds) return true;
    one.is_deaf = true;
    hdr_log(HDR_WARN,
            "%s has read nothing of %s for %g s: the run goes on, and it may lose messages",
            one.name.c_str(), topic.c_str(), patience_seconds);
    return false;
}

/** Adds to how long somebody has been waited for, and says so now and then. The caller holds the
 * lock. */
void note_wait(awaited &one, hdr_publisher &publisher, double seconds)
{
    publisher.waited += seconds;
    one.waited += seconds;
    if (one.waited < one.said_at) return;
    hdr_log(HDR_WARN, "waits for %s, which reads %s slowly: %.0f s so far", one.name.c_str(),
            publisher.topic.c_str(), one.waited);
    one.said_at = 2.0 * one.waited;
}
} // namespace

hdr_readers::hdr_readers() : all(std::make_shared<common>()) {}

void hdr_readers::end()
{
    const std::lock_guard<std::mutex> guard(all->lock);
    all->ended = true;
    for (const auto &named : all->readers) named.second->asked_for.notify_one();
}

void hdr_readers::watch(const hdr_publisher &publisher)
{
    const std::lock_guard<std::mutex> guard(all->lock);
    all->topics[publisher.topic] = {publisher.backlog, std::min(window, publisher.queue), {}};
}

void hdr_readers::add(const std::string &name)
{
    const std::lock_guard<std::mutex> guard(all->lock);
    if (all->readers.size() >= readers_max) return;
    std::shared_ptr<reader> &one = all->readers[name];
    if (one) {
        ask_soon(*one);
        return;
    }
    one = std::make_shared<reader>();
    one->name = name;
    std::thread(follow, all, one).detach();
}

void hdr_readers::wait(hdr_publisher &publisher)
{
    const auto began = clock_type::now();
    auto last = began;
    std::unique_lock<std::mutex> guard(all->lock);
    while (!hdr_stop_requested()) {
        const int64_t published = publisher.backlog->look().published;
        reader *behind = slowest(*all, publisher.topic, published);
        queue *full = fullest(*all, publisher, published);
        awaited *one = behind ? static_cast<awaited *>(behind) : full;
        if (!one || !publisher.patient) break;
        note_wait(*one, publisher, seconds_since(last));
        last = clock_type::now();
        if (waits_for(*one, behind ? std::max(began, one->moved) : one->moved, publisher.topic))
            all->answered.wait_for(guard, poll_time);
    }
}

bool hdr_readers::have_read_all()
{
    const std::lock_guard<std::mutex> guard(all->lock);
    bool read = true;
    for (const auto &named : all->readers) {
        reader &one = *named.second;
        const bool is_awake = one.asked_at_end && one.answered;
        if (one.is_deaf || (is_awake && has_read(*all, one, 0))) continue;
        read = false;
        if (is_awake || !one.asked_at_end) ask_soon(one);
        one.asked_at_end = true;
    }
    return read;
}

int64_t hdr_readers::lost(const std::string &topic)
{
    const std::lock_guard<std::mutex> guard(all->lock);
    int64_t sum = 0;
    for (const auto &named : all->lost[topic]) sum += named.second;
    return sum;
}

void hdr_readers::say_lost()
{
    const std::lock_guard<std::mutex> guard(all->lock);
    for (const auto &topic : all->topics) {
        const hdr_backlog::numbers now = topic.second.backlog->look();
        const char *name = topic.first.c_str();
        if (now.lost > 0)
            hdr_log(
                HDR_WARN,
                "%lld of %lld messages of %s were not sent to all subscribers: the queue was full",
                static_cast<long long>(now.lost), static_cast<long long>(now.published), name);
        for (const auto &named : all->lost[topic.first])
            if (named.second > 0)
                hdr_log(HDR_WARN, "%s has lost %d of %lld messages of %s", named.first.c_str(),
                        named.second, static_cast<long long>(now.published), name);
    }
    for (const auto &named : all->readers) {
        if (named.second->asked_at_end && !named.second->answered)
            hdr_log(HDR_WARN, "%s does not answer: it may not read the last messages",
                    named.first.c_str());
        for (const auto &link : named.second->links) {
            const long long left = unread(*all, link.first, link.second);
            if (left > 0)
                hdr_log(HDR_WARN, "%s has not read the last %lld messages of %s",
                        named.first.c_str(), left, link.first.c_str());
        }
    }
}
