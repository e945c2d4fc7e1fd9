//! A shading point that cannot be is refused by name, and what is left of it still evaluates.

mod support;

use striae::formation::Tool;
use striae::pattern::{Footprint, Frame, Pattern, SurfacePoint};
use striae::scattering::{CrossFootprint, Output, Shading};
use support::refusal::assert_named;
use support::{dark_sheet, direction, ggx, lambert, single, straight};

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;

const LIGHT: [f32; 3] = [0.3, 0.4, 0.866];
const VIEW: [f32; 3] = [0.0, 0.0, 1.0];

/// A point in the middle of a scratch.
const POINT: SurfacePoint = SurfacePoint {
    uv: [0.5, 0.5],
    dp_du: [1000.0, 0.0, 0.0],
    dp_dv: [0.0, 1000.0, 0.0],
    normal: [0.0, 0.0, 1.0],
    footprint: Footprint::Radius(0.01),
};

fn pattern() -> Pattern {
    let line = ([0.2, 0.5], [0.8, 0.5]);
    straight(&dark_sheet(), &Tool::rockwell_c(), &[line], 2.0)
}

/// What a point gives, and the refusal it gives it with, after a good point was shaded into the same memory.
fn shade(point: &SurfacePoint, view: [f32; 3]) -> (f32, Option<String>) {
    let pattern = pattern();
    let mut shading = Shading::default();
    shading.shade(&pattern, &POINT, VIEW).unwrap();
    let refusal = shading.shade(&pattern, point, view).err();
    for light in [LIGHT, VIEW, direction(89.9, 10.0), [0.0; 3], [NAN; 3]] {
        for output in [Output::Brdf, Output::BrdfCos] {
            let f = shading.eval(light, output);
            assert!(
                f.iter().all(|f| f.is_finite() && *f >= 0.0),
                "{f:?} for {point:?}, view {view:?}, light {light:?}"
            );
        }
    }
    let f = shading.eval(LIGHT, Output::BrdfCos)[0];
    (f, refusal.map(|error| error.to_string()))
}

fn refused(point: &SurfacePoint, view: [f32; 3], argument: &str) -> f32 {
    let (f, refusal) = shade(point, view);
    let message = refusal.unwrap_or_else(|| panic!("accepted: {point:?}, view {view:?}"));
    assert!(
        message.contains(argument) && message.contains("; accepted: "),
        "{argument} is answered with \"{message}\""
    );
    f
}

/// The unscratched sheet's radiance.
fn bare() -> f32 {
    let beside = SurfacePoint {
        uv: [0.5, 0.3],
        ..POINT
    };
    shade(&beside, VIEW).0
}

/// A view that is no direction reflects nothing, whatever was shaded before.
#[test]
fn views() {
    for view in [
        [0.0; 3],
        [NAN, 0.0, 1.0],
        [0.0, INF, 1.0],
        [0.0, 0.0, -INF],
        [-0.0; 3],
    ] {
        assert_eq!(refused(&POINT, view, "view"), 0.0, "{view:?}");
    }
    let below = shade(&POINT, [0.1, 0.2, -0.9]);
    assert_eq!(below, (0.0, None), "a view from below is no error");
    let (tiny, plain) = (shade(&POINT, [0.0, 0.0, 1e-40]), shade(&POINT, VIEW));
    assert_eq!(tiny, plain, "the length of a view does not matter");
    assert_eq!(shade(&POINT, [0.0, 0.0, 3e38]), plain, "nor a long one");
}

/// A point without a place or a frame is an unscratched one.
#[test]
fn places_and_frames() {
    let bare = bare();
    assert!(
        bare > 0.0 && shade(&POINT, VIEW).0 > 10.0 * bare,
        "the scratch does not show"
    );
    for x in [f64::NAN, f64::INFINITY, -f64::INFINITY] {
        for uv in [[x, 0.5], [0.5, x]] {
            assert_eq!(
                refused(&SurfacePoint { uv, ..POINT }, VIEW, "uv"),
                bare,
                "{uv:?}"
            );
        }
    }
    for normal in [[0.0; 3], [NAN, 0.0, 1.0], [0.0, 0.0, INF]] {
        let point = SurfacePoint { normal, ..POINT };
        assert_eq!(refused(&point, VIEW, "normal"), bare, "{normal:?}");
        assert!(Frame::at(&point).is_err(), "a frame at {normal:?}");
    }
    for bad in [
        [0.0; 3],
        [NAN, 0.0, 0.0],
        [INF, 0.0, 0.0],
        [0.0, 0.0, 1000.0],
    ] {
        for point in [
            SurfacePoint {
                dp_du: bad,
                ..POINT
            },
            SurfacePoint {
                dp_dv: bad,
                ..POINT
            },
        ] {
            assert_eq!(refused(&point, VIEW, "dp_d"), bare, "{point:?}");
        }
    }
    let folded = SurfacePoint {
        dp_dv: POINT.dp_du,
        ..POINT
    };
    assert_eq!(refused(&folded, VIEW, "dp_d"), bare, "dP/dv along dP/du");
}

