/* How far a picture is from what it should be. */
#ifndef BENCH_ERRORS_H
#define BENCH_ERRORS_H
#include "film.h"

/* Root mean square difference of all channels of all pixels, over the mean of the second. */
double relative_rms(const Film *film, const Film *truth);

/* What two pictures of one kind, noisy each in its own way, both are away from the truth: chance alone gives 0 on average. */
double relative_bias(const Film *a, const Film *b, const Film *truth);
#endif
