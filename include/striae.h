/*
 * striae: physically based scratches for renderers.
 *
 * Build time:  tool, material -> (cross-section) ; builder -> add scratches -> pattern
 * Render time: striae_shade(pattern, point, view) once per shading point and view, then
 *              striae_eval(shading, light) per light. Neither allocates, locks or blocks.
 *
 * Units are in the names: lengths mm, forces kgf (9.80665 N), Vickers hardness kgf/mm^2, angles in
 * degrees. `view` and `light` both point away from the surface, in the local frame of striae_frame().
 *
 * Calls that can fail return a StriaeStatus; striae_last_error() then says which argument was refused,
 * what was given and what is accepted. Outputs are written on success only; handles become NULL on
 * failure. NULL arguments are refused, never dereferenced. Enumerations are passed as uint32_t.
 *
 * Handles are immutable and may be shared between threads; retain and release count references, may be
 * called from any thread, and accept NULL. A builder is used by one thread at a time.
 */

#ifndef STRIAE_H
#define STRIAE_H

#include <stddef.h>
#include <stdint.h>

/**
 * Major version of the header.
 */
#define STRIAE_VERSION_MAJOR 0

/**
 * Minor version of the header. Before 1.0 each minor version may change the ABI.
 */
#define STRIAE_VERSION_MINOR 1

/**
 * Patch version of the header.
 */
#define STRIAE_VERSION_PATCH 0

/**
 * Flag of striae_eval(): the BRDF alone, without the cosine between light and normal.
 */
#define STRIAE_EVAL_BRDF_ONLY 1

/**
 * What a call says of its outcome. After anything but `STRIAE_STATUS_OK`, striae_last_error() has the details.
 */
typedef enum StriaeStatus {
  /**
   * All went well.
   */
  STRIAE_STATUS_OK = 0,
  /**
   * An argument was refused. Nothing was made or changed.
   */
  STRIAE_STATUS_INVALID_ARGUMENT = 1,
  /**
   * A fault of the library's own. Please report it.
   */
  STRIAE_STATUS_INTERNAL = 2,
} StriaeStatus;

/**
 * Tools by name, sized as in the trade.
 */
typedef enum StriaeToolPreset {
  /**
   * The diamond of scratch testers: a 120 degree cone with a 0.2 mm tip radius (ISO 6508-2).
   */
  STRIAE_TOOL_PRESET_ROCKWELL_C = 0,
  /**
   * A square pyramid, 136 degrees between opposite faces (ISO 6507-2). As it stands a face leads; spun by
   * 45 degrees an edge does.
   */
  STRIAE_TOOL_PRESET_VICKERS = 1,
  /**
   * A wire nail's point: a cone of 50 degrees in all, blunted to 0.1 mm.
   */
  STRIAE_TOOL_PRESET_NAIL = 2,
  /**
   * A slotted screwdriver: an edge 1 mm wide across the travel, faces 60 degrees apart.
   */
  STRIAE_TOOL_PRESET_SCREWDRIVER = 3,
} StriaeToolPreset;

/**
 * Kinds of base BRDF.
 */
typedef enum StriaeBrdfKind {
  /**
   * Perfectly diffuse: `albedo`.
   */
  STRIAE_BRDF_KIND_LAMBERT = 0,
  /**
   * GGX microfacets with height-correlated Smith masking: `alpha` and a Fresnel reflectance.
   */
  STRIAE_BRDF_KIND_GGX = 1,
} StriaeBrdfKind;

/**
 * Kinds of Fresnel reflectance.
 */
typedef enum StriaeFresnelKind {
  /**
   * Schlick's approximation from `f0`.
   */
  STRIAE_FRESNEL_KIND_SCHLICK = 0,
  /**
   * A conductor's exact reflectance from `eta` and `k`.
   */
  STRIAE_FRESNEL_KIND_CONDUCTOR = 1,
} StriaeFresnelKind;

/**
 * Metals with known hardness and optical constants.
 */
typedef enum StriaeMetal {
  /**
   * Aluminium alloy 6061-T6, 107 HV.
   */
  STRIAE_METAL_ALUMINIUM = 0,
  /**
   * Cartridge brass, half hard, 120 HV.
   */
  STRIAE_METAL_BRASS = 1,
  /**
   * Low-carbon steel AISI 1018, 131 HV.
   */
  STRIAE_METAL_STEEL = 2,
  /**
   * Titanium, grade 2, 145 HV.
   */
  STRIAE_METAL_TITANIUM = 3,
} StriaeMetal;

