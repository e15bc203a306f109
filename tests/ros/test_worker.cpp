/** The worker beside a change that takes its time, without ROS and without a run. */
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <future>
#include <thread>

extern "C" {
#include "node/table.h"
#include "node/worker.h"

/* what the worker calls of the node */
bool changes_take(changes *, settings *, hd_run *) { return false; }
bool checkpoint_writer_due(const checkpoint_writer *) { return false; }
void checkpoint_writer_save(checkpoint_writer *, hd_run *) {}
void checkpoint_writer_touch(checkpoint_writer *) {}
progress progress_of(const hd_run *, double) { return {}; }
bool report_awaited_here(report *) { return false; }
unsigned report_demand(report *) { return 0; }
void report_demand_slow(report *, hd_run *) {}
hd_status report_finish(report *, const progress *) { return HD_OK; }
hd_status report_publish(report *, const hd_run *) { return HD_OK; }
hd_status report_run_info(report *, const hd_run *, const changes *) { return HD_OK; }
hd_status report_slow(report *, const hd_run *, bool) { return HD_OK; }
hd_status report_window(report *, const hd_run *) { return HD_OK; }
void table_tell(table *, const settings *, const hd_run *) {}
void hdr_log(hdr_level, const char *, ...) {}
}

namespace
{
std::atomic<bool> at_it, free_to_go;
}

/** Until it may. */
extern "C" bool changes_ask(changes *, settings *, hd_run *, const char *assignment, char *message,
                            size_t size)
{
    at_it = true;
    while (!free_to_go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::snprintf(message, size, "%s it is", assignment);
    return true;
}

extern "C" bool changes_end(changes *, settings *, hd_run *, char *, size_t) { return false; }

/** The state is told meanwhile; the asker stays longer than it would have waited for the step. */
TEST(Worker, isFreeWhileAChangeIsMade)
{
    using namespace std::chrono;
    checkpoint_writer keep = {};
    settings set = {};
    worker *w;
    char message[64] = "";
    ASSERT_TRUE(worker_create(&w, nullptr, nullptr, &set, nullptr, &keep));
    ASSERT_TRUE(worker_begin(w));
    auto asker = std::async(std::launch::async,
                            [&] { return worker_set(w, 3.0, "a=1", message, sizeof message); });
    while (!at_it) std::this_thread::sleep_for(milliseconds(1));
    auto looker = std::async(std::launch::async, [&] { return worker_state_now(w).stage; });
    EXPECT_EQ(looker.wait_for(seconds(10)), std::future_status::ready);
    EXPECT_EQ(asker.wait_for(milliseconds(3500)), std::future_status::timeout);
    free_to_go = true;
    EXPECT_TRUE(asker.get());
    EXPECT_STREQ(message, "a=1 it is");
    worker_end(w);
    worker_free(w);
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
