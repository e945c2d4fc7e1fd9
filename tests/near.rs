//! What is told at a glance of a point: whether there is anything to shade.

mod support;

use glam::{DMat3, DQuat, DVec3, Vec3};
use rand::Rng;
use rand::rngs::StdRng;
use striae::formation::{CrossSection, Process, Tool};
use striae::pattern::{
    Footprint, Frame, Key, Path, Pattern, PatternBuilder, Scratch, SurfacePoint,
};
use striae::scattering::{Output, Shading};
use support::{SHEET_MM, any_direction, dark_sheet, random, sheet_of, single};

/// Curves and lines here and there on 100 by 80 mm, some of which taper.
fn strewn(random: &mut StdRng) -> Pattern {
    let mut builder = PatternBuilder::new(dark_sheet(), 10.0, [10.0, 8.0]).unwrap();
    for i in 0..150 {
        let mut place = || [random.random::<f64>(), random.random()];
        let start = place();
        let points = [(); 4].map(|()| {
            let place = place();
            [0, 1].map(|axis| start[axis] + 0.2 * (place[axis] - 0.5))
        });
        let keys = [Key::force(0.0, 1.0), Key::force(1.0, [0.0, 2.0][i % 2])];
        let tool = [Tool::vickers(), Tool::rockwell_c()][i % 2].clone();
        let path = match i % 3 {
            0 => Path::Polyline(&points[..2]),
            _ => Path::CubicBezier(&points),
        };
        builder
            .add(&Scratch {
                path,
                keys: &keys,
                ..Scratch::new(&tool)
            })
            .unwrap();
    }
    builder.build()
}

/// A surface that lies in space as it likes, whose texture is sheared a little, and a pixel of any size.
fn any_point(random: &mut StdRng) -> SurfacePoint {
    let angles = [(); 3].map(|()| random.random_range(-3.0..3.0));
    let turned = DMat3::from_quat(DQuat::from_scaled_axis(DVec3::from(angles)));
    let vector = |v: DVec3| (turned * v).to_array().map(single);
    let shear = random.random_range(-0.5..0.5);
    let size = 10_f32.powf(random.random_range(-5.0..-1.3));
    let mut edge = || [(); 2].map(|()| size * random.random_range(-1.0..1.0_f32));
    let (duv_dx, duv_dy) = (edge(), edge());
    let footprint = match random.random_range(0..4) {
        0 => Footprint::Point,
        1 => Footprint::Radius(5.0 * size),
        _ => Footprint::Differentials { duv_dx, duv_dy },
    };
    SurfacePoint {
        uv: [
            random.random_range(-0.1..1.1),
            random.random_range(-0.1..1.1),
        ],
        dp_du: vector(DVec3::new(10.0, shear, 0.0)),
        dp_dv: vector(DVec3::new(shear, -8.0, 0.0)),
        normal: vector(DVec3::Z * random.random_range(0.1..10.0)),
        footprint,
    }
}

/// Where it says that nothing is near a point, shading finds nothing, at any place, pose, size of footprint and view, and the
/// point is the unscratched surface to the bit; and it says so of most points that are unscratched.
#[test]
fn what_is_not_near_is_not_there() {
    let mut random = random(11);
    let pattern = strewn(&mut random);
    let bare = PatternBuilder::new(dark_sheet(), 10.0, [10.0, 8.0])
        .unwrap()
        .build();
    let (mut shading, mut unscratched) = (Shading::default(), Shading::default());
    let [mut far, mut scratched, mut missed] = [0; 3];
    for _ in 0..60_000 {
        let point = any_point(&mut random);
        let frame = Frame::at(&point).unwrap();
        let local = any_direction(&mut random, 89.9);
        let length = 10_f32.powf(random.random_range(-6.0..6.0));
        let view = frame.to_world(length * Vec3::from(local));
        let view_there = frame.to_local(view).to_array();
        shading.shade(&pattern, &point, view_there).unwrap();
        unscratched.shade(&bare, &point, view_there).unwrap();
        let is_near = pattern.is_near(&point, Some(view.to_array()));
        let light = any_direction(&mut random, 89.0);
        let is_bare = shading.scratch_count() == 0
            && shading.coverage() == 0.0
            && shading.eval(light, Output::BrdfCos) == unscratched.eval(light, Output::BrdfCos);
        assert!(
            is_near || is_bare,
            "not near, but there: {point:?} from {view}"
        );
        assert!(
            !is_near || pattern.is_near(&point, None),
            "near from {view}, but not from anywhere: {point:?}"
        );
        far += u32::from(!is_near);
        scratched += u32::from(!is_bare);
        missed += u32::from(is_near && is_bare);
    }
    assert!(scratched > 4_000, "only {scratched} points are scratched");
    // The rest lies within reach of shadows and of what a grazing view sees.
    assert!(far > 4 * missed, "{far} are told, {missed} are not");
    assert!(
        !bare.is_near(&any_point(&mut random), None),
        "nothing is near where there is no scratch"
    );
}

