//! Pixels of single cross-sections against brute-force ray casting, at every size of footprint.

mod support;

use rand::Rng;
use rand::rngs::StdRng;
use striae::scattering::{CrossFootprint, Output};
use support::caster::{Caster, Filter, Finish, any_profile, cast, dot, shade, unit};
use support::{any_direction, random, single};

/// A light near the mirror direction of one facet, or of the flat.
fn near_highlight(random: &mut StdRng, points: &[[f32; 2]]) -> ([f32; 3], [f32; 3]) {
    loop {
        let v = any_direction(random, 85.0);
        let k = random.random_range(1..points.len());
        let (a, b) = (points[k - 1], points[k]);
        let (dx, dz) = (f64::from(b[0] - a[0]), f64::from(b[1] - a[1]));
        let n = [-dz / dx.hypot(dz), 0.0, dx / dx.hypot(dz)];
        let twice = 2.0 * dot(n, unit(v));
        let l: [f64; 3] = std::array::from_fn(|i| {
            twice * n[i] - unit(v)[i] + 1e-2 * random.random_range(-1.0..1.0)
        });
        let l = l.map(single);
        if unit(l)[2] > 0.0872 {
            return (l, v);
        }
    }
}

/// Single precision: each edge is placed to this share of the cross-section's own extent.
const PLACING: f64 = 1e-7;

/// Compares many random pixels with the caster; `finishes` chooses the zones' and the flat's, `rounding` is
/// what single precision may do to a base BRDF.
fn compare(name: &str, seed: u64, rounding: f64, finishes: impl Fn(&mut StdRng) -> [Finish; 2]) {
    let mut random = random(seed);
    let mut worst = (0.0, String::new());
    for case in 0..400 {
        let points = any_profile(&mut random);
        let width = f64::from(points[points.len() - 1][0] - points[0][0]);
        let [zone, flat] = finishes(&mut random);
        let (l, v) = match case % 10 {
            0 => ([0.0, 0.0, 1.0], any_direction(&mut random, 85.0)),
            1 => ([0.0, 0.6, 0.8], [0.0, -0.6, 0.8]),
            2..=5 => near_highlight(&mut random, &points),
            _ => (
                any_direction(&mut random, 85.0),
                any_direction(&mut random, 85.0),
            ),
        };
        let longer = width * 10_f64.powf(random.random_range(-3.0..3.0));
        let filter = Filter {
            center: (width + longer) * random.random_range(-0.5..0.5),
            extents: [longer * random.random_range(1e-3..1.0), longer],
        };
        let caster = Caster::new(&points, 1e5 * (width + longer), zone, flat);
        let truth = cast(&caster, filter, unit(l), unit(v));
        let pixel = CrossFootprint::Box {
            center_mm: filter.center,
            extents_mm: filter.extents,
        };
        let ours = shade(&points, [zone, flat], pixel, l, v, Output::BrdfCos);
        let allowed = rounding * truth.value + truth.missed + PLACING * truth.per_shift;
        let deviation = (ours - truth.value).abs() / allowed.max(1e-12);
        if deviation > worst.0 {
            let report = format!(
                "case {case}: {ours} against {} ± {allowed:e}, {points:?}, {zone:?}, {flat:?}, \
                 {filter:?}, light {l:?}, view {v:?}",
                truth.value
            );
            worst = (deviation, report);
        }
    }
    println!("{name}: worst {:.3} of what is allowed", worst.0);
    assert!(worst.0 <= 1.0, "{name}: {}", worst.1);
}

/// Geometry: shadowing, masking, parallax and the filter, at every size of footprint.
#[test]
fn lambert_pixels() {
    compare("Lambert", 1, 2e-6, |random| {
        [0, 1].map(|_| Finish::Lambert(random.random_range(0.1..1.0)))
    });
}

/// The same with base BRDFs that depend on every angle.
#[test]
fn ggx_pixels() {
    compare("GGX", 2, 2e-5, |random| {
        [0, 1].map(|_| {
            let alpha = 10_f32.powf(random.random_range(-2.5..0.0));
            Finish::Ggx(alpha, random.random_range(0.02..1.0))
        })
    });
}

/// Nothing of a polished sheet shows through a matt scratch that fills the pixel, however small the pixel.
#[test]
fn within_a_scratch_no_flat_shows() {
    let mut random = random(4);
    let mut brightest = 0.0_f64;
    for _ in 0..2000 {
        let v = any_direction(&mut random, 70.0);
        let l = [-v[0], -v[1], v[2]];
        let points = [[-0.05, 0.0], [0.001, -0.004], [0.05, 0.0]];
        let filter = Filter {
            center: random.random_range(-0.045..0.045),
            extents: [1e-8, 10_f64.powf(random.random_range(-7.0..-3.0))],
        };
        let pixel = CrossFootprint::Box {
            center_mm: filter.center,
            extents_mm: filter.extents,
        };
        let finishes = [Finish::Lambert(0.5), Finish::Ggx(1e-3, 1.0)];
        let ours = shade(&points, finishes, pixel, l, v, Output::BrdfCos);
        brightest = brightest.max(ours);
    }
    // Albedo / π is the most that the matt facets can reflect; the sheet's highlight is a million times that.
    let most = 0.5 / std::f64::consts::PI;
    assert!(
        brightest < 1.001 * most,
        "{brightest} from facets that reflect {most} at most"
    );
}

/// The caster notices what it should: a shadow, a mask, and the shift of relief under an oblique view.
#[test]
fn caster_notices_light_view_and_place() {
    let points = [
        [-0.5, 0.0],
        [-0.3, 0.2],
        [0.0, -0.4],
        [0.2, 0.1],
        [0.5, 0.0],
    ];
    let [zone, flat] = [Finish::Lambert(0.9), Finish::Lambert(0.2)];
    let caster = Caster::new(&points, 1e3, zone, flat);
    let filter = |center| Filter {
        center,
        extents: [0.01, 0.02],
    };
    let value = |center, l, v| cast(&caster, filter(center), unit(l), unit(v)).value;
    let above = [0.0, 0.0, 1.0];
    let (left, right) = ([-0.8, 0.0, 0.6], [0.8, 0.0, 0.6]);
    // The right wall of the groove, its normal in the plane: albedo / π n·l.
    let n = [-5.0, 0.0, 2.0].map(|x: f64| x / 29.0_f64.sqrt());
    let wall = 0.9 / std::f64::consts::PI * dot(n, unit(left));
    for (what, value, expected) in [
        ("lit wall", value(0.12, [-0.3, 0.0, 0.954], above), {
            0.9 / std::f64::consts::PI * dot(n, unit([-0.3, 0.0, 0.954]))
        }),
        ("wall in its own shadow", value(0.1, right, above), 0.0),
        (
            "flat in the open",
            value(3.0, right, left),
            0.12 / std::f64::consts::PI,
        ),
    ] {
        assert!(
            (value - expected).abs() < 1e-6,
            "{what}: {value}, not {expected}"
        );
    }
    let shaded = value(-0.6, right, above);
    assert!(shaded < 0.2, "no shadow beside the peak: {shaded}");
    assert!(
        (value(0.0, left, left) - value(0.0, left, above)).abs() > 0.05 * wall,
        "the view has no effect"
    );
}
