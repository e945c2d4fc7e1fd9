//! Arc lengths of curves that turn little, by fixed rules of a few nodes: all others are left to kurbo (`path.rs`).

use super::closest::{LengthShares, speed};
use glam::DVec2;

/// A piece turns by no more than this, so that it has one nearest point and a tight box.
const MOST_TURN_RAD: f64 = 0.5;

/// Arc length within a piece is interpolated; it strays from the true one by at most this share of the piece.
const LENGTH_ACCURACY: f64 = 5e-5;

/// Corners of a plain curve's control polygon turn by no more than this (its tangent), and no leg is longer than so many
/// times another.
const PLAIN_TURN: f64 = 0.05;
const PLAIN_LEGS: f64 = 3.0;

/// Whether a curve is so straight, and run through so evenly, that interpolation knows its parts, and [`length`] knows it
/// within 3e-7: told without a root.
pub(super) fn is_plain([a, b, c, d]: &[DVec2; 4]) -> bool {
    let legs = [*b - *a, *c - *b, *d - *c];
    let turns_little = |p: DVec2, q: DVec2| p.perp_dot(q).abs() < PLAIN_TURN * p.dot(q);
    let [first, middle, last] = legs.map(DVec2::length_squared);
    let (least, most) = (first.min(middle).min(last), first.max(middle).max(last));
    turns_little(legs[0], legs[1])
        && turns_little(legs[1], legs[2])
        && most <= PLAIN_LEGS * PLAIN_LEGS * least
}

/// A curve's arc length, if it turns little and interpolation knows its parts.
pub(super) fn plain_length(control: &[DVec2; 4]) -> Option<f64> {
    let is_gentle = is_gentle(control);
    if !is_gentle && turn_rad(control) > MOST_TURN_RAD {
        return None;
    }
    let length = if is_gentle { gentle_length } else { length };
    let quarters = [0.0, 0.25].map(|from| length(control, from, from + 0.25));
    let half = quarters[0] + quarters[1];
    let whole = half + length(control, 0.5, 1.0);
    let shares = LengthShares::of(control);
    let strays =
        [(0.25, quarters[0]), (0.5, half)].map(|(t, length)| (shares.at(t) - length / whole).abs());
    let strays = strays[0].max(strays[1]);
    (whole <= 0.0 || strays <= LENGTH_ACCURACY).then_some(whole)
}

/// Arc length between two parameters by Gauss and Legendre's rule of five points: 1e-6 and better for what a piece
/// may be.
pub(super) fn length(control: &[DVec2; 4], from: f64, to: f64) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (0.046910077030668, 0.118463442528095),
        (0.230765344947158, 0.239314335249683),
        (0.5, 0.284444444444444),
        (0.769234655052842, 0.239314335249683),
        (0.953089922969332, 0.118463442528095),
    ];
    integral(control, from, to, &NODES)
}

/// The same by the rule of three points, for gentle curves: their speed is nearly a parabola, of which it is exact.
fn gentle_length(control: &[DVec2; 4], from: f64, to: f64) -> f64 {
    const NODES: [(f64, f64); 3] = [
        (0.112701665379258, 0.277777777777778),
        (0.5, 0.444444444444444),
        (0.887298334620742, 0.277777777777778),
    ];
    integral(control, from, to, &NODES)
}

/// The mean of the speed between two parameters at these nodes, by their weights, times the way.
#[inline(always)]
fn integral(control: &[DVec2; 4], from: f64, to: f64, nodes: &[(f64, f64)]) -> f64 {
    let at = |t: f64| from + (to - from) * t;
    let sum: f64 = nodes.iter().map(|&(t, w)| w * speed(control, at(t))).sum();
    (to - from) * sum
}

/// Whether neither corner of the control polygon turns by more than half of what a piece may: told without a root.
fn is_gentle([a, b, c, d]: &[DVec2; 4]) -> bool {
    let gentle = |p: DVec2, q: DVec2| p.perp_dot(q).abs() < 0.5 * MOST_TURN_RAD * p.dot(q);
    gentle(*b - *a, *c - *b) && gentle(*c - *b, *d - *c)
}

/// How much the legs of the control polygon turn in all: no less than the curve does.
fn turn_rad(control: &[DVec2; 4]) -> f64 {
    let [a, b, c, d] = *control;
    let legs = [b - a, c - b, d - c];
    let scale = legs.iter().map(|leg| leg.length()).fold(0.0, f64::max);
    let mut legs = legs.into_iter().filter(|leg| leg.length() > 1e-9 * scale);
    let Some(mut last) = legs.next() else {
        return 0.0;
    };
    let mut sum = 0.0;
    for leg in legs {
        sum += last.angle_to(leg).abs();
        last = leg;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::path::scaled;
    use kurbo::ParamCurve;

    /// However a plain curve turns and runs within its bounds, interpolation knows its parts, and its length is that of
    /// kurbo.
    #[test]
    fn plain_curves_are_plain() {
        let turns = [-1.0, -0.4, 0.0, 1.0].map(|share| 0.999 * share * PLAIN_TURN);
        let legs = [0.334, 0.6, 1.0];
        for number in 0..4 * 4 * 27 {
            let leg = |i: usize| legs[number / 16 / [1, 3, 9][i] % 3];
            let turn_rad = |i: usize| turns[number / [1, 4][i] % 4].atan();
            let middle = 7.0 * DVec2::from_angle(0.3);
            let b = DVec2::new(3.0, -2.0);
            let a = b - leg(0) * DVec2::from_angle(-turn_rad(0)).rotate(middle);
            let c = b + leg(1) * middle;
            let control = [
                a,
                b,
                c,
                c + leg(2) * DVec2::from_angle(turn_rad(1)).rotate(middle),
            ];
            assert!(is_plain(&control), "curve {number} is not");
            let truth = |to: f64| {
                let curve = scaled(&control, DVec2::ONE).subsegment(0.0..to);
                kurbo::ParamCurveArclen::arclen(&curve, 1e-12)
            };
            let whole = truth(1.0);
            let off = length(&control, 0.0, 1.0) / whole - 1.0;
            assert!(off.abs() < 3e-7, "curve {number} is off by {off:e}");
            let shares = LengthShares::of(&control);
            for i in 1..20 {
                let t = f64::from(i) / 20.0;
                let off = shares.at(t) - truth(t) / whole;
                assert!(
                    off.abs() < LENGTH_ACCURACY,
                    "curve {number}: {off:e} at {t}"
                );
            }
        }
    }
}
