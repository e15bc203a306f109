/** Rows of parameters -> texts for users. */
#define _GNU_SOURCE /* program_invocation_short_name */
#include "parameters_text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hdlyap/hdlyap.h"
#include "parameters.h"
#include "particles.h"

enum { LINE_WIDTH = 100 };

static const char *const head =
    "Every parameter of %s, with its default. Reduced units: particle mass 1, diameter "
    "sigma = 1, kinetic energy 1 per particle (soft particles: energy); the time unit follows from "
    "these. YAML reads 1e-8 as a string, which is taken too.";

/** Prints a comment, in several lines. */
static void print_comment(const char *text)
{
    int column = LINE_WIDTH;
    const char *begin = "#";
    while (*text) {
        const int length = (int)strcspn(text, " ");
        if (column + 1 + length > LINE_WIDTH) {
            printf("%s", begin);
            begin = "\n#";
            column = 1;
        }
        printf(" %.*s", length, text);
        column += 1 + length;
        text += length;
        text += strspn(text, " ");
    }
    printf("\n");
}

/** Writes a number that YAML reads as a real one: 1.0e-8, not 1e-08. */
static void write_real(char *out, size_t size, double value)
{
    char digits[32], *exponent;
    snprintf(digits, sizeof digits, "%.15g", value);
    exponent = strchr(digits, 'e');
    const int power = exponent ? atoi(exponent + 1) : 0;
    if (exponent) *exponent = '\0';
    const char *point = strchr(digits, '.') ? "" : ".0";
    if (power)
        snprintf(out, size, "%s%se%d", digits, point, power);
    else
        snprintf(out, size, "%s%s", digits, point);
}

/** Writes the default as it stands in a scene file. */
static void write_value(char *out, size_t size, const parameter *p)
{
    char usual[PARAMETER_TEXT];
    const hd_parameter_kind kind = p->row ? p->row->kind : HD_PARAMETER_WORD;
    parameter_usual(usual, p);
    if (kind == HD_PARAMETER_SEED || kind == HD_PARAMETER_TEXT || p->kind == FILE_PATH)
        snprintf(out, size, "\"%s\"", usual);
    else if (p->kind == TOPICS_OBSERVED || p->kind == TOPICS_AWAITED || p->kind == CHANGES)
        snprintf(out, size, "[%s]", usual);
    else if (kind == HD_PARAMETER_REAL || p->kind == REAL_NUMBER)
        write_real(out, size, atof(usual));
    else
        snprintf(out, size, "%s", usual);
}

/** Writes what is allowed, with its unit. */
static void write_allowed(char *out, size_t size, const parameter *p)
{
    const bool has_unit = *p->unit && !strchr(p->range, '[');
    char allowed[PARAMETER_ALLOWED];
    parameter_allowed(allowed, p);
    snprintf(out, size, "%s%s%s%s", allowed, has_unit ? " [" : "", has_unit ? p->unit : "",
             has_unit ? "]" : "");
}

/** Writes which particles move, and how roslaunch runs the program. */
static void write_program(char *particles, char *launch, size_t size)
{
    int count;
    const hd_dynamics *const *brought = particles_brought(&count);
    snprintf(particles, size, "Disks, spheres and dumbbells, hard or soft");
    snprintf(launch, size, "scene:=quick");
    if (count == 0) return;
    snprintf(particles, size, "Particles of its own, as %.40s, and those of hdlyap",
             brought[0]->particles);
    snprintf(launch, size, "package:=PACKAGE program:=%.60s scene:=FILE.yaml",
             program_invocation_short_name);
}

int parameters_print_help(void)
{
    char particles[PARAMETER_ALLOWED], launch[PARAMETER_ALLOWED];
    const char *name = program_invocation_short_name;
    write_program(particles, launch, PARAMETER_ALLOWED);
    printf(
        "%s, their Lyapunov exponents and modes, as ROS topics.\n\n"
        "  %s [_parameter:=value ...] [__name:=NAME]\n"
        "                         runs the scene that its private parameters say; needs a master\n"
        "  %s --check scene.yaml [parameter:=value ...]\n"
        "                         says, without a run, whether it is valid, what memory and time "
        "it\n"
        "                         takes, how large its bag becomes and which waves are looked for\n"
        "  %s --errors scene.yaml [parameter:=value ...]\n"
        "                         prints the averaged time from which it states errors\n"
        "  %s --test-dynamics scene.yaml [parameter:=value ...]\n"
        "                         tests whether the functions that move its particles do what they "
        "say,\n"
        "                         as those of a program's own\n"
        "  %s --parameters\n"
        "                         prints a scene file with all parameters and their defaults\n"
        "  %s --version\n\n"
        "roslaunch hdlyap run.launch %s runs a scene file with a master of its own.\n"
        "Exit status: 0 finished or stopped, 2 refused, 3 a numerical fault or no memory, 4 a "
        "file fault.\n",
        particles, name, name, name, name, name, name, launch);
    return fflush(stdout) == 0 ? 0 : 1;
}

