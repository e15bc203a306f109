/** Every parameter as a scene file gives it, read, checked and run by the node's own functions in
 * this process: what is refused, by name, value and what is allowed, and what run_info says of the
 * rest. */
#include <gtest/gtest.h>

#include <dirent.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "hdlyap/RunInfo.h"
#include "message_fields.hpp"
#include "refused_together.hpp"
#include "wrapper/received.hpp"

#include "begin.h"
#include "refusals.hpp"

namespace
{
hdlyap::RunInfo published; /**< what was told last */
}

/** In place of the wrapper's, which needs a master. */
extern "C" hdr_status hdr_run_info_publish(hdr_publisher *, const hdr_run_info *message)
{
    const hdlyap_ros::sent<hdr_run_info> out = {*message};
    ros::SerializedMessage bytes = ros::serialization::serializeMessage(out);
    ros::serialization::deserializeMessage(bytes, published);
    return HDR_OK;
}

namespace
{
const std::string scene = "number: 20\ndensity: 0.7\naspect: 1.0\n"
                          "equilibration: 1.0\nwarmup: 1.0\nduration: 2.0\n";

const std::string window = "observables: [covariant]\ncovariant_transient: 1.0\n"
                           "covariant_window: 1.0\ncovariant_sampling: 1.0\n";

/** The scene with other lines: {a: 1, b: 2} stands for two, {covariant, .. has a window before. */
std::string with(const std::string &text)
{
    std::string lines = text[0] == '{' ? text.substr(1, text.size() - 2) : text;
    lines = std::regex_replace(lines, std::regex(", (?=\\w+: )"), "\n");
    return scene + std::regex_replace(lines, std::regex("^covariant\n"), window);
}

/** Parameters of a file with these lines. */
hdr_params *params_of(const std::string &lines)
{
    const std::string path = testing::TempDir() + "parameters." + std::to_string(getpid());
    hdr_params *params = nullptr;
    std::ofstream(path) << lines;
    EXPECT_EQ(hdr_params_read(&params, path.c_str(), 0, nullptr), HDR_OK) << hdr_error_text();
    std::remove(path.c_str());
    return params;
}

/** The line that refuses them; "" if the run is begun, and has said so in `published`. */
std::string begun(const std::string &lines, bool tiny = false)
{
    char line[512] = "";
    hdr_params *params = params_of(lines);
    const bool good = params && begin_run(params, tiny, line, sizeof line);
    EXPECT_EQ(good, !*line) << line;
    hdr_params_free(params);
    return line;
}

template <class Items> std::string listed(const Items &items)
{
    std::ostringstream text;
    for (size_t k = 0; k < items.size(); k++) text << (k ? ", " : "") << items[k];
    return "[" + text.str() + "]";
}

/** The value in effect of a parameter. */
std::string effect_of(const std::string &name)
{
    for (const hdlyap::Parameter &p : published.parameters)
        if (p.name == name) return p.effect;
    return "";
}

/** What run_info says, "name: value" in each line. */
std::string said()
{
    std::ostringstream text;
    text << std::setprecision(12) << "\n" << published;
    for (const hdlyap::Parameter &p : published.parameters)
        text << p.name << ": " << (p.kind == HDR_PARAMETER_LIST ? "[" + p.effect + "]" : p.effect)
             << "\n";
    text << "wave_nx: " << listed(published.wave_nx) << "\nwave_ny: " << listed(published.wave_ny)
         << "\n";
    return text.str();
}

/** wanted: "name: value, name: value". */
void expect_has(const std::string &wanted)
{
    std::istringstream each(std::regex_replace(wanted, std::regex(", (?=\\w+: )"), "\n"));
    for (std::string line; std::getline(each, line);)
        EXPECT_NE(said().find("\n" + line + "\n"), std::string::npos) << line << said();
}

/** Of a scene with these lines. */
void expect_said(const std::string &lines, const std::string &wanted)
{
    EXPECT_EQ(begun(with(lines)), "");
    expect_has(wanted);
}

/** A value of YAML as a message shows it: without quotes, numbers as short as they can be. */
std::string shown(const std::string &value)
{
    const bool quoted = value[0] == '\'';
    const std::string bare = std::regex_replace(value, std::regex("'"), "");
    if (quoted) return bare;
    if (bare == "true" || bare == "false") return bare == "true" ? "1" : "0";
    return std::regex_replace(bare, std::regex("\\.0\\b"), "");
}

/** They are refused as `name = value: must`, and then each of the words. A later line of the
 * same name replaces an earlier one. */
void expect_refused(const std::string &lines, const std::string &what,
                    const std::vector<std::string> &words)
{
    const std::string line = begun(lines), begin = what + ": ";
    EXPECT_TRUE(line.find(begin + "must ") == 0 || line.find(begin + "no such ") == 0) << line;
    for (const std::string &word : words) EXPECT_NE(line.find(word), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
}

/** Whether a text has a number that is rounded as it is there. */
bool says_number(std::string text, double number)
{
    for (size_t at; (at = text.find_first_of("0123456789")) != std::string::npos;) {
        size_t length;
        const double found = std::stod(text.substr(at), &length);
        if (std::fabs(found - number) <= 1e-4 * std::fabs(number)) return true;
        text = text.substr(at + length);
    }
    return false;
}

/** All rows, by what the values of their kind cannot be and by the ends of their ranges, which
 * their words say. */
TEST(Parameters, RefusedByTheirRows)
{
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        const std::string observed = p.needs == 1u << TOPIC_covariant ? window
                                     : p.needs == 1u << TOPIC_fluctuations
                                         ? "observables: [fluctuations]\n"
                                         : "";
        const std::string line = scene + observed + p.name + ": ";
        char allowed[PARAMETER_ALLOWED];
        parameter_allowed(allowed, &p);
        const bool by_word = p.kind == OF_SCENE && p.row->kind == HD_PARAMETER_INTERVAL;
        for (const kind_of_wrong &wrong : wrong_values(p))
            for (const std::string &value : wrong.values)
                expect_refused(line + value, std::string(p.name) + " = " + shown(value),
                               {by_word || wrong.words.empty() ? allowed : wrong.words});
        for (const double end : ends_of(p)) {
            if (end > 0.0 && (std::strstr(allowed, "or above") || std::strstr(allowed, "_window")))
                continue;
            EXPECT_EQ(begun(line + quoted(p, end), true).find(allowed), std::string::npos) << end;
            EXPECT_TRUE(says_number(allowed, end)) << p.name << end;
        }
    }
}

TEST(Parameters, RefusedTogether)
{
    for (const refused &one : refused_together)
        expect_refused(with(one.lines), one.what, one.words);
    /* by more than one of them: all are named */
    EXPECT_EQ(begun(with("{number: 100, aspect: 0.0001}")),
              "density = 0.7 with number = 100, aspect = 0.0001: the box edge Ly = "
              "0.119522860933439 must be above the disk diameter 1");
    EXPECT_EQ(begun(with("{covariant, number: 400, duration: 1000000.0, covariant_window: "
                         "100000.0}")),
              "covariant_window = 100000 with covariant_transient = 1: 150013 triangles and "
              "100007 frames of 797 vectors need 1.4e+03 GB, must be at most covariant_memory = 4 "
              "GB, as orthonormalisations are at most 6.45 time units apart; covariant_window = "
              "270 would fit");
}

TEST(Parameters, RefusedChanges)
{
    const refused changes[] = {
        {"[5pace=1]", "5pace=1", {"a simulated time and NAME=VALUE"}},
        {"[pace=1]", "pace=1", {"a simulated time and NAME=VALUE"}},
        {"['']", "", {"a simulated time and NAME=VALUE"}},
        {"['-5 pace=1']", "-5 pace=1", {"a simulated time and NAME=VALUE"}},
        {"['nan pace=1']", "nan pace=1", {"a simulated time and NAME=VALUE"}},
        {"['inf pace=1']", "inf pace=1", {"a simulated time and NAME=VALUE"}},
        {"['5 pace']", "5 pace", {"pace: must be one NAME=VALUE, such as pace=1.5"}},
        {"['5 pace=-1']", "5 pace=-1", {"pace=-1: must be from 0 ", " to 1e12"}},
        {"['5 pace=nan']", "5 pace=nan", {"pace=nan: must be from 0 ", " to 1e12"}},
        {"['5 pace=1', '6 number=50']", "6 number=50", {"number=50: is read at the start"}},
        {"['5 paces=1']", "5 paces=1", {"paces=1: no such parameter; is pace meant?"}},
    };
    for (refused one : changes) {
        one.words.push_back("changes that ~set can make: ");
        expect_refused(with(std::string("changes: ") + one.lines),
                       std::string("changes = ") + one.what, one.words);
    }
}

/** Of a scene, and of the node alone; a name of its own is a parameter. */
TEST(Parameters, OwnNamesAreNobodyElses)
{
    const hd_scene_def usual = hd_scene_def_default();
    for (const char *name : {"seed", "pace", "stiffness"}) {
        hd_dynamics rods = *hd_dynamics_of(&usual);
        hd_parameter own = {};
        own.name = name, own.kind = HD_PARAMETER_REAL, own.offset = HD_OWN(0);
        own.default_value = 1, own.max = 10, own.range = "from 0 to 10", own.unit = own.text = "";
        rods.particles = "rods", rods.parameter = &own, rods.parameters = 1;
        const hd_dynamics *const rows[] = {&rods};
        particles_register(rows, 1);
        const std::string line = begun(scene + name + ": 12\n");
        if (std::strcmp(name, "stiffness") == 0) {
            EXPECT_EQ(line, "stiffness = 12: must be from 0 to 10");
        } else {
            EXPECT_EQ(line, std::string("particles = rods: must have no parameter ") + name +
                                ": another parameter has this name");
        }
    }
    particles_register(nullptr, 0);
    particles_are(nullptr);
}

/** A coordinate that no message has, and one that is an angle. */
TEST(Parameters, MoreCoordinatesNeedAnInertia)
{
    hd_scene_def usual = hd_scene_def_default();
    usual.particles = HD_DUMBBELLS;
    hd_dynamics rods = *hd_dynamics_of(&usual);
    const hd_dynamics *const rows[] = {&rods};
    rods.particles = "rods";
    particles_register(rows, 1);
    EXPECT_EQ(begun(scene + "density: 0.5\nparticles: rods\n"), "");
    rods.inertia = nullptr;
    EXPECT_EQ(
        begun(scene + "density: 0.5\nparticles: rods\n"),
        "particles = rods: must be particles with a coordinate for each direction of their box, "
        "or with an angle and an inertia besides: messages have no fields for other coordinates");
    particles_register(nullptr, 0);
    particles_are(nullptr);
}

TEST(Parameters, ANameAloneChoosesNoScene)
{
    for (const char *lines : {"scene: quick", "scene: quick\nduration: 5.0"})
        expect_refused(lines, "scene = quick",
                       {"given with its particles, container, number, density, aspects or bound"});
    expect_said("", "scene: unnamed");
    expect_said("scene: mine", "scene: mine");
}

TEST(Parameters, Defaults)
{
    EXPECT_EQ(begun("", true), "");
    expect_has(
        "scene: paper_periodic, number: 780, density: 0.8, aspect: 0.867, exponents: positive, "
        "zero_exponents: 6, wave_nx: [1, 0, 1, 2, 0, 2, 1, 3], wave_ny: [0, 1, 1, 0, 2, 1, 2, 0]");
    EXPECT_NEAR(std::stod(effect_of("warmup")), 97.48, 0.01); /* 3 / (0.05 c_T k), c_T = 3.285 */
}

/** Whatever the node makes of them, in alphabetic order; equal values have one text. */
TEST(Parameters, AsTheyWereGiven)
{
    EXPECT_EQ(begun("number: 20\ndensity: 0.70\naspect: 1\nparticles: soft_disks\n"
                    "time_step: 0.0\nwarmup: auto\ninterval: auto\nduration: '2'\n"
                    "observables: [state,spectrum]\nchanges: ['5 report_interval=2.0']\n"),
              "");
    EXPECT_EQ(listed(published.given),
              "[aspect=1, changes=[5 report_interval=2.0], density=0.7, duration=2, interval=auto, "
              "number=20, observables=[state, spectrum], particles=soft_disks, time_step=0, "
              "warmup=auto]");
    EXPECT_EQ(effect_of("observables"), "spectrum, state");
    EXPECT_GT(std::stod(effect_of("warmup")), 0.0);
}

/** As rosparam would hand it over: YAML 1.1, also within a list that rosrun has as one text. */
TEST(Parameters, OfYaml)
{
    expect_said("number: +40", "number: 40");
    expect_said("{duration: .5, accuracy: 1.0e-7}", "duration: 0.5, accuracy: 1e-07");
    expect_said("{duration: 1., warmup: 1.0e1}", "duration: 1, warmup: 10");
    expect_said("{seed: '010', scene: 'on'}", "seed: 10, scene: on");
    expect_said("seed: !!str 7", "seed: 7");
    expect_said("scene: &name 'y'\nresume: ''", "scene: y");
    expect_said("observables: \"[spectrum, 'state']\"", "observables: [spectrum, state]");
    expect_said("changes: \"['1 pace=2', \\\"2 pace=3\\\"]\"", "duration: 2");
}

TEST(Parameters, Taken)
{
    const std::pair<const char *, const char *> taken[] = {
        /* each its own number, as a text or not */
        {"{duration: '1.5', accuracy: 1e-6, interval: 0.25, threads: 1, phase_interval: 0.5, "
         "equilibration: 3.0, warmup: '5', report_interval: 0.75, field_interval: '2.5', pace: 3, "
         "slow_vectors_rate: 0.125, slow_vectors_count: 4, checkpoint_interval: 7}",
         "duration: 1.5, accuracy: 1e-06, interval: 0.25, threads: 1, phase_interval: 0.5, "
         "equilibration: 3, warmup: 5, report_interval: 0.75, field_interval: 2.5, pace: 3, "
         "slow_vectors_rate: 0.125, slow_vectors_count: 4, checkpoint_interval: 7"},
        {"duration: 1e0", "duration: 1"},
        {"exponents: '5'", "exponents: 5, vectors: 5"},
        {"exponents: 5", "exponents: 5, vectors: 5"},
        {"exponents: all", "exponents: all, vectors: 80"},
        {"exponents: all_independent", "exponents: all_independent, vectors: 80"},
        {"exponents: positive", "exponents: positive, vectors: 37"},
        {"exponents: none", "exponents: none, vectors: 0, observables: [state], wave_nx: []"},
        {"seed: 7", "seed: 7"},
        {"seed: '18446744073709551615'", "seed: 18446744073709551615"},
        {"observables: []", "observables: []"},
        {"observables: [state, spectrum]", "observables: [spectrum, state]"},
        {"observables: [hydro, steps]", "observables: [steps, hydro]"},
        {"interval: auto", "interval: auto"},
        {"target: lambda_max 0.125", "target: lambda_max 0.125"},
        {"target: 'h_KS 1%, T(1,0) 0.2'", "target: h_KS 1%, T(1,0) 0.2"},
        {"target: ''", "target: "},
        {"boundary_x: reflecting",
         "boundary_x: reflecting, boundary_y: periodic, zero_exponents: 4"},
        {"boundary_y: reflecting",
         "boundary_x: periodic, boundary_y: reflecting, zero_exponents: 4"},
        {"{boundary_x: reflecting, boundary_y: reflecting, density: 0.3}", "zero_exponents: 2"},
        {"{boundary_y: shearing, density: 0.3}",
         "boundary_y: shearing, exponents: all, vectors: 80, zero_exponents: 3"},
        {"{boundary_y: shearing, density: 0.3, exponents: 3}", "exponents: 3, vectors: 3"},
        {"{shear_b: 2}", "shear_b: 2, exponents: positive"}, /* it does not matter */
        {"{number: 30, density: 0.5, aspect: 0.6}",
         "number: 30, density: 0.5, aspect: 0.6, box_x: 10, box_y: 6"},
        {"max_mode_number: 1", "max_mode_number: 1, wave_nx: [1, 0, 1], wave_ny: [0, 1, 1]"},
        {"max_wave_number: '1.2'", "max_wave_number: 1.2, wave_nx: [1, 0], wave_ny: [0, 1]"},
        {"{max_wave_number: 0, max_mode_number: 0, observables: [spectrum]}",
         "max_wave_number: 0, max_mode_number: 0, wave_nx: [], wave_ny: []"},
        {"{field_indices: steps, exponents: none}", "field_indices: steps, wave_nx: []"},
        {"field_indices: [37, 1]", "field_indices: [37, 1]"},
        {"{field_interval: 0, observables: [state]}", "field_interval: 0, observables: [state]"},
        {"wait_for_subscribers: [run_info]", "wait_for_subscribers: [run_info]"},
        {"{observables: [state], wait_for_subscribers: all}",
         "wait_for_subscribers: [run_info, state, status, cost]"},
        {"changes: ['0 duration=9']", "duration: 2"}, /* made when it runs */
        {"{covariant_window: 50, covariant_transient: '100', covariant_sampling: 5.0, "
         "covariant_memory: 4}",
         "covariant_memory: 4"},
        {"{covariant, max_mode_number: 1, exponents: 3}",
         "observables: [covariant], wave_nx: [1, 0, 1], covariant_window: 1, covariant_transient: "
         "1"},
        {"{covariant, duration: 3.0, covariant_memory: '0.25', covariant_sampling: 0.5}",
         "covariant_memory: 0.25, covariant_sampling: 0.5, covariant_transient: 1"},
        {"{checkpoint: '', resume: ''}", "checkpoint: , resume: , resumed_time: -1"},
    };
    for (const auto &one : taken) expect_said(one.first, one.second);
}

/** Of a scene of the package: what a line of it says. */
void check_scene(const std::string &file)
{
    std::ifstream scene_file(HDLYAP_SCENES "/" + file);
    std::ostringstream lines;
    lines << scene_file.rdbuf();
    EXPECT_EQ(begun(lines.str(), true), "") << file;
    EXPECT_EQ(effect_of("scene") + ".yaml", file);
    hdr_params *params = params_of(lines.str());
    EXPECT_TRUE(file != "paper_periodic.yaml" || hdr_params_count(params) == parameters_count());
    for (int k = 0; k < hdr_params_count(params); k++) {
        const std::string name = hdr_params_name(params, k),
                          value = hdr_param_text(params, name.c_str());
        const parameter p = parameters_named(name.c_str());
        char usual[PARAMETER_TEXT];
        parameter_usual(usual, &p);
        EXPECT_TRUE(file == "paper_periodic.yaml" || value != usual) << file << ": " << name;
        static const std::set<std::string> others{"threads", "changes", "table", "boundary_z"};
        if (others.count(name)) continue; /* of the machine; none; of the log; of spheres */
        if (value == "auto" && name == "warmup")
            EXPECT_GE(std::stod(effect_of("warmup")), 20.0);
        else
            EXPECT_NE(said().find("\n" + name + ": " + value + "\n"), std::string::npos)
                << file << ": " << name << ": " << value << said();
    }
    hdr_params_free(params);
}

/** Each scene that comes with the package: what it lists is what its run is, and not as usual;
 * paper_periodic lists all. */
TEST(Parameters, Scenes)
{
    int scenes = 0;
    DIR *folder = opendir(HDLYAP_SCENES);
    ASSERT_TRUE(folder);
    while (const dirent *file = readdir(folder)) {
        if (file->d_name[0] == '.' || std::strncmp(file->d_name, "spheres", 7) == 0) continue;
        scenes++;
        check_scene(file->d_name);
    }
    closedir(folder);
    EXPECT_GE(scenes, 17);
}
} // namespace
