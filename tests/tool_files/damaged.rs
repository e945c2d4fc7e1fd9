//! Files cut anywhere, full of noise, or claiming more than they hold.

use crate::pyramid::*;
use crate::refused::{bad_ply, bad_stl, refusal};
use crate::section;
use peak_alloc::PeakAlloc;
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use striae::files::tool_from_bytes;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// What a file claims costs no memory that it does not hold.
#[test]
fn claims_cost_nothing() {
    MEMORY.reset_peak_usage();
    bad_stl();
    bad_ply();
    let peak = MEMORY.peak_usage();
    // Other tests run at the same time; each of these claims would be gigabytes.
    assert!(peak < 64 << 20, "{peak} bytes");
}

/// A file that tells its end is refused wherever it is cut.
#[test]
fn cut_anywhere() {
    let joined = stl_text(1.0).replace("endsolid\nsolid upper end\n", "");
    let refuse_all = |name: &str, bytes: &[u8], sure: usize| {
        for end in 0..sure {
            refusal(name, &bytes[..end]);
        }
    };
    refuse_all(
        "joined.stl",
        joined.as_bytes(),
        joined.len() - "olid upper end\n".len(),
    );
    for (name, bytes) in every_form(1.0) {
        match name {
            "binary.STL" | "solid.stl" | "little.ply" | "big.Ply" => {
                refuse_all(name, &bytes, bytes.len());
            }
            // The last number may lose its last digits and stay a number.
            "text.ply" => refuse_all(name, &bytes, bytes.len() - ".5\n".len()),
            _ => {}
        }
    }
}

/// Noise, and files with a few wrong bytes: refused or taken, and what is taken can be used.
#[test]
fn noise() {
    let mut random = StdRng::seed_from_u64(3);
    let mut taken = 0;
    let mut attempt = |name: &str, bytes: &[u8]| {
        if let Ok(tool) = tool_from_bytes(bytes, format_of(name), 1.0) {
            taken += 1;
            let _ = section(&tool);
        }
    };
    for _ in 0..3000 {
        let mut bytes = vec![0; random.random_range(0..400)];
        random.fill(bytes.as_mut_slice());
        for (name, start) in [
            ("a.obj", ""),
            ("a.stl", ""),
            ("a.stl", "solid a\nfacet normal 0 0 0\n"),
            ("a.ply", "ply\nformat ascii 1.0\n"),
            (
                "a.ply",
                "ply\nformat binary_big_endian 1.0\nelement face 9\n",
            ),
        ] {
            attempt(name, &[start.as_bytes(), &bytes].concat());
        }
    }
    let forms = every_form(1.0);
    for _ in 0..1000 {
        for (name, bytes) in &forms {
            let mut bytes = bytes.clone();
            for _ in 0..random.random_range(1..6) {
                let at = random.random_range(0..bytes.len());
                match random.random_range(0..3) {
                    0 => bytes[at] = random.random(),
                    1 => drop(bytes.remove(at)),
                    _ => bytes.insert(at, b"0123456789-. \n/e"[random.random_range(0..16)]),
                }
            }
            attempt(name, &bytes);
        }
    }
    assert!(taken > 1000, "{taken}");
}
