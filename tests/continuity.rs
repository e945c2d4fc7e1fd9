//! Nothing jumps: along a scratch, across it, zooming out, and as view and light turn.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::formation::{Orientation, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, Scratch, SurfacePoint};
use support::crowd::{add, tangle};
use support::jumps::{CROWD, NOISE, assert_jumps_below, assert_smooth, largest_jump};
use support::{SHEET_MM, Sheet, dark_sheet, direction, random, sheet_of, straight};

const SLANTED: Sheet = Sheet {
    view: [-0.3, 0.4, 0.866],
    light: [0.5, 0.3, 0.8],
    ..Sheet::UPRIGHT
};

fn key(at: f64, force_kgf: f64, angles: [f64; 3]) -> Key {
    let [spin_deg, tilt_deg, azimuth_deg] = angles;
    let mut key = Key::force(at, force_kgf);
    key.orientation = Orientation {
        spin_deg,
        tilt_deg,
        azimuth_deg,
    };
    key
}

fn one(tool: &Tool, path: Path<'_>, keys: &[Key]) -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    builder
        .add(&Scratch {
            path,
            keys,
            ..Scratch::new(tool)
        })
        .unwrap();
    builder.build()
}

/// A pixel of `size_mm`, a little askew.
fn pixel(pattern: &Pattern, uv: DVec2, size_mm: f64) -> f64 {
    let dx = size_mm / SHEET_MM * DVec2::new(0.9, 0.2);
    SLANTED.pixel(pattern, uv, dx, 0.7 * dx.perp())
}

/// Force, spin, tilt and azimuth that change along the path change what is seen without a jump.
#[test]
fn along_a_scratch_whose_process_changes() {
    let keys = [
        key(0.0, 1.0, [0.0, 0.0, 0.0]),
        key(0.3, 4.0, [40.0, 15.0, 90.0]),
        key(0.5, 2.0, [-70.0, 15.0, 270.0]),
        key(0.5001, 3.0, [-70.0, 3.0, 0.0]),
        key(0.9, 0.5, [90.0, 10.0, -90.0]),
    ];
    let line = [[0.3, 0.5], [0.7, 0.52]];
    for (name, tool) in [
        ("Rockwell C", Tool::rockwell_c()),
        ("Vickers", Tool::vickers()),
        ("nail", Tool::nail()),
    ] {
        let pattern = one(&tool, Path::Polyline(&line), &keys);
        for size_mm in [0.02, 0.5] {
            let along = |s| DVec2::from(line[0]).lerp(DVec2::from(line[1]), s);
            assert_smooth(&format!("along, {name}, {size_mm} mm"), |s| {
                pixel(&pattern, along(s), size_mm)
            });
        }
    }
}

/// A tool whose outline has corners, which pass the surface as it is turned.
#[test]
fn along_a_scratch_of_a_turning_edge() {
    let keys = [
        key(0.0, 1.0, [0.0, 0.0, 0.0]),
        key(0.3, 4.0, [40.0, 15.0, 90.0]),
        key(0.6, 2.0, [-70.0, 3.0, 270.0]),
        key(0.7, 3.0, [-70.0, 15.0, 0.0]),
        key(0.9, 0.5, [90.0, 10.0, -90.0]),
    ];
    let line = [[0.3, 0.5], [0.7, 0.52]];
    let edge = Tool::wedge(0.1, 120.0, 5.0).unwrap();
    let pattern = one(&edge, Path::Polyline(&line), &keys);
    for size_mm in [0.02, 0.5, 10.0] {
        let along = |s| DVec2::from(line[0]).lerp(DVec2::from(line[1]), s);
        assert_smooth(&format!("along, turning edge, {size_mm} mm"), |s| {
            pixel(&pattern, along(s), size_mm)
        });
    }
}

/// Joints of Bézier pieces show no seam, on a curve that turns a full circle.
#[test]
fn around_a_circle_of_bezier_pieces() {
    let k = 0.552_284_75;
    let unit = [
        [1.0, 0.0],
        [1.0, k],
        [k, 1.0],
        [0.0, 1.0],
        [-k, 1.0],
        [-1.0, k],
        [-1.0, 0.0],
        [-1.0, -k],
        [-k, -1.0],
        [0.0, -1.0],
        [k, -1.0],
        [1.0, -k],
        [1.0, 0.0],
    ];
    let radius = 0.02;
    let points = unit.map(|p| p.map(|x| 0.5 + radius * x));
    let keys = [Key::force(0.0, 2.0)];
    let pattern = one(&Tool::rockwell_c(), Path::CubicBezier(&points), &keys);
    for size_mm in [0.05, 1.0, 15.0] {
        assert_smooth(&format!("around a circle, {size_mm} mm"), |s| {
            // From 0.1 to 0.9: its two ends meet at 0.
            let angle = std::f64::consts::TAU * (0.1 + 0.8 * s);
            let uv = DVec2::splat(0.5) + radius * DVec2::from_angle(angle);
            pixel(&pattern, uv, size_mm)
        });
    }
}

