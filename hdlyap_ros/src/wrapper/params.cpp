/** Private parameters: an XML-RPC struct, from the master or a file -> typed values. */
#include "hdlyap_ros/params.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <ros/ros.h>

#include "guard.hpp"
#include "node.hpp"
#include "scene_file.hpp"

using XmlRpc::XmlRpcValue;

namespace
{
/** The meaning of a string that rosrun passes on: _name:=[a, b] is a list of its items, and
 * _name:="'5'" a string without the quotes. Returns any other value unchanged. */
XmlRpcValue listed(XmlRpcValue &value)
{
    if (value.getType() != XmlRpcValue::TypeString) return value;
    const std::string text = value;
    const std::string ends = text.size() > 1 ? std::string{text.front(), text.back()} : "";
    return ends == "[]" || ends == "''" || ends == "\"\"" ? scene_file_value(text) : value;
}

/** A number in the fewest digits that distinguish it from every other number. */
std::string number_text(double number)
{
    std::ostringstream text;
    for (int digits = 6; digits <= 17; digits++) {
        text.str("");
        text.precision(digits);
        text << number;
        if (std::strtod(text.str().c_str(), nullptr) == number) break;
    }
    return text.str();
}

/** The text of a value: the contents of a string, or a list as YAML writes it. Equal values have
 * the same text, however they were written. */
std::string param_text(XmlRpcValue &given)
{
    std::ostringstream text;
    XmlRpcValue value = listed(given);
    if (value.getType() == XmlRpcValue::TypeString) return value;
    if (value.getType() == XmlRpcValue::TypeDouble) return number_text(value);
    if (value.getType() != XmlRpcValue::TypeArray) return value.write(text), text.str();
    for (int k = 0; k < value.size(); k++) text << (k ? ", " : "") << param_text(value[k]);
    return "[" + text.str() + "]";
}

struct entry {
    XmlRpcValue value;
    std::string text;                 /**< see param_text */
    std::vector<std::string> strings; /**< the items of a list of strings */
    std::vector<const char *> list; /**< pointers into strings, which stay when an entry is moved */
    std::vector<int> integers;      /**< the items of a list of integers */
};

bool is_list(XmlRpcValue &value, XmlRpcValue::Type type)
{
    if (value.getType() != XmlRpcValue::TypeArray) return false;
    for (int k = 0; k < value.size(); k++)
        if (value[k].getType() != type) return false;
    return true;
}

entry make_entry(XmlRpcValue &given)
{
    XmlRpcValue value = listed(given);
    entry made;
    made.value = value;
    made.text = param_text(value);
    if (is_list(value, XmlRpcValue::TypeString))
        for (int k = 0; k < value.size(); k++) made.strings.push_back(value[k]);
    for (const std::string &item : made.strings) made.list.push_back(item.c_str());
    if (is_list(value, XmlRpcValue::TypeInt))
        for (int k = 0; k < value.size(); k++) made.integers.push_back(value[k]);
    return made;
}

bool number_parse(const std::string &text, double *out)
{
    char *end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') return false;
    *out = number;
    return true;
}
} // namespace

struct hdr_params {
    std::map<std::string, entry> entries;
    std::vector<std::string> arguments; /**< as in hdr_node, and those of run.launch */
    std::unique_ptr<hdr_params> file;   /**< what the scene's file says; NULL without one */
    std::string path;                   /**< of the scene's file */
};

