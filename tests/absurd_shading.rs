//! Whatever is asked while shading, the answer is a sensible number.

mod support;

use rand::Rng;
use striae::brdf::{Brdf, Metal};
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, SurfacePoint};
use striae::scattering::{Bounces, CrossFootprint, Output, SeenZone, Shading};
use support::{dark_sheet, direction, ggx, lambert, random, straight};

/// Numbers that are no use as sizes, directions or places.
const ABSURD: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-45,
    -1e-40,
    f32::MIN_POSITIVE,
    1e-20,
    1e-6,
    1e6,
    1e20,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
];

fn assert_usable(shading: &Shading, lights: &[[f32; 3]], what: &str) {
    let mut followed = *shading;
    followed.set_bounces(Bounces::All);
    for &light in lights {
        assert_sampled(shading, light, what);
        assert_sampled(&followed, light, what);
    }
    assert_described(shading, what);
    for (&light, output) in lights
        .iter()
        .flat_map(|light| [Output::Brdf, Output::BrdfCos].map(|output| (light, output)))
    {
        let f = shading.eval(light, output);
        assert!(
            f.iter().all(|f| f.is_finite() && *f >= 0.0),
            "{f:?} for light {light:?}, {output:?}, {what}"
        );
    }
    let coverage = shading.coverage();
    assert!(
        (0.0..=1.0).contains(&coverage),
        "coverage {coverage}, {what}"
    );
}

fn assert_numbers(numbers: &[f32], what: &str) {
    let good = |number: &f32| number.is_finite() && *number >= 0.0;
    assert!(numbers.iter().all(good), "{numbers:?}, {what}");
}

/// Chosen lights and densities; three numbers serve as a light and as random ones.
fn assert_sampled(shading: &Shading, numbers: [f32; 3], what: &str) {
    let both = shading.eval_pdf(numbers);
    assert_numbers(&both.brdf_cos, what);
    assert_numbers(&[both.pdf, shading.pdf_reverse(numbers)], what);
    if let Some(sample) = shading.sample(numbers) {
        assert_numbers(&sample.weight, what);
        assert!(sample.pdf > 0.0 && sample.pdf.is_finite(), "{what}");
        let length: f32 = sample.light.iter().map(|x| x * x).sum();
        assert!((length - 1.0).abs() < 1e-5, "{:?}, {what}", sample.light);
    }
    let mut zones = [SeenZone::default(); 8];
    shading.zones(numbers, &mut zones);
    for zone in zones {
        assert_numbers(&[zone.seen, zone.lit, zone.normal[2]], what);
    }
}

fn assert_described(shading: &Shading, what: &str) {
    let told = shading.parameters();
    assert_numbers(&[shading.roughness(), told.tangent_deg], what);
    assert_numbers(
        &[told.alpha_along, told.alpha_across, told.anisotropy],
        what,
    );
    assert!(
        told.tangent_deg < 180.0 && told.normal[2] > 0.0,
        "{told:?}, {what}"
    );
    assert!(
        told.alpha_across <= 1.0 && told.anisotropy <= 1.0,
        "{told:?}, {what}"
    );
}

/// Whatever is asked of a pattern, the answer is a number of zero or more.
#[test]
fn absurd_shading_points_evaluate() {
    let mut random = random(24);
    let mut lights = vec![
        [0.0, 0.0, 1.0],
        direction(89.9999, 20.0),
        direction(91.0, 20.0),
    ];
    let materials = [
        Material::metal(Metal::Titanium),
        Material {
            surface: ggx(0.001, 1.0),
            scratched: Brdf::metal(Metal::Aluminium, 0.001),
            ..dark_sheet()
        },
    ];
    for material in materials {
        let lines = [([0.2, 0.5], [0.8, 0.5]), ([0.5, 0.2], [0.5, 0.8])];
        let pattern = straight(&material, &Tool::nail(), &lines, 2.0);
        let (mut refused, mut scratched) = (0, 0);
        for _ in 0..30_000 {
            let mut number = |sane: f32| {
                if random.random_ratio(1, 8) {
                    ABSURD[random.random_range(0..ABSURD.len())]
                } else {
                    sane * random.random_range(-1.0..1.0)
                }
            };
            let mut vector = |sane| [number(sane), number(sane), number(sane)];
            let (dp_du, dp_dv, normal, view) = (vector(1e3), vector(1e3), vector(1.0), vector(1.0));
            lights.truncate(3);
            lights.push(vector(1.0));
            lights.push([-view[0], -view[1], view[2]]);
            let (a, b) = (vector(1e-3), vector(1e-3));
            let footprint = match random.random_range(0..3) {
                0 => Footprint::Point,
                1 => Footprint::Radius(a[0]),
                _ => Footprint::Differentials {
                    duv_dx: [a[0], a[1]],
                    duv_dy: [b[0], b[1]],
                },
            };
            let uv = if random.random_ratio(1, 20) {
                [f64::from(a[2]), f64::from(b[2])]
            } else {
                [0.5 + 1e-4 * random.random_range(-1.0..1.0), 0.5]
            };
            let point = SurfacePoint {
                uv,
                dp_du,
                dp_dv,
                normal,
                footprint,
            };
            let mut shading = Shading::default();
            let result = shading.shade(&pattern, &point, view);
            refused += u32::from(result.is_err());
            scratched += u32::from(shading.coverage() > 0.0);
            assert_usable(
                &shading,
                &lights,
                &format!("{point:?}, {view:?}: {result:?}"),
            );
        }
        println!("{refused} refused, {scratched} with scratches");
        assert!(
            refused > 1000 && scratched > 1000,
            "{refused} refused, {scratched} with scratches"
        );
    }
}

