//! Shading and queries are content with little stack: threads of renderers may have no more.

use striae::brdf::Metal;
use striae::formation::{Material, Tool};
use striae::pattern::{
    Footprint, Generated, Generator, PatternBuilder, ScratchHit, Style, SurfacePoint,
};
use striae::scattering::{Output, Shading};

/// What `include/striae.h` promises.
const STACK_BYTES: usize = 256 << 10;

/// Pixels over one scratch, dozens and thousands, on a thread that has no more than that.
#[test]
fn shading_needs_little_stack() {
    let tool = Tool::abrasive_grain();
    let mut builder = PatternBuilder::new(Material::metal(Metal::Steel), 1.0, [20.0; 2]).unwrap();
    let generated = Generated {
        generator: &Generator::style(Style::Brushed),
        tool: &tool,
        material: None,
        seed: 7,
    };
    builder.generate(&generated).unwrap();
    let pattern = builder.build();
    let pixels = move || -> Vec<(u32, usize)> {
        let radii = [1e-3, 0.03, 0.1, 0.3, 1.0, 8.0];
        let shaded = radii.map(|radius| {
            let point = SurfacePoint {
                uv: [0.5; 2],
                dp_du: [20.0, 0.0, 0.0],
                dp_dv: [0.0, 20.0, 0.0],
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Radius(radius),
            };
            let mut shading = Shading::default();
            shading.shade(&pattern, &point, [0.3, 0.1, 1.0]).unwrap();
            let light = shading.eval([-0.3, 0.2, 1.0], Output::BrdfCos)[0];
            assert!(light > 0.0, "nothing seen with {radius} mm");
            let mut hits = [ScratchHit::default(); 8];
            let found = pattern.hits(&point, &mut hits).unwrap();
            (shading.scratch_count(), found.count)
        });
        shaded.to_vec()
    };
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
    let counts = thread.spawn(pixels).unwrap().join().unwrap();
    println!("scratches shaded and told apart: {counts:?}");
    let most = counts.iter().map(|&(_, told)| told).max();
    assert!(counts[0].1 < 12 && most > Some(200), "{counts:?}");
    let takes_most = |&(shaded, _): &(u32, usize)| (13..=48).contains(&shaded);
    assert!(counts.iter().any(takes_most), "{counts:?}: none one by one");
}
