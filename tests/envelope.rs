//! Grooves against brute force: a tool's whole surface turned, projected along the travel, and its lowest
//! points taken.

mod support;

use glam::{DVec2, Vec3Swizzles};
use striae::formation::Orientation;
use support::random;
use support::tool_surface::{Shape, any_case, any_section, crossing, lowest, turn};

/// Vertices below the surface lie on the tool's lowest points, and so does every place between them.
#[test]
fn grooves_are_lower_envelopes() {
    let mut random = random(31);
    let mut worst = (0.0, String::new());
    for _ in 0..150 {
        let (name, section, edges) = any_case(&mut random);
        let vertices = section.vertices();
        let deep = -1e-6 * section.depth_mm();
        let below: Vec<DVec2> = vertices.iter().copied().filter(|p| p.y < deep).collect();
        for pair in below.windows(2) {
            let (run, rise) = (pair[1].x - pair[0].x, pair[1].y - pair[0].y);
            // A wall as good as upright: nothing lies between.
            if run < 0.05 * rise.abs() {
                continue;
            }
            for s in [1e-3, 0.3, 0.5, 0.999] {
                let p = pair[0].lerp(pair[1], s);
                if p.y > -1e-3 * section.depth_mm() {
                    continue;
                }
                let deviation = (lowest(&edges, p.x) - p.y).abs() / section.depth_mm();
                if deviation > worst.0 {
                    worst = (deviation, format!("at {p}: {name}"));
                }
            }
        }
    }
    println!("envelope: {:.1e} of the depth, {}", worst.0, worst.1);
    // Chords of the rounded tip, ours and the brute force's own.
    assert!(worst.0 < 2e-3, "{} of the depth {}", worst.0, worst.1);
}

/// However a tool is leant, its cross-section runs from left to right: a flank that overhangs leaves an upright
/// wall.
#[test]
fn cross_sections_never_fold_back() {
    let mut random = random(34);
    let mut folded = Vec::new();
    for _ in 0..400 {
        let (shape, process, section) = any_section(&mut random);
        let vertices = section.vertices();
        let size = vertices[vertices.len() - 1].x - vertices[0].x;
        let back = vertices.windows(2).map(|pair| pair[0].x - pair[1].x);
        if back.fold(0.0, f64::max) > 1e-9 * size {
            folded.push(format!("{shape:?}, {process:?}"));
        }
    }
    assert!(folded.is_empty(), "{} of 400: {folded:#?}", folded.len());
}

/// The groove is as wide and as large as where the tool's lowest points lie below the surface.
#[test]
fn widths_and_areas() {
    let mut random = random(32);
    let mut worst = (0.0, String::new());
    for _ in 0..60 {
        let (name, section, edges) = any_case(&mut random);
        let reach = 3.0 * section.groove_width_mm();
        // From a place below the surface to both sides.
        let inside = section.vertices().iter().find(|p| p.y < 0.0).unwrap().x;
        let [left, right] = [-reach, reach].map(|far| crossing(&edges, inside, inside + far));
        let width = right - left;
        let step = width / 1000.0;
        let depth = |i| -lowest(&edges, left + step * (f64::from(i) + 0.5));
        let area = step * (0..1000).map(depth).sum::<f64>();
        for (what, ours, truth) in [
            ("width", section.groove_width_mm(), width),
            ("area", section.groove_area_mm2(), area),
        ] {
            let deviation = (ours - truth).abs() / truth;
            if deviation > worst.0 {
                worst = (deviation, format!("{what} {ours}, not {truth}: {name}"));
            }
        }
    }
    println!("groove: {:.1e}, {}", worst.0, worst.1);
    assert!(worst.0 < 2e-3, "{}: {}", worst.0, worst.1);
}

/// The inner flanks go on as steep as the tool where it crosses the surface, up to 85°.
#[test]
fn flanks_are_as_steep_as_the_tool() {
    let mut random = random(33);
    let mut worst = (0.0, String::new());
    for _ in 0..100 {
        let (name, section, edges) = any_case(&mut random);
        let vertices = section.vertices();
        let deep = |p: &&DVec2| p.y < -1e-6 * section.depth_mm();
        let first = vertices.iter().find(deep).unwrap();
        let last = vertices.iter().rev().find(deep).unwrap();
        for (side, peak, inner, outwards) in [
            ("left", section.left(), first, -1.0),
            ("right", section.right(), last, 1.0),
        ] {
            // Bracket the crossing from inside, and take the slope just below it.
            let far = 3.0 * outwards * section.groove_width_mm();
            let low = crossing(&edges, inner.x, inner.x + far);
            let step = 2e-3 * section.depth_mm();
            let (a, b) = (lowest(&edges, low - outwards * step), lowest(&edges, low));
            let upright = b < -1e-6 * section.depth_mm();
            let alpha = if upright {
                90.0
            } else {
                ((b - a) / step).atan().to_degrees()
            };
            let deviation = (peak.alpha_deg - alpha.min(85.0)).abs();
            if deviation > worst.0 {
                let report = format!("{side}: alpha {}, not {alpha}: {name}", peak.alpha_deg);
                worst = (deviation, report);
            }
        }
    }
    println!("flanks: {:.2e} degrees, {}", worst.0, worst.1);
    // The brute force's own facets turn by 0.7° at most from one to the next.
    assert!(worst.0 < 0.4, "{}", worst.1);
}

/// The brute force knows left from right and a lean from none.
#[test]
fn brute_force_leans_the_right_way() {
    let edges = Shape::Cone {
        half_angle_deg: 45.0,
        radius_mm: 0.0,
    }
    .edges();
    let left = Orientation {
        tilt_deg: 20.0,
        azimuth_deg: 90.0,
        ..Orientation::default()
    };
    let turn = turn(&left);
    let seen: Vec<[DVec2; 2]> = edges.iter().map(|e| e.map(|p| (turn * p).xz())).collect();
    // Leant to the left, the left flank is 45° - 20° above the surface, the right one 45° + 20°.
    for (x, degrees) in [(-0.5, 25.0_f64), (0.5, 65.0)] {
        let expected = 0.5 * degrees.to_radians().tan();
        let z = lowest(&seen, x);
        assert!((z - expected).abs() < 1e-4, "{z} at {x}, not {expected}");
    }
}
