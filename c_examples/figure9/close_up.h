/* A scratched plate from close by, against the light. */
#ifndef FIGURE9_CLOSE_UP_H
#define FIGURE9_CLOSE_UP_H
#include "film.h"
#include "scratched_plate.h"

/* Renders the shot; NULL, or why not. */
const char *close_up(const Shot *shot, int threads, Film *film);
#endif
