//! From one scratch in a pixel to a hundred thousand: no jump on the way, and near the truth all the time.

mod support;

use glam::DVec2;
use rand::Rng;
use striae::brdf::Metal;
use striae::formation::{Material, Tool};
use striae::pattern::{Key, Path, Pattern, Scratch};
use support::jumps::largest_jump;
use support::{SHEET_MM, Sheet, direction, ggx, lambert, random, relative, sheet_of};

/// A square of this side is scratched.
const SIDE_MM: f64 = 300.0;

const COUNT: u32 = 100_000;

/// Which way scratches run.
#[derive(Clone, Copy, Debug)]
enum Way {
    Any,
    /// Within a few degrees of one direction.
    Brushed,
    /// Around the middle.
    Rings,
}

/// Scratches of 5 mm and of many forces that run out, all over the square; they cover more than half of it.
fn scratched(material: &Material, tool: &Tool, way: Way) -> Pattern {
    let mut random = random(11);
    let mut builder = sheet_of(material);
    for _ in 0..COUNT {
        let mut across = || SIDE_MM * random.random_range(-0.5..0.5);
        let middle = DVec2::new(across(), across());
        let degrees = match way {
            Way::Any => random.random_range(0.0..360.0),
            Way::Brushed => random.random_range(-4.0..4.0),
            Way::Rings => middle.perp().to_angle().to_degrees() + random.random_range(-2.0..2.0),
        };
        let half = 2.5 * DVec2::from_angle(f64::to_radians(degrees));
        let uv = |p: DVec2| (DVec2::splat(0.5) + p / SHEET_MM).to_array();
        let force_kgf = 0.05 * 20_f64.powf(random.random_range(0.0..1.0));
        builder
            .add(&Scratch {
                path: Path::Polyline(&[uv(middle - half), uv(middle + half)]),
                keys: &[
                    Key::force(0.0, 0.0),
                    Key::force(0.1, force_kgf),
                    Key::force(0.9, force_kgf),
                    Key::force(1.0, 0.0),
                ],
                ..Scratch::new(tool)
            })
            .unwrap();
    }
    builder.build()
}

/// Sheets under views and lights that show highlights of scratches.
fn sheets() -> [Sheet; 3] {
    let seen = |view, light| Sheet {
        view,
        light,
        ..Sheet::UPRIGHT
    };
    [
        seen(direction(0.0, 0.0), direction(40.0, 90.0)),
        seen(direction(35.0, 200.0), direction(30.0, 60.0)),
        seen(direction(60.0, 10.0), direction(50.0, 170.0)),
    ]
}

/// A pixel of `size_mm`, askew, near the middle.
fn edges(size_mm: f64) -> (DVec2, DVec2) {
    let dx = size_mm / SHEET_MM * DVec2::from_angle(0.3);
    (dx, 0.8 * dx.perp())
}

fn satin() -> Material {
    Material::metal(Metal::Titanium)
}

fn matt() -> Material {
    Material::new(150.0, lambert(0.05), lambert(0.8))
}

fn polished() -> Material {
    Material::new(150.0, ggx(0.1, 0.6), ggx(0.08, 0.9))
}

const NEAR: DVec2 = DVec2::new(0.5213, 0.4891);

/// Sizes of a pixel, mm, and into how many parts each of its edges is cut for each scratch in them to be shaded by itself.
const SIZES: [(f64, u32); 7] = [
    (0.02, 3),
    (2.0, 4),
    (4.0, 7),
    (8.0, 14),
    (12.0, 20),
    (20.0, 34),
    (40.0, 67),
];

