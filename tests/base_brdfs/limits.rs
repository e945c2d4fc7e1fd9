//! Where one base BRDF becomes another, or something known.

use super::grid::Seen;
use super::{
    anisotropic, any_direction, cook_torrance, facet, ggx, lambert, oren_nayar, phong, single,
    tilted,
};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::f64::consts::PI;
use striae::brdf::{Brdf, Fresnel, Metal};

/// How far two base BRDFs are apart over random pairs, as a share; densities too.
fn apart(a: Brdf, b: Brdf) -> f64 {
    let mut random = StdRng::seed_from_u64(41);
    let mut worst = 0.0_f64;
    for _ in 0..2000 {
        let tilt_deg = random.random_range(-80.0..80.0);
        let [a, b] = [a, b].map(|brdf| facet(brdf, tilt_deg));
        let pair = [any_direction(&mut random), any_direction(&mut random)];
        let [view, light] = pair.map(|w| single(tilted(tilt_deg, w)));
        let values = [
            [a, b].map(|facet| facet.eval(view, light)[0]),
            [a, b].map(|facet| facet.pdf(view, light)),
        ];
        for [a, b] in values.map(|pair| pair.map(f64::from)) {
            worst = worst.max((a - b).abs() / a.max(b).max(1e-6));
        }
    }
    worst
}

/// Without roughness, Oren-Nayar is Lambert.
#[test]
fn smooth_oren_nayar_is_lambert() {
    let apart = apart(oren_nayar(0.0), lambert());
    assert!(apart < 1e-6, "{apart}");
}

/// As wide along as across, polishing lines are none.
#[test]
fn even_anisotropy_is_none() {
    for alpha in [0.01, 0.2, 1.0] {
        let apart = apart(anisotropic(alpha, alpha), ggx(alpha));
        assert!(apart < 1e-4, "alpha {alpha}: {apart}");
    }
}

/// Polishing lines turned by a right angle are the same lines with their widths swapped.
#[test]
fn lines_turn() {
    let mut random = StdRng::seed_from_u64(42);
    let [a, b] = [(0.1, 0.6), (0.6, 0.1)].map(|(x, y)| facet(anisotropic(x, y), 0.0));
    for _ in 0..1000 {
        let pair = [any_direction(&mut random), any_direction(&mut random)].map(single);
        let [[v, l], [vt, lt]] = [pair, pair.map(|[x, y, z]| [-y, x, z])];
        let (there, turned) = (a.eval(v, l)[0], b.eval(vt, lt)[0]);
        assert!(
            (there - turned).abs() <= 1e-5 * there,
            "{there} and {turned} at {pair:?}"
        );
    }
}

/// At normal incidence the visible normals are all normals: the density adds up to 1 just where Beckmann's and GGX's
/// distributions are normalised.
#[test]
fn distributions_are_normalised() {
    for brdf in [
        cook_torrance(0.1),
        cook_torrance(0.4),
        ggx(0.1),
        anisotropic(0.1, 0.3),
    ] {
        let seen = Seen::new(facet(brdf, 0.0), 0.0, [0.0, 0.0]);
        // Normals steeper than 45 degrees mirror below the facet.
        let below = match brdf {
            Brdf::CookTorrance { alpha, .. } => (-1.0 / f64::from(alpha).powi(2)).exp(),
            Brdf::Ggx { alpha, .. } => {
                let a2 = f64::from(alpha).powi(2);
                a2 / (1.0 + a2)
            }
            _ => {
                // The same, averaged over azimuths of slopes that are drawn from the distribution.
                let turns = 10_000;
                let share = |i: i32| {
                    let (sin, cos) = (2.0 * PI * f64::from(i) / f64::from(turns)).sin_cos();
                    let a2 = (0.1 * cos).powi(2) + (0.3 * sin).powi(2);
                    a2 / (1.0 + a2)
                };
                (0..turns).map(share).sum::<f64>() / f64::from(turns)
            }
        };
        let whole: f64 = seen.integrals().pdf.iter().sum();
        assert!(
            (whole + below - 1.0).abs() < 1e-3,
            "{brdf:?}: {whole} above, {below} below"
        );
    }
}

/// At normal incidence a metal's highlight is ((eta - 1)² + k²) / ((eta + 1)² + k²) of a white one's, whatever the
/// microfacets.
#[test]
fn fresnel_at_normal_incidence() {
    let up = [0.0, 0.0, 1.0];
    for metal in Metal::ALL {
        let (eta, k) = metal.eta_k();
        let fresnel = Fresnel::metal(metal);
        let pairs = [
            (
                Brdf::Ggx {
                    alpha: 0.2,
                    fresnel,
                },
                ggx(0.2),
            ),
            (
                Brdf::CookTorrance {
                    alpha: 0.2,
                    fresnel,
                },
                cook_torrance(0.2),
            ),
        ];
        for [found, white] in pairs.map(|(a, b)| [a, b].map(|b| facet(b, 0.0).eval(up, up))) {
            for i in 0..3 {
                let [eta, k] = [eta[i], k[i]].map(f64::from);
                let truth = ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
                let found = f64::from(found[i]) / f64::from(white[i]);
                assert!((found - truth).abs() < 1e-5, "{metal:?}: {found}, {truth}");
            }
        }
    }
}

/// A rough white surface reflects what Portsmouth, Kutz and Hill's closed form of the integral says.
#[test]
fn oren_nayar_reflects_the_closed_form() {
    for roughness in [0.3_f32, 1.0] {
        for degrees in [0.0_f64, 40.0, 75.0, 88.0] {
            let (theta, r) = (degrees.to_radians(), f64::from(roughness));
            let (sin, cos, tan) = (theta.sin(), theta.cos(), theta.tan());
            let g = sin * (theta - sin * cos) + 2.0 / 3.0 * (tan * (1.0 - sin.powi(3)) - sin);
            let truth = (1.0 + r * g / PI) / (1.0 + r * (0.5 - 2.0 / (3.0 * PI)));
            let seen = Seen::new(facet(oren_nayar(roughness), 20.0), 20.0, [degrees, 10.0]);
            let found = seen.integrals().albedo;
            assert!(
                (found - truth).abs() < 1e-3,
                "{r}, {degrees}: {found}, {truth}"
            );
        }
    }
}

/// Phong's white lobe reflects all light at normal incidence, and less at an angle.
#[test]
fn phong_reflects_all_at_normal_incidence() {
    for exponent in [1.0, 30.0, 2000.0] {
        let [normal, oblique] = [0.0, 60.0].map(|degrees| {
            let seen = Seen::new(facet(phong(exponent), 0.0), 0.0, [degrees, 0.0]);
            seen.integrals().albedo
        });
        assert!((normal - 1.0).abs() < 1e-3, "{exponent}: {normal}");
        assert!(oblique < 0.8, "{exponent}: {oblique}");
    }
}

/// Roughness stands for what is as rough: alike for all kinds, 1 for what is diffuse.
#[test]
fn roughness_is_an_alpha() {
    for (brdf, alpha) in [
        (lambert(), 1.0),
        (oren_nayar(0.3), 1.0),
        (ggx(0.2), 0.2),
        (cook_torrance(0.2), 0.2),
        (anisotropic(0.1, 0.4), 0.2),
        (phong(12.0), 0.2),
    ] {
        let found = facet(brdf, 0.0).roughness();
        assert!((found - alpha).abs() < 1e-6, "{brdf:?}: {found}");
    }
}
