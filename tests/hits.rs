//! What a renderer is told of the scratches in a footprint is what was scratched.

mod support;

use glam::{DVec2, Vec3};
use rand::Rng;
use striae::formation::{DepthLaw, Orientation, Tool};
use striae::pattern::{
    Footprint, Found, Frame, Key, Path, Pattern, PatternBuilder, Scratch, ScratchHit, SurfacePoint,
};
use striae::scattering::Shading;
use support::process::form;
use support::{SHEET_MM, Sheet, dark_sheet, random, sheet_of, single, straight};

const NONE: ScratchHit = ScratchHit {
    scratch: u32::MAX,
    coverage: -1.0,
    arc_length: -1.0,
    offset_mm: 0.0,
    travel: [0.0; 3],
    depth_mm: 0.0,
    deepest_mm: 0.0,
};

const LEANING: Orientation = Orientation {
    spin_deg: 10.0,
    tilt_deg: 8.0,
    azimuth_deg: 70.0,
};

fn hits(pattern: &Pattern, point: &SurfacePoint) -> Vec<ScratchHit> {
    let mut hits = vec![NONE; 400];
    let found = pattern.hits(point, &mut hits).unwrap();
    assert!(found.complete, "too many to tell apart at {point:?}");
    assert_eq!(found.written, found.count, "room for all");
    hits[..found.written].to_vec()
}

fn only(pattern: &Pattern, point: &SurfacePoint) -> ScratchHit {
    let hits = hits(pattern, point);
    assert_eq!(hits.len(), 1, "{hits:?} at {point:?}");
    hits[0]
}

/// A pixel around a place of the upright sheet, (u, v), with edges in mm.
fn pixel(uv: DVec2, dx_mm: DVec2, dy_mm: DVec2) -> SurfacePoint {
    Sheet::UPRIGHT.point(uv, dx_mm / SHEET_MM, dy_mm / SHEET_MM)
}

fn there(uv: DVec2) -> SurfacePoint {
    SurfacePoint {
        footprint: Footprint::Point,
        ..pixel(uv, DVec2::X, DVec2::Y)
    }
}

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
/// arc length to a ten-thousandth, offset to the right of travel, and direction in the frame of the point.
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
        assert!(worst[0] < 1e-4 * arc_length, "{worst:?}");
        assert!(worst[1] < 1e-5 && worst[2] < 1e-4, "{worst:?}");
    }
}

/// Where two scratches cross, the later one covers, the earlier one has what is left; of equal ones the later one
/// comes first.
#[test]
fn later_scratches_cut_earlier_ones() {
    let lines = [([0.2, 0.5], [0.8, 0.5]), ([0.5, 0.2], [0.5, 0.8])];
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &lines, 2.0);
    let middle = DVec2::splat(0.5);
    let crossing = only(&pattern, &there(middle));
    assert_eq!(
        (crossing.scratch, crossing.coverage),
        (1, 1.0),
        "{crossing:?}"
    );
    let section = form(
        &Tool::rockwell_c(),
        DepthLaw::default(),
        2.0,
        support::process::UPRIGHT,
    );
    let points = section.vertices();
    let width = points[points.len() - 1].x - points[0].x;
    for side in [2.0 * width, 5.0 * width] {
        let hits = hits(&pattern, &pixel(middle, side * DVec2::X, side * DVec2::Y));
        let shares = [width / side, width * (side - width) / (side * side)];
        assert_eq!(hits.len(), 2, "{hits:?}");
        for (i, (hit, share)) in hits.iter().zip(shares).enumerate() {
            assert_eq!(hit.scratch as usize, 1 - i, "{hit:?}");
            assert!(
                (f64::from(hit.coverage) - share).abs() < 1e-5,
                "{hit:?}: {share}"
            );
        }
    }
    let corner = middle + DVec2::splat(2.0 / SHEET_MM);
    let both = hits(&pattern, &pixel(corner, 5.0 * DVec2::X, 5.0 * DVec2::Y));
    let order: Vec<u32> = both.iter().map(|hit| hit.scratch).collect();
    assert_eq!(order, [1, 0], "{both:?}");
    let apart = [([0.2, 0.5], [0.8, 0.5]), ([0.2, 0.501], [0.8, 0.501])];
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &apart, 2.0);
    let both = hits(
        &pattern,
        &pixel(DVec2::new(0.5, 0.5005), 4.0 * DVec2::X, 4.0 * DVec2::Y),
    );
    assert_eq!(
        both.iter().map(|hit| hit.scratch).collect::<Vec<_>>(),
        [1, 0],
        "{both:?}"
    );
}

