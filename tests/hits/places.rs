//! Which scratch, where on it, which way it runs and how deep it is there.

use super::support::process::form;
use super::support::{SHEET_MM, dark_sheet, random, sheet_of};
use super::{only, pixel};
use glam::{DVec2, Vec3};
use rand::Rng;
use striae::formation::{DepthLaw, Orientation, Tool};
use striae::pattern::{Footprint, Frame, Key, Path, PatternBuilder, Scratch, SurfacePoint};

const LEANING: Orientation = Orientation {
    spin_deg: 10.0,
    tilt_deg: 8.0,
    azimuth_deg: 70.0,
};

/// A polyline's height at x, 0 beside it.
fn height(points: &[DVec2], x: f64) -> f64 {
    let mut pairs = points.windows(2);
    let around = pairs.find(|pair| pair[0].x <= x && x <= pair[1].x);
    around.map_or(0.0, |pair| {
        pair[0].y + (pair[1].y - pair[0].y) * (x - pair[0].x) / (pair[1].x - pair[0].x)
    })
}

/// Straight scratches in any direction: number, arc length, offset, direction, and depth of a cross-section
/// without a mirror image; and the covered share, by overlap.
#[test]
fn straight_scratches() {
    let mut random = random(71);
    let tool = Tool::vickers();
    let section = form(&tool, DepthLaw::default(), 2.0, LEANING);
    let points = section.vertices();
    let (left, right) = (points[0].x, points[points.len() - 1].x);
    assert!(
        (left + right).abs() > 0.01 * right,
        "a mirror image: {left} to {right}"
    );
    let (mut deep, mut high) = (0, 0);
    for case in 0..60_u32 {
        let travel = DVec2::from_angle(random.random_range(0.0..6.3));
        let across = DVec2::new(travel.y, -travel.x);
        let mut builder = sheet_of(&dark_sheet());
        for i in 0..3 {
            let start = DVec2::splat(0.5) + across * 0.01 * f64::from(i) - 0.1 * travel;
            let key = Key {
                orientation: LEANING,
                ..Key::force(0.0, 2.0)
            };
            let path = Path::Polyline(&[start.to_array(), (start + 0.2 * travel).to_array()]);
            let scratch = Scratch {
                path,
                keys: &[key],
                ..Scratch::new(&tool)
            };
            builder.add(&scratch).unwrap();
        }
        let pattern = builder.build();
        let (along_mm, offset_mm) = (
            random.random_range(10.0..190.0),
            random.random_range(left..right),
        );
        let uv = DVec2::splat(0.5)
            + across * (0.01 * f64::from(case % 3) + offset_mm / SHEET_MM)
            + travel * (along_mm / SHEET_MM - 0.1);
        let side_mm = 10.0_f64.powf(random.random_range(-3.0..0.5));
        let hit = only(
            &pattern,
            &pixel(uv, side_mm * travel, 0.7 * side_mm * across),
        );
        assert_eq!(hit.scratch, case % 3, "{hit:?}");
        assert!(
            (hit.arc_length - along_mm).abs() < 1e-4,
            "{hit:?}: {along_mm} mm"
        );
        assert!(
            (hit.offset_mm - offset_mm).abs() < 1e-6,
            "{hit:?}: {offset_mm} mm"
        );
        let direction = Vec3::from(hit.travel) - travel.extend(0.0).as_vec3();
        assert!(direction.length() < 1e-6, "{hit:?}: {travel}");
        let depth_mm = -height(&points, offset_mm);
        assert!(
            (f64::from(hit.depth_mm) - depth_mm).abs() < 1e-6,
            "{hit:?}: {depth_mm} mm"
        );
        assert!(
            (f64::from(hit.deepest_mm) - section.depth_mm()).abs() < 1e-6,
            "{hit:?}"
        );
        let half_mm = 0.35 * side_mm;
        let overlap = right.min(offset_mm + half_mm) - left.max(offset_mm - half_mm);
        let coverage = overlap / (2.0 * half_mm);
        assert!(
            (f64::from(hit.coverage) - coverage).abs() < 1e-5,
            "{hit:?}: {coverage}"
        );
        deep += u32::from(depth_mm > 0.0);
        high += u32::from(depth_mm < 0.0);
    }
    assert!(
        deep > 10 && high > 10,
        "{deep} in the groove, {high} on the rims"
    );
}

