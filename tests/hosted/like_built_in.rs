//! Lambert's and GGX's over again, as a host's, are not told from the library's own.

use super::support::{any_direction, random};
use super::{both, pattern, point};
use rand::Rng;
use rand::rngs::StdRng;
use striae::brdf::Lobe;
use striae::pattern::Pattern;
use striae::scattering::{Bounces, Output, Sample, SeenZone, Shading};

/// What single precision may differ by, relative to the larger of both.
const ROUNDING: f32 = 2e-4;

/// The same where light has gone from zone to zone: a host's colour comes of two numbers that it gives.
const PASSED_ON: f32 = 1e-3;

/// Points of the same patterns, with the library's base BRDFs and with the host's.
fn prepared(random: &mut StdRng) -> Vec<[Shading; 2]> {
    let mut all = Vec::new();
    for crowd in [0, 300] {
        let patterns: [Pattern; 2] = both().map(|brdfs| pattern(brdfs, crowd));
        for i in 0..30 {
            let view = any_direction(random, 80.0);
            all.push(patterns.each_ref().map(|pattern| {
                let mut shading = Shading::default();
                shading.shade(pattern, &point(i), view).unwrap();
                shading
            }));
        }
    }
    all
}

#[track_caller]
fn assert_near(ours: f32, theirs: f32, what: &str) {
    assert_all_near([ours], [theirs], ROUNDING, what);
}

#[track_caller]
fn assert_all_near<const N: usize>(ours: [f32; N], theirs: [f32; N], most: f32, what: &str) {
    for (ours, theirs) in ours.into_iter().zip(theirs) {
        let off = (ours - theirs).abs() / ours.abs().max(theirs.abs()).max(1e-4);
        assert!(off < most, "{what}: {ours} and {theirs}, off by {off}");
    }
}

/// Evaluated, and the densities both ways, with one bounce and with all.
#[test]
fn values_and_densities() {
    let mut random = random(7);
    for [mut ours, mut theirs] in prepared(&mut random) {
        for (bounces, most) in [(Bounces::One, ROUNDING), (Bounces::All, PASSED_ON)] {
            ours.set_bounces(bounces);
            theirs.set_bounces(bounces);
            for _ in 0..20 {
                let light = any_direction(&mut random, 80.0);
                let [a, b] = [&ours, &theirs].map(|shading| shading.eval(light, Output::Brdf));
                assert_all_near(a, b, most, "BRDF");
                let [a, b] = [&ours, &theirs].map(|shading| shading.eval_pdf(light));
                assert_all_near(a.brdf_cos, b.brdf_cos, most, "BRDF times cosine");
                assert_near(a.pdf, b.pdf, "density");
                assert_near(
                    ours.pdf_reverse(light),
                    theirs.pdf_reverse(light),
                    "reverse",
                );
            }
        }
    }
}

/// Whether two samples are one but for rounding.
fn are_near(a: &Sample, b: &Sample) -> bool {
    let near = |a: f32, b: f32| (a - b).abs() <= 2e-3 * a.abs().max(b.abs()).max(1e-3);
    let lights = (0..3).all(|i| (a.light[i] - b.light[i]).abs() < 1e-4);
    let weights = (0..3).all(|i| near(a.weight[i], b.weight[i]));
    lights && weights && near(a.pdf, b.pdf) && a.lobe == b.lobe && a.scratch == b.scratch
}

/// The same numbers choose the same lights for the same price. Walks may part where rounding decides what is met next.
#[test]
fn samples() {
    let mut random = random(8);
    let (mut all, mut apart) = (0, [0; 2]);
    for [mut ours, mut theirs] in prepared(&mut random) {
        for bounces in [Bounces::One, Bounces::All] {
            ours.set_bounces(bounces);
            theirs.set_bounces(bounces);
            for _ in 0..200 {
                let u = [random.random(), random.random(), random.random()];
                let is_same = match [&ours, &theirs].map(|shading| shading.sample(u)) {
                    [Some(a), Some(b)] => are_near(&a, &b),
                    [None, None] => true,
                    _ => false,
                };
                all += 1;
                apart[usize::from(bounces == Bounces::All)] += u32::from(!is_same);
            }
        }
    }
    println!("{all} samples, apart: {apart:?}");
    assert!(apart[0] * 2000 < all && apart[1] * 200 < all, "{apart:?}");
}

/// Zones, the few numbers that stand for a point, and its lobes.
#[test]
fn looks() {
    let mut random = random(9);
    for [ours, theirs] in prepared(&mut random) {
        let light = any_direction(&mut random, 80.0);
        let [a, b] = [&ours, &theirs].map(|shading| {
            let mut zones = vec![SeenZone::default(); 3000];
            let count = shading.zones(light, &mut zones);
            zones.truncate(count);
            zones
        });
        assert_eq!(a, b, "zones");
        assert_eq!(ours.parameters(), theirs.parameters());
        assert_eq!(ours.roughness(), theirs.roughness());
        for lobe in [Lobe::Diffuse, Lobe::Glossy, Lobe::Sharp] {
            assert_eq!(ours.has_lobe(lobe), theirs.has_lobe(lobe), "{lobe:?}");
        }
        let [a, b] = [&ours, &theirs].map(Shading::albedo);
        for (a, b) in a.into_iter().zip(b) {
            assert!((a - b).abs() < 2e-3, "albedo {a} and {b}");
        }
    }
}
