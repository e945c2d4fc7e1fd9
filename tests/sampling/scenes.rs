//! Shading points of all kinds.

use super::hosts::{Matt, Satin, hosted};
use super::support::crowd::add;
use super::support::{SHEET_MM, any_direction, lambert, random, sheet_of, single};
use rand::Rng;
use rand::rngs::StdRng;
use std::sync::LazyLock;
use striae::brdf::{Brdf, Fresnel};
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, Scratch, SurfacePoint};
use striae::scattering::{CrossFootprint, Shading};

/// The most grazing view, degrees from the normal.
const MOST_ZENITH_DEG: f64 = 85.0;

/// A shading point that was prepared.
pub(crate) struct Prepared {
    pub name: String,
    pub shading: Shading,
    /// The point's pattern and place; none for a cross-section by itself.
    pub place: Option<(usize, SurfacePoint)>,
    pub view: [f32; 3],
}

/// Names of materials and white base BRDFs of (zones, surface): lobes no narrower than integrals can follow.
pub(crate) fn materials() -> [(&'static str, [Brdf; 2]); 7] {
    let fresnel = Fresnel::Schlick { f0: [1.0; 3] };
    let albedo = [1.0; 3];
    let ggx = |alpha| Brdf::Ggx { alpha, fresnel };
    let anisotropic = |alpha_across, alpha_along| Brdf::AnisotropicGgx {
        alpha_across,
        alpha_along,
        fresnel,
    };
    let oren_nayar = |roughness| Brdf::OrenNayar { albedo, roughness };
    let phong = |exponent| Brdf::Phong {
        specular: [1.0; 3],
        exponent,
    };
    let cook_torrance = |alpha| Brdf::CookTorrance { alpha, fresnel };
    [
        ("diffuse", [lambert(1.0), lambert(1.0)]),
        ("ggx", [ggx(0.08), ggx(0.3)]),
        ("oren-nayar on phong", [oren_nayar(0.6), phong(30.0)]),
        ("phong on oren-nayar", [phong(60.0), oren_nayar(1.0)]),
        ("cook-torrance", [cook_torrance(0.1), cook_torrance(0.4)]),
        ("polished", [anisotropic(0.2, 0.07), anisotropic(0.3, 0.1)]),
        ("the host's", *HOSTED),
    ]
}

/// A satin metal and a matt surface of the host's, made once.
static HOSTED: LazyLock<[Brdf; 2]> = LazyLock::new(|| {
    let alphas = [0.15, 0.1];
    let albedo = [1.0; 3];
    [
        hosted(Satin {
            alphas,
            eta_k: None,
        }),
        hosted(Matt { albedo }),
    ]
});

/// Scratches of two kinds of finish through the sheet's middle: crossing, curved and, if wanted, by the hundred.
pub(crate) fn pattern([scratched, surface]: [Brdf; 2], other: Brdf, crowd: usize) -> Pattern {
    let material = Material::new(150.0, surface, scratched);
    let second = Material::new(100.0, surface, other);
    let mut builder = sheet_of(&material);
    let mut random = random(60);
    for i in 0..crowd.max(4) {
        let wide = if crowd > 0 { 3.0 } else { 0.3 };
        let shift_mm = random.random_range(-wide..wide);
        let turn_deg = random.random_range(0.0..180.0);
        let tool = [Tool::rockwell_c(), Tool::vickers()][i % 2].clone();
        let of = (i % 3 == 0).then_some(&second);
        let force_kgf = random.random_range(0.1..1.5);
        add(&mut builder, &tool, of, shift_mm, turn_deg, force_kgf);
    }
    let nail = Tool::nail();
    let bends = [
        [0.4996, 0.4996],
        [0.5004, 0.4998],
        [0.4998, 0.5002],
        [0.5004, 0.5006],
    ];
    builder
        .add(&Scratch {
            path: Path::CubicBezier(&bends),
            keys: &[Key::force(0.0, 0.3), Key::force(1.0, 2.0)],
            ..Scratch::new(&nail)
        })
        .unwrap();
    builder.build()
}

fn footprint(random: &mut StdRng, kind: usize) -> Footprint {
    let size = |mm: f64| single(mm / SHEET_MM);
    let mut edge = || [0, 1].map(|_| size(random.random_range(-0.3..0.3)));
    match kind {
        0 => Footprint::Point,
        1 => Footprint::Radius(0.01),
        2 => Footprint::Radius(0.15),
        3 => Footprint::Radius(3.0),
        _ => Footprint::Differentials {
            duv_dx: edge(),
            duv_dy: edge(),
        },
    }
}

/// A place near the sheet's middle.
pub(crate) fn point(random: &mut StdRng, kind: usize) -> SurfacePoint {
    let size = single(SHEET_MM);
    SurfacePoint {
        uv: [0, 1].map(|_| 0.5 + random.random_range(-0.2..0.2) / SHEET_MM),
        dp_du: [size, 0.0, 0.0],
        dp_dv: [0.0, size, 0.0],
        normal: [0.0, 0.0, 1.0],
        footprint: footprint(random, kind),
    }
}

/// With few scratches, then with a crowd, for each material.
pub(crate) static PATTERNS: LazyLock<Vec<(String, Pattern)>> = LazyLock::new(|| {
    let all = materials();
    let with = |i: usize, crowd| {
        let (name, brdfs) = all[i];
        let other = all[(i + 1) % all.len()].1[0];
        (
            format!("{name}, crowd of {crowd}"),
            pattern(brdfs, other, crowd),
        )
    };
    (0..all.len())
        .flat_map(|i| [with(i, 0), with(i, 300)])
        .collect()
});

/// Points of all patterns with all kinds of footprint, and cross-sections by themselves.
pub(crate) static ALL: LazyLock<Vec<Prepared>> = LazyLock::new(|| {
    let mut random = random(61);
    let mut all = Vec::new();
    for (number, (name, pattern)) in PATTERNS.iter().enumerate() {
        for kind in 0..5 {
            let point = point(&mut random, kind);
            let view = any_direction(&mut random, MOST_ZENITH_DEG);
            let mut shading = Shading::default();
            shading.shade(pattern, &point, view).unwrap();
            all.push(Prepared {
                name: format!(
                    "{name}, {:?} at {:?} from {view:?}: {} scratches cover {}",
                    point.footprint,
                    point.uv,
                    shading.scratch_count(),
                    shading.coverage()
                ),
                shading,
                place: Some((number, point)),
                view,
            });
        }
    }
    all.extend(
        materials()
            .into_iter()
            .map(|(name, brdfs)| section(name, brdfs, &mut random)),
    );
    all
});

/// A groove with rims by itself.
fn section(name: &str, [scratched, surface]: [Brdf; 2], random: &mut StdRng) -> Prepared {
    let groove = [
        [-0.1, 0.0],
        [-0.06, 0.015],
        [0.0, -0.04],
        [0.05, 0.012],
        [0.1, 0.0],
    ];
    let pixel = CrossFootprint::Box {
        center_mm: random.random_range(-0.1..0.1),
        extents_mm: [random.random_range(0.01..0.4), 0.02],
    };
    let view = any_direction(random, MOST_ZENITH_DEG);
    let mut shading = Shading::default();
    shading
        .shade_cross_section(&groove, &scratched, &surface, pixel, view)
        .unwrap();
    Prepared {
        name: format!("{name}, a cross-section in {pixel:?} from {view:?}"),
        shading,
        place: None,
        view,
    }
}
