#include "cells.h"

static StriaeStatus nail(StriaeTool **tool) { return striae_tool_preset(STRIAE_TOOL_PRESET_NAIL, tool); }

static StriaeStatus tester(StriaeTool **tool) { return striae_tool_preset(STRIAE_TOOL_PRESET_ROCKWELL_C, tool); }

static StriaeStatus pyramid(StriaeTool **tool) { return striae_tool_preset(STRIAE_TOOL_PRESET_VICKERS, tool); }

/* What of a blade 4 mm wide touches the plate when it leans by 15 degrees: the corner, the side above it, the edge. */
static StriaeStatus screwdriver(StriaeTool **tool) {
    static const double corner_mm[3][2] = {{-0.26, 0.97}, {0.0, 0.0}, {3.86, 1.04}};
    return striae_tool_profile(corner_mm, 3, tool);
}

/* The four-sided point that wire nails have. Unlike a round one, it leaves another groove when it leans forward. */
static StriaeStatus square_point(StriaeTool **tool) { return striae_tool_pyramid(4, 40.0, 3.0, tool); }

const Group figure_groups[GROUP_COUNT] = {
    {STRIAE_METAL_STEEL,
     0.60,
     4.0,
     {{"tool-1", "Tool: nail\n50°, tip radius 0.1 mm", nail, 131.0, 2.0, 0.0, 0.0},
      {"tool-2", "Tool: screwdriver\non a corner, leaning 15°", screwdriver, 131.0, 2.0, 0.0, 0.0},
      {"tool-3", "Tool: scratch tester's cone\n120°, tip radius 0.2 mm", tester, 131.0, 2.0, 0.0, 0.0},
      {"tool-4", "Tool: pyramid\n136°, a face leading", pyramid, 131.0, 2.0, 0.0, 0.0}}},
    {STRIAE_METAL_STEEL,
     0.75,
     4.0,
     {{"hardness-1", "Hardness: 50 HV\ntester's cone, 2 kgf", tester, 50.0, 2.0, 0.0, 0.0},
      {"hardness-2", "Hardness: 100 HV\ntester's cone, 2 kgf", tester, 100.0, 2.0, 0.0, 0.0},
      {"hardness-3", "Hardness: 200 HV\ntester's cone, 2 kgf", tester, 200.0, 2.0, 0.0, 0.0},
      {"hardness-4", "Hardness: 400 HV\ntester's cone, 2 kgf", tester, 400.0, 2.0, 0.0, 0.0}}},
    {STRIAE_METAL_COPPER,
     0.50,
     3.0,
     {{"force-1", "Force: 0.5 kgf\nnail, hard copper 110 HV", nail, 110.0, 0.5, 0.0, 0.0},
      {"force-2", "Force: 1 kgf\nnail, hard copper 110 HV", nail, 110.0, 1.0, 0.0, 0.0},
      {"force-3", "Force: 2 kgf\nnail, hard copper 110 HV", nail, 110.0, 2.0, 0.0, 0.0},
      {"force-4", "Force: 4 kgf\nnail, hard copper 110 HV", nail, 110.0, 4.0, 0.0, 0.0}}},
    {STRIAE_METAL_BRASS,
     0.30,
     1.0,
     {{"orientation-1", "Orientation: (0°, 0°)\nnail with a square point, 40°", square_point, 120.0, 2.0, 0.0, 0.0},
      {"orientation-2", "Orientation: (40°, 0°)\nnail with a square point, 40°", square_point, 120.0, 2.0, 40.0,
       0.0},
      {"orientation-3", "Orientation: (60°, 90°)\nnail with a square point, 40°", square_point, 120.0, 2.0, 60.0,
       90.0},
      {"orientation-4", "Orientation: (45°, 45°)\nnail with a square point, 40°", square_point, 120.0, 2.0, 45.0,
       45.0}}},
};

StriaeProcess cell_process(const Cell *cell) {
    return (StriaeProcess){.struct_size = sizeof(StriaeProcess),
                           .depth_law = STRIAE_DEPTH_LAW_BOSCH2004,
                           .force_kgf = cell->force_kgf,
                           .tilt_deg = cell->tilt_deg,
                           .azimuth_deg = cell->azimuth_deg};
}

StriaeStatus cell_material(const Group *group, const Cell *cell, StriaeMaterial *material) {
    *material = (StriaeMaterial){.struct_size = sizeof *material};
    const StriaeStatus status = striae_material_metal(group->metal, material);
    material->hardness_hv = cell->hardness_hv;
    return status;
}
