/* Roman capitals of single strokes, as an engraver cuts them. */
#ifndef RENDERER_LETTERS_H
#define RENDERER_LETTERS_H
#include <stddef.h>

/* A stroke: cubic Bezier curves, each starting where the last ends, 3 n + 1 points. Letters are 1 high. */
enum { LETTER_MOST_POINTS = 13 };
typedef struct LetterStroke {
    double points[LETTER_MOST_POINTS][2];
    size_t count;
} LetterStroke;

/* A capital letter's strokes, at most 4, its left edge at 0, and its width; what is no letter is an empty space. */
enum { LETTER_MOST_STROKES = 4 };
size_t letter_strokes(char letter, LetterStroke strokes[LETTER_MOST_STROKES], double *width);

/* The space between the right edge of a letter and the left one of the next. */
extern const double LETTER_GAP;
#endif