/// A soft end fades into the bare sheet.
#[test]
fn soft_ends() {
    let keys = [Key::force(0.0, 2.0), Key::force(1.0, 0.0)];
    let line = [[0.4, 0.5], [0.6, 0.5]];
    let pattern = one(&Tool::rockwell_c(), Path::Polyline(&line), &keys);
    for size_mm in [0.001, 0.05, 2.0] {
        let at = |s: f64| pixel(&pattern, DVec2::new(0.5 + 0.12 * s, 0.5), size_mm);
        assert_smooth(&format!("soft end, {size_mm} mm"), at);
        assert_eq!(
            at(1.0),
            pixel(&pattern, DVec2::splat(0.1), size_mm),
            "not bare"
        );
    }
}

/// Walking across a scratch in tiny steps.
#[test]
fn across_a_scratch() {
    let line = ([0.2, 0.5], [0.8, 0.55]);
    for tool in [Tool::rockwell_c(), Tool::vickers()] {
        let pattern = straight(&dark_sheet(), &tool, &[line], 2.0);
        for size_mm in [0.002, 0.1, 3.0] {
            assert_smooth(&format!("across, {size_mm} mm"), |s| {
                let uv = DVec2::new(0.5, 0.525 + (4.0 * size_mm + 0.4) * (s - 0.5) / SHEET_MM);
                pixel(&pattern, uv, size_mm)
            });
        }
    }
}

/// Zooming out from a thousandth of a scratch's width to a thousand times it, on one scratch, on a
/// crossing, and on a tangle.
#[test]
fn zooming_out() {
    let zoom = |limit: f64, name: &str, pattern: &Pattern, uv: DVec2| {
        for radius in [false, true] {
            let name = format!("zooming out of {name}, radius {radius}");
            assert_jumps_below(limit, &name, |s| {
                let size_mm = 10_f64.powf(6.0 * s - 4.0);
                if !radius {
                    return pixel(pattern, uv, size_mm);
                }
                let point = SurfacePoint {
                    footprint: Footprint::Radius(support::single(size_mm)),
                    ..SLANTED.point(uv, DVec2::ZERO, DVec2::ZERO)
                };
                SLANTED.radiance(pattern, &point)
            });
        }
    };
    let lines = [([0.2, 0.5], [0.8, 0.5]), ([0.4, 0.4], [0.6, 0.6])];
    let tool = Tool::rockwell_c();
    let single = straight(&dark_sheet(), &tool, &lines[..1], 2.0);
    zoom(NOISE, "a scratch", &single, DVec2::new(0.5, 0.50001));
    let crossing = straight(&dark_sheet(), &tool, &lines, 2.0);
    zoom(NOISE, "a crossing", &crossing, DVec2::new(0.5, 0.50003));
    let mut random = random(3);
    let mut builder = sheet_of(&dark_sheet());
    for _ in 0..60 {
        let (shift, turn) = (
            random.random_range(-40.0..40.0),
            random.random_range(0.0..180.0),
        );
        add(
            &mut builder,
            &tool,
            None,
            shift,
            turn,
            random.random_range(0.2..2.0),
        );
    }
    zoom(CROWD, "a tangle", &builder.build(), DVec2::new(0.5, 0.501));
}

/// Walking over wide scratches that cross, of whose parts there are more than a shading point has room for.
#[test]
fn over_wide_scratches_that_cross() {
    for seed in 0..6_u32 {
        let mut random = random(seed.into());
        let pattern = tangle(&dark_sheet(), &mut random);
        let way = 0.3 / SHEET_MM * DVec2::from_angle(f64::from(seed));
        let size_mm = random.random_range(0.45..0.7);
        assert_jumps_below(0.3 * CROWD, &format!("over wide scratches, {seed}"), |s| {
            pixel(&pattern, DVec2::splat(0.5) + (s - 0.5) * way, size_mm)
        });
    }
}

/// Turning the light and the view from one horizon to the other.
#[test]
fn turning_view_and_light() {
    let line = ([0.2, 0.5], [0.8, 0.55]);
    let pattern = straight(&dark_sheet(), &Tool::vickers(), &[line], 2.0);
    for size_mm in [0.02, 2.0] {
        let edge = size_mm / SHEET_MM;
        for turns_view in [false, true] {
            assert_smooth(&format!("turning, {size_mm} mm, view {turns_view}"), |s| {
                let turned = direction(178.0 * s - 89.0, 70.0);
                let mut sheet = SLANTED;
                *(if turns_view {
                    &mut sheet.view
                } else {
                    &mut sheet.light
                }) = turned;
                let uv = DVec2::new(0.5, 0.52502);
                sheet.pixel(&pattern, uv, edge * DVec2::X, edge * DVec2::Y)
            });
        }
    }
}

/// The search finds a jump of a thousandth in a curve that is steep elsewhere.
#[test]
fn jumps_are_noticed() {
    let steep = |s: f64| (200.0 * (s - 0.3)).tanh() + 2.0;
    assert!(
        largest_jump(steep).0 < 1e-6,
        "a steep curve taken for a jump"
    );
    let broken = |s: f64| steep(s) + if s > 0.301_234 { 4e-3 } else { 0.0 };
    let (jump, at) = largest_jump(broken);
    assert!(
        jump > 1e-3 && (at - 0.301_234).abs() < 1e-6,
        "{jump} at {at}"
    );
}
