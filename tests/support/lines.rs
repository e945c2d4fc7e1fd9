//! Scratches along lines stated in millimetres, and pixels near them against the mean of their parts.

use super::{SHEET_MM, Sheet, any_direction, random, sheet_of};
use glam::DVec2;
use rand::Rng;
use striae::formation::{Material, Tool};
use striae::pattern::{Key, Path, Pattern, PatternBuilder, Scratch};

/// A path in millimetres from the sheet's middle.
pub(crate) enum Line<'a> {
    Straight(&'a [[f64; 2]]),
    Curve(&'a [[f64; 2]]),
}

/// Millimetres from the sheet's middle, in texture space.
pub(crate) fn uv(place_mm: [f64; 2]) -> [f64; 2] {
    place_mm.map(|mm| 0.5 + mm / SHEET_MM)
}

/// Adds a scratch like another one, along a line.
pub(crate) fn add(builder: &mut PatternBuilder, line: &Line<'_>, like: Scratch<'_>) {
    let (Line::Straight(points) | Line::Curve(points)) = line;
    let points: Vec<[f64; 2]> = points.iter().copied().map(uv).collect();
    let path = match line {
        Line::Straight(_) => Path::Polyline(&points),
        Line::Curve(_) => Path::CubicBezier(&points),
    };
    builder.add(&Scratch { path, ..like }).unwrap();
}

/// Scratches by a Rockwell cone, all with the same keys.
pub(crate) fn pattern(material: &Material, lines: &[Line<'_>], keys: &[Key]) -> Pattern {
    let mut builder = sheet_of(material);
    let tool = Tool::rockwell_c();
    for line in lines {
        let like = Scratch {
            keys,
            ..Scratch::new(&tool)
        };
        add(&mut builder, line, like);
    }
    builder.build()
}

/// The worst relative difference between pixels near the points `near` (mm) and the mean of their parts.
pub(crate) fn worst_of_parts(
    name: &str,
    pattern: &Pattern,
    near: &[[f64; 2]],
    sizes_mm: [f64; 2],
) -> f64 {
    let mut random = random(11);
    let mut worst = (0.0_f64, String::new());
    for case in 0..120 {
        let sheet = Sheet {
            view: any_direction(&mut random, 75.0),
            light: any_direction(&mut random, 75.0),
            ..Sheet::UPRIGHT
        };
        let size_mm = sizes_mm[0] * (sizes_mm[1] / sizes_mm[0]).powf(random.random_range(0.0..1.0));
        let turn = DVec2::from_angle(random.random_range(0.0..7.0));
        let aspect = random.random_range(0.2..1.0);
        let dx = size_mm / SHEET_MM * turn;
        let dy = aspect * size_mm / SHEET_MM * turn.perp();
        let place = DVec2::from(near[random.random_range(0..near.len())]) / SHEET_MM;
        let uv = DVec2::splat(0.5)
            + place
            + random.random_range(-0.4..0.4) * dx
            + random.random_range(-0.4..0.4) * dy;
        let n = random.random_range(2..7);
        let whole = sheet.pixel(pattern, uv, dx, dy);
        let parts = sheet.mean_of_parts(pattern, uv, dx, dy, n);
        let deviation = (whole - parts).abs() / whole.max(parts).max(1e-4);
        if deviation > worst.0 {
            let report = format!(
                "case {case}: {whole} against {parts}, {n}² parts, {size_mm} mm x {aspect}, {sheet:?}"
            );
            worst = (deviation, report);
        }
    }
    println!("{name}: {:.1e} ({})", worst.0, worst.1);
    worst.0
}

pub(crate) const STEADY: &[Key] = &[Key::force(0.0, 2.0)];
