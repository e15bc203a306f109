/** The worker beside threads that ask it for something, with a run, but without ROS. */
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <vector>

extern "C" {
#include "node/clock.h"
#include "node/table.h"
#include "node/worker.h"
}

namespace
{
using namespace std::chrono;

/** What happens where the worker has dropped its lock, and how often it has been there. */
struct place {
    std::function<void()> then = [] {};
    std::atomic<int> visits{0};
    void pass()
    {
        visits++;
        then();
    }
};

/** A run with its worker, and the places where the worker's lock is dropped. */
struct scene {
    place changing, telling, resting, saving, looking;
    std::atomic<bool> awaited_here{true};
    std::atomic<int> steps{0};
};
scene *now;

/** Sleeps until a condition holds; false after 10 s. */
bool comes(const std::function<bool()> &condition)
{
    for (int k = 0; k < 10000 && !condition(); k++) std::this_thread::sleep_for(milliseconds(1));
    return condition();
}
} // namespace

/* what the worker calls of the node */
extern "C" {
bool changes_ask(changes *, settings *, hd_run *, const char *assignment, char *message,
                 size_t size)
{
    now->changing.pass();
    std::snprintf(message, size, "%s it is", assignment);
    return true;
}
bool changes_end(changes *, settings *, hd_run *, char *message, size_t size)
{
    now->changing.pass();
    std::snprintf(message, size, "ends");
    return true;
}
bool changes_take(changes *, settings *, hd_run *) { return false; }
bool checkpoint_writer_due(const checkpoint_writer *k)
{
    return k->changed && clock_seconds() >= k->due;
}
void checkpoint_writer_save(checkpoint_writer *k, hd_run *)
{
    now->saving.pass();
    k->changed = false;
    k->due = INFINITY;
}
void checkpoint_writer_touch(checkpoint_writer *k) { k->changed = true; }
progress progress_of(const hd_run *, double)
{
    now->steps++;
    return {};
}
bool report_awaited_here(report *)
{
    now->looking.pass();
    return now->awaited_here;
}
unsigned report_demand(report *) { return 0; }
void report_demand_slow(report *, hd_run *) {}
hd_status report_vectors(report *, hd_run *) { return HD_OK; }
hd_status report_finish(report *, const progress *) { return HD_OK; }
hd_status report_publish(report *, const hd_run *) { return HD_OK; }
hd_status report_run_info(report *, const hd_run *, const changes *)
{
    now->telling.pass();
    return HD_OK;
}
hd_status report_slow(report *, const hd_run *, bool at_rest)
{
    if (at_rest) now->resting.pass();
    return HD_OK;
}
hd_status report_window(report *, const hd_run *) { return HD_OK; }
void table_tell(table *, const settings *, const hd_run *) {}
void hdr_log(hdr_level, const char *, ...) {}
}

namespace
{
/** Long enough for any answer that comes at all [s]. */
const double patience = 10.0;

struct Worker : testing::Test {
    scene here;
    settings set = {};
    hd_run *run = nullptr;
    worker *w = nullptr;
    /* of answers_at; the worker may come to the place again later */
    std::future<bool> answer;
    std::atomic<bool> asked{false}, passed{false};

    void SetUp() override
    {
        char message[256] = "";
        now = &here;
        hd_scene_def def = hd_scene_def_default();
        def.number = 20;
        def.exponents = 0;
        def.equilibration = def.warmup = 1.0;
        def.duration = 1e9;
        ASSERT_EQ(hd_run_create(&run, &def, message, sizeof message), HD_OK) << message;
        set.checkpoint = "file";
        checkpoint_writer keep = {};
        keep.due = INFINITY;
        ASSERT_TRUE(worker_create(&w, run, nullptr, &set, nullptr, &keep));
    }
    void TearDown() override
    {
        for (place *each :
             {&here.changing, &here.telling, &here.resting, &here.saving, &here.looking})
            each->then = [] {};
        worker_end(w);
        worker_free(w);
        hd_run_free(run);
    }
    worker_stage stage() { return worker_state_now(w).stage; }
    void begin_paused()
    {
        ASSERT_TRUE(worker_begin(w));
        worker_pause(w, true);
        ASSERT_TRUE(comes([this] { return stage() == WORKER_PAUSED; }));
    }
    bool asks_set()
    {
        char message[64] = "";
        return worker_set(w, patience, "a=1", message, sizeof message);
    }
    bool asks_checkpoint()
    {
        char message[64] = "";
        return worker_checkpoint(w, patience, message, sizeof message);
    }

