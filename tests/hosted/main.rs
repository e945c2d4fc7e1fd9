//! Base BRDFs of the host's own: what they say is what is reflected, wherever a zone may have one.

mod answers;
#[cfg(feature = "files")]
mod files;
#[path = "../support/hosts.rs"]
mod hosts;
mod like_built_in;
#[path = "../support/mod.rs"]
mod support;

use hosts::{Matt, Satin, hosted};
use rand::Rng;
use striae::brdf::{Brdf, Fresnel, Metal};
use striae::formation::{Layer, Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, Scratch, SurfacePoint};
use support::crowd::add;
use support::{SHEET_MM, random, sheet_of, single};

/// A metal, a wider one and paint: the library's, and a host's that are to be the same.
fn both() -> [[Brdf; 3]; 2] {
    let (eta, k) = Metal::Gold.eta_k();
    let fresnel = Fresnel::Conductor { eta, k };
    let albedo = [0.7, 0.4, 0.1];
    let built_in = [
        Brdf::AnisotropicGgx {
            alpha_across: 0.3,
            alpha_along: 0.15,
            fresnel,
        },
        Brdf::Ggx {
            alpha: 0.2,
            fresnel,
        },
        Brdf::Lambert { albedo },
    ];
    let satin = |alphas| Satin {
        alphas,
        eta_k: Some((eta, k)),
    };
    let own = [
        hosted(satin([0.3, 0.15])),
        hosted(satin([0.2, 0.2])),
        hosted(Matt { albedo }),
    ];
    [built_in, own]
}

/// Scratches through the sheet's middle that show all three: the first on the surface, the others in a painted material and,
/// the other way round, in one of some scratches' own.
fn pattern([surface, metal, paint]: [Brdf; 3], crowd: usize) -> Pattern {
    let painted = Material {
        layers: vec![Layer {
            thickness_mm: 0.004,
            scratched: paint,
        }],
        ..Material::new(150.0, surface, metal)
    };
    let other = Material::new(100.0, surface, paint);
    let mut builder = sheet_of(&painted);
    let mut random = random(5);
    for i in 0..crowd.max(4) {
        let wide = if crowd > 0 { 3.0 } else { 0.3 };
        let shift_mm = random.random_range(-wide..wide);
        let turn_deg = random.random_range(0.0..180.0);
        let tool = [Tool::rockwell_c(), Tool::vickers()][i % 2].clone();
        let of = (i % 3 == 0).then_some(&other);
        add(&mut builder, &tool, of, shift_mm, turn_deg, 0.8);
    }
    builder
        .add(&Scratch {
            path: Path::CubicBezier(&[
                [0.4996, 0.4996],
                [0.5004, 0.4998],
                [0.4998, 0.5002],
                [0.5004, 0.5006],
            ]),
            keys: &[Key::force(0.0, 0.3), Key::force(1.0, 2.0)],
            ..Scratch::new(&Tool::nail())
        })
        .unwrap();
    builder.build()
}

/// A place near the sheet's middle.
fn point(i: u32) -> SurfacePoint {
    let size = single(SHEET_MM);
    let offset = f64::from(i % 7) * 2e-5;
    SurfacePoint {
        uv: [0.5 + offset, 0.5 - 0.7 * offset],
        dp_du: [size, 0.0, 0.0],
        dp_dv: [0.0, size, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint: Footprint::Radius([0.01, 0.15, 3.0][i as usize % 3]),
    }
}
