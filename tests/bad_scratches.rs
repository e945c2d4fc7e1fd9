//! Scratches that cannot be are refused by name, and leave the builder as it was.

mod support;

use glam::DVec2;
use striae::Error;
use striae::formation::{Material, Tool};
use striae::pattern::{Key, Path, PatternBuilder, Scratch};
use support::{Sheet, dark_sheet, lambert, sheet_of};

const NAN: f64 = f64::NAN;
const INF: f64 = f64::INFINITY;

/// Adds a scratch that is refused, and checks that the builder is as it was: it builds the same pattern as
/// before, and the same as one that never heard of the scratch once a good one is added.
fn refused(path: Path<'_>, keys: &[Key], tool: &Tool, material: Option<&Material>) -> Error {
    let (rockwell, good) = (Tool::rockwell_c(), [Key::force(0.0, 2.0)]);
    let line = [[0.3, 0.5], [0.7, 0.5]];
    let other = [[0.5, 0.3], [0.5, 0.7]];
    let add = |builder: &mut PatternBuilder, line: &[[f64; 2]]| {
        let scratch = Scratch {
            path: Path::Polyline(line),
            keys: &good,
            ..Scratch::new(&rockwell)
        };
        builder.add(&scratch).unwrap();
    };
    let look = |builder: &PatternBuilder| {
        let pattern = builder.build();
        let edge = 1e-3 * DVec2::new(1.0, 0.1);
        let middle = DVec2::splat(0.5);
        (
            pattern.scratch_count(),
            Sheet::UPRIGHT.pixel(&pattern, middle, edge, edge.perp()),
        )
    };
    let mut builder = sheet_of(&dark_sheet());
    add(&mut builder, &line);
    let before = look(&builder);
    let scratch = Scratch {
        path,
        keys,
        material,
        ..Scratch::new(tool)
    };
    let error = builder
        .add(&scratch)
        .expect_err(&format!("accepted: {scratch:?}"));
    assert_eq!(look(&builder), before, "after {error}");
    add(&mut builder, &other);
    let mut untouched = sheet_of(&dark_sheet());
    add(&mut untouched, &line);
    add(&mut untouched, &other);
    assert_eq!(
        look(&builder),
        look(&untouched),
        "a good scratch after {error}"
    );
    error
}

const LINE: Path<'static> = Path::Polyline(&[[0.1, 0.1], [0.9, 0.9]]);

/// Paths of no points, too few, too many, no length, or nowhere.
#[test]
fn paths() {
    let tool = Tool::rockwell_c();
    let keys = [Key::force(0.0, 1.0)];
    let o = [0.5, 0.5];
    for path in [
        Path::Polyline(&[]),
        Path::Polyline(&[o]),
        Path::Polyline(&[o, o]),
        Path::Polyline(&[o, [NAN, 0.5]]),
        Path::Polyline(&[o, [0.6, 0.5], [0.7, INF]]),
        Path::Polyline(&[o, [0.6, -INF], [0.7, 0.0]]),
        Path::Polyline(&[[-1e300, 0.0], [1e300, 0.0]]),
        Path::CubicBezier(&[]),
        Path::CubicBezier(&[o]),
        Path::CubicBezier(&[o, [0.6, 0.5], [0.7, 0.5]]),
        Path::CubicBezier(&[o, [0.6, 0.5], [0.7, 0.5], [0.8, 0.5], [0.9, 0.5]]),
        Path::CubicBezier(&[o, o, o, o]),
        Path::CubicBezier(&[o, [NAN, 0.5], [0.7, 0.5], [0.8, 0.5]]),
    ] {
        let error = refused(path, &keys, &tool, None);
        let message = error.to_string();
        assert!(
            message.contains("path") || message.contains("point"),
            "{path:?}: {message}"
        );
        assert!(
            message.contains(" is ") && message.contains("accepted: "),
            "{path:?}: {message}"
        );
    }
}

/// Keys missing, out of order, off the path or beyond any hand; the message says which one.
#[test]
fn keys() {
    let tool = Tool::rockwell_c();
    let none = refused(LINE, &[], &tool, None).to_string();
    assert!(none.contains("key"), "{none}");
    let key = Key::force;
    for (i, bad) in [
        (1, [key(0.5, 1.0), key(0.4, 1.0), key(1.0, 1.0)]),
        (2, [key(0.0, 1.0), key(1.0, 1.0), key(0.9, 1.0)]),
        (0, [key(-0.1, 1.0), key(0.4, 1.0), key(1.0, 1.0)]),
        (2, [key(0.0, 1.0), key(0.4, 1.0), key(1.1, 1.0)]),
        (1, [key(0.0, 1.0), key(NAN, 1.0), key(1.0, 1.0)]),
        (1, [key(0.0, 1.0), key(0.5, -1.0), key(1.0, 1.0)]),
        (2, [key(0.0, 1.0), key(0.5, 1.0), key(1.0, NAN)]),
        (0, [key(0.0, INF), key(0.5, 1.0), key(1.0, 1.0)]),
    ] {
        let message = refused(LINE, &bad, &tool, None).to_string();
        assert!(
            message.contains(&format!("keys[{i}]")),
            "{bad:?}: {message}"
        );
    }
    let mut leant = [key(0.0, 1.0), key(1.0, 1.0)];
    leant[1].orientation.tilt_deg = 50.0;
    let message = refused(LINE, &leant, &tool, None).to_string();
    assert!(message.contains("tilt_deg is 50"), "{message}");
}

/// A tool that is too short for the deepest key, and a material of its own that is none.
#[test]
fn scratches() {
    let short = Tool::sphero_cone(60.0, 0.2, 0.03).unwrap();
    let keys = [Key::force(0.0, 0.5), Key::force(1.0, 100.0)];
    let message = refused(LINE, &keys, &short, None).to_string();
    assert!(message.contains("keys[1]"), "{message}");
    let soft = Material::new(-3.0, lambert(0.5), lambert(0.5));
    let message = refused(LINE, &keys, &Tool::rockwell_c(), Some(&soft)).to_string();
    assert!(message.contains("hardness_hv is -3"), "{message}");
    let dazzling = Material::new(100.0, lambert(0.5), lambert(3.0));
    let message = refused(LINE, &keys, &Tool::rockwell_c(), Some(&dazzling)).to_string();
    assert!(message.contains("albedo is 3"), "{message}");
}
