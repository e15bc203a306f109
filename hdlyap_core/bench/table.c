/** Rows -> CSV file. */
#include "table.h"

#include <hdlyap/blas.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "timing.h"

enum { PATH_ROOM = 4096 };

struct table {
    char path[PATH_ROOM];
    FILE *rows;
    char *text;
    size_t size;
};

static void fault(const char *path)
{
    perror(path);
    exit(4);
}

table *table_create(const char *folder, const char *name, const char *header)
{
    table *t = room(1, sizeof *t);
    if (snprintf(t->path, sizeof t->path, "%s/%s.csv", folder, name) >= PATH_ROOM - 8) {
        fprintf(stderr, "%s: the name of the folder is too long\n", folder);
        exit(2);
    }
    t->rows = open_memstream(&t->text, &t->size);
    if (!t->rows) fault(t->path);
    fprintf(t->rows, "%s\n", header);
    return t;
}

void table_row(table *t, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vfprintf(t->rows, format, values);
    va_end(values);
    fputc('\n', t->rows);
}

/** Prints the name of the processor from /proc/cpuinfo, if there is one. */
static void print_processor(FILE *file)
{
    char line[512];
    FILE *info = fopen("/proc/cpuinfo", "r");
    while (info && fgets(line, sizeof line, info)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || !colon) continue;
        fprintf(file, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
        fclose(info);
        return;
    }
    if (info) fclose(info);
    fputs("unknown processor", file);
}

static void print_comment(FILE *file, char **argv, double dgemm)
{
    const hd_blas blas = hd_blas_query();
    fputs("# ", file);
    print_processor(file);
    fprintf(file, "; %d cores; %s kernels, %s, threads %d; dgemm %.1f GF/s; command:", blas.cores,
            blas.kernel, blas.threading, blas.threads, dgemm * 1e-9);
    for (; *argv; argv++) fprintf(file, " %s", *argv);
    fputc('\n', file);
}

void table_write(table *t, char **argv, double dgemm)
{
    char unfinished[PATH_ROOM + 8];
    snprintf(unfinished, sizeof unfinished, "%s.part", t->path);
    if (fclose(t->rows) != 0) fault(t->path);
    FILE *file = fopen(unfinished, "w");
    if (!file) fault(unfinished);
    print_comment(file, argv, dgemm);
    fputs(t->text, file);
    const int bad = ferror(file);
    if (fclose(file) != 0 || bad) fault(unfinished);
    if (rename(unfinished, t->path) != 0) fault(t->path);
    free(t->text);
    free(t);
}
