/** Registers what this node has with a master that does not know it; private to the wrapper. */
#pragma once

#include <functional>
#include <string>
#include <vector>

/** The service that roscpp registers when it starts; the name of every other is told. */
std::string first_service();

/** Registers all topics that the node publishes or hears, whose subscribers then connect to their
 * publishers, and the services of these names. Returns false if a registration fails, or if
 * wanted() becomes false. */
bool register_again(const std::vector<std::string> &services, const std::function<bool()> &wanted);
