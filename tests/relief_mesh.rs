//! The relief as triangles: closed, where the cross-sections say, later scratches on top.

mod support;

use glam::{DVec2, DVec3};
use rand::Rng;
use std::collections::HashMap;
use striae::formation::{CrossSection, Process, Tool};
use striae::pattern::{
    Footprint, MeshRegion, MeshZone, Pattern, ReliefMesh, ScratchHit, SurfacePoint,
};
use support::lines::{Line, STEADY, pattern, uv};
use support::reliefs::{BOW, LEVEL, STEEP, patterns};
use support::{SHEET_MM, dark_sheet, random};

/// A square about the sheet's middle.
fn square(half_mm: f64) -> MeshRegion {
    MeshRegion {
        low_uv: uv([-half_mm; 2]),
        high_uv: uv([half_mm; 2]),
        tolerance_mm: 1e-4,
        base_mm: 0.0,
    }
}

fn corners(mesh: &ReliefMesh, triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|i| DVec3::from(mesh.positions[i as usize]))
}

/// How often each edge is passed from its first end to its second, and the other way round.
fn edges(mesh: &ReliefMesh) -> HashMap<[u32; 2], [u32; 2]> {
    let mut edges: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
    for [a, b, c] in &mesh.triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            assert_ne!(from, to, "a triangle without an area");
            let count = edges.entry([*from.min(to), *from.max(to)]).or_default();
            count[usize::from(from > to)] += 1;
        }
    }
    edges
}

/// Every edge belongs to two triangles that pass it in opposite directions; on an open surface but for the border's.
#[test]
fn watertight() {
    for (name, pattern) in patterns() {
        let mut region = square(1.0);
        let open = pattern.relief_mesh(&region).unwrap();
        let middle = 0.5 * SHEET_MM;
        let on_border = |i: u32| {
            let [x, y, _] = open.positions[i as usize];
            [x, y].map(|c| ((c - middle).abs() - 1.0).abs() < 1e-9)
        };
        for ([a, b], count) in edges(&open) {
            let (p, q) = (on_border(a), on_border(b));
            let is_border = (p[0] && q[0]) || (p[1] && q[1]);
            let is_sound = count == [1, 1] || (is_border && count.iter().sum::<u32>() == 1);
            assert!(
                is_sound,
                "{name}: {count:?} at {:?}",
                open.positions[a as usize]
            );
        }
        region.base_mm = 0.5;
        let closed = pattern.relief_mesh(&region).unwrap();
        let unsound = edges(&closed)
            .into_iter()
            .find(|(_, count)| *count != [1, 1]);
        assert!(unsound.is_none(), "{name}: {unsound:?}");
        println!(
            "{name}: {} triangles open, {} closed",
            open.triangles.len(),
            closed.triangles.len()
        );
    }
}

/// The same, however strokes may lie: closed meshes have no edge that is passed unevenly.
#[test]
fn watertight_whatever_crosses() {
    let mut random = random(21);
    for case in [0, 1, 2, 5] {
        let mut any = || [(); 2].map(|()| random.random_range(-1.1..1.1));
        let strokes: Vec<[[f64; 2]; 4]> =
            (0..4 + 2 * case).map(|_| [(); 4].map(|()| any())).collect();
        let lines: Vec<Line<'_>> = strokes
            .iter()
            .enumerate()
            .map(|(i, stroke)| match i % 3 {
                0 => Line::Straight(&stroke[..2]),
                1 => Line::Straight(stroke),
                _ => Line::Curve(stroke),
            })
            .collect();
        let pattern = pattern(&dark_sheet(), &lines, STEADY);
        let region = MeshRegion {
            tolerance_mm: 1e-3,
            base_mm: 0.5,
            ..square(1.0)
        };
        let mesh = pattern.relief_mesh(&region).unwrap();
        let edges = edges(&mesh);
        let uneven = edges.values().filter(|count| count[0] != count[1]).count();
        let crowded = edges.values().filter(|count| count[0] > 1).count();
        println!(
            "{case}: {} edges, {uneven} uneven, {crowded} shared by four",
            edges.len()
        );
        assert_eq!(uneven, 0, "{case}");
        assert_eq!(crowded, 0, "{case}");
    }
}

