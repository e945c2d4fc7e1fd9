#include "chart.h"

#include <math.h>
#include <stdio.h>

enum { WIDTH = 760, HEIGHT = 520, LEFT = 80, TOP = 50, RIGHT = 220, BOTTOM = 60 };

static const char *const COLORS[CHART_MAX_CURVES] = {"#0b6e4f", "#b3261e", "#9dc3e6", "#4a90d9",
                                                     "#1f3f7a", "#7a4fa3", "#8a6d1f", "#555555"};

static double place_x(const Chart *chart, double x) {
    const double from = log10(chart->x_range[0]), to = log10(chart->x_range[1]);
    return LEFT + (log10(x) - from) / (to - from) * (WIDTH - LEFT - RIGHT);
}

static double place_y(const Chart *chart, double y) {
    const double from = log10(chart->y_range[0]), to = log10(chart->y_range[1]);
    return HEIGHT - BOTTOM - (log10(y) - from) / (to - from) * (HEIGHT - TOP - BOTTOM);
}

static void line(FILE *file, double x0, double y0, double x1, double y1, const char *color) {
    fprintf(file, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\"/>\n", x0, y0, x1, y1, color);
}

static void text(FILE *file, double x, double y, const char *anchor, const char *words) {
    fprintf(file, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x, y, anchor, words);
}

static void write_axes(const Chart *chart, FILE *file) {
    const double right = WIDTH - RIGHT, bottom = HEIGHT - BOTTOM;
    char label[32];
    for (double x = chart->x_range[0]; x < 1.001 * chart->x_range[1]; x *= 10.0) {
        line(file, place_x(chart, x), TOP, place_x(chart, x), bottom, "#ddd");
        snprintf(label, sizeof label, "%g", x);
        text(file, place_x(chart, x), bottom + 20, "middle", label);
    }
    for (double y = chart->y_range[0]; y < 1.001 * chart->y_range[1]; y *= 10.0) {
        line(file, LEFT, place_y(chart, y), right, place_y(chart, y), "#ddd");
        snprintf(label, sizeof label, "%g", y);
        text(file, LEFT - 8, place_y(chart, y) + 5, "end", label);
    }
    if (chart->y_mark > 0.0)
        line(file, LEFT, place_y(chart, chart->y_mark), right, place_y(chart, chart->y_mark), "#999");
    text(file, 0.5 * (LEFT + right), HEIGHT - 15, "middle", chart->x_name);
    text(file, LEFT, 25, "start", chart->title);
    fprintf(file, "<text transform=\"translate(22 %.1f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
            0.5 * (TOP + bottom), chart->y_name);
}

static void write_curve(const Chart *chart, FILE *file, int number) {
    const Curve *curve = &chart->curves[number];
    const char *color = COLORS[number];
    fprintf(file, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"2\" points=\"", color);
    for (int i = 0; i < curve->count; i++)
        fprintf(file, "%.1f,%.1f ", place_x(chart, curve->x[i]), place_y(chart, curve->y[i]));
    fprintf(file, "\"/>\n");
    for (int i = 0; i < curve->count; i++)
        fprintf(file, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"/>\n", place_x(chart, curve->x[i]),
                place_y(chart, curve->y[i]), color);
    const double x = WIDTH - RIGHT + 15, y = TOP + 15 + 24 * number;
    line(file, x, y - 5, x + 20, y - 5, color);
    text(file, x + 27, y, "start", curve->name);
}

bool chart_write(const Chart *chart, const char *path) {
    FILE *file = fopen(path, "w");
    if (file) {
        fprintf(file,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
                "font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"%d\" height=\"%d\" fill=\"white\"/>\n",
                WIDTH, HEIGHT, WIDTH, HEIGHT, WIDTH, HEIGHT);
        write_axes(chart, file);
        for (int i = 0; i < chart->count; i++) write_curve(chart, file, i);
        fprintf(file, "</svg>\n");
    }
    const bool written = file && fclose(file) == 0;
    if (!written) fprintf(stderr, "%s cannot be written\n", path);
    return written;
}
