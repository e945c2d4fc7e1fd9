/* The printed page: pictures beside each other on white, eight bits a channel. */
#ifndef FIGURE9_SHEET_H
#define FIGURE9_SHEET_H
#include "film.h"

typedef struct Sheet {
    int width, height;
    unsigned char (*rgb)[3];
} Sheet;

/* White. False where memory is short. */
bool sheet_init(Sheet *sheet, int width, int height);
void sheet_free(Sheet *sheet);

/* Puts a picture's upper left corner at (x, y); what does not fit is cut off. */
void sheet_put_film(Sheet *sheet, const Film *film, double exposure, int x, int y);

/* Likewise; NULL, or why not. */
const char *sheet_put_png(Sheet *sheet, const char *path, int x, int y);

/* NULL if the file was written, otherwise why not. */
const char *sheet_write_png(const Sheet *sheet, const char *path);
#endif
