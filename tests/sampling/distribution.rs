//! Samples are distributed as their density says, the density is that of all of them, and each counts what it must.

use super::chi_square;
use super::each;
use super::integrals::{CELLS, cell, cells};
use super::scenes::{ALL, Prepared};
use super::support::{random, relative};
use rand::Rng;
use rand::rngs::StdRng;
use std::sync::LazyLock;
use striae::scattering::Output;

/// Samples of a test of their distribution.
const SAMPLES: u32 = 20_000;

/// Chance that any one of all tests fails though the samples are right. (With the seeds they have, none does.)
const SIGNIFICANCE: f64 = 0.01;

/// Of each shading point, cell by cell: integrals of density and of BRDF times cosine.
pub(crate) static INTEGRALS: LazyLock<Vec<Vec<[f64; 2]>>> =
    LazyLock::new(|| each(&ALL, |_, prepared| cells(prepared)));

fn numbers(random: &mut StdRng) -> [f32; 3] {
    [random.random(), random.random(), random.random()]
}

/// How likely samples are to be as far from the density as these, or further.
fn p_value(prepared: &Prepared, integrals: &[[f64; 2]], random: &mut StdRng) -> f64 {
    let mut counts = vec![0_u32; CELLS[0] * CELLS[1]];
    let mut failed = 0_u32;
    for _ in 0..SAMPLES {
        match prepared.shading.sample(numbers(random)) {
            Some(sample) => counts[cell(sample.light)] += 1,
            None => failed += 1,
        }
    }
    let cells: Vec<(f64, f64)> = counts
        .iter()
        .zip(integrals)
        .map(|(&count, &[share, _])| (f64::from(count), share * f64::from(SAMPLES)))
        .chain([(f64::from(failed), 0.0)])
        .collect();
    chi_square::p_value(cells)
        .unwrap_or_else(|| panic!("{}: all samples in one cell", prepared.name))
}

/// Chi-square tests of samples against the density, with Šidák's correction for their number.
#[test]
fn samples_follow_their_density() {
    let least = 1.0 - (1.0 - SIGNIFICANCE).powf(1.0 / ALL.len() as f64);
    let values = each(&ALL, |i, prepared| {
        let mut random = random(1000 + i as u64);
        p_value(prepared, &INTEGRALS[i], &mut random)
    });
    let failed: Vec<_> = ALL
        .iter()
        .zip(&values)
        .filter(|(_, p)| **p < least)
        .map(|(prepared, p)| format!("{}: p = {p:.1e}", prepared.name))
        .collect();
    println!(
        "{} tests, the least p {:.1e}",
        ALL.len(),
        values.iter().copied().fold(1.0, f64::min)
    );
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// The density adds up to 1 above the surface, within 1e-3.
#[test]
fn density_is_whole() {
    let mut worst = 0.0_f64;
    let mut failed = Vec::new();
    for (prepared, integrals) in ALL.iter().zip(&*INTEGRALS) {
        let whole: f64 = integrals.iter().map(|[pdf, _]| pdf).sum();
        worst = worst.max((whole - 1.0).abs());
        if (whole - 1.0).abs() > 1e-3 {
            failed.push(format!("{}: {whole}", prepared.name));
        }
    }
    println!("density off by {worst:.1e}");
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// A sample counts BRDF times cosine over its density, as the other calls tell them, within 1e-4, and says so itself.
#[test]
fn samples_count_what_they_must() {
    let mut random = random(71);
    let (mut worst, mut most, mut all) = (0.0_f64, 0.0_f64, 0);
    for prepared in &*ALL {
        let shading = &prepared.shading;
        for sample in (0..200).filter_map(|_| shading.sample(numbers(&mut random))) {
            let f = shading.eval(sample.light, Output::BrdfCos);
            let pdf = shading.pdf(sample.light);
            assert_eq!(
                shading.eval_pdf(sample.light).brdf_cos,
                f,
                "{}",
                prepared.name
            );
            let told = relative(f64::from(sample.pdf), f64::from(pdf));
            worst = worst.max(told);
            for (f, weight) in f.into_iter().zip(sample.weight) {
                worst = worst.max((f64::from(f) / f64::from(pdf) - f64::from(weight)).abs());
                most = most.max(f64::from(weight));
            }
            let length: f32 = sample.light.iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-5, "{}", prepared.name);
            all += 1;
        }
    }
    println!("{all} samples: off by {worst:.1e}; one counts {most} at most");
    assert!(worst < 1e-4 && all > 10_000, "{all} samples: {worst}");
}

/// What samples count adds up to what is reflected, within what chance allows.
#[test]
fn samples_reflect_all() {
    let results = each(&ALL, |i, prepared| {
        let mut random = random(2000 + i as u64);
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..4000 {
            let sample = prepared.shading.sample(numbers(&mut random));
            let weight = sample.map_or(0.0, |sample| f64::from(sample.weight[0]));
            sum += weight;
            squares += weight * weight;
        }
        let mean = sum / 4000.0;
        let chance = ((squares / 4000.0 - mean * mean).max(0.0) / 4000.0).sqrt();
        let reflected: f64 = INTEGRALS[i].iter().map(|[_, f]| f).sum();
        (reflected, mean, chance)
    });
    for (prepared, (reflected, mean, chance)) in ALL.iter().zip(results) {
        assert!(
            (reflected - mean).abs() < 4.5 * chance + 1e-3,
            "{}: {reflected} reflected, {mean} ± {chance} sampled",
            prepared.name
        );
    }
}