/// The same of single cross-sections: refused or not, what is left evaluates.
#[test]
fn absurd_cross_sections_evaluate() {
    let mut random = random(25);
    let mut taken = 0;
    for _ in 0..30_000 {
        let mut number = |sane: f32| {
            if random.random_ratio(1, 10) {
                ABSURD[random.random_range(0..ABSURD.len())]
            } else {
                sane * random.random_range(-1.0..1.0)
            }
        };
        let points = [
            [number(0.1) - 0.2, number(0.0)],
            [number(0.1), number(0.1)],
            [number(0.1) + 0.2, number(0.0)],
        ];
        let pixel = if number(1.0) > 0.0 {
            CrossFootprint::Whole {
                margin_mm: number(1.0),
            }
        } else {
            CrossFootprint::Box {
                center_mm: f64::from(number(0.3)),
                extents_mm: [f64::from(number(0.3)), f64::from(number(0.3))],
            }
        };
        let view = [number(1.0), number(1.0), number(1.0)];
        let lights = [[number(1.0), number(1.0), number(1.0)], [0.0, 0.0, 1.0]];
        let mut shading = Shading::default();
        let result =
            shading.shade_cross_section(&points, &lambert(0.5), &ggx(0.1, 0.5), pixel, view);
        taken += u32::from(result.is_ok());
        let what = format!("{points:?}, {pixel:?}, {view:?}: {result:?}");
        assert_usable(&shading, &lights, &what);
    }
    println!("{taken} taken");
    assert!((1000..29_000).contains(&taken), "{taken} taken");
}

/// Down to the horizon, and with the light straight ahead of the viewer, a pixel reflects what its base BRDFs
/// can: at most 1/π for white Lambert, D / 4 n·v for GGX. A whole pixel counts relief that stands beyond its
/// edges, as in the paper; there the answer is finite.
#[test]
fn grazing_stays_bounded() {
    let groove = [
        [-0.1, 0.0],
        [-0.05, 0.01],
        [0.0, -0.02],
        [0.05, 0.01],
        [0.1, 0.0],
    ];
    let alpha = 0.1;
    let most_ggx = 1.0 / (std::f32::consts::PI * alpha * alpha) / (2.0 * alpha);
    let boxed = CrossFootprint::Box {
        center_mm: 0.07,
        extents_mm: [0.1, 0.02],
    };
    let whole = CrossFootprint::Whole { margin_mm: 0.1 };
    let mut failed = Vec::new();
    for (brdf, pixel, most) in [
        (lambert(1.0), boxed, 0.32),
        (ggx(alpha, 1.0), boxed, most_ggx),
        (lambert(1.0), whole, f32::MAX),
        (ggx(alpha, 1.0), whole, f32::MAX),
    ] {
        for z in [
            1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-10, 1e-15, 1e-20, 1e-30, 1e-38, 1e-42,
        ] {
            let mut shading = Shading::default();
            shading
                .shade_cross_section(&groove, &brdf, &brdf, pixel, [1.0, 0.0, z])
                .unwrap();
            for light in [
                [-1.0, 0.0, z],
                [1.0, 0.0, z],
                [0.0, 1.0, z],
                [0.0, 0.0, 1.0],
            ] {
                let f = shading.eval(light, Output::BrdfCos)[0];
                if !(0.0..=most).contains(&f) {
                    failed.push(format!("z {z:e}, {light:?}, {pixel:?}: {f} above {most}"));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{} failed: {failed:#?}", failed.len());
}
