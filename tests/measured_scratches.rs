//! Scratches as a profilometer saw them: a Vickers pyramid, edge forward, at 12 N in three steels.
//!
//! `tests/data/measured/`, or another folder with files of the same names through the environment variable
//! `STRIAE_MEASURED`. The figures are printed.

use striae::brdf::Metal;
use striae::formation::{CrossSection, DepthLaw, Material, Orientation, PileUpLaw, Process, Tool};

/// 12 N.
const FORCE_KGF: f64 = 12.0 / 9.80665;

/// One set of parameters per steel, found once by least squares on the files in `tests/data/measured/`.
struct Steel {
    name: &'static str,
    scratch_hardness_hv: f64,
    outer_slope: f64,
    pile_up_fraction: f64,
}

const STEELS: [Steel; 3] = [
    Steel {
        name: "Q235",
        scratch_hardness_hv: 105.1,
        outer_slope: 0.511,
        pile_up_fraction: 0.801,
    },
    Steel {
        name: "45steel",
        scratch_hardness_hv: 159.6,
        outer_slope: 0.445,
        pile_up_fraction: 0.721,
    },
    Steel {
        name: "40Cr",
        scratch_hardness_hv: 157.5,
        outer_slope: 0.843,
        pile_up_fraction: 0.812,
    },
];

impl Steel {
    fn section(&self) -> CrossSection {
        let material = Material {
            hardness_hv: self.scratch_hardness_hv,
            pile_up: PileUpLaw::OuterSlope {
                tan_beta: self.outer_slope,
            },
            pile_up_fraction: self.pile_up_fraction,
            ..Material::metal(Metal::Steel)
        };
        let process = Process {
            depth_law: DepthLaw::ScratchHardness,
            force_kgf: FORCE_KGF,
            orientation: Orientation {
                spin_deg: 45.0,
                ..Orientation::default()
            },
            ..Process::default()
        };
        CrossSection::form(&Tool::vickers(), &process, &material).unwrap()
    }

    fn measured(&self) -> Vec<[f64; 2]> {
        let folder = std::env::var("STRIAE_MEASURED")
            .unwrap_or_else(|_| concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/measured").into());
        let path = format!("{folder}/{}-12N.csv", self.name);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let point = |line: &str| {
            let (x, z) = line
                .split_once(',')
                .unwrap_or_else(|| panic!("{path}: {line}"));
            let number = |text: &str| text.trim().parse::<f64>().unwrap();
            [number(x), number(z) * 1e-3]
        };
        text.lines()
            .skip(1)
            .filter(|line| !line.trim().is_empty())
            .map(point)
            .collect()
    }
}

/// The cross-section's height at x.
fn height_at(vertices: &[[f64; 2]], x: f64) -> f64 {
    let next = vertices.partition_point(|vertex| vertex[0] <= x);
    let (Some(a), Some(b)) = (next.checked_sub(1).map(|i| vertices[i]), vertices.get(next)) else {
        return 0.0;
    };
    a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0])
}

/// Mean difference and RMS about it, the cross-section placed at `center`.
fn datum_and_rms(measured: &[[f64; 2]], vertices: &[[f64; 2]], center: f64) -> (f64, f64) {
    let difference = |point: &[f64; 2]| point[1] - height_at(vertices, point[0] - center);
    let count = measured.len() as f64;
    let datum = measured.iter().map(difference).sum::<f64>() / count;
    let squares = measured
        .iter()
        .map(|point| (difference(point) - datum).powi(2));
    (datum, (squares.sum::<f64>() / count).sqrt())
}

/// A profilometer knows neither where the scratch lies nor where its surface is: the best place near the
/// deepest point, as (center, datum, RMS).
fn placed(measured: &[[f64; 2]], vertices: &[[f64; 2]]) -> (f64, f64, f64) {
    let deepest = measured
        .iter()
        .min_by(|a, b| a[1].total_cmp(&b[1]))
        .unwrap()[0];
    let mut best = (deepest, 0.0, f64::INFINITY);
    for i in -400..=400 {
        let center = deepest + f64::from(i) * 1e-4;
        let (datum, rms) = datum_and_rms(measured, vertices, center);
        if rms < best.2 {
            best = (center, datum, rms);
        }
    }
    best
}

/// (crest-to-crest width, depth, left crest, right crest) of measured points about a datum.
fn figures(measured: &[[f64; 2]], datum: f64) -> [f64; 4] {
    let deepest = (0..measured.len())
        .min_by(|&a, &b| measured[a][1].total_cmp(&measured[b][1]))
        .unwrap();
    let highest = |part: &[[f64; 2]]| *part.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    let (left, right) = (highest(&measured[..deepest]), highest(&measured[deepest..]));
    [
        right[0] - left[0],
        datum - measured[deepest][1],
        left[1] - datum,
        right[1] - datum,
    ]
}

/// The scratch-hardness law and a steel's own pile-up give the measured cross-section, RMS within 4 % of
/// peak-to-valley.
#[test]
fn steel_scratches() {
    for steel in STEELS {
        let (section, measured) = (steel.section(), steel.measured());
        let vertices: Vec<[f64; 2]> = section.vertices().iter().map(|v| v.to_array()).collect();
        let (_, datum, rms) = placed(&measured, &vertices);
        let [width, depth, left, right] = figures(&measured, datum).map(|mm| mm * 1e3);
        let heights = measured.iter().map(|point| point[1]);
        let (low, high) = heights.fold((f64::MAX, f64::MIN), |(l, h), z| (l.min(z), h.max(z)));
        let share = rms / (high - low);
        println!(
            "measured {}: crest-to-crest {:.1} um (measured {width:.1}), depth {:.2} ({depth:.2}), crests {:.2} \
             and {:.2} ({left:.2} and {right:.2}), RMS {:.2} % of peak-to-valley",
            steel.name,
            section.crest_width_mm() * 1e3,
            section.depth_mm() * 1e3,
            section.left().height_mm * 1e3,
            section.right().height_mm * 1e3,
            share * 100.0,
        );
        assert!(share <= 0.04, "{}: RMS {share}", steel.name);
    }
}

/// The comparison can fail: another steel's parameters do not fit.
#[test]
fn parameters_matter() {
    let vertices: Vec<[f64; 2]> = STEELS[1]
        .section()
        .vertices()
        .iter()
        .map(|v| v.to_array())
        .collect();
    let measured = STEELS[0].measured();
    let (_, _, rms) = placed(&measured, &vertices);
    let (_, _, own) = placed(
        &measured,
        &STEELS[0]
            .section()
            .vertices()
            .iter()
            .map(|v| v.to_array())
            .collect::<Vec<_>>(),
    );
    assert!(rms > 2.0 * own, "{rms} is no worse than {own}");
}
