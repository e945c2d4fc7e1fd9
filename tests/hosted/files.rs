//! Saved patterns hold no code: it is given again, or they are not opened.

use super::hosts::{Matt, hosted};
use super::{both, pattern, point};
use std::path::PathBuf;
use striae::brdf::{Brdf, Hosted};
use striae::pattern::Pattern;
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

/// A file that names base BRDFs which the pattern does not have gets none of the process's.
#[test]
fn others_are_out_of_reach() {
    let [_, own] = both();
    let saved = Saved::of(&pattern(own, 0), "damaged");
    let mut bytes = std::fs::read(&saved.0).unwrap();
    // Every finish that is the host's, as the file has it: its kind, its place in the list, its widths.
    let mut changed = 0;
    let words = [7_u32, 1, 0.2_f32.to_bits(), 0.2_f32.to_bits()];
    let finish: Vec<u8> = words.iter().flat_map(|word| word.to_ne_bytes()).collect();
    for at in 0..bytes.len() - finish.len() {
        if bytes[at..].starts_with(&finish) {
            bytes[at + 4..at + 8].copy_from_slice(&77_u32.to_ne_bytes());
            changed += 1;
        }
    }
    assert!(changed > 0, "finishes lie differently");
    // Large arrays are not checked when a file is opened, so it may be damaged after that, too.
    std::fs::remove_file(&saved.0).unwrap();
    std::fs::write(&saved.0, &bytes).unwrap();
    match Pattern::open_cache_with(&saved.0, &own.map(host)) {
        Ok(opened) => {
            for f in shown(&opened) {
                assert!(f.iter().all(|f| f.is_finite()), "{f:?}");
            }
        }
        Err(error) => assert!(error.to_string().contains("damaged"), "{error}"),
    }
}
