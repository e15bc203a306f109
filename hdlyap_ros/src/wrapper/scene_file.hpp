/** A file of parameters without a master: what rosparam would have put there. */
#pragma once

#include <string>

#include <XmlRpcValue.h>

/** Members by name; a value is a scalar or a list of scalars. Throws std::runtime_error with a line
 * that names the file: also of words that YAML 1.1, and so roslaunch, takes for something else than
 * what they look like, and of numbers that it cannot hand over. */
XmlRpc::XmlRpcValue scene_file_read(const std::string &path);

/** A text in quotes, or a list; the text itself where it is neither. */
XmlRpc::XmlRpcValue scene_file_value(const std::string &text);