/**
 * Laws that give a groove's depth.
 */
typedef enum StriaeDepthLaw {
  /**
   * The fit of Bosch et al. 2004, made with a Rockwell C cone in metals; below a force over hardness of
   * 4.17e-4 mm² it leaves no scratch.
   */
  STRIAE_DEPTH_LAW_BOSCH2004 = 0,
  /**
   * Scratch hardness (ASTM G171): the groove is sqrt(8 F / (pi HV)) wide between its two crests. Any tool.
   */
  STRIAE_DEPTH_LAW_SCRATCH_HARDNESS = 1,
} StriaeDepthLaw;

/**
 * Kinds of path.
 */
typedef enum StriaeCurve {
  /**
   * Straight lines from point to point, two points or more.
   */
  STRIAE_CURVE_POLYLINE = 0,
  /**
   * Cubic Bezier curves, each starting where the last ends: 3 n + 1 points.
   */
  STRIAE_CURVE_CUBIC_BEZIER = 1,
} StriaeCurve;

/**
 * What a pixel covers of the surface around a point.
 */
typedef enum StriaeFootprint {
  /**
   * Nothing but the point itself.
   */
  STRIAE_FOOTPRINT_POINT = 0,
  /**
   * A square along x and y that reaches `radius` scene units from the point on each side.
   */
  STRIAE_FOOTPRINT_RADIUS = 1,
  /**
   * The parallelogram centred on the point with edges `duv_dx` and `duv_dy`.
   */
  STRIAE_FOOTPRINT_DIFFERENTIALS = 2,
} StriaeFootprint;

/**
 * A scratch's cross-section. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaeCrossSection StriaeCrossSection;

/**
 * A surface with its scratches. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaePattern StriaePattern;

/**
 * Collects scratches. One thread at a time.
 */
typedef struct StriaePatternBuilder StriaePatternBuilder;

/**
 * A scratching tool. Immutable; any thread may use it; reference-counted.
 */
typedef struct StriaeTool StriaeTool;

/**
 * A base BRDF: how the finish of one zone reflects. Linear RGB. Fields that its kinds do not name are ignored.
 */
typedef struct StriaeBrdf {
  /**
   * A StriaeBrdfKind.
   */
  uint32_t kind;
  /**
   * A StriaeFresnelKind (GGX).
   */
  uint32_t fresnel;
  /**
   * Lambert: albedo, 0 to 1.
   */
  float albedo[3];
  /**
   * GGX: width of the distribution of slopes, 0.001 to 1.
   */
  float alpha;
  /**
   * Schlick: reflectance at normal incidence, 0 to 1.
   */
  float f0[3];
  /**
   * Conductor: real part of the index of refraction, 0.01 to 20.
   */
  float eta[3];
  /**
   * Conductor: its imaginary part, 0 to 20.
   */
  float k[3];
} StriaeBrdf;

/**
 * What is scratched. Set struct_size to sizeof(StriaeMaterial) first.
 */
typedef struct StriaeMaterial {
  /**
   * sizeof(StriaeMaterial)
   */
  size_t struct_size;
  /**
   * Vickers hardness, kgf/mm², 0.01 to 20000.
   */
  double hardness_hv;
  /**
   * How the unscratched surface reflects.
   */
  struct StriaeBrdf surface;
  /**
   * How a scratch's zones reflect.
   */
  struct StriaeBrdf scratched;
} StriaeMaterial;

/**
 * How a tool is held and pressed. Set struct_size to sizeof(StriaeProcess).
 */
typedef struct StriaeProcess {
  /**
   * sizeof(StriaeProcess)
   */
  size_t struct_size;
  /**
   * A StriaeDepthLaw.
   */
  uint32_t depth_law;
  /**
   * Normal force, kgf, 0 to 100000.
   */
  double force_kgf;
  /**
   * Spin about the tool's own axis, counter-clockwise from above, degrees.
   */
  double spin_deg;
  /**
   * Angle between the tool's axis and the surface normal, degrees, 0 to 85.
   */
  double tilt_deg;
  /**
   * Where the axis leans to: 0 = forward, 90 = left of travel, degrees.
   */
  double azimuth_deg;
} StriaeProcess;

/**
 * One of the two peaks beside a groove.
 */
typedef struct StriaePeak {
  /**
   * Slope of the inner flank, degrees.
   */
  double alpha_deg;
  /**
   * Slope of the outer flank, degrees.
   */
  double beta_deg;
  /**
   * Height above the surface, mm.
   */
  double height_mm;
  /**
   * Width of the inner flank, mm.
   */
  double inner_width_mm;
  /**
   * Width of the outer flank, mm.
   */
  double outer_width_mm;
} StriaePeak;

