//! Documents of anything that the form allows.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use std::collections::BTreeMap;
use striae::brdf::Metal;
use striae::files::PatternFile;
use striae::files::pattern::{
    BrdfEntry, CurveKind, FresnelEntry, GeneratorEntry, HardnessEntry, KeyEntry, LayerEntry,
    MaterialEntry, MaterialName, ReadingEntry, Scale, ScratchEntry, ToolEntry, ToolName, Version,
};
use striae::formation::{DepthLaw, PileUpLaw};
use striae::pattern::{Amount, Distribution, Held, Style};

fn pick<T: Clone>(random: &mut StdRng, from: &[T]) -> T {
    from[random.random_range(0..from.len())].clone()
}

/// Any finite number: tiny, huge, negative, without end in binary.
fn number(random: &mut StdRng) -> f64 {
    match random.random_range(0..4) {
        0 => random.random_range(-1.0..1.0),
        1 => f64::from(random.random_range(-1000..1000)),
        2 => pick(
            random,
            &[
                0.0,
                -0.0,
                5e-324,
                f64::MAX,
                f64::MIN_POSITIVE,
                0.1,
                1.0 / 3.0,
            ],
        ),
        _ => Some(f64::from_bits(random.random()))
            .filter(|value| value.is_finite())
            .unwrap_or(1e300),
    }
}

fn single(random: &mut StdRng) -> f32 {
    Some(f32::from_bits(random.random()))
        .filter(|value| value.is_finite())
        .unwrap_or(0.1)
}

fn maybe<T>(random: &mut StdRng, value: impl FnOnce(&mut StdRng) -> T) -> Option<T> {
    random.random_bool(0.5).then(|| value(random))
}

fn some<T>(random: &mut StdRng, value: impl Fn(&mut StdRng) -> T) -> Vec<T> {
    (0..random.random_range(0..5))
        .map(|_| value(random))
        .collect()
}

fn name(random: &mut StdRng) -> String {
    let names = ["~nail", "~", "~über/..\\ \u{7}", "~a.b[3]", "~🔨"];
    pick(random, &names).to_owned()
}

fn pair(random: &mut StdRng) -> [f64; 2] {
    [number(random), number(random)]
}

fn rgb(random: &mut StdRng) -> [f32; 3] {
    [single(random), single(random), single(random)]
}

fn brdf(random: &mut StdRng) -> BrdfEntry {
    let alpha = single(random);
    match random.random_range(0..8) {
        0 => BrdfEntry::Lambert {
            albedo: rgb(random),
        },
        1 => BrdfEntry::Schlick {
            alpha,
            f0: rgb(random),
        },
        2 => BrdfEntry::Conductor {
            alpha,
            eta: rgb(random),
            k: rgb(random),
        },
        3 => BrdfEntry::Metal {
            name: pick(random, &Metal::ALL),
            alpha,
        },
        4 => BrdfEntry::OrenNayar {
            albedo: rgb(random),
            roughness: alpha,
        },
        5 => BrdfEntry::Phong {
            specular: rgb(random),
            exponent: alpha,
        },
        6 => BrdfEntry::CookTorrance {
            alpha,
            fresnel: fresnel(random),
        },
        _ => BrdfEntry::AnisotropicGgx {
            alpha_across: alpha,
            alpha_along: single(random),
            fresnel: fresnel(random),
        },
    }
}

fn fresnel(random: &mut StdRng) -> FresnelEntry {
    match random.random_range(0..3) {
        0 => FresnelEntry::Schlick { f0: rgb(random) },
        1 => FresnelEntry::Conductor {
            eta: rgb(random),
            k: rgb(random),
        },
        _ => FresnelEntry::Metal(pick(random, &Metal::ALL)),
    }
}

fn material(random: &mut StdRng) -> MaterialEntry {
    let tan_beta = number(random);
    let laws = [
        PileUpLaw::Bosch2004,
        PileUpLaw::OuterSlope { tan_beta },
        PileUpLaw::None,
    ];
    MaterialEntry {
        like: maybe(random, |random| pick(random, MaterialName::ALL)),
        hardness_hv: maybe(random, number),
        pile_up: maybe(random, |random| pick(random, &laws)),
        pile_up_fraction: maybe(random, number),
        elastic_recovery: maybe(random, number),
        surface: maybe(random, brdf),
        scratched: maybe(random, brdf),
        layers: maybe(random, |random| {
            some(random, |random| LayerEntry {
                thickness_mm: number(random),
                scratched: brdf(random),
            })
        }),
    }
}

