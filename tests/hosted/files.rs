//! Saved patterns hold no code: it is given again, or they are not opened.

use super::hosts::{Matt, hosted};
use super::support::sheet_of;
use super::{both, pattern, point};
use std::path::PathBuf;
use striae::brdf::{Brdf, HostBrdf, Hosted, Lobe};
use striae::formation::{Material, Tool};
use striae::pattern::{Held, Key, Path, Pattern, Scratch};
use striae::scattering::{Output, Shading};

/// A file of this test's own, removed in the end.
struct Saved(PathBuf);

impl Saved {
    fn of(pattern: &Pattern, name: &str) -> Self {
        let file = format!("striae-{}-hosted-{name}.cache", std::process::id());
        let saved = Self(std::env::temp_dir().join(file));
        pattern.save_cache(&saved.0).unwrap();
        saved
    }
}

impl Drop for Saved {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

fn shown(pattern: &Pattern) -> Vec<[f32; 3]> {
    let mut shading = Shading::default();
    let light = [0.4, -0.3, 1.0];
    (0..9)
        .map(|i| {
            shading.shade(pattern, &point(i), [0.1, 0.3, 1.0]).unwrap();
            shading.eval(light, Output::BrdfCos)
        })
        .collect()
}

fn host(brdf: Brdf) -> Hosted {
    match brdf {
        Brdf::Hosted(host) => host,
        other => panic!("{other:?} is the library's"),
    }
}

/// Given the same base BRDFs again a saved pattern shows what it did, few scratches or a crowd; given others, those.
#[test]
fn opened_with_the_same() {
    let [_, own] = both();
    let red = host(hosted(Matt {
        albedo: [0.5, 0.0, 0.0],
    }));
    for crowd in [0, 300] {
        let built = pattern(own, crowd);
        let saved = Saved::of(&built, &crowd.to_string());
        let hosts = built.hosted();
        assert_eq!(hosts, own.map(host), "in the order of the material");
        let opened = Pattern::open_cache_with(&saved.0, hosts).unwrap();
        assert_eq!(shown(&opened), shown(&built));
        Pattern::verify_cache(&saved.0).unwrap();
        let other = Pattern::open_cache_with(&saved.0, &[red; 3]).unwrap();
        for [red, green, blue] in shown(&other) {
            assert!(
                red > 0.0 && green == 0.0 && blue == 0.0,
                "{red} {green} {blue}"
            );
        }
    }
}

/// The file does not depend on what else the process knows.
#[test]
fn files_are_the_same_again() {
    let bytes = [0, 1].map(|i| {
        let [_, own] = both();
        let saved = Saved::of(&pattern(own, 0), &format!("again-{i}"));
        std::fs::read(&saved.0).unwrap()
    });
    assert!(bytes[0] == bytes[1], "two files of one pattern");
}

/// With fewer or more than it has a pattern is refused, and the text says how many there are.
#[test]
fn refused_without() {
    let [built_in, own] = both();
    let saved = Saved::of(&pattern(own, 0), "without");
    let hosts = own.map(host);
    for few in [&[][..], &hosts[..2], &[hosts[0]; 4]] {
        let text = Pattern::open_cache_with(&saved.0, few)
            .unwrap_err()
            .to_string();
        let told = format!(
            "has 3 base BRDFs of the host's own, and {} are given",
            few.len()
        );
        assert!(text.contains(&told) && text.contains("accepted"), "{text}");
    }
    assert!(Pattern::open_cache(&saved.0).is_err(), "opened without");
    let plain = Saved::of(&pattern(built_in, 0), "plain");
    assert!(Pattern::open_cache(&plain.0).is_ok(), "has none");
    let refused = Pattern::open_cache_with(&plain.0, &hosts[..1]);
    assert!(refused.is_err(), "one too many");
}

/// What must not be called.
struct Trap;

impl HostBrdf for Trap {
    fn eval(&self, _: [f32; 3], _: [f32; 3]) -> [f32; 3] {
        panic!("evaluated")
    }

    fn sample(&self, _: [f32; 2], _: [f32; 3]) -> Option<[f32; 3]> {
        panic!("sampled")
    }

    fn pdf(&self, _: [f32; 3], _: [f32; 3]) -> f32 {
        panic!("asked for a density")
    }

    fn lobe(&self) -> Lobe {
        Lobe::Glossy
    }

    fn alphas(&self) -> [f32; 2] {
        [0.2; 2]
    }
}

/// Scratches with cross-sections of their own, so many that their finishes are not checked when the file is opened.
fn many(own: [Brdf; 3]) -> Pattern {
    let mut builder = sheet_of(&Material::new(150.0, own[0], own[1]));
    let tool = Tool::rockwell_c();
    for i in 0..900 {
        let v = 0.45 + 1e-4 * f64::from(i);
        builder
            .add(&Scratch {
                path: Path::Polyline(&[[0.4999, v], [0.5001, v]]),
                keys: &[Key::force(0.0, 1.0)],
                held: Held::ToSurface,
                ..Scratch::new(&tool)
            })
            .unwrap();
    }
    builder.build()
}

/// A file that names base BRDFs which the pattern does not have is opened where nobody looks at once, and then shows black
/// zones: it gets none of those that the process knows.
#[test]
fn others_are_out_of_reach() {
    let [_, own] = both();
    let traps: Vec<Brdf> = (0..100).map(|_| hosted(Trap)).collect();
    assert!(traps.len() > 77, "one has the number that is damaged to");
    let built = many(own);
    let saved = Saved::of(&built, "damaged");
    let mut bytes = std::fs::read(&saved.0).unwrap();
    // Each finish of the metal as the file has it: its kind, its place in the list, its widths.
    let words = [7_u32, 1, 0.2_f32.to_bits(), 0.2_f32.to_bits()];
    let finish: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
    let places: Vec<usize> = (0..bytes.len() - finish.len())
        .step_by(4)
        .filter(|at| bytes[*at..].starts_with(&finish))
        .collect();
    assert!(places.len() >= 900, "finishes lie differently");
    // The last is the palette's, in a small array, which is checked.
    for at in &places[..900] {
        bytes[at + 4..at + 8].copy_from_slice(&77_u32.to_ne_bytes());
    }
    std::fs::remove_file(&saved.0).unwrap();
    std::fs::write(&saved.0, &bytes).unwrap();
    let opened = Pattern::open_cache_with(&saved.0, built.hosted()).unwrap();
    assert!(Pattern::verify_cache(&saved.0).is_err(), "nothing damaged");
    let whole = shown(&built);
    for (damaged, whole) in shown(&opened).into_iter().zip(&whole) {
        assert!(damaged[0] <= whole[0], "{damaged:?}, not {whole:?}");
    }
    let sum = |shown: &[[f32; 3]]| shown.iter().map(|f| f[0]).sum::<f32>();
    let (damaged, whole) = (sum(&shown(&opened)), sum(&whole));
    assert!(
        damaged < 0.95 * whole,
        "{damaged} of {whole}: scratches are not black"
    );
}
