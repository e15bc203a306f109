/** What no parameter can be, whatever else a scene says: values for each kind of them. */
#ifndef REFUSALS_HPP
#define REFUSALS_HPP

#include <string>
#include <vector>

extern "C" {
#include "node/parameters.h"
#include "node/particles.h"
#include "topics/topic.h"
}

#define OF_VECTORS                                                                                 \
    "0 without an observable out of modes, steps, lp_phases, t_phases, fields, hydro, structure, " \
    "covariant"
#define NO_EXPONENTS "a list out of gas, state when exponents = none"
#define UNSEEN "unless covariant is an observable"

/** Values, and words that say what is wrong; none: what is allowed. */
struct kind_of_wrong {
    std::vector<std::string> values;
    std::string words;
};

/** Least and most, of a number that has them. */
inline std::vector<double> ends_of(const parameter &p)
{
    if (p.kind != OF_SCENE)
        return p.max > p.min ? std::vector<double>{p.min, p.max} : std::vector<double>{};
    const bool is_number = p.row->kind == HD_PARAMETER_INT || p.row->kind == HD_PARAMETER_REAL;
    if (is_number) return {p.row->min, p.row->max};
    if (p.row->kind != HD_PARAMETER_INTERVAL) return {};
    return {p.row->min, p.row->max};
}

inline bool is_whole(const parameter &p)
{
    return p.kind == WHOLE_NUMBER || (p.kind == OF_SCENE && p.row->kind == HD_PARAMETER_INT);
}

/** As a scene file has it: more digits than an integer of YAML may have are in quotes. */
inline std::string quoted(const parameter &p, double number)
{
    char text[40];
    snprintf(text, sizeof text, number > 1e9 ? "'%.0f'" : is_whole(p) ? "%.0f" : "%.10g", number);
    return text;
}

inline std::vector<std::string> beyond(const parameter &p)
{
    std::vector<std::string> found = {"-1"};
    const std::vector<double> ends = ends_of(p);
    if (ends.empty()) return {};
    for (const double end : {ends[0] > 0.0 ? 0.999 * ends[0] : -1e-9, 1.001 * ends[1]})
        if (!is_whole(p)) found.push_back(quoted(p, end));
    for (const double end : {ends[0] - 1.0, ends[1] + 1.0})
        if (is_whole(p)) found.push_back(quoted(p, end));
    if (!is_whole(p)) found.insert(found.end(), {"nan", "inf"});
    return found;
}

inline std::vector<kind_of_wrong> wrong_values(const parameter &p)
{
    const std::vector<std::string> no_number = {"x", "''", "[1.0]", "true", "1 2"},
                                   no_integer = {"1.0", "'2'",   "x",  "''",
                                                 "[2]", "false", "08", "0.30000000000000004"},
                                   no_string = {"5", "true", "[file]"};
    if (is_whole(p)) return {{no_integer, "an integer, without a point"}, {beyond(p), ""}};
    if (p.kind == OF_SCENE) switch (p.row->kind) {
        case HD_PARAMETER_WORD: return {{{"open", "''", "1", "Periodic", "[periodic]"}, ""}};
        case HD_PARAMETER_TEXT: return {{{"5", "0.01", "true", "[lambda_max]"}, ""}};
        case HD_PARAMETER_SEED:
            return {{{"''", "'-1'", "'+1'", "' 1'", "'1.5'", "'0x1'", "x", "'18446744073709551616'",
                      "1.0", "-1", "true"},
                     ""}};
        case HD_PARAMETER_EXPONENTS:
            return {{{"some", "''", "'0'", "'-1'", "'1.0'", "0", "-1", "-2", "2.0", "'99999999999'",
                      "[all]"},
                     ""}};
        default: return {{no_number, "a number"}, {{"never"}, "a number"}, {beyond(p), ""}};
        }
    switch (p.kind) {
    case REAL_NUMBER: return {{no_number, "a number"}, {beyond(p), ""}};
    case NAME: return {{no_string, "a string"}, {{"''"}, ""}};
    case FILE_PATH: return {{no_string, "a string"}};
    case CHOICE: return {{{"''", "or", "Wait", "wait or drop", "5", "true", "[wait]"}, ""}};
    case FIELD_CHOICE:
        return {{{"''", "all", "Steps", "5", "1.0", "[]", "['1']", "[1.0]", "[1, steps]"}, ""}};
    case CHANGES: return {{{"5 pace=1", "5", "[5]"}, ""}};
    default: /* topics */
        return {{{"[covariants]", "[modes, covariance]", "[spectra]", "['']", "spectrum", "5",
                  "[1]", "true"},
                 ""}};
    }
}

#endif
