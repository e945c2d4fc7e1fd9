//! The model against values from an independent implementation of the same equations.
//!
//! `tests/data/golden.json`, or another file of the same form named by the environment variable
//! `STRIAE_GOLDEN`. `tests/data/README.md` says what the file holds. Each test prints its worst deviation.

#![expect(
    clippy::cast_possible_truncation,
    reason = "cases are read in double precision"
)]

use serde::Deserialize;
use std::f64::consts::SQRT_2;
use striae::brdf::{Brdf, Fresnel, Metal};
use striae::formation::{CrossSection, DepthLaw, Material, Orientation, Peak, Process, Tool};
use striae::scattering::{CrossFootprint, Output, Shading};

#[derive(Deserialize)]
struct Golden {
    process: Vec<ProcessCase>,
    light: Vec<LightCase>,
}

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum ToolCase {
    SpheroCone {
        half_angle_deg: f64,
        tip_radius_mm: f64,
    },
    Pyramid {
        sides: u32,
        angle_deg: f64,
        spin_deg: f64,
    },
    Wedge {
        width_mm: f64,
        angle_deg: f64,
        spin_deg: f64,
    },
}

#[derive(Deserialize)]
struct ProcessCase {
    tool: ToolCase,
    tilt_deg: f64,
    azimuth_deg: f64,
    force_kgf: f64,
    hardness_hv: f64,
    depth_mm: f64,
    groove_area_mm2: f64,
    groove_width_mm: f64,
    left: PeakCase,
    right: PeakCase,
}

#[derive(Deserialize)]
struct PeakCase {
    alpha_deg: f64,
    beta_deg: f64,
    height_mm: f64,
    inner_width_mm: f64,
    outer_width_mm: f64,
}

#[derive(Deserialize)]
struct LightCase {
    profile: Vec<[f32; 2]>,
    zone_bsdf: BrdfCase,
    flat_bsdf: BrdfCase,
    wi: [f32; 3],
    wo: [f32; 3],
    whole_pixel_width: Option<f64>,
    footprint: Option<FootprintCase>,
    f: f64,
}

#[derive(Deserialize)]
struct FootprintCase {
    center: f64,
    extent_a: f64,
    extent_b: f64,
}

#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum BrdfCase {
    Lambert { albedo: f32 },
    Ggx { alpha: f32, f0: f32 },
}

impl BrdfCase {
    fn brdf(&self) -> Brdf {
        match *self {
            Self::Lambert { albedo } => Brdf::Lambert {
                albedo: [albedo; 3],
            },
            Self::Ggx { alpha, f0 } => Brdf::Ggx {
                alpha,
                fresnel: Fresnel::Schlick { f0: [f0; 3] },
            },
        }
    }
}

/// The tools of the golden file are tall enough never to matter by their height.
const TALL_MM: f64 = 3.0;

impl ToolCase {
    fn tool_and_spin(&self) -> (Tool, f64) {
        let (tool, spin_deg) = match *self {
            Self::SpheroCone {
                half_angle_deg,
                tip_radius_mm,
            } => (
                Tool::sphero_cone(half_angle_deg, tip_radius_mm, TALL_MM),
                0.0,
            ),
            Self::Pyramid {
                sides,
                angle_deg,
                spin_deg,
            } => (Tool::pyramid(sides, angle_deg, TALL_MM), spin_deg),
            Self::Wedge {
                width_mm,
                angle_deg,
                spin_deg,
            } => (Tool::wedge(width_mm, angle_deg, TALL_MM), spin_deg),
        };
        (tool.unwrap(), spin_deg)
    }
}

