//! Saved patterns: opened, they are what was saved; damaged, they are refused or harmless.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::path::PathBuf;
use striae::brdf::Metal;
use striae::files::FileError;
use striae::formation::{Layer, Material, Tool};
use striae::pattern::{
    Amount, Footprint, Generator, Held, Pattern, PatternBuilder, Scratch, Stroke, Style,
    SurfacePoint,
};
use striae::scattering::{Output, Shading};

/// A file of this test's own, removed in the end.
struct Saved(PathBuf);

impl Saved {
    fn new(name: &str) -> Self {
        Self(std::env::temp_dir().join(format!("striae-{}-{name}.cache", std::process::id())))
    }

    fn of(pattern: &Pattern, name: &str) -> Self {
        let saved = Self::new(name);
        pattern.save_cache(&saved.0).unwrap();
        saved
    }

    fn bytes(&self) -> Vec<u8> {
        std::fs::read(&self.0).unwrap()
    }

    /// Puts a new file in the old one's place, which may still be open.
    fn put(&self, bytes: &[u8]) {
        let _ = std::fs::remove_file(&self.0);
        std::fs::write(&self.0, bytes).unwrap();
    }
}

impl Drop for Saved {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// Curved scratches of two kinds in a layered material, some with cross-sections of their own.
fn pattern(count: u32) -> Pattern {
    let material = Material {
        layers: vec![Layer {
            thickness_mm: 5e-4,
            scratched: Material::metal(Metal::Gold).scratched,
        }],
        ..Material::metal(Metal::Steel)
    };
    let mut builder = PatternBuilder::new(material, 1.0, [20.0; 2]).unwrap();
    for (held, seed) in [(Held::ToPath, 1), (Held::ToSurface, 2)] {
        let generator = Generator {
            amount: Amount::Count(if held == Held::ToPath {
                count
            } else {
                count / 20
            }),
            held,
            turn_spread_deg: 60.0,
            curves: 3,
            ..Generator::style(Style::Straight)
        };
        let tool = Tool::abrasive_grain();
        let strokes = generator.strokes(builder.mm_per_uv(), seed).unwrap();
        let drawn = |number| {
            let mut stroke = Stroke::default();
            strokes.stroke(number, &mut stroke);
            stroke
        };
        let drawn: Vec<Stroke> = (0..strokes.count()).map(drawn).collect();
        let scratches: Vec<Scratch<'_>> = drawn.iter().map(|one| one.scratch(&tool)).collect();
        builder.add_all(&scratches).unwrap();
    }
    builder.build()
}

/// What is reflected at random points under footprints of every size, as bits.
fn shaded(pattern: &Pattern, points: u32) -> Vec<[u32; 4]> {
    let mut rng = StdRng::seed_from_u64(5);
    let mut shading = Shading::default();
    let look = |_| {
        let radius = 10_f32.powf(rng.random_range(-3.0..0.8));
        let point = SurfacePoint {
            uv: [rng.random(), rng.random()],
            dp_du: [20.0, 0.0, 0.0],
            dp_dv: [0.0, 20.0, 0.0],
            normal: [0.0, 0.0, 1.0],
            footprint: Footprint::Radius(radius),
        };
        shading.shade(pattern, &point, [0.3, -0.2, 0.9]).unwrap();
        let [r, g, b] = shading.eval([-0.4, 0.1, 0.8], Output::BrdfCos);
        [r, g, b, shading.coverage()].map(f32::to_bits)
    };
    (0..points).map(look).collect()
}

fn opened(saved: &Saved) -> Result<Pattern, FileError> {
    Pattern::open_cache(&saved.0)
}

/// Expects a refusal that names the file and says so.
fn expect_refused(saved: &Saved, says: &str) {
    let refusals = [opened(saved).map(|_| ()), Pattern::verify_cache(&saved.0)];
    for refusal in refusals {
        let text = refusal.expect_err(says).to_string();
        assert!(
            text.contains(says) && text.contains("accepted") && text.contains(".cache: "),
            "{text}, wanted: {says}"
        );
    }
}

/// An opened pattern shades to the bit like the one that was saved, also when it is saved again, and empty ones too.
#[test]
fn round_trip() {
    for count in [0, 1, 800] {
        let pattern = pattern(count);
        let saved = Saved::of(&pattern, &format!("round-{count}"));
        Pattern::verify_cache(&saved.0).unwrap();
        let opened = opened(&saved).unwrap();
        assert_eq!(opened.scratch_count(), pattern.scratch_count());
        assert_eq!(opened.memory_bytes(), pattern.memory_bytes());
        assert!(
            shaded(&opened, 2000) == shaded(&pattern, 2000),
            "{count} scratches shade differently"
        );
        let again = Saved::of(&opened, &format!("again-{count}"));
        assert!(again.bytes() == saved.bytes(), "saved again it differs");
    }
}

/// The same scratches make the same file to the byte on any number of threads.
#[test]
fn threads_leave_no_trace() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let saved = Saved::new(&format!("threads-{threads}"));
        pool.unwrap()
            .install(|| pattern(600).save_cache(&saved.0))
            .unwrap();
        saved.bytes()
    };
    let one = on(1);
    assert!(on(2) == one, "two threads build another pattern");
    assert!(on(7) == one, "seven threads build another pattern");
}

