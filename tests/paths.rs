//! Box filters add up along curves, at corners and crossings, within 1 %.

mod support;

use glam::DVec2;
use striae::formation::Material;
use support::lines::{Line, STEADY, pattern, worst_of_parts};
use support::{SHEET_MM, Sheet, dark_sheet, ggx, lambert, relative};

fn shiny(alpha: f32) -> Material {
    Material {
        surface: ggx(0.3, 0.3),
        scratched: ggx(alpha, 0.9),
        ..dark_sheet()
    }
}

/// Arcs of 50 mm and of 3 mm radius, and an S with a point where it turns over, matt.
#[test]
fn curves() {
    for radius in [50.0, 3.0] {
        let k = 0.552_284_75 * radius;
        let r = radius;
        let arc = [[r, 0.0], [r, k], [k, r], [0.0, r]];
        let pattern = pattern(&dark_sheet(), &[Line::Curve(&arc)], STEADY);
        let near = [30.0, 45.0, 70.0_f64].map(|degrees| {
            let (y, x) = degrees.to_radians().sin_cos();
            [r * x, r * y]
        });
        let worst = worst_of_parts("arc", &pattern, &near, [0.01, 0.6 * radius]);
        assert!(worst < 0.01, "arc of {radius} mm: {worst}");
    }
    let s = [[-20.0, 0.0], [-5.0, 30.0], [5.0, -30.0], [20.0, 0.0]];
    let pattern = pattern(&dark_sheet(), &[Line::Curve(&s)], STEADY);
    let worst = worst_of_parts("S", &pattern, &[[0.0, 0.0], [10.2, -6.1]], [0.01, 15.0]);
    assert!(worst < 0.01, "S: {worst}");
}

/// The same arc with a highlight that moves along it, from satin to polished.
#[test]
#[ignore = "2 % at a GGX width of 0.03: runs turn more than the lobe is wide"]
fn shiny_curves() {
    let arc = [[50.0, 0.0], [50.0, 27.614], [27.614, 50.0], [0.0, 50.0]];
    let mut failed = Vec::new();
    for alpha in [0.3, 0.1, 0.03] {
        let pattern = pattern(&shiny(alpha), &[Line::Curve(&arc)], STEADY);
        let near = [[35.355, 35.355], [43.3, 25.0]];
        let name = format!("arc, alpha {alpha}");
        let worst = worst_of_parts(&name, &pattern, &near, [0.01, 30.0]);
        if worst >= 0.01 {
            failed.push(format!("{name}: {worst}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A corner is one stroke that turns: nothing is counted twice or left out on its way round.
#[test]
fn corners() {
    for degrees in [20.0_f64, 90.0, 130.0] {
        let (y, x) = degrees.to_radians().sin_cos();
        let bent = [[-200.0, 0.0], [0.0, 0.0], [200.0 * x, 200.0 * y]];
        let pattern = pattern(&dark_sheet(), &[Line::Straight(&bent)], STEADY);
        let worst = worst_of_parts("corner", &pattern, &[[0.0, 0.0]], [0.3, 60.0]);
        assert!(worst < 0.01, "corner of {degrees}°: {worst}");
    }
}

/// Two and three scratches through one point, the crossing itself below 1/500 of the pixel: where scratches
/// lie on one another they share the surface, and a pixel does not know how much of it does.
#[test]
fn crossings() {
    let lines = [
        [[-200.0, 0.0], [200.0, 0.0]],
        [[-150.0, -150.0], [150.0, 150.0]],
        [[10.0, -200.0], [-10.0, 200.0]],
    ];
    for (name, material) in [
        ("matt", dark_sheet()),
        ("shiny", shiny(0.2)),
        ("polished", shiny(0.02)),
    ] {
        for count in [2, 3] {
            let lines: Vec<Line<'_>> = lines[..count].iter().map(|l| Line::Straight(l)).collect();
            let pattern = pattern(&material, &lines, STEADY);
            let name = format!("{count} crossing, {name}");
            let worst = worst_of_parts(&name, &pattern, &[[0.0, 0.0]], [14.0, 60.0]);
            assert!(worst < 0.01, "{name}: {worst}");
        }
    }
}

/// The comparison can fail: a scratch that only the parts see, and black instead of white.
#[test]
fn differences_are_noticed() {
    let line = [[-200.0, 0.0], [200.0, 0.0]];
    let bright = pattern(&dark_sheet(), &[Line::Straight(&line)], STEADY);
    let darker = Material {
        scratched: lambert(0.8),
        ..dark_sheet()
    };
    let dark = pattern(&darker, &[Line::Straight(&line)], STEADY);
    let edge = 1.0 / SHEET_MM;
    let [a, b] = [&bright, &dark].map(|pattern| {
        Sheet::UPRIGHT.pixel(pattern, DVec2::splat(0.5), edge * DVec2::X, edge * DVec2::Y)
    });
    assert!(relative(a, b) > 0.02, "{a} and {b} look alike");
}
