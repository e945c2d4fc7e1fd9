/* A region's relief as triangles, for C: bad arguments are named, arrays are what they say, handles count. */
#include <math.h>

#include "plate_fixture.h"

static StriaeMeshRegion middle(void) {
    return (StriaeMeshRegion){.struct_size = sizeof(StriaeMeshRegion),
                              .low_uv = {0.45, 0.45},
                              .high_uv = {0.55, 0.55},
                              .tolerance_mm = 1e-4,
                              .base_mm = 1.0};
}

static void refused(const StriaePattern *pattern) {
    protects("absurd arguments are refused by name, and the handle becomes NULL");
    StriaeMeshRegion region = middle();
    StriaeReliefMesh *mesh = (StriaeReliefMesh *)&region;
    EXPECT_REFUSED(striae_relief_mesh(NULL, &region, &mesh), "pattern", "NULL");
    EXPECT(mesh == NULL);
    EXPECT_REFUSED(striae_relief_mesh(pattern, NULL, &mesh), "region", "NULL");
    EXPECT_REFUSED(striae_relief_mesh(pattern, &region, NULL), "mesh", "NULL");
    region.struct_size = 8;
    EXPECT_REFUSED(striae_relief_mesh(pattern, &region, &mesh), "struct_size", "8");
    region = middle();
    region.high_uv[1] = 0.45;
    EXPECT_REFUSED(striae_relief_mesh(pattern, &region, &mesh), "high_uv", "low_uv");
    region = middle();
    region.tolerance_mm = (double)NAN;
    EXPECT_REFUSED(striae_relief_mesh(pattern, &region, &mesh), "tolerance_mm", "NaN");
    EXPECT(mesh == NULL);
    striae_relief_mesh_release(NULL);
    striae_relief_mesh_retain(NULL);
}

static void arrays_of(const StriaeReliefMesh *mesh) {
    protects("every number in a mesh's arrays leads somewhere, and the scratch and the surface have their own BRDFs");
    StriaeMeshArrays arrays = {.struct_size = sizeof arrays};
    EXPECT_OK(striae_relief_mesh_arrays(mesh, &arrays));
    EXPECT(arrays.vertex_count > 20 && arrays.triangle_count > 20 && arrays.brdf_count == 2);
    size_t lost = 0, scratched = 0;
    for (size_t i = 0; i < arrays.triangle_count; i++) {
        const StriaeMeshZone *zone = &arrays.zones[i];
        for (int k = 0; k < 3; k++) lost += arrays.triangles[i][k] >= arrays.vertex_count;
        const bool is_scratch = zone->scratch == 0 && zone->brdf == 1 && zone->travel[0] == 1.0f;
        scratched += is_scratch;
        lost += !is_scratch && !(zone->scratch == STRIAE_NO_SCRATCH && zone->brdf == 0);
    }
    EXPECT(lost == 0 && scratched > 0 && scratched < arrays.triangle_count);
    for (size_t i = 0; i < arrays.vertex_count; i++) {
        const double *p = arrays.positions[i];
        lost += !(p[0] >= 27.0 - 1e-9 && p[0] <= 33.0 + 1e-9 && p[1] >= 18.0 - 1e-9 && p[1] <= 22.0 + 1e-9);
        lost += !(p[2] >= -1.0 && p[2] < 0.1);
    }
    EXPECT(lost == 0);

    StriaeBrdf brdf = {.kind = 9};
    EXPECT_OK(striae_relief_mesh_brdf(mesh, 1, &brdf));
    EXPECT(brdf.kind == STRIAE_BRDF_KIND_GGX);
    EXPECT_REFUSED(striae_relief_mesh_brdf(mesh, 2, &brdf), "number", "2");
    EXPECT_REFUSED(striae_relief_mesh_brdf(NULL, 0, &brdf), "mesh", "NULL");
    EXPECT_REFUSED(striae_relief_mesh_arrays(mesh, NULL), "arrays", "NULL");
    arrays.struct_size = 1;
    EXPECT_REFUSED(striae_relief_mesh_arrays(mesh, &arrays), "struct_size", "1");
}

#ifdef STRIAE_WITH_FILES
static void written(const StriaeReliefMesh *mesh) {
    protects("a mesh is written by the end of the file's name, and a file that cannot be is told");
    EXPECT_OK(striae_relief_mesh_write(mesh, "relief-mesh-test.obj"));
    EXPECT_OK(striae_relief_mesh_write(mesh, "relief-mesh-test.ply"));
    StriaeTool *tool = NULL;
    EXPECT_OK(striae_tool_load("relief-mesh-test.ply", 1.0, &tool));
    striae_tool_release(tool);
    EXPECT(striae_relief_mesh_write(mesh, "relief-mesh-test.stl") == STRIAE_STATUS_FILE);
    EXPECT(strstr(striae_last_error(), ".obj or .ply") != NULL);
    EXPECT(striae_relief_mesh_write(mesh, "/proc/nowhere/mesh.obj") == STRIAE_STATUS_FILE);
    EXPECT_REFUSED(striae_relief_mesh_write(mesh, NULL), "path", "NULL");
    remove("relief-mesh-test.obj");
    remove("relief-mesh-test.ply");
}
#endif

int main(void) {
    Plate plate;
    plate_init(&plate);
    StriaePattern *pattern = plate_pattern(&plate);
    refused(pattern);
    const StriaeMeshRegion region = middle();
    StriaeReliefMesh *mesh = NULL;
    EXPECT_OK(striae_relief_mesh(pattern, &region, &mesh));
    /* The mesh needs neither its pattern nor more than one of its own references. */
    striae_pattern_release(pattern);
    striae_relief_mesh_retain(mesh);
    striae_relief_mesh_release(mesh);
    arrays_of(mesh);
#ifdef STRIAE_WITH_FILES
    written(mesh);
#endif
    striae_relief_mesh_release(mesh);
    striae_tool_release(plate.tool);
    return expect_summary();
}
