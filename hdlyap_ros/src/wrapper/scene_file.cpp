/** YAML -> XML-RPC values. */
#include "scene_file.hpp"

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <yaml-cpp/yaml.h>

using XmlRpc::XmlRpcValue;

namespace
{
XmlRpcValue scalar_of(const YAML::Node &node)
{
    if (!node.IsScalar() && !node.IsNull())
        throw YAML::Exception(node.Mark(), "a parameter is a number, a word or a list of these");
    const bool is_quoted = node.Tag() == "!";
    return is_quoted ? XmlRpcValue(node.Scalar()) : scene_file_scalar(node.Scalar());
}

XmlRpcValue value_of(const YAML::Node &node)
{
    XmlRpcValue list;
    if (!node.IsSequence()) return scalar_of(node);
    list.setSize(static_cast<int>(node.size()));
    for (int k = 0; k < list.size(); k++) list[k] = scalar_of(node[k]);
    return list;
}

XmlRpcValue members_of(const YAML::Node &root)
{
    XmlRpcValue all;
    all.begin(); /* a struct, also without members */
    if (!root.IsMap() && !root.IsNull())
        throw YAML::Exception(root.Mark(), "must be a list of parameters, name: value");
    for (const auto &pair : root) {
        if (!pair.first.IsScalar())
            throw YAML::Exception(pair.first.Mark(), "a name of a parameter is a word");
        all[pair.first.Scalar()] = value_of(pair.second);
    }
    return all;
}
} // namespace

/** yaml-cpp knows more words than YAML 1.1 (y, n), and numbers (1e5, without a point). */
XmlRpcValue scene_file_scalar(const std::string &text)
{
    const YAML::Node node(text);
    bool truth = false;
    int number = 0;
    double real = 0.0;
    if (text.size() > 1 && YAML::convert<bool>::decode(node, truth)) return XmlRpcValue(truth);
    if (YAML::convert<int>::decode(node, number)) return XmlRpcValue(number);
    if (text.find('.') != std::string::npos && YAML::convert<double>::decode(node, real))
        return XmlRpcValue(real);
    return XmlRpcValue(text);
}

XmlRpcValue scene_file_value(const std::string &text)
{
    try {
        return value_of(YAML::Load(text));
    } catch (const YAML::Exception &) {
        return XmlRpcValue(text);
    }
}

XmlRpcValue scene_file_read(const std::string &path)
{
    std::ifstream file(path);
    if (file.peek() == EOF && !file.eof())
        throw std::runtime_error(path + ": there is no such file, or it cannot be read");
    try {
        return members_of(YAML::Load(file));
    } catch (const YAML::Exception &error) {
        const std::string line = std::to_string(error.mark.line + 1);
        throw std::runtime_error(path + ": line " + line + ": " + error.msg);
    }
}