namespace
{
const entry *find(const hdr_params *params, const char *name)
{
    const auto found = params->entries.find(name);
    return found == params->entries.end() ? nullptr : &found->second;
}

/** Reads a value if it has this type. T is the C++ type in which XmlRpc keeps it. */
template <class T>
hdr_status read(const hdr_params *params, const char *name, XmlRpcValue::Type type, T *out)
{
    const entry *found = find(params, name);
    if (!found) return HDR_MISSING;
    if (found->value.getType() != type) return HDR_WRONG_TYPE;
    *out = static_cast<T &>(const_cast<XmlRpcValue &>(found->value));
    return HDR_OK;
}

/** Reads a list if all its items have this type. list: the member of entry that keeps it. */
template <class Item> hdr_status read_list(const hdr_params *params, const char *name,
                                           XmlRpcValue::Type type, std::vector<Item> entry::*list,
                                           const Item **out, int *count)
{
    const entry *found = find(params, name);
    if (!found) return HDR_MISSING;
    if (!is_list(const_cast<XmlRpcValue &>(found->value), type)) return HDR_WRONG_TYPE;
    *out = (found->*list).data();
    *count = static_cast<int>((found->*list).size());
    return HDR_OK;
}

std::unique_ptr<hdr_params> made_of(XmlRpcValue &all)
{
    std::unique_ptr<hdr_params> params(new hdr_params);
    for (auto &member : all) params->entries[member.first] = make_entry(member.second);
    return params;
}

/** The value of an argument, as rosrun reads it: it is not YAML, and 010 is 10. An integer too long
 * for ROS stays a text. */
XmlRpcValue argument_value(const std::string &text)
{
    char *end = nullptr;
    errno = 0;
    const long whole = std::strtol(text.c_str(), &end, 10);
    double real = 0.0;
    if (text == "true" || text == "false") return XmlRpcValue(text == "true");
    if (!text.empty() && !*end && !errno && whole == static_cast<int>(whole))
        return XmlRpcValue(static_cast<int>(whole));
    if (text.find('.') != std::string::npos && number_parse(text, &real)) return XmlRpcValue(real);
    return XmlRpcValue(text);
}

/** Sets a parameter from an argument name:=value or _name:=value. */
void replace(XmlRpcValue &all, const std::string &argument)
{
    const size_t first = argument.compare(0, 1, "_") == 0, sign = argument.find(":=");
    if (sign == std::string::npos || sign == first)
        throw std::runtime_error("argument " + argument + ": must be parameter:=value");
    all[argument.substr(first, sign - first)] = argument_value(argument.substr(sign + 2));
}

XmlRpcValue fetch(const std::string &name)
{
    XmlRpcValue all;
    all.begin(); /* a struct, also without members */
    if (!ros::param::get(name, all) && !ros::master::check())
        throw std::runtime_error("the ROS master went away");
    if (all.getType() != XmlRpcValue::TypeStruct)
        throw std::runtime_error("parameter " + name + " is not a namespace");
    return all;
}

/** The parameters in lines NAME:=VALUE. One without a value is not given. */
XmlRpcValue lines_of(const std::string &text)
{
    XmlRpcValue all;
    std::istringstream lines(text);
    all.begin(); /* a struct, also without members */
    for (std::string line; std::getline(lines, line);)
        if (line.find(":=") + 2 < line.size()) replace(all, line);
    return all;
}

void put(XmlRpcValue &to, XmlRpcValue &from)
{
    for (auto &member : from) to[member.first] = member.second;
}

/** Refuses a parameter that arguments and params give two values. */
void check_once(XmlRpcValue &arguments, XmlRpcValue &params)
{
    for (auto &member : arguments) {
        if (!params.hasMember(member.first)) continue;
        const std::string one = param_text(member.second), other = param_text(params[member.first]);
        if (one != other)
            throw std::runtime_error(member.first + " = " + one + ": must be " + other +
                                     ", which params says");
    }
}

/** The namespace in which run.launch hands over what it was given. */
const char *const LAUNCH = "launch";

/** Parameters of the server, and below them what run.launch was given. */
std::unique_ptr<hdr_params> launched(XmlRpcValue &server)
{
    const auto text = [&](const char *name) {
        if (!server[LAUNCH].hasMember(name)) return std::string();
        XmlRpcValue &value = server[LAUNCH][name];
        if (value.getType() != XmlRpcValue::TypeString)
            throw std::runtime_error("~launch/" + std::string(name) +
                                     ": must be a text, as run.launch hands it over");
        return std::string(value);
    };
    const std::string path = text("file");
    XmlRpcValue file = lines_of(text("usual")), scene = scene_file_parse(text("scene"), path),
                params = scene_file_parse(text("params"), "params"),
                given = lines_of(text("arguments"));
    check_once(given, params);
    put(file, scene);
    put(given, params);
    XmlRpcValue all = file;
    put(all, given);
    for (auto &member : server)
        if (member.first != LAUNCH) all[member.first] = member.second;
    std::unique_ptr<hdr_params> made = made_of(all);
    for (auto &member : given) made->arguments.push_back("_" + member.first + ":=");
    if (!path.empty()) made->file = made_of(file);
    made->path = path;
    return made;
}

void write(const hdr_node *node, const std::string &name, const XmlRpcValue &value)
{
    if (hdr_guard([&] { node->watch->write(node->name + "/" + name, value); }) != HDR_OK)
        hdr_log(HDR_ERROR, "%s is not written to the parameter server: %s", name.c_str(),
                hdr_error_text());
}
} // namespace

