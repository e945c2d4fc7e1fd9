//! Hard ends: the tool's print closes the groove, and light and filters see it as they see the rest.

mod height_field;
#[path = "../support/mod.rs"]
mod support;

use glam::DVec2;
use height_field::HeightField;
use rand::Rng;
use std::f64::consts::PI;
use striae::formation::{Layer, Material, Orientation, Tool};
use striae::pattern::{Key, Path, Pattern, Scratch};
use support::lines::{Line, add, uv, worst_of_parts};
use support::{SHEET_MM, Sheet, any_direction, dark_sheet, lambert, random, relative, sheet_of};

const FORCE_KGF: f64 = 2.0;

/// Width of a Rockwell scratch on the dark sheet, mm, about.
const WIDTH_MM: f64 = 0.2;

fn held(spin_deg: f64, tilt_deg: f64, azimuth_deg: f64) -> Key {
    let mut key = Key::force(0.0, FORCE_KGF);
    key.orientation = Orientation {
        spin_deg,
        tilt_deg,
        azimuth_deg,
    };
    key
}

/// Straight scratches in their order, each from, to and material.
fn scratched(
    tool: &Tool,
    keys: &[Key],
    lines: &[([f64; 2], [f64; 2], Option<&Material>)],
) -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    for &(from, to, material) in lines {
        let like = Scratch {
            keys,
            material,
            ..Scratch::new(tool)
        };
        add(&mut builder, &Line::Straight(&[from, to]), like);
    }
    builder.build()
}

/// One scratch along u that stops in the sheet's middle.
fn stopped(tool: &Tool, keys: &[Key]) -> Pattern {
    scratched(tool, keys, &[([-100.0, 0.0], [0.0, 0.0], None)])
}