    /** What is asked for while the worker's thread is at a place, to which `go` takes it, is
     * answered. */
    void answers_at(place &at, const std::function<void()> &go, const std::function<bool()> &ask)
    {
        at.then = [this, ask] {
            if (asked.exchange(true)) return;
            answer = std::async(std::launch::async, ask);
            std::this_thread::sleep_for(milliseconds(100)); /* until it waits for its answer */
            passed = true;
        };
        const auto begin = steady_clock::now();
        std::thread going(go);
        const bool has_passed = comes([this] { return passed.load(); });
        going.join();
        ASSERT_TRUE(has_passed);
        EXPECT_TRUE(answer.get());
        EXPECT_LT(steady_clock::now() - begin, milliseconds(int(500 * patience)));
    }
    bool ends()
    {
        worker_stop(w);
        return worker_wait(w, patience);
    }
};

/** The state is told meanwhile; the asker stays longer than it would have waited for the step. */
TEST_F(Worker, isFreeWhileAChangeIsMade)
{
    std::atomic<bool> free_to_go{false};
    char message[64] = "";
    here.changing.then = [&] {
        while (!free_to_go) std::this_thread::sleep_for(milliseconds(1));
    };
    here.awaited_here = false;
    ASSERT_TRUE(worker_begin(w));
    auto asker = std::async(std::launch::async,
                            [&] { return worker_set(w, 3.0, "a=1", message, sizeof message); });
    ASSERT_TRUE(comes([this] { return here.changing.visits > 0; }));
    auto looker = std::async(std::launch::async, [&] { return stage(); });
    EXPECT_EQ(looker.wait_for(seconds(10)), std::future_status::ready);
    EXPECT_EQ(asker.wait_for(milliseconds(3500)), std::future_status::timeout);
    free_to_go = true;
    EXPECT_TRUE(asker.get());
    EXPECT_STREQ(message, "a=1 it is");
}

/* Whatever is asked for while the lock is dropped, wherever that is. */

TEST_F(Worker, answersAChangeThatIsAskedForWhileItTellsOfAnother)
{
    begin_paused();
    answers_at(
        here.telling, [this] { asks_set(); }, [this] { return asks_set(); });
}

TEST_F(Worker, writesACheckpointThatIsAskedForWhileItTellsOfAChange)
{
    begin_paused();
    answers_at(
        here.telling, [this] { asks_set(); }, [this] { return asks_checkpoint(); });
    EXPECT_EQ(here.saving.visits, 1);
}

TEST_F(Worker, stopsThatIsAskedForWhileItTellsOfAChange)
{
    begin_paused();
    answers_at(
        here.telling, [this] { asks_set(); }, [this] { return ends(); });
}

TEST_F(Worker, endsTheAveragingThatIsAskedForWhileItTellsOfAChange)
{
    char message[64] = "";
    begin_paused();
    const int steps = here.steps;
    answers_at(
        here.telling, [this] { asks_set(); },
        [&] { return worker_end_averaging(w, patience, message, sizeof message); });
    EXPECT_STREQ(message, "ends");
    EXPECT_TRUE(comes([&] { return here.steps > steps; })) << "it goes on to its end";
}

TEST_F(Worker, goesOnThatIsAskedForWhileItTellsOfAChange)
{
    begin_paused();
    const int steps = here.steps;
    answers_at(
        here.telling, [this] { asks_set(); },
        [this] {
            worker_pause(w, false);
            return true;
        });
    EXPECT_TRUE(comes([&] { return here.steps > steps; }));
}

TEST_F(Worker, answersAChangeThatIsAskedForWhileItComesToRest)
{
    ASSERT_TRUE(worker_begin(w));
    answers_at(
        here.resting, [this] { worker_pause(w, true); }, [this] { return asks_set(); });
}

TEST_F(Worker, stopsThatIsAskedForWhileItComesToRest)
{
    ASSERT_TRUE(worker_begin(w));
    answers_at(
        here.resting, [this] { worker_pause(w, true); }, [this] { return ends(); });
}

TEST_F(Worker, answersAChangeThatIsAskedForWhileItSaves)
{
    begin_paused();
    answers_at(
        here.saving, [this] { asks_checkpoint(); }, [this] { return asks_set(); });
}

TEST_F(Worker, stopsThatIsAskedForWhileItSaves)
{
    begin_paused();
    answers_at(
        here.saving, [this] { asks_checkpoint(); }, [this] { return ends(); });
}

TEST_F(Worker, answersAChangeThatIsAskedForWhileItLooksForSubscribers)
{
    here.awaited_here = false;
    answers_at(
        here.looking, [this] { ASSERT_TRUE(worker_begin(w)); }, [this] { return asks_set(); });
}

TEST_F(Worker, stopsThatIsAskedForWhileItLooksForSubscribers)
{
    here.awaited_here = false;
    answers_at(
        here.looking, [this] { ASSERT_TRUE(worker_begin(w)); }, [this] { return ends(); });
}

/** Also one that comes while the run waits for its next step, as pace makes it. */
TEST_F(Worker, tellsOfItsStateWheneverItComesToRest)
{
    set.pace = 1e-9;
    ASSERT_TRUE(worker_begin(w));
    ASSERT_TRUE(comes([this] {
        const int before = here.steps;
        std::this_thread::sleep_for(milliseconds(200));
        return before > 0 && here.steps == before;
    }));
    worker_pause(w, true);
    EXPECT_TRUE(comes([this] { return stage() == WORKER_PAUSED; }));
    EXPECT_EQ(here.resting.visits, 1);
}

/** One that sends the next change as soon as the last one is answered, as the callback thread does
 * for clients that are many. */
TEST_F(Worker, answersOneAfterAnother)
{
    begin_paused();
    const auto begin = steady_clock::now();
    for (int k = 0; k < 1000; k++) ASSERT_TRUE(asks_set()) << k;
    EXPECT_LT(steady_clock::now() - begin, seconds(5));
    EXPECT_TRUE(comes([this] { return here.telling.visits == 1000; }));
}

TEST_F(Worker, answersFourAtOnce)
{
    begin_paused();
    here.telling.then = [] { std::this_thread::sleep_for(microseconds(200)); };
    std::vector<std::future<int>> clients;
    for (int client = 0; client < 4; client++)
        clients.push_back(std::async(std::launch::async, [this, client] {
            int wrong = 0;
            for (int k = 0; k < 100; k++) {
                const std::string text = std::to_string(client) + "=" + std::to_string(k);
                char message[64] = "";
                const bool made = worker_set(w, patience, text.c_str(), message, sizeof message);
                wrong += !made || message != text + " it is";
            }
            return wrong;
        }));
    for (auto &each : clients) EXPECT_EQ(each.get(), 0);
    EXPECT_EQ(here.changing.visits, 400);
    EXPECT_TRUE(comes([this] { return here.telling.visits == 400; }));
}
} // namespace

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
