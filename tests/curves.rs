//! Scratches along every kind of curve lie where the curve's textbook definition says.

mod support;

use glam::DVec2;
use striae::formation::{DepthLaw, Tool};
use striae::pattern::{Key, Path, Pattern, Scratch, Spline, SplineKind};
use support::{Sheet, dark_sheet, relative, sheet_of};

const POINTS: [[f64; 2]; 7] = [
    [0.20, 0.30],
    [0.30, 0.70],
    [0.34, 0.72],
    [0.60, 0.75],
    [0.80, 0.50],
    [0.70, 0.25],
    [0.40, 0.20],
];
const KNOTS: [f64; 11] = [0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 3.0, 4.0, 4.0, 4.0, 4.0];
const ROUND: [f64; 8] = [0.0, 1.0, 2.5, 3.0, 3.0, 4.0, 5.5, 6.0];

/// A Catmull-Rom span from the second to the third point by Barry and Goldman's pyramid (1988), centripetal.
fn catmull_rom(points: [DVec2; 4], share: f64) -> DVec2 {
    let mut knots = [0.0; 4];
    for i in 1..4 {
        knots[i] = knots[i - 1] + points[i].distance(points[i - 1]).sqrt();
    }
    let t = knots[1] + share * (knots[2] - knots[1]);
    let mix =
        |a: DVec2, b: DVec2, i: usize, j: usize| a.lerp(b, (t - knots[i]) / (knots[j] - knots[i]));
    let [p, q, r, s] = points;
    let (a, b, c) = (mix(p, q, 0, 1), mix(q, r, 1, 2), mix(r, s, 2, 3));
    let (d, e) = (mix(a, b, 0, 2), mix(b, c, 1, 3));
    mix(d, e, 1, 2)
}

/// A cubic B-spline by its basis functions (Cox and de Boor).
fn b_spline(points: &[DVec2], knots: &[f64], t: f64) -> DVec2 {
    fn basis(knots: &[f64], i: usize, degree: usize, t: f64) -> f64 {
        if degree == 0 {
            return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
        }
        let part = |from: f64, to: f64, x: f64| if to > from { x / (to - from) } else { 0.0 };
        let (a, b) = (knots[i], knots[i + degree]);
        let (c, d) = (knots[i + 1], knots[i + degree + 1]);
        part(a, b, t - a) * basis(knots, i, degree - 1, t)
            + part(c, d, d - t) * basis(knots, i + 1, degree - 1, t)
    }
    let weighed = points.iter().enumerate();
    weighed.map(|(i, &p)| p * basis(knots, i, 3, t)).sum()
}

/// Points of a curve in order, by definition.
fn truth(kind: SplineKind<'_>, closed: bool) -> Vec<DVec2> {
    let count = POINTS.len();
    let at = |i: usize| DVec2::from(POINTS[i % count]);
    let shares = || (0..4000).map(|k| f64::from(k) / 4000.0);
    let spline = |points: &[DVec2], knots: &[f64]| {
        let (from, to) = (knots[3], knots[points.len()]);
        let all = shares().map(|share| b_spline(points, knots, from + share * (to - from)));
        all.collect()
    };
    let points: Vec<DVec2> = (0..count + if closed { 3 } else { 0 }).map(at).collect();
    match kind {
        SplineKind::CatmullRom => (0..if closed { count } else { count - 1 })
            .flat_map(|i| {
                let reflected = |a: DVec2, b: DVec2| a + (a - b);
                let before = if closed || i > 0 {
                    at(i + count - 1)
                } else {
                    reflected(at(0), at(1))
                };
                let after = if closed || i + 2 < count {
                    at(i + 2)
                } else {
                    reflected(at(count - 1), at(count - 2))
                };
                let span = [before, at(i), at(i + 1), after];
                shares()
                    .step_by(8)
                    .map(move |share| catmull_rom(span, share))
            })
            .collect(),
        SplineKind::BSpline => {
            let knots: Vec<f64> = (0..20).map(f64::from).collect();
            spline(&points, &knots[..points.len() + 4])
        }
        SplineKind::NonUniformBSpline { .. } if closed => {
            let knots: Vec<f64> = (0..points.len() + 4)
                .map(|i| ROUND[i % count] + if i >= count { 6.0 } else { 0.0 })
                .collect();
            spline(&points, &knots)
        }
        SplineKind::NonUniformBSpline { knots } => spline(&points, knots),
        _ => panic!("{kind:?} is not asked for"),
    }
}

fn scratched(spline: Spline<'_, 2>, keys: &[Key]) -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    builder
        .add(&Scratch {
            path: Path::Spline(spline),
            keys,
            depth_law: DepthLaw::Stated,
            ..Scratch::new(&Tool::vickers())
        })
        .unwrap();
    builder.build()
}

/// Radiance of a pixel of 0.02 mm: the scratch's bottom, 1.4 mm wide, is white.
fn seen(pattern: &Pattern, place: DVec2) -> f64 {
    Sheet::UPRIGHT.pixel(pattern, place, 2e-5 * DVec2::X, 2e-5 * DVec2::Y)
}

/// Every smooth kind, open and closed, is scratched all along, and as long as its definition says: a scratch that
/// begins half way begins at the middle of the chords.
#[test]
fn smooth_kinds() {
    for (kind, closed) in [
        (SplineKind::CatmullRom, false),
        (SplineKind::CatmullRom, true),
        (SplineKind::BSpline, false),
        (SplineKind::BSpline, true),
        (SplineKind::NonUniformBSpline { knots: &KNOTS }, false),
        (SplineKind::NonUniformBSpline { knots: &ROUND }, true),
    ] {
        let spline = Spline {
            kind,
            points: &POINTS,
            closed,
        };
        let mut truth = truth(kind, closed);
        if closed {
            truth.push(truth[0]);
        }
        let mut along = vec![0.0];
        for pair in truth.windows(2) {
            along.push(along[along.len() - 1] + 1000.0 * pair[0].distance(pair[1]));
        }
        let whole = along[along.len() - 1];
        let curves = Path::Spline(spline).curves(DVec2::splat(1000.0)).unwrap();
        let length: f64 = curves.iter().map(|curve| curve.length).sum();
        // An open curve's last chord is not among those above.
        let last = if closed { 0.0 } else { whole / 1000.0 };
        assert!(
            length > whole * (1.0 - 1e-6) && length < whole * (1.0 + 1e-6) + last,
            "{kind:?}, {closed}: {length} of {whole}"
        );
        let all = scratched(spline, &[Key::depth(0.0, 0.1)]);
        let half = [
            Key::depth(0.0, 0.0),
            Key::depth(0.5, 0.0),
            Key::depth(0.5, 0.1),
        ];
        let half = scratched(spline, &half);
        let black = seen(&all, DVec2::splat(0.01));
        for (place, along) in truth.iter().zip(&along).skip(20).step_by(61) {
            let white = seen(&all, *place);
            assert!(
                white > 20.0 * black,
                "{kind:?}, {closed}: no scratch at {along} mm"
            );
            let from_middle = along - 0.5 * length;
            let share = relative(seen(&half, *place), white);
            if from_middle > 0.5 && from_middle < 0.45 * length {
                assert!(share < 0.02, "{kind:?}: shallow {from_middle} mm on");
            } else if from_middle < -1.5 && along > &2.0 {
                assert!(share > 0.5, "{kind:?}: begins {from_middle} mm early");
            }
        }
    }
}
