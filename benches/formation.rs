//! What a cross-section costs, from a preset and from a mesh of 100,000 triangles.

#![expect(missing_docs, reason = "criterion's macros write none")]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use striae::brdf::Metal;
use striae::formation::{CrossSection, DepthLaw, Material, Orientation, Process, Tool};

/// A lumpy grain, 0.5 mm across, of `4 rings²` triangles.
fn grain(rings: u32) -> Tool {
    let spokes = 2 * rings;
    let position = |ring: u32, spoke: u32| {
        let theta = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        let phi = std::f64::consts::TAU * f64::from(spoke) / f64::from(spokes);
        let lumps = (7.0 * phi).sin() * (9.0 * theta).sin() + (3.0 * phi + 5.0 * theta).cos();
        let r = 0.25 + 0.01 * lumps;
        let flat = r * theta.sin();
        [flat * phi.cos(), flat * phi.sin(), -r * theta.cos()]
    };
    let all = |rings| (0..rings).flat_map(move |ring| (0..spokes).map(move |spoke| (ring, spoke)));
    let positions: Vec<_> = all(rings + 1)
        .map(|(ring, spoke)| position(ring, spoke))
        .collect();
    let faces = all(rings).flat_map(|(ring, spoke)| {
        let at = |i: u32, j: u32| (ring + i) * spokes + (spoke + j) % spokes;
        let [a, b, c, d] = [at(0, 0), at(0, 1), at(1, 0), at(1, 1)];
        [[a, b, c], [b, d, c]]
    });
    Tool::mesh(&positions, &faces.collect::<Vec<_>>(), 1.0).expect("a closed lump")
}

fn cross_sections(criterion: &mut Criterion) {
    let steel = Material::metal(Metal::Steel);
    let held = Orientation {
        spin_deg: 10.0,
        tilt_deg: 12.0,
        azimuth_deg: 70.0,
    };
    let mut group = criterion.benchmark_group("cross_section");
    for (law, name) in [
        (DepthLaw::Bosch2004, "2004"),
        (DepthLaw::ScratchHardness, "hardness"),
    ] {
        let process = Process {
            depth_law: law,
            force_kgf: 1.0,
            orientation: held,
            ..Process::default()
        };
        for (tool, label) in [
            (Tool::rockwell_c(), "rockwell_c"),
            (Tool::vickers(), "vickers"),
            (Tool::round_graver(), "round_graver"),
            (grain(158), "mesh_100k"),
        ] {
            group.bench_function(format!("{label}/{name}"), |bencher| {
                bencher.iter(|| {
                    CrossSection::form(black_box(&tool), black_box(&process), &steel)
                        .expect("forms")
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, cross_sections);
criterion_main!(benches);
