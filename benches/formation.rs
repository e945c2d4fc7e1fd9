//! What a cross-section costs, from a preset and from a mesh of 100,000 triangles.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use striae::brdf::Metal;
use striae::formation::{CrossSection, DepthLaw, Material, Orientation, Process, Tool};

/// A lumpy grain, 0.5 mm across, of about this many triangles.
fn grain(triangles: u32) -> Tool {
    let rings = (f64::from(triangles) / 4.0).sqrt().round();
    let spokes = 2.0 * rings;
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    let number = |ring: f64, spoke: f64| (ring * spokes + spoke % spokes) as u32;
    let (mut ring, mut spoke);
    ring = 0.0;
    while ring <= rings {
        spoke = 0.0;
        while spoke < spokes {
            let theta = std::f64::consts::PI * ring / rings;
            let phi = std::f64::consts::TAU * spoke / spokes;
            let lumps = (7.0 * phi).sin() * (9.0 * theta).sin() + (3.0 * phi + 5.0 * theta).cos();
            let r = 0.25 + 0.01 * lumps;
            let flat = r * theta.sin();
            positions.push([flat * phi.cos(), flat * phi.sin(), -r * theta.cos()]);
            if ring < rings {
                let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)];
                let [a, b, c, d] = corners.map(|(i, j)| number(ring + i, spoke + j));
                faces.extend([[a, b, c], [b, d, c]]);
            }
            spoke += 1.0;
        }
        ring += 1.0;
    }
    Tool::mesh(&positions, &faces, 1.0).expect("a closed lump")
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
            (grain(100_000), "mesh_100k"),
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