/// A file that is open may be replaced: who has it open keeps what it was.
#[test]
fn replaced_while_open() {
    let saved = Saved::of(&pattern(100), "replaced");
    let first = opened(&saved).unwrap();
    let before = shaded(&first, 200);
    pattern(5).save_cache(&saved.0).unwrap();
    assert!(shaded(&first, 200) == before, "changed underfoot");
}

/// A file that ends early, wherever, is refused.
#[test]
fn cut_short() {
    let saved = Saved::of(&pattern(60), "short");
    let whole = saved.bytes();
    let mut lengths: Vec<usize> = (0..400).chain([whole.len() - 1]).collect();
    lengths.extend((400..whole.len()).step_by(whole.len() / 300));
    for length in lengths {
        saved.put(&whole[..length]);
        match length {
            0..8 => expect_refused(&saved, "is no saved pattern"),
            8..40 => expect_refused(&saved, "ends after"),
            _ => expect_refused(&saved, "bytes and claims"),
        }
    }
    saved.put(&[&whole[..], &[0]].concat());
    expect_refused(&saved, "bytes and claims");
}

/// Other files, versions and byte orders are told apart.
#[test]
fn foreign_files() {
    let saved = Saved::of(&pattern(60), "foreign");
    let whole = saved.bytes();
    let with = |at: usize, bytes: &[u8]| {
        let mut changed = whole.clone();
        changed[at..at + bytes.len()].copy_from_slice(bytes);
        saved.put(&changed);
    };
    saved.put(b"{ \"striae_pattern\": 1 }");
    expect_refused(&saved, "is no saved pattern");
    with(6, b"\n\n");
    expect_refused(&saved, "is no saved pattern");
    let mut order: [u8; 4] = whole[8..12].try_into().unwrap();
    order.reverse();
    with(8, &order);
    expect_refused(&saved, "the other byte order");
    with(12, &7_u32.to_ne_bytes());
    expect_refused(&saved, "has version 7");
    let folder = Saved(std::env::temp_dir());
    let error = opened(&folder).unwrap_err().to_string();
    std::mem::forget(folder);
    assert!(error.contains("is no file"), "{error}");
    let error = opened(&Saved::new("missing")).unwrap_err().to_string();
    assert!(error.contains("is not there"), "{error}");
}

/// No byte of the header may change.
#[test]
fn damaged_header() {
    let saved = Saved::of(&pattern(60), "header");
    let whole = saved.bytes();
    for at in 0..768 {
        let mut changed = whole.clone();
        changed[at] ^= 1 << (at % 8);
        saved.put(&changed);
        let refusal = opened(&saved).map(|_| ());
        assert!(
            refusal.is_err(),
            "byte {at} of the header counts for nothing"
        );
    }
}

/// A file damaged anywhere else is refused by verifying, and safe to shade: no panic, finite results.
#[test]
fn damaged_body() {
    let saved = Saved::of(&pattern(2500), "body");
    let whole = saved.bytes();
    let mut rng = StdRng::seed_from_u64(9);
    let mut opened_ones = 0;
    for round in 0..2000 {
        let mut changed = whole.clone();
        let at = rng.random_range(832..whole.len());
        changed[at] ^= 1 << rng.random_range(0..8);
        // Some are damaged all over.
        if round % 10 == 0 {
            for _ in 0..1000 {
                let at = rng.random_range(832..whole.len());
                changed[at] = rng.random();
            }
        }
        saved.put(&changed);
        assert!(
            Pattern::verify_cache(&saved.0).is_err(),
            "byte {at} counts for nothing"
        );
        let Ok(pattern) = opened(&saved) else {
            continue;
        };
        opened_ones += 1;
        let looked = std::panic::catch_unwind(|| shaded(&pattern, 30));
        let looked = looked.unwrap_or_else(|_| panic!("byte {at}, round {round}: panicked"));
        let is_sound = |bits: &u32| f32::from_bits(*bits).is_finite();
        assert!(
            looked.iter().flatten().all(is_sound),
            "byte {at}, round {round}: not finite"
        );
    }
    assert!(opened_ones > 1000, "only {opened_ones} could be opened");
}
