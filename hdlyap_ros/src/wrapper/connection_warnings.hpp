/** Says which subscribers cannot be connected; private to the wrapper. */
#pragma once

#include "node.hpp"

/** From now on, on the callback thread. An ERROR line for each publisher of another type, a WARN
 * line where somebody of the right type cannot be reached; while everybody is connected nobody is
 * asked. */
void connection_warnings_start(hdr_node *node);