int parameters_print_version(void)
{
    printf("hdlyap %s\n", HDLYAP_VERSION);
    return fflush(stdout) == 0 ? 0 : 1;
}

/** Prints one parameter; particles: the names of those that have it, if not all; usual: the usual
 * ones have it. */
typedef void printer(const parameter *p, const char *particles, bool usual);

/** Writes the names of all particles with the same own parameters as row r; false unless r is the
 * first of them. */
static bool particles_alike(char *names, size_t size, int r)
{
    const hd_dynamics *of = particles_at(r), *other;
    snprintf(names, size, "%s", of->particles);
    for (int k = 0; (other = particles_at(k)); k++) {
        if (other->parameter != of->parameter || k == r || of->parameters == 0) continue;
        if (k < r) return false;
        const size_t length = strlen(names);
        snprintf(names + length, size - length, " and %s", other->particles);
    }
    return true;
}

/** Prints the parameters that only these particles have. */
static void print_own(printer *print, const hd_dynamics *of, const char *names, bool usual)
{
    for (int k = 0; k < of->parameters; k++) {
        const parameter p = parameters_named(of->parameter[k].name);
        print(&p, names, usual);
    }
}

static bool is_own(const hd_parameter *row, const hd_dynamics *of)
{
    for (int k = 0; k < of->parameters; k++)
        if (row == &of->parameter[k]) return true;
    return false;
}

/** Prints the usual parameters, then those that only some particles have, the usual ones first. */
static int print_all(printer *print)
{
    const hd_dynamics *usual = particles_now();
    char names[16 * HD_PARTICLES];
    for (int k = 0; k < parameters_count(); k++) {
        const parameter p = parameters_at(k);
        if (!is_own(p.row, usual)) print(&p, NULL, true);
    }
    for (int r = 0; particles_at(r); r++) {
        const hd_dynamics *of = particles_at(r);
        particles_are(of);
        if (!particles_alike(names, sizeof names, r)) continue;
        print_own(print, of, names, of->parameter == usual->parameter);
    }
    particles_are(usual);
    return fflush(stdout) == 0 ? 0 : 1;
}

static void print_lines(const parameter *p, const char *particles, bool usual)
{
    char allowed[PARAMETER_ALLOWED + 20], value[PARAMETER_TEXT + 8], text[400];
    write_allowed(allowed, sizeof allowed, p);
    write_value(value, sizeof value, p);
    snprintf(text, sizeof text, "Allowed: %s. Default: %s.", allowed, value);
    printf("\n");
    if (particles) printf("# For %s only.\n", particles);
    print_comment(p->text);
    print_comment(text);
    printf("%s%s: %s\n", usual ? "" : "# ", p->name, value);
}

int parameters_print_scene(void)
{
    const hd_dynamics *of;
    char text[512];
    snprintf(text, sizeof text, head, program_invocation_short_name);
    print_comment(text);
    const int status = print_all(print_lines);
    printf("\n");
    for (int r = 0; (of = particles_at(r)); r++)
        printf("# %s: %d coordinates, %d of them its position\n", of->particles, of->coordinates,
               of->dimension);
    return status ? status : fflush(stdout) != 0;
}

/** Prints a cell of a table; a bar in it is escaped, as it would end the cell. */
static void print_cell(const char *text)
{
    printf("| ");
    for (; *text; text++) printf(*text == '|' ? "\\|" : "%c", *text);
    printf(" ");
}

static void print_row(const parameter *p, const char *particles, bool usual)
{
    (void)usual;
    char allowed[PARAMETER_ALLOWED + 20], value[PARAMETER_TEXT + 8], name[PARAMETER_TEXT];
    char text[2048];
    write_allowed(allowed, sizeof allowed, p);
    write_value(value, sizeof value, p);
    snprintf(name, sizeof name, "`%s`", p->name);
    print_cell(name);
    print_cell(allowed);
    print_cell(value);
    print_cell(p->live ? "`~set`" : p->may_differ ? "resume" : "");
    snprintf(text, sizeof text, "%s%s%s%s", particles ? "For " : "", particles ? particles : "",
             particles ? " only. " : "", p->text);
    print_cell(text);
    printf("|\n");
}

int parameters_print_table(void)
{
    printf("| parameter | allowed | default | change | what |\n|---|---|---|---|---|\n");
    return print_all(print_row);
}
