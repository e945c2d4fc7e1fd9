/* What the figure shows: four groups of four scratches, in each of which one thing varies. */
#ifndef FIGURE9_CELLS_H
#define FIGURE9_CELLS_H
#include <striae.h>

enum { GROUP_COUNT = 4, CELLS_IN_GROUP = 4 };

typedef struct Cell {
    const char *name;    /* of the cell's files */
    const char *caption; /* two lines */
    StriaeStatus (*make_tool)(StriaeTool **tool);
    double hardness_hv, force_kgf;
    double tilt_deg, azimuth_deg;
} Cell;

typedef struct Group {
    StriaeMetal metal;   /* how the plate reflects */
    double across_mm;    /* how much of the plate each picture shows from left to right */
    double exaggeration; /* of heights in the cross-sections */
    Cell cells[CELLS_IN_GROUP];
} Group;

/* As in the paper: tools upper left, hardness upper right, forces lower left, orientations lower right. */
extern const Group figure_groups[GROUP_COUNT];

StriaeProcess cell_process(const Cell *cell);
StriaeStatus cell_material(const Group *group, const Cell *cell, StriaeMaterial *material);
#endif
