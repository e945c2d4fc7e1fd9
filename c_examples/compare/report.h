/* The table, the worst of each kind, and pictures for people. */
#ifndef COMPARE_REPORT_H
#define COMPARE_REPORT_H
#include "cases.h"
#include "film.h"

/* Who judges what: brute force the light that comes straight from a lamp, and all that does in the end; POV-Ray plates of
   Lambert's finish, and plates of its own phong and specular ones. */
enum { DIRECT, ALL_LIGHT, POVRAY_LAMBERT, POVRAY_GLOSS, KIND_COUNT };

typedef struct Row {
    int distance, elevation, kind;
} Row;

/* The largest mean absolute difference: without crossings and ends, with them, of matte plates, and what of it may be chance. */
typedef struct Worst {
    double plain, crossed, matte, noise;
} Worst;

typedef struct Report {
    const char *folder;
    Worst worst[KIND_COUNT];
} Report;

bool complain(const char *what, const char *why);

/* A name for a row's files. */
void row_name(const Plate *plate, const Row *row, char *name, size_t size);

/* Prints a row and writes its picture. */
bool report_row(Report *report, const Plate *plate, const Row *row, const Film *library, const Film *judge, double noise);

void report_head(void);

/* The worst of each kind; where all plates were compared, the same as FOLDER.json. */
bool report_end(const Report *report, bool all_plates);
#endif
