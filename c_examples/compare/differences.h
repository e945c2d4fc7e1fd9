/* How far two pictures of one size are apart. */
#ifndef COMPARE_DIFFERENCES_H
#define COMPARE_DIFFERENCES_H
#include "film.h"

typedef struct Difference {
    double mean;          /* radiance of the second */
    double mean_absolute; /* of all channels of all pixels, over that mean */
    double signed_mean;   /* likewise, the first less the second */
    double worst;         /* likewise, of any channel of any pixel */
} Difference;

Difference difference(const Film *a, const Film *b);

/* The mean of two pictures; false where memory is short. */
bool film_mean(const Film *a, const Film *b, Film *mean);
#endif
