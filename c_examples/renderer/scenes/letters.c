#include "letters.h"

#include <stdlib.h>

const double LETTER_GAP = 0.28;

/* In hundredths of the height: M begins a stroke, L a straight line to a place, C a curve by two guides to a place. */
static const struct {
    char letter;
    double width;
    const char *path;
} letters[] = {
    {'A', 76, "M 0 0 L 38 100 M 38 100 L 76 0 M 15 36 L 61 36"},
    {'B', 50, "M 0 100 L 0 0 M 0 100 C 58 104 58 54 0 54 M 0 54 C 68 58 68 -4 0 0"},
    {'C', 72, "M 72 84 C 52 110 0 106 0 50 C 0 -6 52 -10 72 16"},
    {'D', 70, "M 0 100 L 0 0 M 0 100 C 94 104 94 -4 0 0"},
    {'E', 46, "M 0 100 L 0 0 M 0 100 L 46 100 M 0 52 L 40 52 M 0 0 L 46 0"},
    {'F', 44, "M 0 100 L 0 0 M 0 100 L 44 100 M 0 52 L 38 52"},
    {'G', 74, "M 72 84 C 52 110 0 106 0 50 C 0 -6 54 -8 74 12 M 74 46 L 74 12 M 52 46 L 74 46"},
    {'H', 66, "M 0 100 L 0 0 M 66 100 L 66 0 M 0 52 L 66 52"},
    {'I', 0, "M 0 100 L 0 0"},
    {'J', 26, "M 26 100 L 26 16 M 26 16 C 26 -8 8 -14 0 -4"},
    {'K', 58, "M 0 100 L 0 0 M 54 100 L 0 46 M 14 60 L 58 0"},
    {'L', 44, "M 0 100 L 0 0 M 0 0 L 44 0"},
    {'M', 90, "M 0 0 L 12 100 M 12 100 L 45 10 M 45 10 L 78 100 M 78 100 L 90 0"},
    {'N', 68, "M 0 0 L 0 100 M 0 100 L 68 0 M 68 0 L 68 100"},
    {'O', 90, "M 45 100 C -15 100 -15 0 45 0 M 45 100 C 105 100 105 0 45 0"},
    {'P', 50, "M 0 100 L 0 0 M 0 100 C 66 106 66 42 0 47"},
    {'Q', 94, "M 45 100 C -15 100 -15 0 45 0 M 45 100 C 105 100 105 0 45 0 M 46 24 L 94 -18"},
    {'R', 58, "M 0 100 L 0 0 M 0 100 C 64 106 64 46 0 51 M 22 51 L 58 0"},
    {'S', 48, "M 44 86 C 34 106 2 106 4 76 C 6 50 48 54 48 26 C 48 -8 8 -6 0 16"},
    {'T', 64, "M 32 100 L 32 0 M 0 100 L 64 100"},
    {'U', 64, "M 0 100 L 0 34 M 0 34 C 0 -12 64 -12 64 34 M 64 100 L 64 34"},
    {'V', 72, "M 0 100 L 36 0 M 72 100 L 36 0"},
    {'W', 104, "M 0 100 L 26 0 M 52 96 L 26 0 M 52 96 L 78 0 M 104 100 L 78 0"},
    {'X', 66, "M 0 100 L 66 0 M 66 100 L 0 0"},
    {'Y', 66, "M 0 100 L 33 48 M 66 100 L 33 48 M 33 48 L 33 0"},
    {'Z', 60, "M 0 100 L 60 100 M 60 100 L 0 0 M 0 0 L 60 0"},
};

static void add_point(LetterStroke *stroke, double x, double y) {
    stroke->points[stroke->count][0] = 0.01 * x;
    stroke->points[stroke->count++][1] = 0.01 * y;
}

/* A straight line as a curve: its guides lie on it. */
static void add_line(LetterStroke *stroke, double x, double y) {
    const double *from = stroke->points[stroke->count - 1], x0 = 100.0 * from[0], y0 = 100.0 * from[1];
    for (int third = 1; third <= 3; third++) add_point(stroke, x0 + third * (x - x0) / 3.0, y0 + third * (y - y0) / 3.0);
}

/* The next number of a path. */
static double take_number(const char **path) {
    char *end;
    const double number = strtod(*path, &end);
    *path = end;
    return number;
}

static size_t follow(const char *path, LetterStroke strokes[LETTER_MOST_STROKES]) {
    size_t count = 0;
    while (*path) {
        const char kind = *path++;
        const int places = kind == 'C' ? 3 : 1;
        if (kind == ' ') continue;
        if (kind == 'M') strokes[count++].count = 0;
        for (int i = 0; i < places; i++) {
            const double x = take_number(&path), y = take_number(&path);
            (kind == 'L' ? add_line : add_point)(&strokes[count - 1], x, y);
        }
    }
    return count;
}

size_t letter_strokes(char letter, LetterStroke strokes[LETTER_MOST_STROKES], double *width) {
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        if (letters[i].letter != letter) continue;
        *width = 0.01 * letters[i].width;
        return follow(letters[i].path, strokes);
    }
    *width = 0.3;
    return 0;
}