/**
 * Measures of a cross-section; all 0 where the force left no scratch. Set struct_size first.
 */
typedef struct StriaeCrossSectionInfo {
  /**
   * sizeof(StriaeCrossSectionInfo)
   */
  size_t struct_size;
  /**
   * Depth of the groove below the surface, mm.
   */
  double depth_mm;
  /**
   * Area of the groove below the surface, mm².
   */
  double groove_area_mm2;
  /**
   * Width of the groove at the surface, mm.
   */
  double groove_width_mm;
  /**
   * Width between the two crests, mm.
   */
  double crest_width_mm;
  /**
   * The peak left of travel.
   */
  struct StriaePeak left;
  /**
   * The peak right of travel.
   */
  struct StriaePeak right;
  /**
   * How many points striae_cross_section_vertices() has.
   */
  size_t vertex_count;
} StriaeCrossSectionInfo;

/**
 * Scale of a pattern. Set struct_size to sizeof(StriaePatternOptions).
 */
typedef struct StriaePatternOptions {
  /**
   * sizeof(StriaePatternOptions)
   */
  size_t struct_size;
  /**
   * Millimetres in one scene unit, 1e-9 to 1e9.
   */
  double mm_per_scene_unit;
  /**
   * Scene units that one unit of u and of v spans, 1e-9 to 1e9 each. Arc length along paths is measured
   * with it, nothing else: while shading, dp_du and dp_dv count.
   */
  double units_per_uv[2];
} StriaePatternOptions;

/**
 * Force and orientation at one place along a scratch.
 */
typedef struct StriaeKey {
  /**
   * Share of the path's arc length, 0 to 1, not below the key before.
   */
  double at;
  /**
   * Normal force, kgf, 0 to 100000.
   */
  double force_kgf;
  /**
   * Spin about the tool's own axis, counter-clockwise from above, degrees.
   */
  double spin_deg;
  /**
   * Angle between the tool's axis and the surface normal, degrees, 0 to 85.
   */
  double tilt_deg;
  /**
   * Where the axis leans to, relative to the travel: 0 = forward, 90 = left, degrees.
   */
  double azimuth_deg;
} StriaeKey;

/**
 * One scratch: a tool drawn along a path. Set struct_size to sizeof(StriaeScratch).
 */
typedef struct StriaeScratch {
  /**
   * sizeof(StriaeScratch)
   */
  size_t struct_size;
  /**
   * The tool.
   */
  const struct StriaeTool *tool;
  /**
   * Another hardness and finish than the surface's for this scratch; NULL for the surface's own.
   */
  const struct StriaeMaterial *material;
  /**
   * A StriaeCurve.
   */
  uint32_t curve;
  /**
   * A StriaeDepthLaw.
   */
  uint32_t depth_law;
  /**
   * The path's points in texture space, (u, v) each.
   */
  const double (*points_uv)[2];
  /**
   * How many points.
   */
  size_t point_count;
  /**
   * Force and orientation along the path, ascending in `at`: linear in arc length between keys, constant
   * before the first and after the last.
   */
  const struct StriaeKey *keys;
  /**
   * How many keys, 1 or more.
   */
  size_t key_count;
} StriaeScratch;

/**
 * A point of a scratched surface. `dp_du`, `dp_dv` and `normal` are in any one frame of the renderer's.
 */
typedef struct StriaePoint {
  /**
   * Texture coordinates.
   */
  double uv[2];
  /**
   * Derivative of position by u, scene units.
   */
  float dp_du[3];
  /**
   * Derivative of position by v, scene units.
   */
  float dp_dv[3];
  /**
   * Surface normal, of any length above 0.
   */
  float normal[3];
  /**
   * A StriaeFootprint; fields that it does not name are ignored.
   */
  uint32_t footprint;
  /**
   * Scene units.
   */
  float radius;
  /**
   * Change of (u, v) by one pixel in x.
   */
  float duv_dx[2];
  /**
   * Change of (u, v) by one pixel in y.
   */
  float duv_dy[2];
} StriaePoint;

/**
 * A point's local frame in the renderer's: z is the unit normal, x is dp_du made orthogonal to it, y is z cross x.
 */
typedef struct StriaeFrame {
  /**
   * Along dp_du.
   */
  float x[3];
  /**
   * z cross x.
   */
  float y[3];
  /**
   * The normal.
   */
  float z[3];
} StriaeFrame;

