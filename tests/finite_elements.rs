//! Pile-up and recovery against finite-element scratches by a sharp 120° cone at a fixed depth.
//!
//! `tests/data/fem.csv`, or another file of the same form through the environment variable `STRIAE_FEM`. The
//! figures are printed.

use std::collections::HashMap;
use striae::brdf::Metal;
use striae::formation::{CrossSection, DepthLaw, Material, Plasticity, Process, Tool};

struct Row {
    depth_mm: f64,
    yield_strain: f64,
    hardening: f64,
    pile_up_mm: f64,
    residual_mm: f64,
}

fn rows() -> Vec<Row> {
    let path = std::env::var("STRIAE_FEM")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/fem.csv").into());
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let names: Vec<&str> = lines.next().unwrap().split(',').map(str::trim).collect();
    let row = |line: &str| {
        let numbers = line
            .split(',')
            .map(|field| field.trim().parse::<f64>().unwrap());
        let field: HashMap<&str, f64> = names.iter().copied().zip(numbers).collect();
        Row {
            depth_mm: field["h"] * 1e-3,
            yield_strain: field["stress"] / (field["E"] * 1e3),
            hardening: field["n"],
            pile_up_mm: field["hp"] * 1e-3,
            residual_mm: (field["hrp"] - field["hp"]) * 1e-3,
        }
    };
    lines.map(row).collect()
}

/// A steel of a row's plasticity, scratched as in the row.
fn section(row: &Row) -> CrossSection {
    let plasticity = Plasticity::of(row.yield_strain, row.hardening).unwrap();
    let material = Material::metal(Metal::Steel).with_plasticity(plasticity);
    let process = Process {
        depth_law: DepthLaw::Stated,
        depth_mm: row.depth_mm,
        ..Process::default()
    };
    let cone = Tool::sphero_cone(60.0, 0.0, 1.0).unwrap();
    CrossSection::form(&cone, &process, &material).unwrap()
}

/// Pile-up height within 3 % on the mean, residual depth within 1 %.
#[test]
fn pile_up_and_recovery() {
    let rows = rows();
    assert!(!rows.is_empty(), "no rows");
    let (mut pile_up, mut depth, mut worst) = (0.0, 0.0, [0.0_f64; 2]);
    for row in &rows {
        let section = section(row);
        let of_height = (section.left().height_mm / row.pile_up_mm - 1.0).abs();
        let of_depth = (section.depth_mm() / row.residual_mm - 1.0).abs();
        pile_up += of_height / rows.len() as f64;
        depth += of_depth / rows.len() as f64;
        worst = [worst[0].max(of_height), worst[1].max(of_depth)];
    }
    println!(
        "finite elements: {} rows, pile-up height mean error {:.2} % (worst {:.2} %), residual depth {:.2} % \
         (worst {:.2} %)",
        rows.len(),
        pile_up * 100.0,
        worst[0] * 100.0,
        depth * 100.0,
        worst[1] * 100.0,
    );
    assert!(pile_up <= 0.03, "pile-up height: {pile_up}");
    assert!(depth <= 0.01, "residual depth: {depth}");
}

/// Harder-yielding and faster-hardening materials pile up less and spring back more.
#[test]
fn trends() {
    let of = |strain, n| Plasticity::of(strain, n).unwrap();
    assert!(
        of(5e-3, 0.2).pile_up_height() < of(1e-3, 0.2).pile_up_height(),
        "yield strain"
    );
    assert!(
        of(1e-3, 0.4).pile_up_height() < of(1e-3, 0.2).pile_up_height(),
        "hardening"
    );
    assert!(
        of(8e-3, 0.2).elastic_recovery() > of(1e-3, 0.2).elastic_recovery(),
        "recovery"
    );
}