/// Bent, crossing and cornered scratches, some crossing themselves.
fn tangle() -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    let tool = Tool::rockwell_c();
    let near = |points: &[[f64; 2]]| -> Vec<[f64; 2]> {
        points
            .iter()
            .map(|p| p.map(|mm| 0.5 + mm / SHEET_MM))
            .collect()
    };
    let straight = [[-5.0, -0.2], [5.0, 0.3]];
    let loop_points = [[-1.0, -1.0], [3.0, 2.0], [-3.0, 2.0], [1.0, -1.0]];
    let corner = [[-2.0, 0.9], [0.2, 0.9], [0.4, -2.0]];
    for (points, bent) in [
        (&straight[..], false),
        (&loop_points, true),
        (&corner, false),
    ] {
        let points = near(points);
        let path = if bent {
            Path::CubicBezier(&points)
        } else {
            Path::Polyline(&points)
        };
        let scratch = Scratch {
            path,
            keys: &[Key::force(0.0, 0.5), Key::force(1.0, 3.0)],
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
    }
    builder.build()
}

/// What a footprint says that a scratch covers is the share of its points that find the scratch; runs of one
/// scratch are one hit.
#[test]
fn coverage_is_the_share_of_points() {
    const SIDE: u32 = 120;
    let pattern = tangle();
    for (center_mm, side_mm) in [([0.0, 0.1], 1.0), ([0.3, 0.9], 1.0), ([0.05, -0.2], 0.5)] {
        let center = DVec2::splat(0.5) + DVec2::from(center_mm) / SHEET_MM;
        let (dx, dy) = (
            side_mm * DVec2::new(0.9, 0.2),
            side_mm * DVec2::new(-0.3, 0.8),
        );
        let mut shares = [0.0; 3];
        for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
            let [a, b] = [i, j].map(|i| (f64::from(i) + 0.5) / f64::from(SIDE) - 0.5);
            for hit in hits(&pattern, &there(center + (a * dx + b * dy) / SHEET_MM)) {
                shares[hit.scratch as usize] += f64::from(hit.coverage) / f64::from(SIDE * SIDE);
            }
        }
        let hits = hits(&pattern, &pixel(center, dx, dy));
        println!("{center_mm:?}, {side_mm} mm: {shares:?} by points, {hits:?}");
        assert!(
            hits.windows(2)
                .all(|pair| pair[0].coverage >= pair[1].coverage),
            "order"
        );
        for (i, share) in shares.into_iter().enumerate() {
            let mut own = hits.iter().filter(|hit| hit.scratch as usize == i);
            let coverage = own.next().map_or(0.0, |hit| f64::from(hit.coverage));
            assert!(
                (coverage - share).abs() < 0.01,
                "scratch {i}: {coverage}, by points {share}"
            );
            assert!(own.next().is_none(), "scratch {i} twice: {hits:?}");
        }
    }
}

/// Seen from above, a pixel shows of scratches what they cover of it.
#[test]
fn coverage_is_what_shading_shows_from_above() {
    let mm = |x: f64, y: f64| [0.5 + x / SHEET_MM, 0.5 + y / SHEET_MM];
    let lines = [
        (mm(-9.0, -1.0), mm(9.0, 1.5)),
        (mm(-9.0, 2.0), mm(9.0, -2.5)),
        (mm(0.3, -9.0), mm(-0.4, 9.0)),
    ];
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &lines, 2.0);
    let (mut random, mut shading) = (random(72), Shading::default());
    let mut worst = 0.0_f32;
    for _ in 0..300 {
        let place = DVec2::new(
            random.random_range(-2.0..2.0),
            random.random_range(-2.0..2.0),
        );
        let side = 10.0_f64.powf(random.random_range(-3.0..0.3));
        let turn = side * DVec2::from_angle(random.random_range(0.0..6.3));
        let point = pixel(
            DVec2::splat(0.5) + place / SHEET_MM,
            turn,
            0.8 * turn.perp(),
        );
        shading.shade(&pattern, &point, [0.0, 0.0, 1.0]).unwrap();
        let sum: f32 = hits(&pattern, &point).iter().map(|hit| hit.coverage).sum();
        worst = worst.max((sum - shading.coverage()).abs());
    }
    println!("worst difference {worst:.1e}");
    assert!(worst < 1e-4, "{worst}");
}

