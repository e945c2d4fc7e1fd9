//! How a tool is held: what is symmetric, what is mirrored, and that nothing jumps as it turns.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::formation::{CrossSection, DepthLaw, Orientation, Peak, Tool};
use support::jumps::largest_jump;
use support::process::{any_hold, form};
use support::{random, relative};

/// Tools alike on both sides leave sections alike on both sides.
#[test]
fn symmetric_tools_leave_symmetric_sections() {
    for (tool, spin_deg) in [
        (Tool::rockwell_c(), 77.0),
        (Tool::vickers(), 0.0),
        (Tool::vickers(), 45.0),
        (Tool::pyramid(6, 140.0, 5.0).unwrap(), 30.0),
        (Tool::pyramid(3, 120.0, 5.0).unwrap(), 30.0),
        (Tool::wedge(0.3, 120.0, 5.0).unwrap(), 0.0),
        (Tool::wedge(0.3, 120.0, 5.0).unwrap(), 90.0),
    ] {
        for azimuth_deg in [0.0, 180.0] {
            let hold = Orientation {
                spin_deg,
                tilt_deg: 8.0,
                azimuth_deg,
            };
            let section = form(&tool, DepthLaw::Bosch2004, 3.0, hold);
            assert_mirrored(&section, &section);
        }
    }
}

/// That `a` is `b` with left and right swapped.
fn assert_mirrored(a: &CrossSection, b: &CrossSection) {
    for (x, y) in [(a.left(), b.right()), (a.right(), b.left())] {
        let values = |p: Peak| {
            [
                p.alpha_deg,
                p.beta_deg,
                p.height_mm,
                p.inner_width_mm,
                p.outer_width_mm,
            ]
        };
        for (x, y) in values(x).into_iter().zip(values(y)) {
            assert!(relative(x, y) < 1e-6, "{x} and {y}: {a:?}, {b:?}");
        }
    }
    let size = a.crest_width_mm();
    let (there, mut back) = (a.vertices(), b.vertices());
    back.reverse();
    // Each polyline passes through the other's mirrored vertices.
    for p in &there {
        let away = |pair: &[DVec2]| {
            let mirror = |p: DVec2| DVec2::new(-p.x, p.y);
            let (from, to) = (mirror(pair[0]), mirror(pair[1]));
            let along = (to - from).normalize_or_zero();
            let s = (*p - from).dot(along).clamp(0.0, from.distance(to));
            p.distance(from + s * along)
        };
        let nearest = back.windows(2).map(away).fold(f64::INFINITY, f64::min);
        assert!(
            nearest < 1e-4 * size,
            "{p} is {nearest} from the mirrored section"
        );
    }
}

/// A mirrored hand leaves a mirrored section.
#[test]
fn mirrored_azimuth_mirrors_left_and_right() {
    let mut random = random(43);
    let mut lopsided = 0;
    for _ in 0..200 {
        let tool = match random.random_range(0..3) {
            0 => Tool::sphero_cone(random.random_range(40.0..80.0), 0.1, 5.0),
            1 => Tool::pyramid(4, random.random_range(100.0..160.0), 5.0),
            _ => Tool::wedge(
                random.random_range(0.05..0.5),
                random.random_range(90.0..160.0),
                5.0,
            ),
        }
        .unwrap();
        let hold = any_hold(&mut random);
        let mirrored = Orientation {
            spin_deg: -hold.spin_deg,
            azimuth_deg: -hold.azimuth_deg,
            ..hold
        };
        let [a, b] = [hold, mirrored].map(|hold| form(&tool, DepthLaw::Bosch2004, 2.0, hold));
        assert_mirrored(&a, &b);
        lopsided += u32::from(relative(a.left().height_mm, a.right().height_mm) > 1e-3);
    }
    assert!(
        lopsided > 100,
        "only {lopsided} sections differ from left to right"
    );
}

/// Turning the tool little by little changes the section little by little.
#[test]
fn sections_are_continuous_in_the_hold() {
    for (name, tool) in [
        ("Rockwell C", Tool::rockwell_c()),
        ("Vickers", Tool::vickers()),
        ("wedge", Tool::wedge(0.3, 120.0, 5.0).unwrap()),
    ] {
        for measure in 0..4 {
            let walk = |s: f64| {
                let hold = Orientation {
                    spin_deg: 200.0 * s,
                    tilt_deg: 14.0 * (3.0 * s).sin().abs(),
                    azimuth_deg: 300.0 * s - 100.0,
                };
                let section = form(&tool, DepthLaw::Bosch2004, 2.0, hold);
                [
                    section.groove_area_mm2(),
                    section.groove_width_mm(),
                    section.left().height_mm,
                    section.right().outer_width_mm,
                ][measure]
            };
            let (jump, at) = largest_jump(walk);
            println!("{name}, measure {measure}: largest jump {jump:.1e}");
            assert!(
                jump < 1e-4,
                "{name}, measure {measure} jumps by {jump} at {at}"
            );
        }
    }
}
