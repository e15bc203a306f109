/** What diagnostics tell of the subscribers that are behind, without ROS. */
#include <gtest/gtest.h>

#include "begin.h"

/** What is lost is worse than what comes late. */
TEST(Subscribers, TheWorst)
{
    hdr_lag each[] = {{"late", 5.0, 3, 0},
                      {"later", 9.0, 1, 0},
                      {"few", 0.0, 0, 2},
                      {"many", 1.0, 1, 7},
                      {"some", 2.0, 9, 4}};
    EXPECT_STREQ(worst_of(each, 0).topic, "");
    EXPECT_STREQ(worst_of(each, 2).topic, "later");
    EXPECT_STREQ(worst_of(each, 3).topic, "few");
    EXPECT_STREQ(worst_of(each, 5).topic, "many");
}

int main(int argc, char **argv)
{
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