fn golden() -> Golden {
    let path = std::env::var("STRIAE_GOLDEN")
        .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/golden.json").into());
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The metals of the paper: nothing is lost, nothing springs back.
fn metal(hardness_hv: f64) -> Material {
    Material {
        hardness_hv,
        ..Material::metal(Metal::Steel)
    }
}

/// Every dimension of every golden cross-section, within 0.5 %.
#[test]
fn process_cases() {
    let mut worst = (0.0, String::new());
    let cases = golden().process;
    assert!(!cases.is_empty(), "no process cases");
    for (i, case) in cases.iter().enumerate() {
        let (tool, spin_deg) = case.tool.tool_and_spin();
        let process = Process {
            depth_law: DepthLaw::Bosch2004,
            force_kgf: case.force_kgf,
            depth_mm: 0.0,
            orientation: Orientation {
                spin_deg,
                tilt_deg: case.tilt_deg,
                azimuth_deg: case.azimuth_deg,
            },
        };
        let section = CrossSection::form(&tool, &process, &metal(case.hardness_hv)).unwrap();
        let mut compare = |name: &str, ours: f64, golden: f64| {
            let deviation = (ours - golden).abs() / golden.abs().max(1e-12);
            if deviation > worst.0 {
                worst = (
                    deviation,
                    format!("case {i}, {name}: {ours} against {golden}"),
                );
            }
        };
        compare("depth_mm", section.depth_mm(), case.depth_mm);
        compare(
            "groove_area_mm2",
            section.groove_area_mm2(),
            case.groove_area_mm2,
        );
        compare(
            "groove_width_mm",
            section.groove_width_mm(),
            case.groove_width_mm,
        );
        for (side, ours, golden) in [
            ("left", section.left(), &case.left),
            ("right", section.right(), &case.right),
        ] {
            let Peak {
                alpha_deg,
                beta_deg,
                height_mm,
                inner_width_mm,
                outer_width_mm,
            } = ours;
            compare(&format!("{side} alpha_deg"), alpha_deg, golden.alpha_deg);
            compare(&format!("{side} beta_deg"), beta_deg, golden.beta_deg);
            compare(&format!("{side} height_mm"), height_mm, golden.height_mm);
            compare(
                &format!("{side} inner_width_mm"),
                inner_width_mm,
                golden.inner_width_mm,
            );
            compare(
                &format!("{side} outer_width_mm"),
                outer_width_mm,
                golden.outer_width_mm,
            );
        }
    }
    println!(
        "golden process: {} cases, worst relative deviation {:.3e} ({})",
        cases.len(),
        worst.0,
        worst.1
    );
    assert!(worst.0 <= 0.005, "{}", worst.1);
}

/// Every golden light case, within 1e-4 relative or 1e-6 absolute.
#[test]
fn light_cases() {
    let cases = golden().light;
    assert!(!cases.is_empty(), "no light cases");
    for whole in [true, false] {
        let mut worst = (0.0, String::from("none"));
        let mut count = 0;
        for (i, case) in cases.iter().enumerate() {
            if case.whole_pixel_width.is_some() != whole {
                continue;
            }
            count += 1;
            let ours = f64::from(evaluate(case));
            // In units of what is allowed: 1e-4 relative, 1e-6 absolute near zero.
            let deviation = (ours - case.f).abs() / (1e-4 * case.f.abs()).max(1e-6);
            if deviation > worst.0 {
                worst = (deviation, format!("case {i}: {ours} against {}", case.f));
            }
        }
        let kind = if whole { "whole pixel" } else { "footprint" };
        println!(
            "golden light, {kind}: {count} cases, worst deviation {:.3} of what is allowed ({})",
            worst.0, worst.1
        );
        assert!(worst.0 <= 1.0, "{kind}: {}", worst.1);
    }
}

fn evaluate(case: &LightCase) -> f32 {
    let pixel = match (case.whole_pixel_width, &case.footprint) {
        (Some(width), _) => {
            let (first, last) = (case.profile[0], case.profile[case.profile.len() - 1]);
            let margin_mm = 0.5 * (width - f64::from(last[0] - first[0]));
            CrossFootprint::Whole {
                margin_mm: margin_mm as f32,
            }
        }
        (None, Some(footprint)) => CrossFootprint::Box {
            center_mm: footprint.center,
            extents_mm: [footprint.extent_a, footprint.extent_b],
        },
        (None, None) => panic!("a light case needs whole_pixel_width or footprint"),
    };
    let mut shading = Shading::default();
    shading
        .shade_cross_section(
            &case.profile,
            &case.zone_bsdf.brdf(),
            &case.flat_bsdf.brdf(),
            pixel,
            case.wo,
        )
        .unwrap();
    shading.eval(case.wi, Output::Brdf)[0]
}

/// The comparison can fail: a wrong force is noticed.
#[test]
fn deviations_are_noticed() {
    let process = |force_kgf| Process {
        force_kgf,
        ..Default::default()
    };
    let section =
        |force| CrossSection::form(&Tool::rockwell_c(), &process(force), &metal(200.0)).unwrap();
    assert!(
        section(2.0).depth_mm() > 1.2 * section(1.0).depth_mm(),
        "force has no effect"
    );
    assert!(
        section(2.0).groove_width_mm() > SQRT_2.sqrt() * section(1.0).groove_width_mm(),
        "nor on width"
    );
}
