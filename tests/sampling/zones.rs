//! Zones as hosts see them, and the few numbers that stand for all of them.

use super::distribution::INTEGRALS;
use super::scenes::{ALL, Prepared};
use super::support::{any_direction, direction, ggx, lambert, random, relative};
use striae::brdf::{Brdf, Facet, Fresnel, Lobe};
use striae::scattering::{CrossFootprint, Output, SeenZone, Shading};

/// What is left of 1 is known no better than this: 1 in single precision, rounded twice.
const OPEN_REST: f64 = 1.2e-7;

/// A host that adds up its own base BRDFs, zone by zone, gets what the library does, within 1e-5 and what single precision
/// leaves open where a zone is seen or lit at a grazing angle, and of the flat surface, which has what scratches leave of 1;
/// and all zones are chosen in all.
#[test]
fn add_up_to_the_whole() {
    let mut random = random(91);
    let mut worst = 0.0_f64;
    let mut zones = vec![SeenZone::default(); 3000];
    for prepared in &*ALL {
        for _ in 0..10 {
            let light = any_direction(&mut random, 85.0);
            let count = prepared.shading.zones(light, &mut zones);
            let zones = &zones[..count];
            let (mut sum, mut open) = (0.0, 0.0);
            for zone in zones {
                let part = told(prepared, zone, light);
                let cos = dot(zone.normal, light).min(dot(zone.normal, prepared.view));
                sum += part;
                open += part * 4e-7 / cos.max(4e-7);
            }
            let flat = &zones[count - 1];
            open += told(prepared, flat, light) * OPEN_REST / f64::from(flat.lit).max(OPEN_REST);
            let ours = f64::from(prepared.shading.eval(light, Output::BrdfCos)[0]);
            let seen: f64 = zones.iter().map(|zone| f64::from(zone.seen)).sum();
            let off = (sum - ours).abs();
            worst = worst.max(off / ours.max(1e-3));
            assert!(
                off < 1e-5 * ours.max(1e-3) + open,
                "{}: {sum} (± {open}), not {ours}",
                prepared.name
            );
            assert!((seen - 1.0).abs() < 1e-4, "{}: {seen} seen", prepared.name);
            assert_eq!(
                zones[count - 1].normal,
                [0.0, 0.0, 1.0],
                "{}",
                prepared.name
            );
        }
    }
    println!("zones added up: off by {worst:.1e}");
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|i| f64::from(a[i]) * f64::from(b[i])).sum()
}

/// What a zone counts by the base BRDF that it names.
fn told(prepared: &Prepared, zone: &SeenZone, light: [f32; 3]) -> f64 {
    let brdf = prepared.shading.zone_brdf(zone.brdf).unwrap();
    let along = zone.tangent;
    let across = [along[1], -along[0], 0.0];
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    let turned = |w| [dot(across, w) as f32, dot(along, w) as f32, w[2]];
    let lean = dot(zone.normal, across);
    let tilt_deg = lean.atan2(f64::from(zone.normal[2])).to_degrees();
    let facet = Facet::new(brdf, tilt_deg).unwrap();
    f64::from(zone.lit) * f64::from(facet.eval(turned(prepared.view), turned(light))[0])
}

/// More zones than there is room for are counted, and those that fit are the first.
#[test]
fn little_room() {
    for prepared in ALL.iter().step_by(7) {
        let light = direction(30.0, 40.0);
        let mut all = vec![SeenZone::default(); 3000];
        let count = prepared.shading.zones(light, &mut all);
        let mut few = [SeenZone::default(); 2];
        assert_eq!(prepared.shading.zones(light, &mut few), count);
        assert_eq!(few[..count.min(2)], all[..count.min(2)]);
        assert_eq!(prepared.shading.zones(light, &mut []), count);
        assert!(
            prepared.shading.zone_brdf(99).is_none(),
            "too many finishes"
        );
    }
}

/// Walls of slope `slope` that fill the pixel, in this finish, along the local frame's y.
fn walls(slopes: [f32; 2], brdf: Brdf, view: [f32; 3]) -> Shading {
    let deep = 0.1;
    let groove = [
        [-deep / slopes[0], 0.0],
        [0.0, -deep],
        [deep / slopes[1], 0.0],
    ];
    let pixel = CrossFootprint::Box {
        center_mm: f64::from(0.5 * (groove[0][0] + groove[2][0])),
        extents_mm: [f64::from(groove[2][0] - groove[0][0]), 0.0],
    };
    let mut shading = Shading::default();
    shading
        .shade_cross_section(&groove, &brdf, &lambert(1.0), pixel, view)
        .unwrap();
    shading
}

