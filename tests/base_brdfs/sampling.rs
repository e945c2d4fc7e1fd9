//! Samples are distributed as their density says, and the density is that of all of them.

use super::chi_square;
use super::grid::{ALL, Seen};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};

/// Samples of a test of their distribution.
const SAMPLES: u32 = 100_000;

/// Chance that any one of all tests fails though the samples are right. (With the seed they have, none does.)
const SIGNIFICANCE: f64 = 0.01;

/// How likely samples are to be as far from the density as these, or further.
fn p_value(seen: &Seen, pdf: &[f64], random: &mut StdRng) -> f64 {
    let mut counts = vec![0_u32; pdf.len()];
    let mut failed = 0_u32;
    for _ in 0..SAMPLES {
        match seen
            .facet
            .sample([random.random(), random.random()], seen.view)
        {
            Some(light) => counts[seen.cell(light)] += 1,
            None => failed += 1,
        }
    }
    let expected = |share: f64| share * f64::from(SAMPLES);
    let failing = 1.0 - pdf.iter().sum::<f64>();
    let cells: Vec<(f64, f64)> = counts
        .iter()
        .zip(pdf)
        .map(|(&count, &share)| (f64::from(count), expected(share)))
        .chain([(f64::from(failed), expected(failing).max(0.0))])
        .collect();
    chi_square::p_value(cells).unwrap_or(1.0)
}

/// Chi-square tests of samples against the density, Bonferroni's correction for their number.
#[test]
fn samples_follow_their_density() {
    let mut random = StdRng::seed_from_u64(11);
    let least = SIGNIFICANCE / ALL.len() as f64;
    let mut failed = Vec::new();
    for (name, seen, integrals) in &*ALL {
        let p = p_value(seen, &integrals.pdf, &mut random);
        if p < least {
            failed.push(format!("{name}: p = {p:.1e}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Samples, one in each cell of an even grid of u: the share that fails, the mean of what they count, and the most that one does.
fn mean_weight(seen: &Seen, random: &mut StdRng) -> (f64, f64, f64) {
    const SIDE: u32 = 400;
    let mut share = |i: u32| (i as f32 + random.random::<f32>()) / SIDE as f32;
    let (mut failed, mut sum, mut most) = (0.0, 0.0, 0.0_f64);
    for (i, j) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))) {
        let Some(light) = seen.facet.sample([share(i), share(j)], seen.view) else {
            failed += 1.0;
            continue;
        };
        let reflected = f64::from(seen.facet.eval(seen.view, light)[0]);
        let pdf = f64::from(seen.facet.pdf(seen.view, light));
        // A light that grazes the facet may fall below it once rounded.
        if pdf > 0.0 {
            sum += reflected / pdf;
            most = most.max(reflected / pdf);
        }
    }
    let all = f64::from(SIDE * SIDE);
    (failed / all, sum / all, most)
}

/// The density and the share of failing samples add up to 1; what samples count adds up to what is reflected; no
/// sample counts more than 2.2 times what a white surface could reflect.
#[test]
fn density_is_whole() {
    let mut random = StdRng::seed_from_u64(13);
    let (mut worst_pdf, mut worst_mean, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut failed = Vec::new();
    for (name, seen, integrals) in &*ALL {
        let (failing, mean, weight) = mean_weight(seen, &mut random);
        let pdf = (integrals.pdf.iter().sum::<f64>() + failing - 1.0).abs();
        let mean = (mean - integrals.albedo).abs();
        (worst_pdf, worst_mean) = (worst_pdf.max(pdf), worst_mean.max(mean));
        most = most.max(weight);
        if pdf > 1e-3 || mean > 1e-3 || weight > 2.2 {
            failed.push(format!("{name}: off by {pdf:.1e}, {mean:.1e}; {weight}"));
        }
    }
    println!(
        "density off by {worst_pdf:.1e}, mean by {worst_mean:.1e}; a sample counts {most} at most"
    );
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
