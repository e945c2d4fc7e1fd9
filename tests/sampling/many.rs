//! Many lights at once, and SIMD registers: only faster.

use super::scenes::{ALL, Prepared};
use super::support::{any_direction, random};
use rand::Rng;
use std::sync::RwLock;
use striae::scattering::{Bounces, Output, Shading, Vectors, set_simd};

/// Held for writing while SIMD registers are switched, which they are for all threads: sums of flocks are rounded otherwise
/// with them than without, and what is compared bit by bit must not be caught in between.
static SWITCHED: RwLock<()> = RwLock::new(());

/// Lights of all kinds: above, below, of any length, and none.
fn lights(count: usize, seed: u64) -> Vec<[f32; 3]> {
    let mut random = random(seed);
    let mut lights: Vec<[f32; 3]> = (0..count - 4)
        .map(|_| any_direction(&mut random, 89.0).map(|x| x * 3.0))
        .collect();
    lights.push([0.1, 0.2, -0.9]);
    lights.push([0.0; 3]);
    lights.push([f32::NAN, 0.0, 1.0]);
    lights.push([1e-30, 0.0, 1e-30]);
    lights
}

/// What `eval_many` says of these lights, packed as x, y, z, x, y, z: reflected light and densities.
fn together(shading: &Shading, lights: &[[f32; 3]]) -> (Vec<[f32; 3]>, Vec<f32>) {
    let count = lights.len();
    let flat: &[f32] = lights.as_flattened();
    let interleaved = Vectors {
        x: flat,
        y: &flat[1..],
        z: &flat[2..],
        stride: 3,
    };
    let (mut f, mut pdfs) = (vec![[f32::NAN; 3]; count], vec![f32::NAN; count]);
    shading
        .eval_pdf_many(&interleaved, count, |i, one| {
            (f[i], pdfs[i]) = (one.brdf_cos, one.pdf);
        })
        .unwrap();
    let mut plain = f.clone();
    shading
        .eval_many(&interleaved, count, Output::BrdfCos, |i, rgb| {
            plain[i] = rgb;
        })
        .unwrap();
    assert_eq!(plain, f, "with densities and without");
    (f, pdfs)
}

/// Differences in what is reflected and in the densities, over what is larger: the value or 1.
fn apart(a: &(Vec<[f32; 3]>, Vec<f32>), b: &(Vec<[f32; 3]>, Vec<f32>)) -> f32 {
    let numbers = |(f, pdfs): &(Vec<[f32; 3]>, Vec<f32>)| [f.as_flattened(), pdfs].concat();
    let pairs = numbers(a).into_iter().zip(numbers(b));
    pairs
        .map(|(a, b)| (a - b).abs() / a.max(b).max(1.0))
        .map(|off| if off.is_nan() { f32::INFINITY } else { off })
        .fold(0.0, f32::max)
}

/// One by one.
fn alone(shading: &Shading, lights: &[[f32; 3]]) -> (Vec<[f32; 3]>, Vec<f32>) {
    let all = lights.iter().map(|light| shading.eval_pdf(*light));
    all.map(|one| (one.brdf_cos, one.pdf)).unzip()
}

fn worst(judge: impl Fn(usize, &Prepared) -> f32) -> f32 {
    let (mut worst, mut at) = (0.0, "");
    for (i, prepared) in ALL.iter().enumerate() {
        let off = judge(i, prepared);
        if off > worst {
            (worst, at) = (off, &prepared.name);
        }
    }
    println!("off by {worst:.1e} at most: {at}");
    worst
}

/// Lights together count as each alone does, with one bounce and with all, from both sides and from below.
#[test]
fn lights_together_are_as_each_alone() {
    let _switched = SWITCHED.read();
    let off = worst(|i, prepared| {
        let lights = lights(5 + i % 20, 90 + i as u64);
        let mut shading = prepared.shading;
        let one = apart(&together(&shading, &lights), &alone(&shading, &lights));
        shading.set_bounces(Bounces::All);
        let all = apart(&together(&shading, &lights), &alone(&shading, &lights));
        one.max(all)
    });
    assert!(off < 1e-5, "off by {off}");
}

/// Samples together are those drawn one by one.
#[test]
fn samples_together_are_as_each_alone() {
    let _switched = SWITCHED.read();
    let off = worst(|i, prepared| {
        let mut random = random(190 + i as u64);
        let us: Vec<[f32; 3]> = (0..19).map(|_| random.random()).collect();
        let flat = us.as_flattened();
        let interleaved = Vectors {
            x: flat,
            y: &flat[1..],
            z: &flat[2..],
            stride: 3,
        };
        let mut off = 0.0_f32;
        let mut told = 0;
        let tell = |k: usize, sample: Option<striae::scattering::Sample>| {
            assert_eq!(k, told, "in order");
            told += 1;
            let own = prepared.shading.sample(us[k]);
            let (Some(ours), Some(own)) = (sample, own) else {
                assert_eq!(sample.is_some(), own.is_some(), "{}", prepared.name);
                return;
            };
            assert_eq!(ours.light, own.light, "{}", prepared.name);
            assert_eq!((ours.lobe, ours.scratch), (own.lobe, own.scratch));
            let pair =
                |sample: &striae::scattering::Sample| (vec![sample.weight], vec![sample.pdf]);
            off = off.max(apart(&pair(&ours), &pair(&own)));
        };
        prepared
            .shading
            .sample_many(&interleaved, us.len(), tell)
            .unwrap();
        assert_eq!(told, us.len(), "each is told");
        off
    });
    assert!(off < 1e-5, "off by {off}");
}

/// Without SIMD instructions, which not all processors have, all is the same.
#[test]
fn simd_only_makes_it_faster() {
    let _switched = SWITCHED.write();
    let off = worst(|i, prepared| {
        let lights = lights(24, 290 + i as u64);
        let mut judged = [(); 2].map(|()| (Vec::new(), Vec::new()));
        let mut coverage = [0.0; 2];
        for (k, allowed) in [true, false].into_iter().enumerate() {
            set_simd(allowed);
            let mut shading = prepared.shading;
            if let Some((number, point)) = &prepared.place {
                let pattern = &super::scenes::PATTERNS[*number].1;
                shading.shade(pattern, point, prepared.view).unwrap();
            }
            coverage[k] = shading.coverage();
            judged[k] = alone(&shading, &lights);
            let many = together(&shading, &lights);
            judged[k].0.extend(many.0);
            judged[k].1.extend(many.1);
        }
        set_simd(true);
        apart(&judged[0], &judged[1]).max((coverage[0] - coverage[1]).abs())
    });
    assert!(off < 1e-5, "off by {off}");
}

/// An array that is too short is refused by name, and nothing is written.
#[test]
fn short_arrays_are_refused() {
    let shading = Shading::default();
    let long = [0.0; 8];
    let lights = Vectors {
        x: &long,
        y: &long,
        z: &long[..3],
        stride: 2,
    };
    let refused = shading.eval_many(&lights, 4, Output::BrdfCos, |i, _| panic!("{i} is told"));
    let text = refused.unwrap_err().to_string();
    assert!(text.contains("lights") && text.contains('2'), "{text}");
}
