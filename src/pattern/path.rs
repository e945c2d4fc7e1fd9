//! A scratch's path in texture space, as its author states it, and the cubic curves it comes to.

use crate::error::{Error, Result};
use glam::DVec2;
use kurbo::{CubicBez, ParamCurveArclen, Point};

/// Where a scratch runs, in texture space (u, v).
#[derive(Clone, Copy, Debug)]
pub enum Path<'a> {
    /// Straight lines from point to point, two points or more.
    Polyline(&'a [[f64; 2]]),
    /// Cubic Bézier curves, each starting where the last one ends: 3 n + 1 points, n at least 1.
    CubicBezier(&'a [[f64; 2]]),
}

/// One cubic Bézier curve of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Curve {
    /// Control points, (u, v).
    pub control: [DVec2; 4],
    /// Arc length, scene units, above 0.
    pub length: f64,
    /// Starts where the curve before it ends; on the first curve, where the last one ends: the path is closed.
    pub joins: bool,
}

/// Relative accuracy of arc lengths.
const ARC_LENGTH_ACCURACY: f64 = 1e-7;

impl<'a> Path<'a> {
    fn points(self) -> (&'a [[f64; 2]], &'static str) {
        match self {
            Self::Polyline(points) => (points, "two or more"),
            Self::CubicBezier(points) => (points, "3 n + 1, n curves with n at least 1"),
        }
    }

    /// The path's curves in order, checked; those of no length are left out. `units_per_uv` scales texture space
    /// for arc length.
    pub(crate) fn curves(self, units_per_uv: DVec2) -> Result<Vec<Curve>> {
        let controls = self.controls()?;
        let measured = controls.into_iter().map(|control| Curve {
            control,
            length: arc_length(&scaled(&control, units_per_uv)),
            joins: true,
        });
        let mut curves: Vec<Curve> = measured.filter(|curve| curve.length > 0.0).collect();
        let whole: f64 = curves.iter().map(|curve| curve.length).sum();
        if whole.is_nan() || whole <= 0.0 || whole.is_infinite() {
            let accepted = "a path of finite length above 0";
            return Err(Error::number("points_uv", whole, accepted));
        }
        curves[0].joins = false;
        Ok(curves)
    }

    /// Control points, checked.
    fn controls(self) -> Result<Vec<[DVec2; 4]>> {
        let (points, accepted) = self.points();
        let count_fits = match self {
            Self::Polyline(_) => points.len() >= 2,
            Self::CubicBezier(_) => points.len() >= 4 && points.len() % 3 == 1,
        };
        if !count_fits {
            return Err(Error::count("point_count", points.len(), accepted));
        }
        for (i, point) in points.iter().enumerate() {
            for &value in point {
                if !value.is_finite() || value.abs() > 1e9 {
                    let accepted = "a finite u or v between -1e9 and 1e9";
                    return Err(Error::number("", value, accepted).within("points_uv", i));
                }
            }
        }
        let line = |pair: &[[f64; 2]]| {
            let (a, b) = (DVec2::from(pair[0]), DVec2::from(pair[1]));
            [a, a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0), b]
        };
        let bezier = |i: usize| [0, 1, 2, 3].map(|k| DVec2::from(points[3 * i + k]));
        Ok(match self {
            Self::Polyline(_) => points.windows(2).map(line).collect(),
            Self::CubicBezier(_) => (0..points.len() / 3).map(bezier).collect(),
        })
    }
}

/// Control points in scene units.
pub(crate) fn scaled(control: &[DVec2; 4], units_per_uv: DVec2) -> CubicBez {
    let [a, b, c, d] = control.map(|p| p * units_per_uv);
    let point = |p: DVec2| Point::new(p.x, p.y);
    CubicBez::new(point(a), point(b), point(c), point(d))
}

pub(crate) fn arc_length(curve: &CubicBez) -> f64 {
    let hull = (curve.p1 - curve.p0).hypot()
        + (curve.p2 - curve.p1).hypot()
        + (curve.p3 - curve.p2).hypot();
    if hull > 0.0 {
        curve.arclen(ARC_LENGTH_ACCURACY * hull)
    } else {
        0.0
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
    }
}