/// The volume of a closed mesh.
fn volume(mesh: &ReliefMesh) -> f64 {
    let base = DVec3::from(mesh.positions[0]);
    let parts = mesh.triangles.iter().map(|&triangle| {
        let [a, b, c] = corners(mesh, triangle).map(|p| p - base);
        a.dot(b.cross(c)) / 6.0
    });
    parts.sum()
}

/// Triangles point outward, and a solid lacks as much as its relief lacks: nothing where peaks hold what the groove lost.
#[test]
fn solids_hold_what_they_should() {
    for (name, line) in [
        ("straight", Line::Straight(LEVEL)),
        ("curved", Line::Curve(BOW)),
    ] {
        let pattern = pattern(&dark_sheet(), &[line], STEADY);
        let region = MeshRegion {
            base_mm: 0.1,
            tolerance_mm: 1e-5,
            ..square(1.0)
        };
        let lost = 4.0 * 0.1 - volume(&pattern.relief_mesh(&region).unwrap());
        let groove = section(2.0).groove_area_mm2() * 2.0;
        assert!(lost.abs() < 0.01 * groove, "{name}: {lost} of {groove}");
    }
}

fn section(force_kgf: f64) -> CrossSection {
    let process = Process {
        force_kgf,
        ..Process::default()
    };
    CrossSection::form(&Tool::rockwell_c(), &process, &dark_sheet()).unwrap()
}

/// Below the surface a straight scratch lacks its cross-section's groove along its length.
#[test]
fn groove_has_its_area() {
    let pattern = pattern(&dark_sheet(), &[Line::Straight(LEVEL)], STEADY);
    let mesh = pattern.relief_mesh(&square(1.0)).unwrap();
    let mut volume = 0.0;
    for &triangle in &mesh.triangles {
        let [a, b, c] = corners(&mesh, triangle);
        // No facet passes from below the surface to above it.
        if (a.z + b.z + c.z) < 0.0 {
            let area = 0.5 * (b - a).truncate().perp_dot((c - a).truncate());
            volume -= area * (a.z + b.z + c.z) / 3.0;
        }
    }
    let length = 2.0 * (DVec2::from(LEVEL[1]) - DVec2::from(LEVEL[0])).length() / 18.0;
    let off = volume / (section(2.0).groove_area_mm2() * length) - 1.0;
    assert!(off.abs() < 1e-5, "{off}");
}

/// The uppermost triangle at a place that is no wall.
fn look(mesh: &ReliefMesh, place: DVec2) -> Option<(f64, &MeshZone)> {
    let mut triangles = mesh.triangles.iter().zip(&mesh.zones);
    triangles.find_map(|(&triangle, zone)| {
        let [a, b, c] = corners(mesh, triangle);
        let sides = [(b, c), (c, a), (a, b)].map(|(p, q)| [p, q].map(|p| p.truncate() - place));
        let parts = sides.map(|[p, q]| p.perp_dot(q));
        let whole: f64 = parts.iter().sum();
        let holds = whole > 1e-15 && parts.iter().all(|part| *part >= 0.0);
        let z = || (parts[0] * a.z + parts[1] * b.z + parts[2] * c.z) / whole;
        holds.then(|| (z(), zone))
    })
}