/// Views and points that are none, or from below, or of lengths that single precision cannot square, count as near what a
/// grazing view is near.
#[test]
fn odd_views_are_near_what_any_is() {
    let mut random = random(12);
    let pattern = strewn(&mut random);
    let nan = f32::NAN;
    for _ in 0..2000 {
        let point = any_point(&mut random);
        let any = pattern.is_near(&point, None);
        let below = Vec3::from(point.normal) * -1.0;
        for view in [[0.0; 3], [nan, 0.0, 1.0], [1e30; 3], below.to_array()] {
            assert_eq!(pattern.is_near(&point, Some(view)), any, "{view:?}");
        }
        let bent = SurfacePoint {
            dp_dv: point.dp_du,
            ..point
        };
        assert!(pattern.is_near(&bent, None), "a point that is none");
    }
}

/// A crest's shadow reaches as far as it is high and the light is low, and so does what a grazing view sees of it: up to there
/// the sheet beside a scratch is dark, or the bright scratch stands before it, and behind it is as if there were none. What
/// looks for scratches near a pixel must not end sooner.
#[test]
fn shadows_and_grazing_views_reach_as_far_as_crests_are_high() {
    let (tool, sheet) = (Tool::rockwell_c(), dark_sheet());
    let process = Process {
        force_kgf: 2.0,
        ..Process::default()
    };
    let profile = CrossSection::form(&tool, &process, &sheet).unwrap();
    let mut builder = sheet_of(&sheet);
    builder
        .add(&Scratch {
            path: Path::Polyline(&[[0.2, 0.5], [0.8, 0.5]]),
            keys: &[Key::force(0.0, process.force_kgf)],
            ..Scratch::new(&tool)
        })
        .unwrap();
    let (pattern, bare) = (builder.build(), sheet_of(&sheet).build());
    let vertices = profile.vertices();
    let highest = vertices.iter().map(|vertex| vertex.y).fold(0.0, f64::max);
    let widest = vertices.iter().map(|vertex| vertex.x).fold(0.0, f64::max);
    let above = [0.0, 0.0, 1.0];
    let mut shading = Shading::default();
    for slope in [9.0, 14.0, 19.5] {
        let grazing = [0.0, -slope, 1.0].map(|x| single(x / f64::hypot(slope, 1.0)));
        let reaches = vertices.iter().map(|vertex| vertex.x + slope * vertex.y);
        let reach = reaches.fold(0.0, f64::max);
        for share in [0.4, 0.7, 0.9, 0.98, 1.02, 1.1, 1.5] {
            let across_mm = widest + share * (reach - widest);
            let point = SurfacePoint {
                uv: [0.5, 0.5 + across_mm / SHEET_MM],
                dp_du: [single(SHEET_MM), 0.0, 0.0],
                dp_dv: [0.0, single(SHEET_MM), 0.0],
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Radius(single(1e-3 * highest)),
            };
            let mut seen = |pattern: &Pattern, view, light| {
                shading.shade(pattern, &point, view).unwrap();
                shading.eval(light, Output::BrdfCos)[0]
            };
            let lit = seen(&pattern, above, grazing) / seen(&bare, above, grazing);
            let shown = seen(&pattern, grazing, above) / seen(&bare, grazing, above);
            let at = format!("at {share} of the reach of slope {slope}");
            if share < 1.0 {
                assert!(lit < 0.01, "{lit} of the light {at}");
                assert!(shown > 50.0, "{shown} times as bright {at}");
                assert!(pattern.is_near(&point, Some(grazing)), "not near {at}");
            } else {
                assert_eq!((lit, shown), (1.0, 1.0), "{at}");
            }
        }
    }
}
