//! Light from zone to zone, in pixels of whole patterns.

use super::each;
use super::scenes::{pattern, point};
use super::support::{any_direction, lambert, random};
use rand::Rng;
use rand::rngs::StdRng;
use striae::scattering::{Bounces, Shading};

/// What the header says is enough.
const STACK_BYTES: usize = 256 << 10;

/// Points of patterns that scatter this much evenly everywhere, few scratches and a crowd.
fn prepared(albedo: f32) -> Vec<Shading> {
    let brdf = lambert(albedo);
    let mut random = random(62);
    let mut all = Vec::new();
    for crowd in [0, 300] {
        let pattern = pattern([brdf; 2], brdf, crowd);
        for kind in 0..5 {
            let view = any_direction(&mut random, 80.0);
            let mut shading = Shading::default();
            shading
                .shade(&pattern, &point(&mut random, kind), view)
                .unwrap();
            shading.set_bounces(Bounces::All);
            all.push(shading);
        }
    }
    all
}

/// The mean of `count` trials, and how far chance may move it.
fn mean(count: u32, mut trial: impl FnMut() -> f64) -> [f64; 2] {
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..count {
        let value = trial();
        sum += value;
        squares += value * value;
    }
    let mean = sum / f64::from(count);
    let variance = (squares / f64::from(count) - mean * mean).max(0.0);
    [mean, (variance / f64::from(count)).sqrt()]
}

fn walked(shading: &Shading, random: &mut StdRng) -> f64 {
    let u = [random.random(), random.random(), random.random()];
    let sample = shading.sample(u);
    sample.map_or(0.0, |sample| f64::from(sample.weight[0]))
}

/// All that white scratches in a white surface get leaves them again.
#[test]
fn white_patterns_stay_white() {
    let results = each(&prepared(1.0), |i, shading| {
        let mut random = random(3000 + i as u64);
        mean(5000, || walked(shading, &mut random))
    });
    println!("reflected: {results:.4?}");
    for [reflected, chance] in results {
        assert!(
            (reflected - 1.0).abs() < 4.5 * chance + 2e-3,
            "{reflected} ± {chance}"
        );
    }
}

/// What is walked adds up to what is evaluated, within 1 %, where zones scatter light evenly.
#[test]
fn walks_and_exchange_agree() {
    let results = each(&prepared(0.9), |i, shading| {
        let mut random = random(4000 + i as u64);
        let walked = mean(6000, || walked(shading, &mut random));
        // Lights by the first bounce's density.
        let mut single = *shading;
        single.set_bounces(Bounces::One);
        let told = mean(500, || {
            let u = [random.random(), random.random(), random.random()];
            let both = single
                .sample(u)
                .map(|sample| shading.eval_pdf(sample.light));
            both.map_or(0.0, |both| f64::from(both.brdf_cos[0] / both.pdf))
        });
        [walked, told]
    });
    println!("walked and told: {results:.4?}");
    for [walked, told] in results {
        let chance = walked[1].hypot(told[1]);
        assert!(
            (walked[0] - told[0]).abs() < 0.01 + 4.5 * chance,
            "{walked:?} walked, {told:?} told"
        );
    }
}

/// Evaluating all bounces is content with little stack.
#[test]
fn little_stack() {
    let all = prepared(0.9);
    let judge = move || {
        let light = [0.3, 0.2, 1.0];
        let told = all.iter().map(|shading| shading.eval_pdf(light).pdf);
        told.sum::<f32>()
    };
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
    let sum = thread.spawn(judge).unwrap().join().unwrap();
    assert!(sum > 0.0, "nothing told");
}
