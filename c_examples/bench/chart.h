/* Curves on logarithmic axes, as SVG. */
#ifndef BENCH_CHART_H
#define BENCH_CHART_H
#include <stdbool.h>

enum { CHART_MAX_POINTS = 16, CHART_MAX_CURVES = 8 };

typedef struct Curve {
    char name[48];
    double x[CHART_MAX_POINTS], y[CHART_MAX_POINTS]; /* above 0 */
    int count;
} Curve;

typedef struct Chart {
    const char *title, *x_name, *y_name;
    double x_range[2], y_range[2]; /* powers of ten */
    double y_mark;                 /* a line across; 0 for none */
    Curve curves[CHART_MAX_CURVES];
    int count;
} Chart;

/* False, with a reason on stderr, where the file cannot be written. */
bool chart_write(const Chart *chart, const char *path);
#endif