fn tools() -> [(&'static str, Tool, Key); 4] {
    [
        ("Rockwell", Tool::rockwell_c(), held(0.0, 0.0, 0.0)),
        ("Vickers, edge ahead", Tool::vickers(), held(45.0, 0.0, 0.0)),
        ("Vickers, askew", Tool::vickers(), held(17.0, 0.0, 0.0)),
        ("tilted cone", Tool::rockwell_c(), held(0.0, 20.0, 130.0)),
    ]
}

fn pixel(sheet: &Sheet, pattern: &Pattern, place_mm: [f64; 2], size_mm: f64) -> f64 {
    let edge = size_mm / SHEET_MM;
    let (dx, dy) = (edge * DVec2::X, edge * DVec2::Y);
    sheet.pixel(pattern, DVec2::from(uv(place_mm)), dx, dy)
}

/// A pixel is the mean of its parts, from a hundredth of the scratch's width to a hundred times it, at either end.
#[test]
fn parts_add_up() {
    let mut failed = Vec::new();
    for (name, tool, key) in tools() {
        let there = stopped(&tool, &[key]);
        let back = scratched(&tool, &[key], &[([0.0, 0.0], [100.0, 0.0], None)]);
        let sizes = [0.01 * WIDTH_MM, 100.0 * WIDTH_MM];
        for (end, side, pattern) in [("stop", 1.0, there), ("start", -1.0, back)] {
            let near = [[0.0, 0.0], [0.05 * side, 0.02], [0.1 * side, -0.08]];
            let name = format!("{name}, {end}");
            let worst = worst_of_parts(&name, &pattern, &near, sizes);
            if worst >= 1e-3 {
                failed.push(format!("{name}: {worst}"));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Pixels that hold the end of a Rockwell scratch, against rays into the surface itself.
#[test]
fn rays_into_the_surface() {
    let field = HeightField::new();
    let pattern = stopped(&Tool::rockwell_c(), &[held(0.0, 0.0, 0.0)]);
    let mut random = random(71);
    let mut deviations: Vec<(f64, f64, String)> = Vec::new();
    for case in 0..60 {
        let most_deg = if case % 2 == 0 { 30.0 } else { 60.0 };
        let sheet = Sheet {
            view: any_direction(&mut random, most_deg),
            light: any_direction(&mut random, 60.0),
            ..Sheet::UPRIGHT
        };
        let (view, light) = (
            support::caster::unit(sheet.view),
            support::caster::unit(sheet.light),
        );
        // The end in its half ahead, up to the whole end and some of the scratch.
        let size_mm = 2.0 * field.foot_mm * random.random_range(0.5..1.2);
        let center = DVec2::new(0.5 * size_mm * random.random_range(0.3..0.9), 0.0);
        let mut sum = 0.0;
        const SAMPLES: u32 = 80;
        for (i, j) in (0..SAMPLES).flat_map(|i| (0..SAMPLES).map(move |j| (i, j))) {
            let jitter = DVec2::new(random.random_range(0.0..1.0), random.random_range(0.0..1.0));
            let share = (DVec2::new(f64::from(i), f64::from(j)) + jitter) / f64::from(SAMPLES);
            sum += field.radiance(center + size_mm * (share - 0.5), view, light);
        }
        let truth = sum / f64::from(SAMPLES * SAMPLES);
        let ours = pixel(&sheet, &pattern, center.to_array(), size_mm);
        let report =
            format!("case {case}: {ours} against {truth}, {size_mm} mm at {center}, {sheet:?}");
        deviations.push((relative(ours, truth), most_deg, report));
    }
    for most_deg in [30.0, 60.0] {
        let mut of: Vec<_> = deviations.iter().filter(|d| d.1 == most_deg).collect();
        of.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mean = of.iter().map(|d| d.0).sum::<f64>() / of.len() as f64;
        println!(
            "views to {most_deg}°: mean {mean:.1e}, worst {:.1e} ({})",
            of[0].0, of[0].2
        );
        println!("   next {:.1e} {:.1e} ({})", of[1].0, of[2].0, of[1].2);
    }
    assert!(
        deviations.iter().all(|d| d.0 < 0.02),
        "a pixel is not what rays see"
    );
}

/// A small pixel moved along the scratch over its end, on the centre line and beside it, does not jump.
#[test]
fn nothing_jumps_over_the_end() {
    let mut random = random(73);
    for (name, tool, key) in tools() {
        let pattern = stopped(&tool, &[key]);
        for beside_mm in [0.0, 0.013, -0.04, 0.03] {
            let sheet = Sheet {
                view: any_direction(&mut random, 60.0),
                light: any_direction(&mut random, 60.0),
                ..Sheet::UPRIGHT
            };
            let (size_mm, count) = (0.02, 2000);
            let step_mm = 0.6 / f64::from(count);
            let values: Vec<f64> = (0..=count)
                .map(|i| {
                    pixel(
                        &sheet,
                        &pattern,
                        [-0.3 + step_mm * f64::from(i), beside_mm],
                        size_mm,
                    )
                })
                .collect();
            // A box filter changes by at most the range of what it sees, for each pixel's length.
            let most = 0.9 / PI * step_mm / size_mm;
            let jump = values
                .windows(2)
                .map(|w| (w[1] - w[0]).abs())
                .fold(0.0, f64::max);
            assert!(
                jump < most,
                "{name}, {beside_mm} mm: a jump of {jump}, at most {most}"
            );
            let range = values.iter().copied().fold(0.0, f64::max);
            assert!(
                range > 10.0 * most,
                "{name}, {beside_mm} mm: nothing to see"
            );
        }
    }
}

/// Where the force falls to nothing there is no cap, also beside scratches of the same kind that have one.
#[test]
fn soft_ends_have_none() {
    let tool = Tool::rockwell_c();
    let soft = [
        Key::force(0.0, 0.0),
        Key::force(0.5, FORCE_KGF),
        Key::force(1.0, 0.0),
    ];
    let add = |also_hard: bool| {
        let mut builder = sheet_of(&dark_sheet());
        let one = Scratch {
            keys: &soft,
            ..Scratch::new(&tool)
        };
        add(
            &mut builder,
            &Line::Straight(&[[-1.0, 0.0], [0.0, 0.0]]),
            one,
        );
        if also_hard {
            let far = Scratch {
                keys: &[Key::force(0.0, FORCE_KGF)],
                ..Scratch::new(&tool)
            };
            add(
                &mut builder,
                &Line::Straight(&[[-300.0, 400.0], [300.0, 400.0]]),
                far,
            );
        }
        builder.build()
    };
    let (alone, beside) = (add(false), add(true));
    let mut random = random(79);
    let bare = pixel(&Sheet::UPRIGHT, &alone, [0.02, 0.0], 0.03);
    assert!(
        relative(bare, 0.002 / PI * 0.866) < 1e-3,
        "something beyond the end: {bare}"
    );
    for _ in 0..200 {
        let sheet = Sheet {
            view: any_direction(&mut random, 75.0),
            light: any_direction(&mut random, 75.0),
            ..Sheet::UPRIGHT
        };
        let place = [
            random.random_range(-0.2..0.2),
            random.random_range(-0.1..0.1),
        ];
        let [a, b] = [&alone, &beside].map(|pattern| pixel(&sheet, pattern, place, 0.05));
        assert_eq!(a.to_bits(), b.to_bits(), "{a} and {b} at {place:?}");
    }
}

/// A closed path has no end.
#[test]
fn closed_paths_have_none() {
    use striae::pattern::{Spline, SplineKind};
    let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(uv);
    let tool = Tool::rockwell_c();
    let of = |path: Path<'_>| {
        let mut builder = sheet_of(&dark_sheet());
        let keys = &[Key::force(0.0, FORCE_KGF)];
        builder
            .add(&Scratch {
                path,
                keys,
                ..Scratch::new(&tool)
            })
            .unwrap();
        builder.build()
    };
    let open = of(Path::Spline(Spline::open(SplineKind::Polyline, &corners)));
    let closed = of(Path::Spline(Spline::closed(SplineKind::Polyline, &corners)));
    // Behind the start of the first line, outside the corner.
    let [open, closed] =
        [&open, &closed].map(|pattern| pixel(&Sheet::UPRIGHT, pattern, [-0.04, 0.01], 0.01));
    let bare = 0.002 / PI * 0.866;
    assert!(
        open > 10.0 * bare,
        "no cap at the start of an open path: {open}"
    );
    assert!(closed > 10.0 * bare, "a corner closes: {closed}");
    assert!(relative(open, closed) > 0.01, "the corner looks like a cap");
}

/// Paint shows around an end as it shows beside a scratch: its own colour on the outer flank, what is below it inside.
#[test]
fn layers_show_on_caps() {
    let painted = |thickness_mm| Material {
        layers: vec![Layer {
            thickness_mm,
            scratched: lambert(0.9),
        }],
        scratched: lambert(0.0),
        ..dark_sheet()
    };
    let tool = Tool::rockwell_c();
    let keys = [held(0.0, 0.0, 0.0)];
    let field = HeightField::new();
    let value = |thickness_mm, place_mm| {
        let material = painted(thickness_mm);
        let lines = [([-100.0, 0.0], [0.0, 0.0], Some(&material))];
        pixel(
            &Sheet::UPRIGHT,
            &scratched(&tool, &keys, &lines),
            [place_mm, 0.0],
            0.001,
        )
    };
    let (inside, outside) = (0.3 * field.foot_mm, 0.97 * field.foot_mm);
    assert!(value(1.0, inside) > 0.1, "thick paint does not show inside");
    assert!(value(1e-6, inside) < 1e-3, "thin paint shows inside");
    assert!(value(1e-6, outside) > 0.1, "paint does not show outside");
}

/// A later scratch cuts an end away, and a later end cuts what was there.
#[test]
fn ends_cut_and_are_cut_in_time() {
    let black = Material {
        scratched: lambert(0.0),
        ..dark_sheet()
    };
    let tool = Tool::rockwell_c();
    let keys = [held(0.0, 0.0, 0.0)];
    let ending = ([-100.0, 0.0], [0.0, 0.0], None);
    let across = ([0.05, -100.0], [0.05, 100.0], Some(&black));
    let value = |lines: &[_]| {
        let pattern = scratched(&tool, &keys, lines);
        pixel(&Sheet::UPRIGHT, &pattern, [0.05, 0.0], 0.01)
    };
    let end = value(&[ending]);
    assert!(end > 0.1, "no cap: {end}");
    assert!(
        value(&[ending, across]) < 1e-3,
        "the cap shows in a later groove"
    );
    let last = value(&[across, ending]);
    assert!(
        relative(last, end) < 1e-3,
        "{last}: an earlier groove shows in the cap of {end}"
    );
}
