/** What diagnostics judge, without ROS: errors that do not fall, disks that overlap or drift,
 * subscribers that are behind, and what is made of all of it. */
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "wrapper/backlog.hpp"
#include "hdlyap_ros/messages.h"

extern "C" {
#include "node/conditions.h"
}

namespace
{
/** Messages in a queue as roscpp keeps it for one subscriber, the oldest dropped first. */
class Queue
{
  public:
    explicit Queue(size_t queue) : backlog(queue), length(queue) {}
    void publish(double now)
    {
        const hdr_backlog::buffer message(new uint8_t[1]);
        waiting.push_back(message);
        if (waiting.size() > length) waiting.erase(waiting.begin());
        backlog.count();
        backlog.add(message, now);
    }
    void take() { waiting.erase(waiting.begin()); }
    hdr_backlog backlog;
    size_t length;
    std::vector<hdr_backlog::buffer> waiting;
};

TEST(Backlog, NobodyListens)
{
    hdr_backlog backlog(10);
    EXPECT_EQ(backlog.look().waiting, 0);
    backlog.count();
    backlog.add({}, 1.0);
    EXPECT_EQ(backlog.look(100.0).waiting, 0);
    EXPECT_EQ(backlog.look(100.0).seconds, 0.0);
    EXPECT_EQ(backlog.look().published, 1);
}

/** Of a latched topic somebody keeps the newest message. */
TEST(Backlog, Latched)
{
    hdr_backlog backlog(10, true);
    hdr_backlog::buffer kept(new uint8_t[1]);
    backlog.add(kept, 1.0);
    EXPECT_EQ(backlog.look().waiting, 0);
    hdr_backlog::buffer waiting = kept; /* for one who comes late */
    EXPECT_EQ(backlog.look().waiting, 1);
    kept.reset(new uint8_t[1]);
    waiting.reset();
    backlog.add(kept, 2.0);
    EXPECT_EQ(backlog.look().waiting, 0);
    waiting = kept;
    EXPECT_EQ(backlog.look(5.0).waiting, 1);
    EXPECT_EQ(backlog.look(5.0).seconds, 3.0);
    kept.reset(new uint8_t[1]);
    backlog.add(kept, 6.0); /* behind the one that waits */
    EXPECT_EQ(backlog.look(7.0).seconds, 5.0);
    waiting.reset();
    EXPECT_EQ(backlog.look().waiting, 0);
}

TEST(Backlog, DeafThenWellAgain)
{
    Queue queue(1000);
    for (int k = 0; k < 30; k++) {
        queue.publish(k);
        EXPECT_EQ(queue.backlog.look(k + 0.5).seconds, k + 0.5);
        EXPECT_EQ(queue.backlog.look(k + 0.5).waiting, k + 1);
    }
    while (!queue.waiting.empty()) queue.take();
    EXPECT_EQ(queue.backlog.look(30).waiting, 0);
    queue.publish(31);
    EXPECT_EQ(queue.backlog.look(32).seconds, 1.0); /* nothing of the past is left */
    EXPECT_EQ(queue.backlog.look().lost, 0);
}

TEST(Backlog, AlwaysFiveBehind)
{
    Queue queue(1000);
    for (int k = 0; k < 100; k++) {
        queue.publish(k);
        if (k >= 5) queue.take();
        EXPECT_EQ(queue.backlog.look(k).seconds, std::min(k, 4));
    }
    EXPECT_EQ(queue.backlog.look().lost, 0);
}

/** One message is being written while the queue is full: what is dropped lies behind it. */
TEST(Backlog, FullQueue)
{
    Queue queue(10);
    hdr_backlog::buffer written(new uint8_t[1]);
    queue.backlog.count();
    queue.backlog.add(written, -1.0);
    for (int k = 0; k < 100; k++) {
        queue.publish(k);
        EXPECT_EQ(queue.backlog.look(k).waiting, std::min(k + 2, 11));
        EXPECT_EQ(queue.backlog.look(k).seconds, k + 1);
        EXPECT_EQ(queue.backlog.look(k).lost, std::max(0, k - 9));
    }
    written.reset();
    queue.publish(100);
    EXPECT_EQ(queue.backlog.look().published, 102);
    EXPECT_EQ(queue.backlog.look(100).waiting, 10);
    EXPECT_EQ(queue.backlog.look().lost, 90); /* the last one goes unseen with what was written */
}

worker_state healthy()
{
    worker_state state = {};
    state.status = HD_OK;
    state.warning = "";
    state.particles = "disks";
    state.last.cost.stalled_since = -1.0;
    state.seen = {true, 1e-16, 1e-13, 1e-15, 1e-12};
    return state;
}

TEST(Conditions, NothingToSay)
{
    const worker_state state = healthy();
    const hdr_lag slowest = {"/a", 2.9, 5, 0};
    const conditions all = conditions_of(&state, &slowest);
    EXPECT_EQ(all.level, HDR_DIAGNOSTIC_OK);
    EXPECT_STREQ(all.message, "");
}

TEST(Conditions, EachHasItsLevelAndMessage)
{
    const hdr_lag prompt = {"", 0, 0, 0}, behind = {"/b/fields", 12.34, 5, 0},
                  losing = {"/b/fields", 0.5, 1001, 42};
    const hd_target_progress target = {"c_L", 3.0, 0.07, 0.03, 0.05, INFINITY, false};
    worker_state fault = healthy(), unkept = healthy(), deep = healthy(), warm = healthy(),
                 stalled = healthy(), lost = healthy(), open = healthy(), empty = healthy(),
                 caged = healthy(), off = healthy(), split = healthy();
    empty.warning = "none of them belongs to a step";
    fault.status = HD_ILL_CONDITIONED;
    unkept.checkpoint.failed = true;
    snprintf(unkept.checkpoint.message, sizeof unkept.checkpoint.message, "disk full");
    deep.seen.overlap = 1e-12;
    warm.seen.energy_error = NAN;
    lost.lost = 12.3;
    stalled.last.averaged = 32;
    stalled.last.cost.std_error = stalled.last.cost.stalled_error = 0.5;
    stalled.last.cost.stalled_since = 4;
    open.last.cost.target = target;
    caged.last.caged = true;
    off.last.energy = {-1e-4, 0.00123, 5e-4};
    split.last.split = {true, 0.07, 0.015, 0.01, 2.0 / 3.0};
    const worker_state well = healthy();
    const struct {
        const worker_state *state;
        const hdr_lag *lag;
        uint8_t level;
        std::string message;
    } cases[] = {
        {&fault, &prompt, HDR_DIAGNOSTIC_ERROR, hd_status_text(HD_ILL_CONDITIONED)},
        {&unkept, &prompt, HDR_DIAGNOSTIC_ERROR, "disk full"},
        {&deep, &prompt, HDR_DIAGNOSTIC_ERROR, "disks overlap by 1e-12, rounding explains 1e-13"},
        {&warm, &prompt, HDR_DIAGNOSTIC_ERROR, "energy is off by nan, rounding explains 1e-12"},
        {&stalled, &prompt, HDR_DIAGNOSTIC_WARN,
         "errors of the smallest exponents do not fall: 0.5 after 4 time units of averaging, 0.5 "
         "after 32"},
        {&lost, &prompt, HDR_DIAGNOSTIC_WARN,
         "nobody can subscribe: no ROS master has known this node for 12 s"},
        {&open, &prompt, HDR_DIAGNOSTIC_WARN,
         "the target of c_L, 0.03, cannot be reached: an error of 0.05 remains, however long it "
         "averages"},
        {&empty, &prompt, HDR_DIAGNOSTIC_WARN, "none of them belongs to a step"},
        {&caged, &prompt, HDR_DIAGNOSTIC_WARN,
         "disks keep their places: errors hold for this arrangement only, other seeds may differ"},
        {&split, &prompt, HDR_DIAGNOSTIC_WARN,
         "time_step = 0.01 is too long for the zero exponents: the largest is 0.07, not 0.015; "
         "it falls as time_step^0.67"},
        {&off, &prompt, HDR_DIAGNOSTIC_WARN,
         "the energy has been off by 0.0012, asked is 0.0005: take a shorter time_step or a "
         "coarser "
         "accuracy"},
        {&well, &behind, HDR_DIAGNOSTIC_WARN, "a subscriber of /b/fields is 12.3 s behind"},
        {&well, &losing, HDR_DIAGNOSTIC_WARN, "subscribers of /b/fields have lost 42 messages"},
    };
    for (const auto &one : cases) {
        const conditions all = conditions_of(one.state, one.lag);
        EXPECT_EQ(all.level, one.level) << one.message;
        EXPECT_EQ(all.message, one.message);
    }
}

TEST(Conditions, SeveralAtOnce)
{
    worker_state state = healthy();
    const hdr_lag behind = {"/a", 4, 1, 0};
    state.checkpoint.failed = true;
    memset(state.checkpoint.message, 'x', 400);
    const conditions all = conditions_of(&state, &behind);
    EXPECT_EQ(all.level, HDR_DIAGNOSTIC_ERROR);
    EXPECT_EQ(all.message, std::string(400, 'x') + "; a subscriber of /a is 4.0 s behind");
}
} // namespace

int main(int argc, char **argv)
{
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