/// Two walls of slope 0.3 either way, of GGX with alpha 0.1, have slopes that deviate by 0.3² + 0.1²/2 across them, and
/// by 0.1²/2 along; seen from above they do not lean. Steeper to one side, they lean as far as the mean of both, each by
/// its width, says.
#[test]
fn parameters_of_two_walls() {
    let near = |ours: f32, truth: f32| assert!((ours - truth).abs() < 1e-4, "{ours}, not {truth}");
    let told = walls([0.3, 0.3], ggx(0.1, 0.9), [0.0, 0.0, 1.0]).parameters();
    let across = (2.0_f32 * (0.3 * 0.3 + 0.005)).sqrt();
    near(told.coverage, 1.0);
    near(told.tangent_deg, 90.0);
    near(told.alpha_along, 0.1);
    near(told.alpha_across, across);
    near(told.roughness, (0.1 * across).sqrt());
    near(told.anisotropy, 1.0 - 0.1 / across);
    near(told.normal[0], 0.0);
    near(told.normal[2], 1.0);

    let told = walls([0.2, 0.4], ggx(0.1, 0.9), [0.0, 0.0, 1.0]).parameters();
    // Normals lean towards the middle: the left wall's to the right.
    let mean = 2.0 / 3.0 * 0.2 - 1.0 / 3.0 * 0.4;
    near(told.normal[0], mean);
    let squares = 2.0 / 3.0 * 0.2 * 0.2 + 1.0 / 3.0 * 0.4 * 0.4 + 0.005;
    near(told.alpha_across, (2.0_f32 * squares).sqrt());
}

/// Without scratches the parameters are the surface's own: polishing lines along x, or none that stand out.
#[test]
fn parameters_of_a_surface() {
    let fresnel = Fresnel::Schlick { f0: [0.9; 3] };
    let lines = |alpha_across, alpha_along| Brdf::AnisotropicGgx {
        alpha_across,
        alpha_along,
        fresnel,
    };
    for (brdf, truth) in [
        (lines(0.4, 0.1), [0.0, 0.0, 0.1, 0.4]),
        (lines(0.1, 0.4), [0.0, 90.0, 0.1, 0.4]),
        (ggx(0.25, 0.9), [0.0, 0.0, 0.25, 0.25]),
        (lambert(0.5), [0.0, 0.0, 1.0, 1.0]),
    ] {
        let far = CrossFootprint::Box {
            center_mm: 50.0,
            extents_mm: [0.1, 0.0],
        };
        let mut shading = Shading::default();
        let groove = [[-0.1, 0.0], [0.0, -0.02], [0.1, 0.0]];
        shading
            .shade_cross_section(&groove, &ggx(0.01, 0.9), &brdf, far, direction(40.0, 10.0))
            .unwrap();
        let told = shading.parameters();
        let ours = [
            told.coverage,
            told.tangent_deg,
            told.alpha_along,
            told.alpha_across,
        ];
        for (ours, truth) in ours.into_iter().zip(truth) {
            assert!((ours - truth).abs() < 1e-4, "{brdf:?}: {told:?}");
        }
        let rough = (truth[2] * truth[3]).sqrt();
        assert!((shading.roughness() - rough).abs() < 1e-4, "{brdf:?}");
    }
}

/// The estimate of what all points reflect of an even light is within 0.05 of the integral.
#[test]
fn albedo_is_near() {
    let mut worst = 0.0_f64;
    for (prepared, integrals) in ALL.iter().zip(&*INTEGRALS) {
        let truth: f64 = integrals.iter().map(|[_, f]| f).sum();
        let ours = f64::from(prepared.shading.albedo()[0]);
        worst = worst.max((ours - truth).abs());
        assert!(
            (ours - truth).abs() < 0.05,
            "{}: {ours}, not {truth}",
            prepared.name
        );
    }
    println!("albedo off by {worst:.3}");
}

/// Lobes are told before one is chosen: those that samples have, and no others.
#[test]
fn lobes_are_those_of_samples() {
    let sharp = ggx(0.01, 0.9);
    for (brdf, kinds) in [
        (sharp, [Lobe::Sharp, Lobe::Diffuse]),
        (ggx(0.1, 0.9), [Lobe::Glossy, Lobe::Diffuse]),
        (lambert(0.5), [Lobe::Diffuse, Lobe::Diffuse]),
    ] {
        let pixel = CrossFootprint::Whole { margin_mm: 0.1 };
        let groove = [[-0.1, 0.0], [0.0, -0.02], [0.1, 0.0]];
        let mut shading = Shading::default();
        shading
            .shade_cross_section(&groove, &brdf, &lambert(0.5), pixel, [0.0, 0.0, 1.0])
            .unwrap();
        for kind in [Lobe::Diffuse, Lobe::Glossy, Lobe::Sharp] {
            assert_eq!(
                shading.has_lobe(kind),
                kinds.contains(&kind),
                "{brdf:?}, {kind:?}"
            );
        }
        for i in 0..100_u8 {
            let sample = shading.sample([f32::from(i) / 100.0, 0.3, 0.6]).unwrap();
            let own = kinds[usize::from(!sample.scratch)];
            assert_eq!(sample.lobe, own, "{sample:?}");
        }
        assert!(
            relative(f64::from(shading.coverage()), 0.5) < 1e-4,
            "half of it"
        );
    }
}