/// Along a curve, in scene units of a centimetre, on a texture space that is turned, stretched or mirrored:
/// arc length to a hundred-thousandth, offset to the right of travel, and direction in the frame of the point.
#[test]
fn curves_and_mirrored_texture_space() {
    const STEPS: u32 = 20_000;
    let control = [[0.1, 0.2], [1.1, 0.3], [-0.1, 0.7], [0.8, 0.8]].map(DVec2::from);
    let bezier = |t: f64| {
        let [a, b, c, d] = control;
        let (s, u) = (1.0 - t, t);
        s * s * s * a + 3.0 * s * s * u * b + 3.0 * s * u * u * c + u * u * u * d
    };
    let velocity = |t: f64| {
        let [a, b, c, d] = control;
        let s = 1.0 - t;
        3.0 * (s * s * (b - a) + 2.0 * s * t * (c - b) + t * t * (d - c))
    };
    for [du, dv] in [
        [DVec2::X, DVec2::Y],
        [DVec2::new(-1.0, 0.0), DVec2::Y],
        [DVec2::new(0.6, 0.8), DVec2::new(1.6, -1.2)],
    ] {
        // 10 scene units to a unit of u, 10 mm to a scene unit.
        let (du, dv) = (10.0 * du, 10.0 * dv);
        let place = |uv: DVec2| uv.x * du + uv.y * dv;
        let to_uv = glam::DMat2::from_cols(du, dv).inverse();
        let units = [du.length(), dv.length()];
        let mut builder = PatternBuilder::new(dark_sheet(), 10.0, units).unwrap();
        let tool = Tool::rockwell_c();
        let points = control.map(|p| p.to_array());
        let scratch = Scratch {
            path: Path::CubicBezier(&points),
            keys: &[Key::force(0.0, 1.0), Key::force(1.0, 4.0)],
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
        let pattern = builder.build();
        let (mut arc_length, mut worst) = (0.0, [0.0_f64; 3]);
        for i in 1..=STEPS {
            let [before, t] = [i - 1, i].map(|i| f64::from(i) / f64::from(STEPS));
            arc_length += place(bezier(before)).distance(place(bezier(t)));
            if i % 311 != 0 {
                continue;
            }
            let travel = place(velocity(t)).normalize();
            let offset_mm = 0.04 * f64::from(i % 3) - 0.04;
            let right = DVec2::new(travel.y, -travel.x);
            let at = place(bezier(t)) + right * offset_mm / 10.0;
            let point = SurfacePoint {
                uv: (to_uv * at).to_array(),
                dp_du: du.extend(0.0).as_vec3().to_array(),
                dp_dv: dv.extend(0.0).as_vec3().to_array(),
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Radius(0.003),
            };
            let hit = only(&pattern, &point);
            let world = Frame::at(&point).unwrap().to_world(Vec3::from(hit.travel));
            let off = [
                (hit.arc_length - arc_length).abs(),
                (hit.offset_mm - offset_mm).abs(),
                f64::from((world - travel.extend(0.0).as_vec3()).length()),
            ];
            worst = [0, 1, 2].map(|k| worst[k].max(off[k]));
        }
        println!("{du} {dv}: worst arc length, offset, direction: {worst:?} of {arc_length}");
        assert!(worst[0] < 1e-5 * arc_length, "{worst:?}");
        assert!(worst[1] < 1e-7 && worst[2] < 1e-6, "{worst:?}");
    }
}
