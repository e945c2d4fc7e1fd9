//! A scratch's path in texture space, as its author states it, and the cubic curves it comes to.

use super::arc_length::{is_plain, length};
use super::pieces::points_of;
use super::spline::{Spline, SplineKind};
use super::surface::{self, Surface};
use crate::error::{Error, Result};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurveArclen, Point};

/// Where a scratch runs.
#[derive(Clone, Copy, Debug)]
pub enum Path<'a> {
    /// Straight lines in texture space (u, v) from point to point, two points or more: short for an open
    /// [`SplineKind::Polyline`].
    Polyline(&'a [[f64; 2]]),
    /// Cubic Bézier curves in texture space, each starting where the last one ends, 3 n + 1 points, n at least 1:
    /// short for an open [`SplineKind::CubicBezier`].
    CubicBezier(&'a [[f64; 2]]),
    /// A curve of any kind in texture space, open or closed.
    Spline(Spline<'a, 2>),
    /// A curve drawn in space near a mesh, as in a modeller: its closest points on the mesh, carried into texture
    /// space. Its arc length is that on the mesh, and goes on where the path passes over a seam of texture
    /// space or from one chart to another, mirrored or not: left and right of travel stay what they are on the
    /// mesh. Where it leaves an open mesh by more than a tenth of a triangle there is no path; arc length
    /// goes on where it comes back. Where the closest point leaps, the path runs straight across the mesh.
    OnSurface {
        /// The mesh.
        surface: &'a Surface,
        /// The curve, in the mesh's own coordinates.
        spline: Spline<'a, 3>,
    },
}

/// One cubic Bézier curve of a path.
#[derive(Clone, Copy, Debug)]
pub struct Curve {
    /// Control points, (u, v).
    pub control: [DVec2; 4],
    /// Arc length, scene units, above 0.
    pub length: f64,
    /// Starts where the curve before it ends; on the first curve, where the last one ends: the path is closed.
    pub joins: bool,
}

/// Relative accuracy of arc lengths.
const ARC_LENGTH_ACCURACY: f64 = 1e-6;

impl Path<'_> {
    /// The path's curves in texture space in order, checked, as a pattern has them; those of no length are left out.
    /// `units_per_uv` (above 0) says how many scene units one unit of u and of v spans, for arc length of paths that
    /// are stated in texture space.
    ///
    /// Errors: too few or too many points for the kind, values out of range, bad knots, no length.
    pub fn curves(self, units_per_uv: DVec2) -> Result<Vec<Curve>> {
        let spline = match self {
            Self::Polyline(points) => Spline::open(SplineKind::Polyline, points),
            Self::CubicBezier(points) => Spline::open(SplineKind::CubicBezier, points),
            Self::Spline(spline) => spline,
            Self::OnSurface { surface, spline } => {
                let (runs, smooth) = surface::trace(surface, &spline)?;
                return Ok(surface::curves(surface, &runs, smooth, units_per_uv));
            }
        };
        let cubics = spline.cubics("points_uv", units_per_uv.to_array())?;
        let measured = cubics.into_iter().map(|cubic| {
            let control = cubic.map(DVec2::from);
            Curve {
                control,
                length: arc_length(&scaled(&control, units_per_uv)),
                joins: true,
            }
        });
        let mut curves = Vec::with_capacity(measured.len());
        curves.extend(measured.filter(|curve: &Curve| curve.length > 0.0));
        let whole: f64 = curves.iter().map(|curve| curve.length).sum();
        if whole.is_nan() || whole <= 0.0 || whole.is_infinite() {
            let accepted = "a path of finite length above 0";
            return Err(Error::number("points_uv", whole, accepted));
        }
        curves[0].joins = spline.closed;
        Ok(curves)
    }
}

/// Control points in scene units.
pub(crate) fn scaled(control: &[DVec2; 4], units_per_uv: DVec2) -> CubicBez {
    let [a, b, c, d] = control.map(|p| p * units_per_uv);
    let point = |p: DVec2| Point::new(p.x, p.y);
    CubicBez::new(point(a), point(b), point(c), point(d))
}

/// Arc length. No curve is shorter than its chord or longer than its control polygon.
pub(crate) fn arc_length(curve: &CubicBez) -> f64 {
    let control = points_of(curve);
    if is_plain(&control) {
        return length(&control, 0.0, 1.0);
    }
    let chord = (curve.p3 - curve.p0).hypot();
    let polygon = (curve.p1 - curve.p0).hypot()
        + (curve.p2 - curve.p1).hypot()
        + (curve.p3 - curve.p2).hypot();
    let accuracy = ARC_LENGTH_ACCURACY * polygon;
    if polygon - chord <= accuracy {
        0.5 * (chord + polygon)
    } else {
        curve.arclen(accuracy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points that coincide, are too few or not finite are refused by name.
    #[test]
    fn bad_paths_are_refused() {
        let refused = |path: Path<'_>| path.curves(DVec2::ONE).unwrap_err().to_string();
        assert!(
            refused(Path::Polyline(&[])).starts_with("point_count is 0"),
            "empty"
        );
        assert!(
            refused(Path::Polyline(&[[0.5; 2]; 3])).contains("length above 0"),
            "no length"
        );
        let bad = [[0.0, 0.0], [1.0, f64::NAN]];
        assert!(
            refused(Path::Polyline(&bad)).starts_with("points_uv[1] is NaN"),
            "NaN"
        );
        assert!(
            refused(Path::CubicBezier(&[[0.0; 2]; 5])).contains("3 n + 1"),
            "count"
        );
        let closed = Spline::closed(SplineKind::CubicBezier, &[[0.0; 2]; 4]);
        assert!(
            refused(Path::Spline(closed))
                .starts_with("point_count is 4; accepted: 3 n for a closed"),
            "closed"
        );
    }

    const POINTS: [[f64; 2]; 7] = [
        [0.0, 0.0],
        [0.2, 0.9],
        [0.25, 0.9],
        [0.9, 0.7],
        [1.0, 0.1],
        [0.6, -0.4],
        [0.3, -0.1],
    ];
    const CLAMPED: SplineKind<'_> = SplineKind::NonUniformBSpline {
        knots: &[0.0, 0.0, 0.0, 0.0, 1.0, 3.0, 3.5, 4.0, 4.0, 4.0, 4.0],
    };
    const PERIODIC: SplineKind<'_> = SplineKind::NonUniformBSpline {
        knots: &[0.0, 1.0, 1.5, 3.0, 3.5, 4.0, 4.0, 5.0],
    };
    const UNITS: DVec2 = DVec2::new(20.0, 5.0);

    fn curves(spline: Spline<'_, 2>) -> Vec<Curve> {
        Path::Spline(spline).curves(UNITS).unwrap()
    }

    /// Unit tangents at both ends, where neighbours of the end differ from it.
    fn tangents(curve: &Curve) -> [DVec2; 2] {
        let [a, b, c, d] = curve.control;
        [b - a, d - c].map(|tangent| (tangent * UNITS).normalize())
    }

    /// Smooth curves go on without a kink, closed ones also where they close.
    #[test]
    fn tangents_continue() {
        use SplineKind::{BSpline, CatmullRom};
        for (spline, count) in [
            (Spline::open(CatmullRom, &POINTS), 6),
            (Spline::open(BSpline, &POINTS), 4),
            (Spline::open(CLAMPED, &POINTS), 4),
            (Spline::closed(CatmullRom, &POINTS), 7),
            (Spline::closed(BSpline, &POINTS), 7),
            (Spline::closed(PERIODIC, &POINTS), 6),
        ] {
            let curves = curves(spline);
            assert_eq!(curves.len(), count, "{spline:?}");
            assert_eq!(curves[0].joins, spline.closed, "{spline:?}");
            let joints = if spline.closed { count } else { count - 1 };
            for i in 0..joints {
                let next = &curves[(i + 1) % count];
                assert_eq!(curves[i].control[3], next.control[0], "gap in {spline:?}");
                let (ends, begins) = (tangents(&curves[i])[1], tangents(next)[0]);
                assert!(ends.distance(begins) < 1e-9, "kink after {i} of {spline:?}");
            }
        }
    }

    /// A Catmull-Rom spline passes through its points, repeated ones once, and keeps its shape on a
    /// stretched texture.
    #[test]
    fn catmull_rom_passes_through_its_points() {
        let repeated: Vec<[f64; 2]> = POINTS.iter().flat_map(|&p| [p, p]).collect();
        for closed in [false, true] {
            let spline = |points| Spline {
                kind: SplineKind::CatmullRom,
                points,
                closed,
            };
            let curves = curves(spline(&POINTS));
            for (curve, point) in curves.iter().zip(POINTS) {
                assert_eq!(curve.control[0], DVec2::from(point));
            }
            let again = Path::Spline(spline(&repeated)).curves(UNITS).unwrap();
            let stretched = POINTS.map(|[u, v]| [u * UNITS.x, v * UNITS.y]);
            let stretched = Path::Spline(spline(&stretched)).curves(DVec2::ONE).unwrap();
            for ((curve, again), stretched) in curves.iter().zip(&again).zip(&stretched) {
                assert_eq!(curve.control, again.control, "repeated points");
                let scaled = curve.control.map(|p| p * UNITS);
                for (a, b) in scaled.into_iter().zip(stretched.control) {
                    assert!(a.distance(b) < 1e-12, "{a} and {b}");
                }
            }
        }
    }

    /// Arc lengths are those of a million chords, and of circles.
    #[test]
    fn arc_lengths() {
        for spline in [
            Spline::open(SplineKind::Polyline, &POINTS),
            Spline::closed(SplineKind::Polyline, &POINTS),
            Spline::closed(SplineKind::CubicBezier, &POINTS[..6]),
            Spline::closed(SplineKind::CatmullRom, &POINTS),
            Spline::closed(SplineKind::BSpline, &POINTS),
            Spline::open(CLAMPED, &POINTS),
        ] {
            for curve in curves(spline) {
                let chords = 100_000;
                let at = |i: u32| {
                    let t = f64::from(i) / f64::from(chords);
                    crate::pattern::closest::bezier(&curve.control, t) * UNITS
                };
                let sum: f64 = (0..chords).map(|i| at(i).distance(at(i + 1))).sum();
                let deviation = (curve.length / sum - 1.0).abs();
                assert!(deviation < 2e-6, "{deviation:e} in {spline:?}");
            }
        }
        // A periodic B-spline around many points of a circle is a circle, a little smaller: (2 + cos) / 3 of it.
        let angle = std::f64::consts::TAU / 64.0;
        let round: Vec<[f64; 2]> = (0..64)
            .map(|i| (f64::from(i) * angle).sin_cos().into())
            .collect();
        let circle = Path::Spline(Spline::closed(SplineKind::BSpline, &round));
        let length: f64 = circle
            .curves(DVec2::ONE)
            .unwrap()
            .iter()
            .map(|curve| curve.length)
            .sum();
        let truth = std::f64::consts::TAU * (2.0 + angle.cos()) / 3.0;
        assert!((length / truth - 1.0).abs() < 1e-5, "{length} of {truth}");
    }

    /// How long a million smooth scratches of four curves each take.
    #[test]
    #[ignore = "a measurement: cargo test --release --lib a_million -- --ignored --nocapture"]
    fn a_million_paths() {
        for kind in [
            SplineKind::Polyline,
            SplineKind::CatmullRom,
            SplineKind::BSpline,
        ] {
            let count = if kind == SplineKind::BSpline { 7 } else { 5 };
            let path = Path::Spline(Spline::open(kind, &POINTS[..count]));
            let start = std::time::Instant::now();
            let mut sum = 0;
            for _ in 0..1_000_000 {
                sum += std::hint::black_box(path).curves(UNITS).unwrap().len();
            }
            assert_eq!(sum, 4_000_000);
            println!("{kind:?}: {:.2} s", start.elapsed().as_secs_f64());
        }
    }
}
