/** Numbers, texts, lists and structs -> JSON. */
#pragma once

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <utility>

namespace
{
/** Members of an object; + joins them. */
struct members {
    std::string text;
};
members operator+(const members &one, const members &other)
{
    return {one.text + (one.text.empty() || other.text.empty() ? "" : ",") + other.text};
}

struct json {
    std::string text;
    template <class Number, class = decltype(double(Number()))> json(Number x)
    {
        char digits[32];
        std::snprintf(digits, sizeof digits, "%.17g", double(x));
        text = std::isnan(double(x)) ? "NaN" : std::isinf(double(x)) ? "Infinity" : digits;
    }
    json(const char *line) : text("\"" + std::string(line) + "\"") {}
    json(const members &of) : text("{" + of.text + "}") {}
    template <class Number, size_t count> json(const Number (&x)[count]) : text("[")
    {
        for (const Number &one : x) text += (text.size() > 1 ? "," : "") + json(one).text;
        text += "]";
    }
    json() : text("[") {}
};

template <class Value> json list(int count, Value value)
{
    json all;
    for (int k = 0; k < count; k++) all.text += (k > 0 ? "," : "") + json(value(k)).text;
    all.text += "]";
    return all;
}

json numbers(const double *x, int count, int stride = 1)
{
    return list(count, [=](int k) { return x[size_t(k) * size_t(stride)]; });
}

members named(std::initializer_list<std::pair<const char *, json>> all)
{
    members out;
    for (const auto &one : all)
        out = out + members{"\"" + std::string(one.first) + "\":" + one.second.text};
    return out;
}
} // namespace
