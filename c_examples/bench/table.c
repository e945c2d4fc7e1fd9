#include "table.h"

#include <stdarg.h>

#include "figures.h"

bool table_open(Table *table, const char *folder, const char *name) {
    char path[4096], machine[256];
    snprintf(path, sizeof path, "%s/%s.txt", folder, name);
    table->file = fopen(path, "w");
    if (!table->file) {
        fprintf(stderr, "%s cannot be written\n", path);
        return false;
    }
    machine_name(machine, sizeof machine);
    table_say(table, "%s\n", machine);
    return true;
}

bool table_close(Table *table) {
    const bool written = !table->file || fclose(table->file) == 0;
    table->file = NULL;
    return written;
}

void table_say(const Table *table, const char *format, ...) {
    va_list words;
    va_start(words, format);
    vfprintf(stdout, format, words);
    va_end(words);
    fflush(stdout);
    va_start(words, format);
    vfprintf(table->file, format, words);
    va_end(words);
}