/**
 * A point seen from one direction: plain data, 8 KiB, on the caller's stack. It need not be initialised, owns
 * nothing, outlives its pattern, and may be copied and read by any thread. Write to none of it.
 */
typedef struct StriaeShading {
  /**
   * How much of what the pixel shows belongs to scratches, 0 to 1.
   */
  float coverage;
  /**
   * How many runs of scratch the footprint holds.
   */
  uint32_t scratch_count;
  /**
   * The library's own.
   */
  uint64_t opaque[1023];
} StriaeShading;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The library's version at run time: (major << 16) | (minor << 8) | patch. Any thread; never fails.
 */
uint32_t striae_version(void);

/**
 * The text of this thread's last failed call: which argument, what was given, what is accepted. UTF-8,
 * never NULL, empty before the first failure. Valid until this thread's next failure.
 */
const char *striae_last_error(void);

/**
 * Makes a cone whose tip is rounded by a sphere.
 *
 * @param half_angle_deg angle between flank and axis, 5 to 85
 * @param tip_radius_mm 0 (sharp) to 100
 * @param height_mm 1e-6 to 1000, and taller than the rounded tip; a scratch may not be deeper
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_sphero_cone(double half_angle_deg,
                                          double tip_radius_mm,
                                          double height_mm,
                                          struct StriaeTool **tool);

/**
 * Makes a pyramid, corners at azimuths 360 degrees (i + 1/2) / sides from the right of travel, counter-clockwise.
 *
 * @param sides 3 to 64
 * @param angle_deg between opposite faces (each stands at half of it to the axis), 10 to 170
 * @param height_mm 1e-6 to 1000
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_pyramid(uint32_t sides,
                                      double angle_deg,
                                      double height_mm,
                                      struct StriaeTool **tool);

/**
 * Makes a wedge: a straight edge across the travel, two faces meeting in it, flat upright ends.
 *
 * @param width_mm length of the edge, 1e-6 to 1000
 * @param angle_deg between the faces, 1 to 170
 * @param height_mm 1e-6 to 1000
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_wedge(double width_mm,
                                    double angle_deg,
                                    double height_mm,
                                    struct StriaeTool **tool);

/**
 * Makes a tool by name.
 *
 * @param preset a StriaeToolPreset
 * @param tool receives a handle to release with striae_tool_release(); NULL on failure
 */
enum StriaeStatus striae_tool_preset(uint32_t preset, struct StriaeTool **tool);

/**
 * Adds a reference. NULL is fine.
 */
void striae_tool_retain(const struct StriaeTool *tool);

/**
 * Drops a reference; the last one frees the tool. NULL is fine.
 */
void striae_tool_release(const struct StriaeTool *tool);

/**
 * Fills in a diffuse base BRDF.
 *
 * @param albedo RGB, each 0 to 1
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_lambert(const float albedo[3], struct StriaeBrdf *brdf);

/**
 * Fills in polished metal: GGX with the metal's own conductor Fresnel reflectance.
 *
 * @param metal a StriaeMetal
 * @param alpha width of the distribution of slopes, 0.001 (mirror) to 1 (rough)
 * @param brdf is written on success only
 */
enum StriaeStatus striae_brdf_metal(uint32_t metal, float alpha, struct StriaeBrdf *brdf);

/**
 * Fills in a metal: its hardness, a satin surface (GGX alpha 0.3) and smoother scratches (0.15).
 *
 * @param metal a StriaeMetal
 * @param material with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_material_metal(uint32_t metal, struct StriaeMaterial *material);

/**
 * Forms the cross-section that a tool, held and pressed so, leaves in a material.
 *
 * @param tool the tool
 * @param material its hardness counts
 * @param process how the tool is held and pressed
 * @param cross_section receives a handle to release with striae_cross_section_release(); NULL on failure
 */
enum StriaeStatus striae_cross_section(const struct StriaeTool *tool,
                                       const struct StriaeMaterial *material,
                                       const struct StriaeProcess *process,
                                       struct StriaeCrossSection **cross_section);

/**
 * Measures a cross-section.
 *
 * @param cross_section the cross-section
 * @param info with struct_size set; the rest is written on success only
 */
enum StriaeStatus striae_cross_section_info(const struct StriaeCrossSection *cross_section,
                                            struct StriaeCrossSectionInfo *info);