/// Heights and scratches are those that a query tells for the same place.
#[test]
fn heights_are_the_cross_sections() {
    let mut random = random(4);
    // Where a scratch crosses itself a query tells of the nearer of its two places, not of the later.
    let told = |(name, _): &(&str, Pattern)| !["crossing itself", "all at once"].contains(name);
    for (name, pattern) in patterns().into_iter().filter(told) {
        let region = MeshRegion {
            tolerance_mm: 2e-5,
            ..square(1.0)
        };
        let mesh = pattern.relief_mesh(&region).unwrap();
        let (mut inside, mut worst) = (0, 0.0_f64);
        let mut differ = 0;
        for _ in 0..if cfg!(debug_assertions) { 1500 } else { 20_000 } {
            // Most of them near the middle, where all that these patterns hold comes together.
            let spread = random.random_range(0.0..1.0_f64).powi(2);
            let mut any = || spread * random.random_range(-1.0..1.0);
            let place = [any(), any()];
            let mut hits = [ScratchHit::default(); 4];
            let found = pattern.hits(&point(place), &mut hits).unwrap();
            let told = (found.written > 0).then_some(hits[0]);
            let (z, zone) = look(&mesh, DVec2::from(uv(place)) * SHEET_MM).unwrap();
            let scratch = told.map_or(MeshZone::NO_SCRATCH, |hit| hit.scratch);
            if scratch != zone.scratch {
                differ += 1;
                continue;
            }
            // In a fan a query tells of the nearest place on the path, which has another height.
            let on_path = told.filter(|hit| !is_end(&pattern, hit, place));
            if let Some(hit) = on_path {
                inside += 1;
                worst = worst.max((z + f64::from(hit.depth_mm)).abs());
            }
        }
        println!("{name}: {inside} on scratches, {worst:.1e} mm, {differ} differ");
        assert!(inside > 50, "{name}: {inside} on scratches");
        assert!(worst < region.tolerance_mm, "{name}: {worst} mm");
        assert!(differ <= 3, "{name}: {differ} others on top");
    }
}

