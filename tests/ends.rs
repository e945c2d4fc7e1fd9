//! Box filters add up where scratches end or change within a pixel, within 1 %.

mod support;

use glam::DVec2;
use std::f64::consts::PI;
use striae::formation::Tool;
use striae::pattern::Key;
use striae::scattering::Shading;
use support::lines::{Line, STEADY, pattern, worst_of_parts};
use support::{SHEET_MM, Sheet, dark_sheet, relative, straight};

/// Scratches that end hard, or softly, inside the footprint.
#[test]
fn ends() {
    let line = [[-200.0, 0.0], [0.0, 0.0]];
    let soft = [Key::force(0.0, 2.0), Key::force(1.0, 0.0)];
    for (name, keys) in [("hard", STEADY), ("soft", &soft[..])] {
        let pattern = pattern(&dark_sheet(), &[Line::Straight(&line)], keys);
        let name = format!("{name} end");
        let worst = worst_of_parts(&name, &pattern, &[[-0.02, 0.0], [-20.0, 0.0]], [0.3, 60.0]);
        assert!(worst < 0.01, "{name}: {worst}");
    }
}

/// Force and tilt that change within one pixel, up to a scratch that starts and ends in it.
#[test]
fn changes_within_a_pixel() {
    let line = [[-50.0, 0.0], [50.0, 0.0]];
    let lean = |at, force, tilt_deg| {
        let mut key = Key::force(at, force);
        key.orientation.azimuth_deg = 90.0;
        key.orientation.tilt_deg = tilt_deg;
        key
    };
    let stroke = [
        Key::force(0.0, 0.0),
        Key::force(0.5, 4.0),
        Key::force(1.0, 0.0),
    ];
    let ramp = [Key::force(0.0, 1.0), Key::force(1.0, 9.0)];
    let sway = [
        lean(0.0, 2.0, 0.0),
        lean(0.4, 2.0, 25.0),
        lean(1.0, 2.0, 5.0),
    ];
    let mut failed = Vec::new();
    for (name, keys) in [("stroke", &stroke[..]), ("ramp", &ramp), ("sway", &sway)] {
        for sizes in [[0.1, 1.0], [1.0, 10.0], [10.0, 100.0], [120.0, 200.0]] {
            let pattern = pattern(&dark_sheet(), &[Line::Straight(&line)], keys);
            let name = format!("{name}, {sizes:?} mm");
            let worst = worst_of_parts(&name, &pattern, &[[0.0, 0.0], [-30.0, 0.0]], sizes);
            if worst >= 0.01 {
                failed.push(format!("{name}: {worst}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A hand that trembles, up to sixty keys within one pixel: within 2 %.
#[test]
fn trembling_within_a_pixel() {
    let line = [[-50.0, 0.0], [50.0, 0.0]];
    let keys: Vec<Key> = (0..=60)
        .map(|i| {
            let force = if i % 2 == 0 { 0.5 } else { 3.0 };
            Key::force(f64::from(i) / 60.0, force)
        })
        .collect();
    let pattern = pattern(&dark_sheet(), &[Line::Straight(&line)], &keys);
    let mut failed = Vec::new();
    for sizes in [[2.0, 10.0], [10.0, 100.0], [120.0, 200.0]] {
        let name = format!("trembling, {sizes:?} mm");
        let worst = worst_of_parts(&name, &pattern, &[[0.0, 0.0], [-30.0, 0.0]], sizes);
        if worst >= 0.02 {
            failed.push(format!("{name}: {worst}"));
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A short scratch wholly inside the footprint, at both its ends at once.
#[test]
fn short_scratches() {
    for length in [0.01, 0.2, 2.0] {
        let line = [[-length, 0.3], [length, 0.3]];
        let pattern = pattern(&dark_sheet(), &[Line::Straight(&line)], STEADY);
        let name = format!("{length} mm stroke");
        let worst = worst_of_parts(&name, &pattern, &[[0.0, 0.3]], [0.5, 60.0]);
        assert!(worst < 0.01, "{name}: {worst}");
    }
}

/// An end counts with its covered length, and its cap as half a disc as wide as the scratch: as the pixel moves off
/// the end, what is added falls linearly for as long as it holds the whole cap.
#[test]
fn ends_count_by_length() {
    let line = ([0.2, 0.5], [0.5, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0);
    let edge = 2.0 / SHEET_MM;
    let coverage = |u_mm: f64| {
        let uv = DVec2::new(0.5 + u_mm / SHEET_MM, 0.5);
        let point = Sheet::UPRIGHT.point(uv, edge * DVec2::X, edge * DVec2::Y);
        let mut shading = Shading::default();
        shading
            .shade(&pattern, &point, Sheet::UPRIGHT.view)
            .unwrap();
        let radiance = Sheet::UPRIGHT.radiance(&pattern, &point);
        (f64::from(shading.coverage()), radiance)
    };
    let (full, bright) = coverage(-50.0);
    let (none, bare) = coverage(50.0);
    assert!(full > 0.04, "coverage in the middle {full}");
    assert_eq!(none, 0.0, "coverage off the end");
    assert!(bright > 1.1 * bare, "no brighter: {bright} and {bare}");
    let (half, half_lit) = coverage(0.0);
    let (cap, cap_lit) = (half - 0.5 * full, half_lit - 0.5 * (bare + bright));
    // The scratch takes `full` of 2 mm in width.
    let half_disc = 0.5 * PI * full * full / (2.0 * 2.0);
    assert!(
        relative(cap, half_disc) < 0.02,
        "the cap covers {cap}, half a disc {half_disc}"
    );
    for i in -8..=9 {
        let (here, radiance) = coverage(0.1 * f64::from(i));
        let share = 0.5 - 0.05 * f64::from(i);
        assert!(
            (here - share * full - cap).abs() < 1e-3 * full,
            "coverage {here} of {full} with {share} of the length"
        );
        let expected = bare + share * (bright - bare) + cap_lit;
        assert!(
            relative(radiance, expected) < 1e-3,
            "radiance {radiance}, not {expected}, with {share} of the length"
        );
    }
}
