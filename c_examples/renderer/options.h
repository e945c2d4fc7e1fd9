/* The command line. */
#ifndef RENDERER_OPTIONS_H
#define RENDERER_OPTIONS_H
#include <stdbool.h>

typedef enum Integrator { INTEGRATOR_OF_SCENE, INTEGRATOR_DIRECT, INTEGRATOR_PATHS } Integrator;

typedef struct Options {
    const char *scene;
    const char *out; /* folder for the pictures */
    int width, height;
    Integrator integrator;
    int spp;         /* 0: as the scene says */
    int reflections; /* 0: as many as are usual */
    int threads;
    bool walls;                  /* light goes from wall to wall within scratches */
    const char *environment;     /* NULL: the scene's own */
    int first_frame, last_frame; /* from 1; 0 and 0: all */
    int first_tile, last_tile;   /* from 0; 0 and -1: all */
    bool resume;
    bool check;
    bool aov;
} Options;

typedef enum OptionsOutcome { OPTIONS_RUN, OPTIONS_HELP, OPTIONS_WRONG } OptionsOutcome;

/* Explains on stderr what is wrong, or on stdout what there is. */
OptionsOutcome options_parse(int argc, char **argv, Options *options);
#endif
