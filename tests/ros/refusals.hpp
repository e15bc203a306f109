/** What no parameter can be, whatever else a scene says: a row for each rule. */
#ifndef REFUSALS_HPP
#define REFUSALS_HPP

#include <string>
#include <vector>

/** Values that are refused whatever else is given, by the words that say what they must be. */
struct refusal {
    const char *name, *must_be;
    std::vector<std::string> values;
};

#define OBSERVABLES                                                                                \
    "spectrum, modes, steps, lp_phases, t_phases, fields, hydro, structure, covariant, "           \
    "localization, gas, state"
#define EXPONENTS "positive, all, all_independent, none or a number from 1 to 4 disks"
#define SEED "a string of digits, from \"0\" to \"18446744073709551615\""
#define FOR_CHANGES "changes that ~set can make: "

const std::vector<std::string> no_number = {"x", "''", "[1.0]", "true", "1 2"};
const std::vector<std::string> no_integer = {"1.0", "'2'",   "x",  "''",
                                             "[2]", "false", "08", "0.30000000000000004"};
const std::vector<std::string> no_time = {"-1", "-1e-09", "'2000000000000'", "nan", "inf"};
const std::vector<std::string> no_length = {"0", "-1", "0.9e-6", "'2000000000000'", "nan", "inf"};
const std::vector<std::string> no_interval = {"0",   "0.0", "-1",  "'2000000000000'", "never", "''",
                                              "nan", "inf", "true"};

const std::vector<refusal> refusals = {
    {"scene", "a string", {"5", "[quick]", "true"}},
    {"scene", "a line that is not empty", {"''"}},
    {"disks", "an integer, without a point", no_integer},
    {"container", "rectangle or circle", {"square", "''", "1"}},
    {"disks", "an integer from 1 to 1000000", {"0", "-3", "1000001"}},
    {"density", "a number", no_number},
    {"density", "from 1e-6 to 2/sqrt(3) = 1.1547", {"0", "-0.1", "1.1548", "nan", "inf"}},
    {"aspect", "a number", no_number},
    {"aspect", "from 1e-6 to 1e6", {"0", "-1", "10000000", "nan", "inf"}},
    {"boundary_x", "periodic or reflecting", {"open", "''", "1", "Periodic"}},
    {"boundary_y", "periodic or reflecting", {"open", "''", "1", "[periodic]"}},
    {"boundary_z", "periodic or reflecting", {"open", "''", "1", "[periodic]"}},
    {"aspect_z", "a number", no_number},
    {"aspect_z", "from 1e-6 to 1e6", {"0", "-1", "10000000", "nan", "inf"}},
    {"dimensions", "an integer, without a point", no_integer},
    {"dimensions",
     "2: disks; hdlyap_node_3d is for spheres (run.launch dimensions:=3)",
     {"0", "1", "3", "4"}},
    {"seed",
     SEED,
     {"''", "'-1'", "'+1'", "' 1'", "'1.5'", "'0x1'", "x", "'18446744073709551616'", "1.0", "-1",
      "true"}},
    {"exponents",
     EXPONENTS,
     {"some", "''", "'0'", "'-1'", "'1.0'", "0", "-1", "-2", "2.0", "'99999999999'", "[all]"}},
    {"exponents", "positive, all, all_independent, none or from 1 to 4 disks = 80", {"81", "'81'"}},
    {"equilibration", "a number", no_number},
    {"equilibration", "from 0 to 1e12", no_time},
    {"warmup", "auto, or from 0 to 1e12", no_number},
    {"warmup", "auto, or from 0 to 1e12", no_time},
    {"duration", "a number", no_number},
    {"duration", "from 0 (until stopped) to 1e12", no_time},
    {"target",
     "quantities with their errors, as lambda_max 0.01, c_T 1%, T(1,0) 0.5%",
     {"5", "0.01", "true", "[lambda_max]"}},
    {"interval", "auto, or from 1e-6 to 1e12", no_interval},
    {"accuracy", "a number", no_number},
    {"accuracy", "from 1e-12 to 1e-2", {"0", "9e-13", "0.011", "nan", "inf"}},
    {"report_interval", "a number", no_number},
    {"report_interval", "from 1e-6 to 1e12", {"0", "-1", "'2000000000000'", "nan", "inf"}},
    {"phase_interval", "auto, or from 1e-6 to 1e12", no_interval},
    {"observables",
     "a list out of " OBSERVABLES,
     {"[covariants]", "[modes, covariance]", "[run_info]", "[cost]", "[spectra]", "['']",
      "spectrum", "5", "[1]", "true"}},
    {"wait_for_subscribers",
     "all or a list out of run_info, " OBSERVABLES ", status, cost",
     {"[nothing]", "[spectrum, '']", "spectrum", "5", "[1]"}},
    {"threads", "an integer, without a point", no_integer},
    {"threads", "from 0 (all cores) to 1024", {"-1", "1025"}},
    {"pace", "a number", no_number},
    {"pace", "from 0 (as fast as it goes) to 1e12", no_time},
    {"slow_vectors_rate", "a number", no_number},
    {"slow_vectors_rate", "from 0.01 to 100", {"0", "0.0099", "101", "nan"}},
    {"slow_vectors_count", "an integer, without a point", no_integer},
    {"slow_vectors_count",
     "from 0 (the lowest T and LP steps) to 37, the vectors carried",
     {"-1", "38"}},
    {"max_wave_number", "a number", no_number},
    {"max_wave_number", "0 (by max_mode_number) or above", {"-1", "'2000000000000'", "nan", "inf"}},
    {"max_mode_number", "an integer, without a point", no_integer},
    {"max_mode_number", "from 0 (automatic) to 1000000", {"-1", "1000001"}},
    {"field_indices",
     "steps or a list of integers from 1",
     {"''", "all", "Steps", "5", "1.0", "[]", "['1']", "[1.0]", "[1, steps]"}},
    {"field_indices",
     "steps or a list of integers from 1 to 37, the vectors carried",
     {"[0]", "[-1]", "[38]", "[1, 2, 1000000]"}},
    {"field_interval", "a number", no_number},
    {"field_interval", "from 0 (with every report) to 1e12", no_time},
    {"changes", "a list of texts \"TIME NAME=VALUE\"", {"5 pace=1", "5", "[5]"}},
    {"checkpoint", "a string", {"5", "true", "[file]"}},
    {"checkpoint_interval", "a number", no_number},
    {"checkpoint_interval", "from 0 (only at the end and when asked) to 1e12", no_time},
    {"resume", "a string", {"5", "true", "[file]"}},
    {"table", "a number", no_number},
    {"table", "from 0 (none) to 1e12", no_time},
    {"covariant_window", "a number", no_number},
    {"covariant_transient", "a number", no_number},
    {"covariant_sampling", "a number", no_number},
    {"covariant_memory", "a number", no_number},
    {"covariant_storage", "memory or recompute", {"''", "disk", "file", "Memory", "5", "[memory]"}},
    {"thickness", "removed: there is no parameter of this name", {"0.8"}},
    {"densty", "removed: there is no parameter of this name; is density meant?", {"0.8"}},
    {"Disks", "removed: there is no parameter of this name; is disks meant?", {"100"}},
    {"warmpu", "removed: there is no parameter of this name; is warmup meant?", {"100"}},
};

#endif
