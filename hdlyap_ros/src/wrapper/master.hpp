/** Where the master is said to be; private to the wrapper. */
#pragma once

/** Throws std::invalid_argument unless the master's address, of __master:= or the environment, is
 * one: roscpp dies of others. Where the environment has none, it is given rospy's own. */
void master_address_check(int argc, const char *const *argv);
