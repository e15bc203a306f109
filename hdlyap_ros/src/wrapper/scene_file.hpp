/** A file of parameters without a master: what rosparam would have put there. */
#pragma once

#include <string>

#include <XmlRpcValue.h>

/** Members by name; a value is a scalar or a list of scalars. Throws std::runtime_error with a line
 * that names the file. */
XmlRpc::XmlRpcValue scene_file_read(const std::string &path);

/** What YAML 1.1, and so rosparam, takes a text without quotes for. */
XmlRpc::XmlRpcValue scene_file_scalar(const std::string &text);

/** The same, or a list of such; the text itself where it is neither. */
XmlRpc::XmlRpcValue scene_file_value(const std::string &text);
