//! Which way a scratch runs: its cross-section's right side lies to the right of its travel.

mod support;

use glam::DVec2;
use rand::Rng;
use std::f64::consts::TAU;
use striae::formation::{CrossSection, Orientation, Process, Tool};
use striae::pattern::{Key, Path, PatternBuilder, Scratch};
use striae::scattering::{CrossFootprint, Output, Shading};
use support::{Sheet, any_direction, dark_sheet, random, relative, single};

/// What a pixel shows of a scratch is its cross-section, right side to the right of travel: t × z.
#[test]
fn cross_sections_lie_right_of_travel() {
    let mut random = random(53);
    let (mut worst, mut mirrored) = (0.0_f64, 0);
    let tool = Tool::vickers();
    for _ in 0..100 {
        let mut key = Key::force(0.0, 3.0);
        key.orientation = Orientation {
            spin_deg: random.random_range(0.0..90.0),
            tilt_deg: 12.0,
            azimuth_deg: random.random_range(0.0..360.0),
        };
        let process = Process {
            force_kgf: key.force_kgf,
            orientation: key.orientation,
            ..Process::default()
        };
        let section = CrossSection::form(&tool, &process, &dark_sheet()).unwrap();
        let vertices: Vec<[f32; 2]> = section
            .vertices()
            .iter()
            .map(|p| p.as_vec2().to_array())
            .collect();
        let travel = DVec2::from_angle(random.random_range(0.0..TAU));
        let right = DVec2::new(travel.y, -travel.x);
        let ends = [-0.3, 0.3].map(|s| (DVec2::splat(0.5) + s * travel).to_array());
        let mut builder = PatternBuilder::new(dark_sheet(), 1.0, [1000.0, 1000.0]).unwrap();
        builder
            .add(&Scratch {
                path: Path::Polyline(&ends),
                keys: &[key],
                ..Scratch::new(&tool)
            })
            .unwrap();
        let pattern = builder.build();
        let offset_mm = random.random_range(-0.1..0.1);
        let size_mm = random.random_range(0.005..0.1);
        let sheet = Sheet {
            view: any_direction(&mut random, 70.0),
            light: any_direction(&mut random, 70.0),
            ..Sheet::UPRIGHT
        };
        let place = |offset_mm: f64| DVec2::splat(0.5) + offset_mm / 1e3 * right;
        let (dx, dy) = (size_mm / 1e3 * right, size_mm / 1e3 * travel);
        let ours = sheet.pixel(&pattern, place(offset_mm), dx, dy);
        // In the section's own frame: x to the right, y along the travel.
        let turned = |w: [f32; 3]| {
            let flat = DVec2::new(f64::from(w[0]), f64::from(w[1]));
            [single(flat.dot(right)), single(flat.dot(travel)), w[2]]
        };
        let mut shading = Shading::default();
        let pixel = CrossFootprint::Box {
            center_mm: offset_mm,
            extents_mm: [size_mm, 0.0],
        };
        let sheet_of = dark_sheet();
        shading
            .shade_cross_section(
                &vertices,
                &sheet_of.scratched,
                &sheet_of.surface,
                pixel,
                turned(sheet.view),
            )
            .unwrap();
        let truth = f64::from(shading.eval(turned(sheet.light), Output::BrdfCos)[0]);
        let apart = |a: f64, b: f64| (a - b).abs() / a.max(b).max(1e-4);
        worst = worst.max(apart(ours, truth));
        let swapped = sheet.pixel(&pattern, place(-offset_mm), dx, dy);
        mirrored += u32::from(apart(swapped, truth) > 0.05);
    }
    println!("pixels against cross-sections: {worst:.1e}");
    assert!(worst < 1e-3, "a pixel is not its cross-section: {worst}");
    assert!(mirrored > 50, "left and right look alike: {mirrored}");
}

/// A scratch looks the same from both its ends if its section is symmetric, and mirrored if it is not: right
/// is right of travel.
#[test]
fn travel_has_a_right_side() {
    let tool = Tool::rockwell_c();
    let stroke = |line: [[f64; 2]; 2], azimuth_deg: f64| {
        let mut builder = PatternBuilder::new(dark_sheet(), 1.0, [1000.0, 1000.0]).unwrap();
        let mut key = Key::force(0.0, 2.0);
        key.orientation.tilt_deg = 25.0;
        key.orientation.azimuth_deg = azimuth_deg;
        builder
            .add(&Scratch {
                path: Path::Polyline(&line),
                keys: &[key],
                ..Scratch::new(&tool)
            })
            .unwrap();
        builder.build()
    };
    let [there, back] = [[[0.2, 0.5], [0.8, 0.5]], [[0.8, 0.5], [0.2, 0.5]]];
    // Leant to the left on the way there is leant to the right on the way back.
    let [a, b] = [stroke(there, 90.0), stroke(back, -90.0)];
    let unlike = stroke(back, 90.0);
    let mut differ = 0;
    for i in -20..=20 {
        let uv = DVec2::new(0.5, 0.5 + 1e-5 * f64::from(i));
        let edge = 1e-5 * DVec2::X;
        let [a, b, unlike] =
            [&a, &b, &unlike].map(|pattern| Sheet::UPRIGHT.pixel(pattern, uv, edge, edge.perp()));
        assert!(relative(a, b) < 1e-4, "{a} there, {b} back, {i}");
        differ += u32::from(relative(a, unlike) > 0.01);
    }
    assert!(differ > 10, "left and right look alike: {differ}");
}