/// Every pixel of these sizes at these places is within 3 % of the mean of its parts.
fn assert_near_the_truth(sizes: &[(f64, u32)], places: &[DVec2]) {
    let mut failed = Vec::new();
    for (name, material) in [
        ("matt", matt()),
        ("satin", satin()),
        ("polished", polished()),
    ] {
        for way in [Way::Any, Way::Brushed, Way::Rings] {
            let pattern = scratched(&material, &Tool::rockwell_c(), way);
            for (&place, &(size_mm, parts)) in places
                .iter()
                .flat_map(|place| sizes.iter().map(move |size| (place, size)))
            {
                let (dx, dy) = edges(size_mm);
                let mut worst = 0.0_f64;
                let mut line = format!("{name}, {way:?}, {size_mm} mm at {place}:");
                for sheet in sheets() {
                    let whole = sheet.pixel(&pattern, place, dx, dy);
                    let parts = sheet.mean_of_parts(&pattern, place, dx, dy, parts);
                    let off = relative(whole, parts);
                    line += &format!(" {off:.1e}");
                    worst = worst.max(off);
                }
                println!("{line}");
                if worst >= 0.03 {
                    failed.push(line);
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// From a fifth of a scratch's width to 40 mm.
#[test]
fn near_the_truth() {
    assert_near_the_truth(&SIZES, &[NEAR]);
}

/// A few scratches, crowds of some dozens, of which few shine, and of hundreds, anywhere.
#[test]
fn crowds_near_the_truth_elsewhere() {
    let mut random = random(99);
    let mut place = || 0.5 + random.random_range(-0.12..0.12);
    let places = [(); 16].map(|()| DVec2::new(place(), place()));
    assert_near_the_truth(
        &[(1.0, 10), (2.0, 12), (3.0, 12), (4.0, 12), (8.0, 24)],
        &places,
    );
    assert_near_the_truth(&SIZES[4..6], &places[..4]);
}

/// Pixels as small as the tips of scratches that set in or run out are within 1 % of the mean of their parts.
#[test]
fn tips_are_cut_straight() {
    let pattern = scratched(&matt(), &Tool::rockwell_c(), Way::Rings);
    let mut random = random(99);
    let mut place = || 0.5 + random.random_range(-0.12..0.12);
    let (dx, dy) = edges(0.02);
    let [sheet, ..] = sheets();
    let mut worst = (0.0, DVec2::ZERO);
    for _ in 0..400 {
        let place = DVec2::new(place(), place());
        let whole = sheet.pixel(&pattern, place, dx, dy);
        let parts = sheet.mean_of_parts(&pattern, place, dx, dy, 8);
        let off = relative(whole, parts);
        if off > worst.0 {
            worst = (off, place);
        }
    }
    println!("tips: {worst:?}");
    assert!(worst.0 < 0.01, "{worst:?}");
}

/// A hundred thousand scratches in one pixel.
#[test]
fn all_in_one_pixel() {
    let pattern = scratched(&satin(), &Tool::rockwell_c(), Way::Any);
    let edge = 1.1 * SIDE_MM / SHEET_MM;
    let (dx, dy) = (edge * DVec2::X, edge * DVec2::Y);
    for sheet in &sheets()[..1] {
        let whole = sheet.pixel(&pattern, DVec2::splat(0.5), dx, dy);
        let parts = sheet.mean_of_parts(&pattern, DVec2::splat(0.5), dx, dy, 330);
        let off = relative(whole, parts);
        println!("{COUNT} in a pixel: {off:.1e}");
        assert!(off < 0.03, "{whole} against {parts}");
    }
}

/// Zooming out, neighbouring footprints differ by less than 2 % of what is seen.
#[test]
fn no_jump_on_the_way_out() {
    let mut failed = Vec::new();
    for (name, material) in [("matt", matt()), ("satin", satin())] {
        let pattern = scratched(&material, &Tool::rockwell_c(), Way::Any);
        for sheet in sheets() {
            let (jump, at) = largest_jump(|s| {
                let (dx, dy) = edges(0.05 * 3000_f64.powf(s));
                sheet.pixel(&pattern, NEAR, dx, dy)
            });
            println!("{name}: largest jump {jump:.1e} at {at}");
            if jump >= 0.02 {
                failed.push(format!("{name}: {jump} at {at}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Moving on by a pixel of some dozens of scratches, neighbouring footprints differ by less than 2 % of what is seen.
#[test]
fn no_jump_on_the_way_past() {
    let mut failed = Vec::new();
    for (name, material) in [("matt", matt()), ("polished", polished())] {
        let pattern = scratched(&material, &Tool::rockwell_c(), Way::Any);
        for size_mm in [1.0, 3.0] {
            let [sheet, ..] = sheets();
            let (dx, dy) = edges(size_mm);
            let (jump, at) = largest_jump(|s| sheet.pixel(&pattern, NEAR + s * dx, dx, dy));
            println!("{name}, {size_mm} mm: largest jump {jump:.1e} at {at}");
            if jump >= 0.02 {
                failed.push(format!("{name}, {size_mm} mm: {jump} at {at}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
