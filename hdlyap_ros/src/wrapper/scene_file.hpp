/** Reads parameters that are written in YAML. */
#pragma once

#include <string>

#include <XmlRpcValue.h>

/** Returns parameters by name; a value is a scalar or a list of scalars. Throws std::runtime_error
 * with a text that names file and line: also if a word means something else in YAML 1.1, and so to
 * rosparam, than it seems to, or if ROS cannot carry a number. */
XmlRpc::XmlRpcValue scene_file_read(const std::string &path);

/** The same of a text that was read from `path`. */
XmlRpc::XmlRpcValue scene_file_parse(const std::string &text, const std::string &path);

/** The value of a text in quotes or of a list; any other text unchanged. */
XmlRpc::XmlRpcValue scene_file_value(const std::string &text);