fn tool(random: &mut StdRng) -> ToolEntry {
    let (height_mm, angle_deg) = (number(random), number(random));
    match random.random_range(0..6) {
        0 => ToolEntry::Preset(pick(random, ToolName::ALL)),
        1 => ToolEntry::SpheroCone {
            half_angle_deg: angle_deg,
            tip_radius_mm: number(random),
            height_mm,
        },
        2 => ToolEntry::Pyramid {
            sides: random.random(),
            angle_deg,
            height_mm,
        },
        3 => ToolEntry::Wedge {
            width_mm: number(random),
            angle_deg,
            height_mm,
        },
        4 => ToolEntry::Profile {
            points_mm: some(random, pair),
        },
        _ => ToolEntry::Mesh {
            file: name(random),
            mm_per_unit: number(random),
        },
    }
}

const CURVES: [CurveKind; 5] = [
    CurveKind::Polyline,
    CurveKind::CubicBezier,
    CurveKind::CatmullRom,
    CurveKind::BSpline,
    CurveKind::NonUniformBSpline,
];

fn scratch(random: &mut StdRng) -> ScratchEntry {
    let laws = [
        DepthLaw::Bosch2004,
        DepthLaw::ScratchHardness,
        DepthLaw::Stated,
    ];
    ScratchEntry {
        tool: name(random),
        material: maybe(random, name),
        depth_law: pick(random, &laws),
        held: pick(random, &[Held::ToPath, Held::ToSurface]),
        curve: pick(random, &CURVES),
        closed: random.random(),
        knots: some(random, number),
        points_uv: some(random, pair),
        keys: some(random, |random| KeyEntry {
            at: number(random),
            force_kgf: number(random),
            depth_mm: number(random),
            spin_deg: number(random),
            tilt_deg: number(random),
            azimuth_deg: number(random),
        }),
    }
}

fn distribution(random: &mut StdRng) -> Distribution {
    let ([from, to], [middle, deviation]) = (pair(random), pair(random));
    let all = [
        Distribution::Uniform { from, to },
        Distribution::Normal {
            from,
            to,
            middle,
            deviation,
        },
        Distribution::LogNormal {
            from,
            to,
            middle,
            deviation,
        },
        Distribution::PowerLaw {
            from,
            to,
            exponent: middle,
        },
        Distribution::Exponential {
            from,
            to,
            decay: middle,
        },
    ];
    pick(random, &all)
}

fn generator(random: &mut StdRng) -> GeneratorEntry {
    let amounts = [
        Amount::Count(random.random()),
        Amount::PerCm2(number(random)),
    ];
    let style = pick(random, &Style::ALL);
    GeneratorEntry {
        material: maybe(random, name),
        amount: maybe(random, |random| pick(random, &amounts)),
        area_uv: maybe(random, |random| [pair(random), pair(random)]),
        length_mm: maybe(random, distribution),
        force_kgf: maybe(random, distribution),
        depth_mm: maybe(random, distribution),
        direction_deg: maybe(random, number),
        spread_deg: maybe(random, number),
        turn_deg: maybe(random, number),
        turn_spread_deg: maybe(random, number),
        wander_deg: maybe(random, number),
        curves: maybe(random, Rng::random),
        taper: maybe(random, pair),
        spin_deg: maybe(random, number),
        spin_spread_deg: maybe(random, number),
        tilt_deg: maybe(random, number),
        azimuth_deg: maybe(random, number),
        held: maybe(random, |_| Held::ToSurface),
        depth_law: maybe(random, |_| DepthLaw::ScratchHardness),
        ..GeneratorEntry::new(&name(random), style, random.random())
    }
}

/// A document of anything that the form allows, sensible or not.
pub(crate) fn document(random: &mut StdRng) -> PatternFile {
    let readings = |random: &mut StdRng| {
        HardnessEntry::Readings(some(random, |random| ReadingEntry {
            uv: pair(random),
            hardness_hv: number(random),
        }))
    };
    let image = |random: &mut StdRng| HardnessEntry::Image {
        file: name(random),
        range_hv: pair(random),
    };
    let named = |random: &mut StdRng| some(random, |random| (name(random), material(random)));
    PatternFile {
        striae_pattern: Version,
        scale: Scale {
            mm_per_scene_unit: number(random),
            units_per_uv: pair(random),
        },
        surface: name(random),
        hardness: if random.random_bool(0.3) {
            maybe(random, readings)
        } else {
            maybe(random, image)
        },
        materials: BTreeMap::from_iter(named(random)),
        tools: BTreeMap::from_iter(some(random, |random| (name(random), tool(random)))),
        scratches: some(random, scratch),
        generators: some(random, generator),
    }
}

/// Any document comes back equal, and is written the same again: no digit is lost.
#[test]
fn random_documents_come_back() {
    let mut random = StdRng::seed_from_u64(2);
    for i in 0..500 {
        let file = document(&mut random);
        let text = file.to_json().unwrap();
        let back = PatternFile::parse(&text).unwrap();
        assert_eq!(back, file, "document {i}: {text}");
        // Equal numbers may differ in the sign of 0: their texts may not.
        assert_eq!(back.to_json().unwrap(), text, "document {i}");
    }
}