/// A footprint of no usable size is a point: reported, and shaded as one.
#[test]
fn footprints() {
    let (point, error) = shade(
        &SurfacePoint {
            footprint: Footprint::Point,
            ..POINT
        },
        VIEW,
    );
    assert_eq!(error, None, "a point is no error");
    let radii = [0.0, -1.0, NAN, INF, -INF].map(Footprint::Radius);
    let edges = [[0.0, 0.0], [NAN, 0.0], [INF, 0.0], [-INF, 1.0]];
    let edges = edges.map(|duv_dx| Footprint::Differentials {
        duv_dx,
        duv_dy: [0.0, 1e-5],
    });
    let both = Footprint::Differentials {
        duv_dx: [0.0; 2],
        duv_dy: [0.0; 2],
    };
    for footprint in radii.into_iter().chain(edges).chain([both]) {
        let point_like = SurfacePoint { footprint, ..POINT };
        let (f, refusal) = shade(&point_like, VIEW);
        assert!(
            (f - point).abs() < 1e-3 * point,
            "{footprint:?} gives {f}, a point {point}"
        );
        // An edge of no length beside a good one is a footprint as thin as a line.
        let thin = matches!(footprint, Footprint::Differentials { duv_dx: [0.0, 0.0], duv_dy } if duv_dy != [0.0; 2]);
        assert!(refusal.is_some() || thin, "{footprint:?} is accepted");
    }
}

/// Cross-sections to shade: too few or too many points, points that are none, out of order or not from
/// surface to surface, and pixels of no size.
#[test]
fn cross_sections_to_shade() {
    const GOOD: [[f32; 2]; 3] = [[-0.1, 0.0], [0.0, -0.02], [0.1, 0.0]];
    const WHOLE: CrossFootprint = CrossFootprint::Whole { margin_mm: 0.1 };
    let boxed = |center_mm, a, b| CrossFootprint::Box {
        center_mm,
        extents_mm: [a, b],
    };
    let whole = |margin_mm| CrossFootprint::Whole { margin_mm };
    let call = |points: &[[f32; 2]], pixel| {
        let mut shading = Shading::default();
        let result =
            shading.shade_cross_section(points, &lambert(0.5), &ggx(0.1, 0.5), pixel, VIEW);
        let f = shading.eval(LIGHT, Output::Brdf)[0];
        assert!(
            f.is_finite() && f >= 0.0,
            "{f} for {points:?}, {pixel:?}: {result:?}"
        );
        result
    };
    for count in [0_u8, 1, 101, 200] {
        let points: Vec<[f32; 2]> = (0..count).map(|x| [f32::from(x), 0.0]).collect();
        assert_named(call(&points, WHOLE), "vertex_count", f64::from(count));
    }
    for good in [
        WHOLE,
        whole(0.0),
        boxed(0.3, 0.1, 0.0),
        boxed(-1e3, 1e-9, 1e3),
    ] {
        assert!(call(&GOOD, good).is_ok(), "{good:?} is refused");
    }
    let with = |i: usize, vertex: [f32; 2]| {
        let mut points = GOOD;
        points[i] = vertex;
        points
    };
    let mut accepted = Vec::new();
    for points in [
        with(1, [NAN, -0.02]),
        with(1, [0.0, NAN]),
        with(1, [0.0, INF]),
        with(2, [INF, 0.0]),
        with(0, [-INF, 0.0]),
        with(1, [0.2, -0.02]),
        with(1, [-0.2, -0.02]),
        with(0, [-0.1, 0.01]),
        with(2, [0.1, -0.01]),
    ] {
        if call(&points, WHOLE).is_ok() {
            accepted.push(format!("{points:?}"));
        }
    }
    for x in [NAN, INF, -INF, -0.05, -5.0] {
        let (margin, x) = (whole(x), f64::from(x));
        let center = if x.is_finite() { f64::NAN } else { x };
        for pixel in [
            margin,
            boxed(center, 0.1, 0.1),
            boxed(0.0, x, 0.1),
            boxed(0.0, 0.1, x),
        ] {
            if call(&GOOD, pixel).is_ok() {
                accepted.push(format!("{pixel:?}"));
            }
        }
    }
    for brdf in [
        lambert(1.5),
        lambert(single(-0.1)),
        ggx(0.0, 0.5),
        ggx(NAN, 0.5),
        ggx(0.1, 2.0),
    ] {
        for [zone, flat] in [[brdf, lambert(0.5)], [lambert(0.5), brdf]] {
            let mut shading = Shading::default();
            let result = shading.shade_cross_section(&GOOD, &zone, &flat, WHOLE, VIEW);
            assert!(result.is_err(), "{zone:?} and {flat:?} are accepted");
        }
    }
    assert!(accepted.is_empty(), "accepted: {accepted:#?}");
}
