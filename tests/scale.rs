//! Box filters add up over six decades of footprint size: the mean over a pixel's parts is the pixel.

mod support;

use glam::DVec2;
use striae::pattern::Key;
use support::dark_sheet;
use support::lines::{Line, STEADY, pattern, worst_of_parts};

/// From a hundredth of a scratch's width to ten times a scratch's length, mm.
const DECADES: [[f64; 2]; 6] = [
    [1e-3, 1e-2],
    [1e-2, 1e-1],
    [1e-1, 1.0],
    [1.0, 10.0],
    [10.0, 100.0],
    [100.0, 1000.0],
];

fn assert_adds_up(name: &str, limit: f64, lines: &[Line<'_>], keys: &[Key], near: &[[f64; 2]]) {
    let pattern = pattern(&dark_sheet(), lines, keys);
    for sizes_mm in DECADES {
        let name = format!("{name}, {sizes_mm:?} mm");
        let worst = worst_of_parts(&name, &pattern, near, sizes_mm);
        assert!(worst < limit, "{name}: {worst}");
    }
}

/// A straight scratch, and three side by side: within 0.1 %.
#[test]
fn straight() {
    let line = |y: f64| [[-50.0, y], [50.0, y + 3.0]];
    let lines = [line(0.0), line(0.4), line(-7.0)];
    let near = [[0.0, 1.5], [20.0, 2.1], [-30.0, 1.0]];
    assert_adds_up(
        "straight",
        1e-3,
        &[Line::Straight(&lines[0])],
        STEADY,
        &near,
    );
    let lines = lines.each_ref().map(|line| Line::Straight(line));
    assert_adds_up("side by side", 1e-3, &lines, STEADY, &near);
}

/// An arc of a quarter turn: within 1 %.
#[test]
fn curved() {
    let arc = [[50.0, 0.0], [50.0, 27.614], [27.614, 50.0], [0.0, 50.0]];
    let near = [[35.355, 35.355], [43.301, 25.0], [0.0, 50.0]];
    assert_adds_up("arc", 0.01, &[Line::Curve(&arc)], STEADY, &near);
}

/// Scratches that cross, at a steep and at a shallow angle, and three through one place: within 1 %.
#[test]
fn crossing() {
    let lines = [
        [[-50.0, 0.0], [50.0, 0.0]],
        [[-20.0, -30.0], [20.0, 30.0]],
        [[-50.0, 5.0], [50.0, -5.0]],
    ];
    let near = [[0.0, 0.0], [0.05, 0.03], [-0.2, -0.1]];
    let lines = lines.each_ref().map(|line| Line::Straight(line));
    assert_adds_up("two", 0.01, &lines[..2], STEADY, &near);
    assert_adds_up("three", 0.01, &lines, STEADY, &near);
}

/// Scratches that end: hard, and running out: within 1 %.
#[test]
fn ending() {
    let line = [[-50.0, 0.0], [30.0, 2.0]];
    let near = [[30.0, 2.0], [29.0, 1.975], [-50.0, 0.0]];
    assert_adds_up("hard", 0.01, &[Line::Straight(&line)], STEADY, &near);
    let soft = [
        Key::force(0.0, 0.0),
        Key::force(0.4, 2.0),
        Key::force(1.0, 0.0),
    ];
    assert_adds_up("soft", 0.01, &[Line::Straight(&line)], &soft, &near);
}

/// A dozen scratches that cross within a few pixels, some of which end there: within 1 %, though later ones are taken from
/// each by area alone where it is thin.
#[test]
fn a_dozen() {
    let line = |i: u32| {
        let turn = DVec2::from_angle(2.4 * f64::from(i));
        let middle = 1.5 * f64::from(i % 5) * turn.perp();
        let reach = if i.is_multiple_of(3) { 0.5 } else { 60.0 };
        [middle - 50.0 * turn, middle + reach * turn].map(|end| end.to_array())
    };
    let lines: Vec<_> = (0..12).map(line).collect();
    let lines: Vec<_> = lines.iter().map(|line| Line::Straight(line)).collect();
    let near = [[0.0, 0.0], [1.0, 0.5], [-0.7, 2.0]];
    assert_adds_up("a dozen", 0.01, &lines, STEADY, &near);
}
