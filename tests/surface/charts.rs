//! Scratches on mirrored charts look as they do on others.

use super::support::meshes::Mesh;
use super::support::{dark_sheet, relative, sheet_of};
use glam::{DVec2, DVec3};
use striae::formation::{DepthLaw, Orientation, Tool};
use striae::pattern::{Footprint, Key, Path, Scratch, Spline, SplineKind, SurfacePoint};
use striae::scattering::{Output, Shading};

/// On a mirrored chart left and right of travel stay what they are on the mesh: the frame's y is z × x, and travel is
/// measured in it. A tool that leans to one side leaves the same scratch on both sides of the seam.
#[test]
fn mirrored_charts() {
    let mut mesh = Mesh::default();
    let half = |from: f64| move |p: DVec2| DVec3::new(from + 500.0 * p.x, 1000.0 * p.y, 0.0);
    mesh.add_grid([5, 10], half(-500.0), |p| DVec2::new(0.5 * p.x, p.y));
    mesh.add_grid([5, 10], half(0.0), |p| {
        DVec2::new(1.0 + 0.5 * p.x, 1.0 - p.y)
    });
    let surface = mesh.surface();
    let points = [[-400.0, 300.0, 0.0], [400.0, 700.0, 0.0]];
    let lean = Orientation {
        spin_deg: 0.0,
        tilt_deg: 10.0,
        azimuth_deg: 90.0,
    };
    let key = Key {
        orientation: lean,
        ..Key::depth(0.0, 0.1)
    };
    let mut builder = sheet_of(&dark_sheet());
    builder
        .add(&Scratch {
            path: Path::OnSurface {
                surface: &surface,
                spline: Spline::open(SplineKind::Polyline, &points),
            },
            keys: &[key],
            depth_law: DepthLaw::Stated,
            ..Scratch::new(&Tool::vickers())
        })
        .unwrap();
    let pattern = builder.build();
    let radiance = |mirrored: bool, right: f64| {
        let along = if mirrored { 200.0 } else { -200.0 };
        let travel = DVec2::new(2.0, 1.0).normalize();
        let p = DVec2::new(along, 500.0 + 0.5 * along) - right * travel.perp();
        let (uv, dv) = if mirrored {
            (DVec2::new(1.0 + p.x / 1000.0, 1.0 - p.y / 1000.0), -1000.0)
        } else {
            (DVec2::new((p.x + 500.0) / 1000.0, p.y / 1000.0), 1000.0)
        };
        let point = SurfacePoint {
            uv: uv.to_array(),
            dp_du: [1000.0, 0.0, 0.0],
            dp_dv: [0.0, dv, 0.0],
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Radius(0.03),
        };
        let mut shading = Shading::default();
        shading.shade(&pattern, &point, [0.0, 0.0, 1.0]).unwrap();
        f64::from(shading.eval([0.5, -0.3, 0.8], Output::BrdfCos)[0])
    };
    let mut sides = 0.0_f64;
    let mut worst = 0.0_f64;
    for right in [-0.2, -0.1, -0.05, 0.0, 0.05, 0.1, 0.2] {
        let (plain, mirrored) = (radiance(false, right), radiance(true, right));
        sides = sides.max(relative(plain, radiance(false, -right)));
        worst = worst.max(relative(plain, mirrored));
        assert!(
            relative(plain, mirrored) < 1e-4,
            "{right} mm to the right: {plain}, mirrored {mirrored}"
        );
    }
    println!("mirrored and not: {worst:.1e} apart, sides {sides:.1e}");
    assert!(sides > 0.1, "left and right look alike: {sides}");
}
