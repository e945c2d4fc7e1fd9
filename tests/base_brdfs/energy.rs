//! Base BRDFs are BRDFs: reciprocal, and never brighter than their light.

use super::grid::ALL;
use super::{any_direction, facet, single, tilted, white};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

/// White reflects no more than it gets, from anywhere; and what a query estimates is near what it reflects.
#[test]
fn no_light_is_gained() {
    let mut failed = Vec::new();
    let (mut most, mut worst) = (0.0_f64, 0.0_f64);
    for (name, seen, integrals) in &*ALL {
        let albedo = integrals.albedo;
        let estimate = f64::from(seen.facet.reflectance(seen.view)[0]);
        most = most.max(albedo);
        worst = worst.max((estimate - albedo).abs());
        if albedo > 1.001 || (estimate - albedo).abs() > 0.04 {
            failed.push(format!(
                "{name}: {albedo:.4} reflected, {estimate:.4} estimated"
            ));
        }
    }
    println!("{most:.5} reflected at most; estimates within {worst:.3}");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Light and view swapped give the same BRDF.
#[test]
fn reciprocal() {
    let mut random = StdRng::seed_from_u64(12);
    let mut worst = 0.0_f64;
    for brdf in white() {
        for _ in 0..3000 {
            let tilt_deg = random.random_range(-80.0..80.0);
            let facet = facet(brdf, tilt_deg);
            let (l, v) = (any_direction(&mut random), any_direction(&mut random));
            // Near the highlight, so that sharp lobes are seen at all.
            let near = [0, 1, 2].map(|i| [-v[0], -v[1], v[2]][i] + 0.02 * l[i]);
            let l = if random.random() {
                l
            } else {
                super::unit(near)
            };
            let [light, view] = [l, v].map(|w| single(tilted(tilt_deg, w)));
            let there = f64::from(facet.eval(view, light)[0]) / l[2];
            let back = f64::from(facet.eval(light, view)[0]) / v[2];
            let deviation = (there - back).abs() / there.max(back).max(1e-4);
            worst = worst.max(deviation);
            assert!(
                deviation < 1e-4,
                "{brdf:?}, tilted {tilt_deg}: {there} there, {back} back from {v:?} to {l:?}"
            );
        }
    }
    println!("reciprocity: {worst:.1e}");
}
