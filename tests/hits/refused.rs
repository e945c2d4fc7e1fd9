//! Points that cannot be.

use super::many::parallel;
use super::support::single;
use super::{NONE, there};
use glam::DVec2;
use striae::pattern::{Footprint, SurfacePoint};

/// A point that cannot be is refused by name.
#[test]
fn bad_points() {
    let pattern = parallel(3);
    let good = there(DVec2::splat(0.5));
    let nan = f32::NAN;
    let uv = [f64::NAN, 0.5];
    for (argument, point) in [
        ("uv", SurfacePoint { uv, ..good }),
        (
            "normal",
            SurfacePoint {
                normal: [0.0; 3],
                ..good
            },
        ),
        (
            "dp_du",
            SurfacePoint {
                dp_du: [nan, 0.0, 0.0],
                ..good
            },
        ),
        (
            "dp_du x dp_dv",
            SurfacePoint {
                dp_dv: [0.0; 3],
                ..good
            },
        ),
        (
            "radius",
            SurfacePoint {
                footprint: Footprint::Radius(-1.0),
                ..good
            },
        ),
        (
            "radius",
            SurfacePoint {
                footprint: Footprint::Radius(nan),
                ..good
            },
        ),
        (
            "duv_dx",
            SurfacePoint {
                footprint: Footprint::Differentials {
                    duv_dx: [single(f64::INFINITY), 0.0],
                    duv_dy: [0.0, 1.0],
                },
                ..good
            },
        ),
    ] {
        let mut hits = [NONE; 2];
        let message = pattern.hits(&point, &mut hits).unwrap_err().to_string();
        assert!(
            message.contains(argument) && message.contains("; accepted: "),
            "{message}"
        );
        assert_eq!(hits, [NONE; 2], "written all the same: {argument}");
    }
}