fn point(place_mm: [f64; 2]) -> SurfacePoint {
    SurfacePoint {
        uv: uv(place_mm),
        dp_du: [1000.0, 0.0, 0.0],
        dp_dv: [0.0, 1000.0, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint: Footprint::Point,
    }
}

/// Whether the nearest place on a path is one of its ends: a step along it leads nowhere.
fn is_end(pattern: &Pattern, hit: &ScratchHit, place_mm: [f64; 2]) -> bool {
    let travel = DVec2::new(f64::from(hit.travel[0]), f64::from(hit.travel[1]));
    [-1e-4, 1e-4].into_iter().any(|step| {
        let beside = (DVec2::from(place_mm) + step * travel).to_array();
        let mut hits = [ScratchHit::default(); 1];
        let found = pattern.hits(&point(beside), &mut hits).unwrap();
        found.written == 0
            || hits[0].scratch != hit.scratch
            || (hits[0].arc_length - hit.arc_length).abs() < 5e-5
    })
}

/// Files hold all vertices and triangles, each scratch as a group of its own, and the crate's own reader takes them.
#[cfg(feature = "files")]
#[test]
fn files_hold_all() {
    let mut region = square(1.0);
    region.base_mm = 0.5;
    let pattern = pattern(
        &dark_sheet(),
        &[Line::Straight(LEVEL), Line::Straight(STEEP)],
        STEADY,
    );
    let mesh = pattern.relief_mesh(&region).unwrap();
    let folder = std::env::temp_dir().join(format!("striae-relief-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let [obj, ply, other] = ["mesh.obj", "mesh.PLY", "mesh.txt"].map(|name| folder.join(name));
    mesh.write(&obj).unwrap();
    mesh.write(&ply).unwrap();
    let refused = mesh.write(&other).unwrap_err().to_string();
    let text = std::fs::read_to_string(&obj).unwrap();
    let bytes = std::fs::read(&ply).unwrap();
    let tools = [&obj, &ply].map(|path| striae::files::read_tool(path, 1.0).is_ok());
    std::fs::remove_dir_all(&folder).unwrap();

    assert!(refused.contains("mesh.txt: a name that ends"), "{refused}");
    let lines = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
    let (vertices, triangles) = (mesh.positions.len(), mesh.triangles.len());
    assert_eq!((lines("v "), lines("f ")), (vertices, triangles));
    for group in ["g surface", "g scratch_0", "g scratch_1"] {
        assert_eq!(lines(group), 1, "{group}");
    }
    let end = bytes
        .windows(11)
        .position(|w| w == b"end_header\n")
        .unwrap()
        + 11;
    assert_eq!(bytes.len() - end, 24 * vertices + (1 + 12 + 8) * triangles);
    assert_eq!(tools, [true; 2], "the crate's own reader");
}

/// Regions that are none, and numbers out of range, are refused by name.
#[test]
fn bad_regions() {
    let pattern = pattern(&dark_sheet(), &[Line::Straight(LEVEL)], STEADY);
    let sound = square(1.0);
    for (region, name) in [
        (
            MeshRegion {
                high_uv: sound.low_uv,
                ..sound
            },
            "high_uv",
        ),
        (
            MeshRegion {
                low_uv: [f64::NAN, 0.0],
                ..sound
            },
            "low_uv",
        ),
        (
            MeshRegion {
                high_uv: [2e9, 1.0],
                ..sound
            },
            "high_uv",
        ),
        (
            MeshRegion {
                tolerance_mm: 0.0,
                ..sound
            },
            "tolerance_mm",
        ),
        (
            MeshRegion {
                base_mm: 1e-3,
                ..sound
            },
            "base_mm",
        ),
        (
            MeshRegion {
                base_mm: -1.0,
                ..sound
            },
            "base_mm",
        ),
    ] {
        let error = pattern.relief_mesh(&region).unwrap_err();
        assert_eq!(error.argument(), name, "{error}");
    }
}

/// Regions that are absurd and yet regions give a mesh or an answer, never a panic.
#[test]
fn absurd_regions() {
    let pattern = pattern(
        &dark_sheet(),
        &[
            Line::Straight(LEVEL),
            Line::Curve(BOW),
            Line::Straight(STEEP),
        ],
        STEADY,
    );
    for (low_uv, size) in [
        ([0.5, 0.5], 1e-15),
        ([0.5, 0.5], 1e-9),
        ([0.5, 0.5], 1e-300),
        ([-1e9, -1e9], 2e9),
        ([1e9 - 1.0, 0.0], 1.0),
        ([-1.0, -1.0], 1e3),
        ([0.0, 0.0], 1e-300),
    ] {
        let region = MeshRegion {
            low_uv,
            high_uv: low_uv.map(|low| low + size),
            tolerance_mm: 1e-3,
            base_mm: 0.5,
        };
        let Ok(mesh) = pattern.relief_mesh(&region) else {
            continue;
        };
        assert!(
            mesh.positions.iter().flatten().all(|x| x.is_finite()),
            "{region:?}"
        );
        let uneven = edges(&mesh)
            .into_values()
            .find(|count| count[0] != count[1]);
        assert_eq!(uneven, None, "{region:?}");
    }
}

/// Of two that cross the later one is on top, whole; the earlier one goes on behind it.
#[test]
fn later_scratch_wins() {
    for (lines, top) in [([LEVEL, STEEP], STEEP), ([STEEP, LEVEL], LEVEL)] {
        let lines = lines.map(Line::Straight);
        let pattern = pattern(&dark_sheet(), &lines, STEADY);
        let mesh = pattern.relief_mesh(&square(1.0)).unwrap();
        let [from, to] = [0, 1].map(|i| DVec2::from(uv(top[i])) * SHEET_MM);
        let mut hits = [ScratchHit::default(); 1];
        pattern
            .hits(&point(top[0].map(|c| c / 9.5)), &mut hits)
            .unwrap();
        let deepest_mm = f64::from(hits[0].deepest_mm);
        for i in 0..2000 {
            let (z, zone) =
                look(&mesh, from.lerp(to, 0.46 + 0.08 * f64::from(i) / 2000.0)).unwrap();
            assert_eq!(zone.scratch, 1);
            assert!((z + deepest_mm).abs() < 1e-6, "{z}");
        }
        // Both are there in all.
        assert!(
            mesh.zones.iter().any(|zone| zone.scratch == 0),
            "only the later"
        );
    }
}
