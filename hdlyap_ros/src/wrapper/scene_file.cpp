/** YAML -> XML-RPC values. */
#include "scene_file.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <yaml-cpp/yaml.h>

using XmlRpc::XmlRpcValue;

namespace
{
/** Words without quotes to which YAML 1.1, and so rosparam, gives another meaning than they seem
 * to have. They are refused in files, as are all numbers that are not decimal. */
const struct {
    std::regex word;
    const char *must_be;
} refused[] = {
    {std::regex("[-+]?(0[0-7_]+|0b[01_]+|0x[0-9a-fA-F_]+|[0-9][0-9_]*(:[0-5]?[0-9])+(\\.[0-9_]*)?|"
                "[0-9][0-9_]*_[0-9_]*|[0-9][0-9_]*\\.[0-9_]*([eE][-+][0-9]+)?)|\\.[0-9][0-9_]*([eE]"
                "[-+][0-9]+)?"),
     "a number in decimal digits, or a text in quotes: rosparam (YAML 1.1) reads another number"},
    {std::regex("[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}.*|(deg|rad)\\([^)]*\\)|<<|="),
     "in quotes: rosparam (YAML 1.1) reads something else"},
    {std::regex("~|null|Null|NULL|"), "a value; an empty text is ''"},
};

const std::regex whole("[-+]?(0|[1-9][0-9]*)");
const std::regex real("[-+]?[0-9]+\\.[0-9]*([eE][-+][0-9]+)?|\\.[0-9]+([eE][-+][0-9]+)?");
const std::regex infinite("([-+]?)\\.(inf|Inf|INF)"), no_number("\\.(nan|NaN|NAN)");

[[noreturn]] void refuse(const std::string &text, const char *must_be)
{
    throw std::invalid_argument(text + ": must be " + must_be);
}

XmlRpcValue integer_of(const std::string &text)
{
    const long long number = std::strtoll(text.c_str(), nullptr, 10); /* the nearest one it holds */
    if (number != static_cast<int>(number))
        refuse(text, "in quotes: ROS carries no integer of more than 32 bits");
    return XmlRpcValue(static_cast<int>(number));
}

/** The value that rosparam gives to a word without quotes. Throws std::invalid_argument if the
 * word is refused. */
XmlRpcValue word_of(const std::string &text)
{
    bool truth = false;
    if (text.size() > 1 && YAML::convert<bool>::decode(YAML::Node(text), truth))
        return XmlRpcValue(truth);
    if (std::regex_match(text, whole)) return integer_of(text);
    if (std::regex_match(text, real)) return XmlRpcValue(std::strtod(text.c_str(), nullptr));
    if (std::regex_match(text, no_number)) return XmlRpcValue(std::nan(""));
    if (std::regex_match(text, infinite)) return XmlRpcValue(text[0] == '-' ? -HUGE_VAL : HUGE_VAL);
    for (const auto &row : refused)
        if (std::regex_match(text, row.word)) refuse(text, row.must_be);
    return XmlRpcValue(text);
}

XmlRpcValue scalar_of(const YAML::Node &node)
{
    const std::string tag = node.Tag(), text = node.IsNull() ? "" : node.Scalar();
    if (!node.IsScalar() && !node.IsNull())
        throw YAML::Exception(node.Mark(),
                              "a parameter must be a number, a word or a list of these");
    if (tag == "!" || tag == "tag:yaml.org,2002:str") return XmlRpcValue(text); /* in quotes */
    if (!tag.empty() && tag != "?")
        throw YAML::Exception(node.Mark(), "a parameter must have no YAML tag, but has " + tag);
    return word_of(text);
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
            throw YAML::Exception(pair.first.Mark(), "the name of a parameter must be a word");
        const std::string name = pair.first.Scalar();
        try {
            all[name] = value_of(pair.second);
        } catch (const std::invalid_argument &error) {
            throw YAML::Exception(pair.first.Mark(), name + " = " + error.what());
        }
    }
    return all;
}

XmlRpcValue members_of_all(const std::vector<YAML::Node> &documents)
{
    if (documents.size() > 1)
        throw YAML::Exception(documents[1].Mark(), "must be one document, without ---");
    return members_of(documents.empty() ? YAML::Node() : documents[0]);
}
} // namespace

XmlRpcValue scene_file_value(const std::string &text)
{
    try {
        return value_of(YAML::Load(text));
    } catch (const std::exception &) {
        return XmlRpcValue(text);
    }
}

XmlRpcValue scene_file_read(const std::string &path)
{
    std::ifstream file(path);
    std::ostringstream text;
    if (file.peek() == EOF && !file.eof())
        throw std::runtime_error(path + ": there is no such file, or it cannot be read");
    text << file.rdbuf();
    return scene_file_parse(text.str(), path);
}

XmlRpcValue scene_file_parse(const std::string &text, const std::string &path)
{
    try {
        return members_of_all(YAML::LoadAll(text));
    } catch (const YAML::Exception &error) {
        const std::string line = std::to_string(error.mark.line + 1);
        throw std::runtime_error(path + ": line " + line + ": " + error.msg);
    }
}