/**
 * Writes a cross-section's points (x, z), mm, from left to right of travel; the surface is at z = 0.
 *
 * @param cross_section the cross-section
 * @param xz_mm room for `capacity` points; NULL to ask for the count alone
 * @param capacity how many points there is room for; what does not fit is left out
 * @param count receives how many points the cross-section has; may be NULL
 */
enum StriaeStatus striae_cross_section_vertices(const struct StriaeCrossSection *cross_section,
                                                double (*xz_mm)[2],
                                                size_t capacity,
                                                size_t *count);

/**
 * Adds a reference. NULL is fine.
 */
void striae_cross_section_retain(const struct StriaeCrossSection *cross_section);

/**
 * Drops a reference; the last one frees the cross-section. NULL is fine.
 */
void striae_cross_section_release(const struct StriaeCrossSection *cross_section);

/**
 * Begins a pattern on an unscratched surface.
 *
 * @param surface the surface's material
 * @param options scale
 * @param builder receives a builder to free with striae_pattern_builder_free(); NULL on failure
 */
enum StriaeStatus striae_pattern_builder_new(const struct StriaeMaterial *surface,
                                             const struct StriaePatternOptions *options,
                                             struct StriaePatternBuilder **builder);

/**
 * Adds a scratch. Everything is copied; if it is refused, the builder is as it was.
 *
 * @param builder the builder
 * @param scratch the scratch
 */
enum StriaeStatus striae_pattern_builder_add_scratch(struct StriaePatternBuilder *builder,
                                                     const struct StriaeScratch *scratch);

/**
 * Builds the pattern of all scratches added so far. The builder stays usable.
 *
 * @param builder the builder
 * @param pattern receives a handle to release with striae_pattern_release(); NULL on failure
 */
enum StriaeStatus striae_pattern_builder_build(const struct StriaePatternBuilder *builder,
                                               struct StriaePattern **pattern);

/**
 * Frees a builder. Patterns built with it live on. NULL is fine.
 */
void striae_pattern_builder_free(struct StriaePatternBuilder *builder);

/**
 * Adds a reference. NULL is fine.
 */
void striae_pattern_retain(const struct StriaePattern *pattern);

/**
 * Drops a reference; the last one frees the pattern. NULL is fine.
 */
void striae_pattern_release(const struct StriaePattern *pattern);

/**
 * A point's local frame, in which `view` and `light` are given. Allocates nothing.
 *
 * @param point its normal and dp_du count. Without a usable dp_du (zero, or along the normal) x is any tangent.
 * @param frame is written on success only
 */
enum StriaeStatus striae_frame(const struct StriaePoint *point,
                               struct StriaeFrame *frame);

/**
 * Turns a vector of the renderer's frame into the local one. `world` and `local` may be the same.
 */
enum StriaeStatus striae_frame_to_local(const struct StriaeFrame *frame,
                                        const float world[3],
                                        float local[3]);

/**
 * Turns a vector of the local frame into the renderer's. `local` and `world` may be the same.
 */
enum StriaeStatus striae_frame_to_world(const struct StriaeFrame *frame,
                                        const float local[3],
                                        float world[3]);

/**
 * Prepares a point for one viewing direction: finds the scratches in its footprint and all that does not
 * depend on the light. Never allocates, locks or blocks; any number of threads at once.
 *
 * A point that is refused leaves a shading that can be used all the same, so that a render goes on: a view that
 * is no direction reflects nothing; a bad normal, uv or derivative gives the unscratched surface; a
 * footprint of zero, infinite or NaN size counts as a point. Only with a NULL argument is nothing written.
 * A view below the surface is no error: it reflects nothing.
 *
 * @param pattern the pattern
 * @param point the point
 * @param view direction to the viewer, away from the surface, in the local frame, of any length above 0
 * @param shading receives the result; need not be initialised
 */
enum StriaeStatus striae_shade(const struct StriaePattern *pattern,
                               const struct StriaePoint *point,
                               const float view[3],
                               struct StriaeShading *shading);

/**
 * Evaluates a prepared point for one light. Never allocates, locks or blocks; any number of threads at once.
 *
 * @param shading filled in by striae_shade()
 * @param light direction to the light, away from the surface, in the local frame, of any length above 0. From
 *     below the surface, or with no direction (NaN, zero), f is 0.
 * @param flags 0 for BRDF times cosine, STRIAE_EVAL_BRDF_ONLY for the BRDF alone
 * @param f receives linear RGB, never negative, never NaN
 */
enum StriaeStatus striae_eval(const struct StriaeShading *shading,
                              const float light[3],
                              uint32_t flags,
                              float f[3]);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* STRIAE_H */
