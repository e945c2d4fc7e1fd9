//! Whatever the directions, base BRDFs answer with numbers.

use super::{facet, tilted, white};
use rand::rngs::StdRng;
use rand::seq::IndexedRandom;
use rand::{Rng, SeedableRng};

const ODD: [f32; 14] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    1e-3,
    -1e-7,
    1e-12,
    1e-20,
    1e-38,
    1e-45,
    f32::MAX,
    f32::INFINITY,
    f32::NAN,
    0.5,
];

/// Grazing, tiny, huge, opposite, equal and broken directions and numbers: finite, never below 0, no panic; and
/// nothing from below the facet.
#[test]
fn odd_directions() {
    let mut random = StdRng::seed_from_u64(51);
    let (mut lit, mut sampled) = (0, 0);
    for brdf in white() {
        for _ in 0..20_000 {
            let tilt_deg = *[0.0, 90.0, -90.0, 89.999_999, 33.0]
                .choose(&mut random)
                .unwrap();
            let facet = facet(brdf, tilt_deg);
            let mut odd = || *ODD.choose(&mut random).unwrap();
            let view = [odd(), odd(), odd()];
            let u = [odd(), odd()];
            let light = [odd(), odd(), odd()];
            let light = if random.random() {
                light
            } else {
                view.map(|x| -x)
            };
            let light = if random.random() { light } else { view };
            let value = facet.eval(view, light)[0];
            let pdf = facet.pdf(view, light);
            let reflectance = facet.reflectance(view)[0];
            for value in [value, pdf, reflectance] {
                assert!(
                    value.is_finite() && value >= 0.0,
                    "{brdf:?}, tilted {tilt_deg}: {value} from {view:?} to {light:?}"
                );
            }
            lit += u32::from(value > 0.0);
            if let Some(light) = facet.sample(u, view) {
                sampled += 1;
                let length: f32 = light.iter().map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 1e-5, "{brdf:?}: {light:?} sampled");
            }
            let below = tilted(-tilt_deg, view.map(f64::from))[2] < 0.0;
            if below && view.iter().all(|x| x.is_finite()) {
                assert!(
                    value == 0.0 && pdf == 0.0 && facet.sample([0.5; 2], view).is_none(),
                    "{brdf:?}, tilted {tilt_deg}: {value} from below, {view:?}"
                );
            }
        }
    }
    assert!(lit > 1000 && sampled > 1000, "{lit} lit, {sampled} sampled");
}

/// Values out of range are refused by name.
#[test]
fn ranges() {
    use super::{anisotropic, cook_torrance, ggx, oren_nayar, phong};
    use striae::brdf::{Brdf, Facet};
    let bright = [0.5, 1.5, 0.5];
    for (brdf, name) in [
        (oren_nayar(-0.1), "roughness"),
        (oren_nayar(1.1), "roughness"),
        (oren_nayar(f32::NAN), "roughness"),
        (phong(0.9), "exponent"),
        (phong(2e5), "exponent"),
        (phong(f32::INFINITY), "exponent"),
        (ggx(0.0009), "alpha"),
        (cook_torrance(1.1), "alpha"),
        (anisotropic(0.0, 0.1), "alpha_across"),
        (anisotropic(0.1, f32::NAN), "alpha_along"),
        (
            Brdf::OrenNayar {
                albedo: bright,
                roughness: 0.5,
            },
            "albedo",
        ),
        (
            Brdf::Phong {
                specular: bright,
                exponent: 5.0,
            },
            "specular",
        ),
    ] {
        let error = Facet::new(brdf, 0.0).unwrap_err();
        assert_eq!(error.argument(), name, "{brdf:?}");
    }
    assert_eq!(
        Facet::new(ggx(0.1), 91.0).unwrap_err().argument(),
        "tilt_deg"
    );
}