/// The one of so many parallel scratches, 0.9 mm apart, whose forces grow.
fn parallel(count: u32) -> Pattern {
    let mut builder = sheet_of(&dark_sheet());
    let tool = Tool::rockwell_c();
    for i in 0..count {
        let v = 0.5 + 0.0009 * f64::from(i) - 0.00045 * f64::from(count);
        let scratch = Scratch {
            path: Path::Polyline(&[[0.4, v], [0.6, v]]),
            keys: &[Key::force(
                0.0,
                1.0 + f64::from(i * 37 % count) / f64::from(count),
            )],
            ..Scratch::new(&tool)
        };
        builder.add(&scratch).unwrap();
    }
    builder.build()
}

/// However short the caller's array, the count is that of all, and the largest ones are written in their order; what
/// is beyond the last one stays as it was.
#[test]
fn capacities() {
    let (pattern, point) = (
        parallel(150),
        pixel(DVec2::splat(0.5), 180.0 * DVec2::X, 180.0 * DVec2::Y),
    );
    let all = hits(&pattern, &point);
    assert_eq!(all.len(), 150, "scratches");
    assert!(
        all.windows(2)
            .all(|pair| pair[0].coverage >= pair[1].coverage),
        "order"
    );
    let mut numbers: Vec<u32> = all.iter().map(|hit| hit.scratch).collect();
    numbers.sort_unstable();
    assert!(numbers.into_iter().eq(0..150), "each once");
    for hit in &all {
        let force = 1.0 + f64::from(hit.scratch * 37 % 150) / 150.0;
        let section = form(
            &Tool::rockwell_c(),
            DepthLaw::default(),
            force,
            support::process::UPRIGHT,
        );
        let points = section.vertices();
        let share = (points[points.len() - 1].x - points[0].x) / 180.0;
        assert!(
            (f64::from(hit.coverage) / share - 1.0).abs() < 0.02,
            "{hit:?}: {share}"
        );
    }
    for capacity in [0, 1, 2, 149, 150, 200] {
        let mut written = vec![NONE; capacity];
        let found = pattern.hits(&point, &mut written).unwrap();
        let expected = Found {
            written: capacity.min(150),
            count: 150,
            complete: true,
        };
        assert_eq!(found, expected, "capacity {capacity}");
        assert_eq!(
            written[..found.written],
            all[..found.written],
            "capacity {capacity}"
        );
        assert!(
            written[found.written..].iter().all(|hit| *hit == NONE),
            "the rest"
        );
    }
}

/// A footprint over more scratches than can be told apart says so.
#[test]
fn too_many_to_tell_apart() {
    let (pattern, mut hits) = (parallel(4000), [NONE; 8]);
    let point = pixel(DVec2::splat(0.5), 5000.0 * DVec2::X, 5000.0 * DVec2::Y);
    let found = pattern.hits(&point, &mut hits).unwrap();
    assert!(!found.complete && found.count < 4000, "{found:?}");
    assert!(
        hits[found.written..].iter().all(|hit| *hit == NONE),
        "{found:?}"
    );
}

/// Nothing is found beside a scratch, beyond its ends, or on a bare sheet.
#[test]
fn nothing_there() {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    let pattern = straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0);
    for uv in [[0.5, 0.502], [0.81, 0.5], [0.19, 0.5], [7.0, -3.0]] {
        assert!(hits(&pattern, &there(uv.into())).is_empty(), "{uv:?}");
    }
    let bare = sheet_of(&dark_sheet()).build();
    assert!(
        hits(&bare, &there(DVec2::splat(0.5))).is_empty(),
        "a bare sheet"
    );
}

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