hdr_status hdr_params_read(hdr_params **out, const char *path, int count, char *const *replaced)
{
    *out = nullptr;
    return hdr_guard([&] {
        XmlRpcValue all = scene_file_read(path);
        for (int k = 0; k < count; k++) replace(all, replaced[k]);
        *out = made_of(all).release();
    });
}

hdr_status hdr_params_create(hdr_params **out, const hdr_node *node)
{
    *out = nullptr;
    return hdr_guard([&] {
        XmlRpcValue server = fetch(node->name);
        const bool is_launched = server.hasMember(LAUNCH) && server[LAUNCH].hasMember("arguments");
        if (is_launched) ros::param::del(node->name + "/" + LAUNCH); /* `server` is a copy */
        std::unique_ptr<hdr_params> made = is_launched ? launched(server) : made_of(server);
        for (const std::string &one : node->arguments) made->arguments.push_back(one);
        for (const auto &member : made->entries)
            if (!server.hasMember(member.first)) write(node, member.first, member.second.value);
        *out = made.release();
    });
}

void hdr_param_write_double(hdr_node *node, const char *name, double value)
{
    write(node, name, XmlRpcValue(value));
}

void hdr_param_write_string(hdr_node *node, const char *name, const char *value)
{
    write(node, name, XmlRpcValue(value));
}

const hdr_params *hdr_params_file(const hdr_params *params, const char **path)
{
    *path = params->path.c_str();
    return params->file.get();
}

bool hdr_param_is_argument(const hdr_params *params, const char *name)
{
    const std::string begin = "_" + std::string(name) + ":=";
    return std::any_of(params->arguments.begin(), params->arguments.end(),
                       [&](const auto &one) { return one.compare(0, begin.size(), begin) == 0; });
}

void hdr_params_warn_of_renaming(const hdr_params *params, bool (*is_parameter)(const char *name))
{
    for (const std::string &argument : params->arguments)
        if (is_parameter(argument.substr(0, argument.find(":=")).c_str()))
            hdr_log(HDR_WARN, "argument %s renames a topic and sets no parameter: is _%s meant?",
                    argument.c_str(), argument.c_str());
}

void hdr_params_free(hdr_params *params) { delete params; }

int hdr_params_count(const hdr_params *params) { return static_cast<int>(params->entries.size()); }

const char *hdr_params_name(const hdr_params *params, int k)
{
    if (k < 0 || k >= hdr_params_count(params)) return nullptr;
    return std::next(params->entries.begin(), k)->first.c_str();
}

const char *hdr_params_unknown(const hdr_params *params, const char *const *known)
{
    for (const auto &member : params->entries) {
        const char *const *same = known;
        while (*same && member.first != *same) same++;
        if (!*same) return member.first.c_str();
    }
    return nullptr;
}

const char *hdr_param_text(const hdr_params *params, const char *name)
{
    const entry *found = find(params, name);
    return found ? found->text.c_str() : "";
}

hdr_status hdr_param_bool(const hdr_params *params, const char *name, bool *out)
{
    return read(params, name, XmlRpcValue::TypeBoolean, out);
}

hdr_status hdr_param_int(const hdr_params *params, const char *name, int *out)
{
    return read(params, name, XmlRpcValue::TypeInt, out);
}

hdr_status hdr_param_double(const hdr_params *params, const char *name, double *out)
{
    int integer = 0;
    const hdr_status status = read(params, name, XmlRpcValue::TypeDouble, out);
    if (status != HDR_WRONG_TYPE) return status;
    if (hdr_param_int(params, name, &integer) == HDR_OK) return *out = integer, HDR_OK;
    const entry *found = find(params, name);
    const bool text = found->value.getType() == XmlRpcValue::TypeString;
    return text && number_parse(found->text, out) ? HDR_OK : HDR_WRONG_TYPE;
}

hdr_status hdr_param_string(const hdr_params *params, const char *name, const char **out)
{
    const entry *found = find(params, name);
    if (!found) return HDR_MISSING;
    if (found->value.getType() != XmlRpcValue::TypeString) return HDR_WRONG_TYPE;
    *out = found->text.c_str();
    return HDR_OK;
}

hdr_status hdr_param_string_list(const hdr_params *params, const char *name,
                                 const char *const **out, int *count)
{
    return read_list(params, name, XmlRpcValue::TypeString, &entry::list, out, count);
}

hdr_status hdr_param_int_list(const hdr_params *params, const char *name, const int **out,
                              int *count)
{
    return read_list(params, name, XmlRpcValue::TypeInt, &entry::integers, out, count);
}
