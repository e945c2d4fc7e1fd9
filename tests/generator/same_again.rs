//! The same seed is the same scratches, in any order, on any thread, on every machine.

use super::statistics::correlation;
use super::*;
use std::time::Instant;
use striae::pattern::Key;

/// A generator in which every kind of random number is drawn.
fn thorough() -> Generator {
    Generator {
        amount: Amount::Count(1000),
        spin_spread_deg: 30.0,
        depth_mm: Distribution::Exponential {
            from: 0.0,
            to: 0.1,
            decay: 0.01,
        },
        ..Generator::style(Style::Swirls)
    }
}

/// All that a scratch is.
fn parts(stroke: &Stroke) -> (Vec<[f64; 2]>, Vec<Key>) {
    (stroke.points_uv().to_vec(), stroke.keys().to_vec())
}

/// Scratches do not depend on which were asked for before, nor on which thread asks.
#[test]
fn chunks_and_threads_agree() {
    let strokes = strokes(&thorough(), 9);
    let together = measured(&strokes, parts);
    let strokes = &strokes;
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..7_u32)
            .map(|first| {
                scope.spawn(move || {
                    let mut stroke = Stroke::default();
                    let mut made = Vec::new();
                    for number in (first..1000).step_by(7).collect::<Vec<_>>().iter().rev() {
                        strokes.stroke(*number, &mut stroke);
                        made.push((*number, parts(&stroke)));
                    }
                    made
                })
            })
            .collect();
        for thread in threads {
            for (number, parts) in thread.join().unwrap() {
                assert_eq!(together[number as usize], parts, "scratch {number}");
            }
        }
    });
}

/// More scratches of the same seed begin with the same ones.
#[test]
fn denser_patterns_hold_sparser_ones() {
    let mut generator = thorough();
    let few = measured(&strokes(&generator, 9), |stroke| {
        stroke.points_uv().to_vec()
    });
    generator.amount = Amount::Count(1500);
    let many = measured(&strokes(&generator, 9), |stroke| {
        stroke.points_uv().to_vec()
    });
    assert_eq!(few[..], many[..1000], "the first thousand");
}

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits) of a scratch's numbers.
fn fnv(sum: u64, stroke: &Stroke) -> u64 {
    let points = stroke.points_uv().iter().flatten().copied();
    let keys = stroke
        .keys()
        .iter()
        .flat_map(|key| [key.at, key.force_kgf, key.depth_mm]);
    points
        .chain(keys)
        .flat_map(f64::to_le_bytes)
        .fold(sum ^ 0xcbf2_9ce4_8422_2325, |sum, byte| {
            (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        })
}

/// Stored bits: the same on every machine, compiler and version of the libraries below. The four numbers were worked out
/// with another implementation of `ChaCha` and of the normal distribution too, and agree to the last digit or the one before.
#[test]
fn bits_are_stored() {
    let hash = |style: Style, seed: u64| {
        let generator = Generator {
            amount: Amount::Count(1000),
            ..Generator::style(style)
        };
        let mut sum = 0_u64;
        measured(&strokes(&generator, seed), |stroke| sum = fnv(sum, stroke));
        sum
    };
    let stroke = stroke(&thorough(), 10, 999);
    let [u, v] = stroke.points_uv()[6];
    let key = stroke.keys()[1];
    assert_eq!([u, v], [0.013436829920936533, 0.11493989328930143]);
    assert_eq!(key.force_kgf, 0.0005858283508854287);
    assert_eq!(key.orientation.spin_deg, 23.255392442959245);
    let stored = [
        0x76b5_89b6_b05b_0746,
        0x84c0_e695_8465_8c3a,
        0xf475_a9c0_ab11_e4c6,
        0x2c09_a4dc_0ada_fad7,
    ];
    for (style, sum) in Style::ALL.into_iter().zip(stored) {
        assert_eq!(hash(style, 11), sum, "{style:?}");
    }
}

/// A million scratches of four curves are a matter of a second: `cargo test --release -- --ignored` says how long.
#[test]
#[ignore = "a measurement"]
fn million() {
    let generator = Generator {
        amount: Amount::Count(1_000_000),
        ..Generator::style(Style::Swirls)
    };
    let strokes = strokes(&generator, 1);
    let begin = Instant::now();
    let mut points = 0;
    let all = strokes.try_for_each(0..strokes.count(), |_, stroke| {
        points += stroke.points_uv().len();
        Ok::<(), ()>(())
    });
    assert_eq!((all, points), (Ok(()), 13_000_000));
    println!("{:?}", begin.elapsed());
}

/// Other seeds are other scratches.
#[test]
fn seeds_differ() {
    let first = |seed| measured(&strokes(&thorough(), seed), |stroke| stroke.points_uv()[0]);
    let (one, other) = (first(1), first(2));
    assert!(one.iter().zip(&other).all(|(a, b)| a != b), "seeds 1 and 2");
    let pairs: Vec<[f64; 2]> = one.iter().zip(&other).map(|(a, b)| [a[0], b[0]]).collect();
    let related = correlation(&pairs);
    assert!(related.abs() < 0.12, "{related}");
}
