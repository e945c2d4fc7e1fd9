/* The command line. */
#ifndef RENDERER_OPTIONS_H
#define RENDERER_OPTIONS_H
#include <stdbool.h>

typedef struct Options {
    const char *scene;
    const char *out; /* folder for the pictures */
    int width, height;
    int samples_across; /* square root of --spp */
    int threads;
    bool check;
    bool aov;
} Options;

typedef enum OptionsOutcome { OPTIONS_RUN, OPTIONS_HELP, OPTIONS_WRONG } OptionsOutcome;

/* Explains on stderr what is wrong, or on stdout what there is. */
OptionsOutcome options_parse(int argc, char **argv, Options *options);
#endif
