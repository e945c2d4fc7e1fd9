//! Light that meets several zones of a scratch, against a path tracer of its own in the explicit cross-section, and in
//! white surroundings that must stay white.

mod support;

use rand::Rng;
use rand::rngs::StdRng;
use striae::brdf::{Brdf, Facet, Fresnel, Metal};
use striae::formation::{CrossSection, Material, Orientation, Process, Tool};
use striae::scattering::{Bounces, CrossFootprint, Output, Shading};
use support::{direction, lambert, random, single};

/// Paths of the path tracer per pair of directions.
const PATHS: u32 = 600_000;

/// What the groove's zones and the flat surface reflect of all light.
const ALBEDO: f64 = 0.9;

/// A cross-section's points (x, z), mm.
fn section(
    tool: &Tool,
    hardness_hv: f64,
    force_kgf: f64,
    tilt_deg: f64,
    azimuth_deg: f64,
) -> Vec<[f32; 2]> {
    let process = Process {
        force_kgf,
        orientation: Orientation {
            tilt_deg,
            azimuth_deg,
            ..Orientation::default()
        },
        ..Process::default()
    };
    let material = Material::new(hardness_hv, lambert(0.9), lambert(0.9));
    let section = CrossSection::form(tool, &process, &material).unwrap();
    let vertices = section.vertices();
    // As many points as a shading point takes: all of the peaks', every so many of the groove's.
    let (count, step) = (vertices.len(), vertices.len().div_ceil(60));
    let numbers = (0..count).filter(|i| i % step == 0 || *i < 3 || *i >= count - 3);
    numbers
        .map(|i| [single(vertices[i].x), single(vertices[i].y)])
        .collect()
}

fn width(points: &[[f32; 2]]) -> f32 {
    points[points.len() - 1][0] - points[0][0]
}

fn shaded(
    points: &[[f32; 2]],
    brdf: &Brdf,
    pixel: CrossFootprint,
    view: [f32; 3],
    bounces: Bounces,
) -> Shading {
    let mut shading = Shading::default();
    shading
        .shade_cross_section(points, brdf, brdf, pixel, view)
        .unwrap();
    shading.set_bounces(bounces);
    shading
}

/// A cross-section between wide flats, of one base BRDF all over.
struct Scene {
    points: Vec<[f64; 2]>,
    facets: Vec<Facet>,
}

impl Scene {
    fn new(points: &[[f32; 2]], brdf: &Brdf) -> Self {
        let wide = 1e3 * f64::from(width(points));
        let own = points.iter().map(|p| p.map(f64::from));
        let ends = |x: f64| std::iter::once([x, 0.0]);
        let points: Vec<_> = ends(-wide).chain(own).chain(ends(wide)).collect();
        let tilt = |pair: &[[f64; 2]]| (pair[0][1] - pair[1][1]).atan2(pair[1][0] - pair[0][0]);
        let facet = |pair: &[[f64; 2]]| Facet::new(*brdf, tilt(pair).to_degrees()).unwrap();
        let facets = points.windows(2).map(facet).collect();
        Self { points, facets }
    }

    /// The first facet that a ray meets, and where; the ray starts on facet `from`, or nowhere.
    fn met(&self, [x, z]: [f64; 2], d: [f64; 3], from: Option<usize>) -> Option<(usize, [f64; 2])> {
        let mut nearest: Option<(f64, usize)> = None;
        for k in (0..self.points.len() - 1).filter(|&k| Some(k) != from) {
            let ([ax, az], [bx, bz]) = (self.points[k], self.points[k + 1]);
            let (ex, ez) = (bx - ax, bz - az);
            let det = d[0] * ez - d[2] * ex;
            if det == 0.0 {
                continue;
            }
            let t = ((ax - x) * ez - (az - z) * ex) / det;
            let s = ((ax - x) * d[2] - (az - z) * d[0]) / det;
            if t > 0.0 && (0.0..=1.0).contains(&s) && nearest.is_none_or(|(best, _)| t < best) {
                nearest = Some((t, k));
            }
        }
        nearest.map(|(t, k)| (k, [x + t * d[0], z + t * d[2]]))
    }

    /// Radiance after one bounce, and after all of them, per unit of irradiance on the flat times its cosine.
    fn traced(
        &self,
        window: [f64; 2],
        view: [f64; 3],
        light: [f64; 3],
        random: &mut StdRng,
    ) -> [f64; 2] {
        let high = self.points.iter().fold(0.0_f64, |most, p| most.max(p[1])) + 1.0;
        let mut sums = [0.0; 2];
        for _ in 0..PATHS {
            let x = random.random_range(window[0]..window[1]);
            let above = [x + view[0] / view[2] * high, high];
            let Some((mut k, mut at)) = self.met(above, view.map(|c| -c), None) else {
                continue;
            };
            let (mut weight, mut view) = (1.0, view.map(single));
            for bounce in 0..40 {
                let facet = &self.facets[k];
                if self.met(at, light, Some(k)).is_none() {
                    let direct = weight * f64::from(facet.eval(view, light.map(single))[0]);
                    sums[0] += if bounce == 0 { direct } else { 0.0 };
                    sums[1] += direct;
                }
                let Some(next) = facet.sample([random.random(), random.random()], view) else {
                    break;
                };
                weight *= f64::from(facet.eval(view, next)[0] / facet.pdf(view, next));
                let Some(met) = self.met(at, next.map(f64::from), Some(k)) else {
                    break;
                };
                view = next.map(|c| -c);
                (k, at) = met;
            }
        }
        sums.map(|sum| sum / f64::from(PATHS))
    }
}

/// The three grooves of a Rockwell tip: untilted 2 kgf on 300 HV, 20 degrees to the side 4 kgf on 100 HV, 10 degrees
/// askew 1 kgf on 40 HV.
fn grooves() -> [(&'static str, Vec<[f32; 2]>); 3] {
    let tip = Tool::rockwell_c();
    [
        ("untilted", section(&tip, 300.0, 2.0, 0.0, 0.0)),
        ("to the side", section(&tip, 100.0, 4.0, 20.0, 90.0)),
        ("askew", section(&tip, 40.0, 1.0, 10.0, 45.0)),
    ]
}

fn pairs() -> [([f32; 3], [f32; 3]); 3] {
    [
        (direction(0.0, 0.0), direction(30.0, 20.0)),
        (direction(40.0, 10.0), direction(45.0, 170.0)),
        (direction(60.0, 200.0), direction(20.0, 80.0)),
    ]
}

/// What is traced and what is evaluated, each with one bounce and with all, in a pixel three scratches wide.
fn compared(
    what: &str,
    scene: &Scene,
    points: &[[f32; 2]],
    brdf: &Brdf,
    view: [f32; 3],
    light: [f32; 3],
    random: &mut StdRng,
) -> [[f64; 2]; 2] {
    let width = width(points);
    let window = [points[0][0] - width, points[points.len() - 1][0] + width].map(f64::from);
    let truth = scene.traced(window, view.map(f64::from), light.map(f64::from), random);
    let ours = [Bounces::One, Bounces::All].map(|bounces| {
        let pixel = CrossFootprint::Whole { margin_mm: width };
        let shading = shaded(points, brdf, pixel, view, bounces);
        f64::from(shading.eval(light, Output::BrdfCos)[0])
    });
    println!(
        "{what}: {:+.2} % traced, {:+.2} % evaluated; off by {:.1e} and {:.1e}",
        100.0 * (truth[1] / truth[0] - 1.0),
        100.0 * (ours[1] / ours[0] - 1.0),
        ours[0] / truth[0] - 1.0,
        ours[1] / truth[1] - 1.0
    );
    [truth, ours]
}

/// With one bounce and with all, both ways of asking agree with paths traced in the explicit cross-section within 1 %.
#[test]
fn agrees_with_a_path_tracer() {
    let mut random = random(5);
    let brdf = lambert(single(ALBEDO));
    for (name, points) in grooves() {
        let scene = Scene::new(&points, &brdf);
        for (view, light) in pairs() {
            let [truth, ours] = compared(name, &scene, &points, &brdf, view, light, &mut random);
            for (ours, truth) in ours.into_iter().zip(truth) {
                assert!(
                    (ours / truth - 1.0).abs() < 0.01,
                    "{name}: {ours} against {truth}"
                );
            }
            let more = (ours[1] - ours[0]) / (truth[1] - truth[0]);
            assert!(
                (more - 1.0).abs() < 0.2,
                "{name}: further bounces count {more} times too much"
            );
        }
    }
}

/// The same of metals, rough to smooth, which pass light on by its direction; also under grazing light.
#[test]
fn gloss_agrees_with_a_path_tracer() {
    let mut random = random(7);
    let (eta, k) = Metal::Steel.eta_k();
    let metal = |alpha| Brdf::Ggx {
        alpha,
        fresnel: Fresnel::Conductor { eta, k },
    };
    let brdfs = [
        ("rough metal", metal(0.4)),
        ("satin metal", metal(0.15)),
        ("smooth metal", metal(0.05)),
    ];
    let pairs = pairs().into_iter().chain([
        (direction(35.0, 30.0), direction(75.0, 180.0)),
        (direction(10.0, 90.0), direction(70.0, 0.0)),
    ]);
    for (view, light) in pairs {
        for (name, points) in grooves() {
            for (finish, brdf) in brdfs {
                let scene = Scene::new(&points, &brdf);
                let what = format!("{name}, {finish}");
                let [truth, ours] =
                    compared(&what, &scene, &points, &brdf, view, light, &mut random);
                let off = (ours[1] / truth[1] - 1.0).abs();
                assert!(off < 0.01, "{what}: {ours:?} against {truth:?}");
            }
        }
    }
}

/// What samples count on average, and how far chance may move that.
fn albedo(shading: &Shading, samples: u32, random: &mut StdRng) -> (f64, f64) {
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..samples {
        let u = [random.random(), random.random(), random.random()];
        let weight = shading
            .sample(u)
            .map_or(0.0, |sample| f64::from(sample.weight[0]));
        sum += weight;
        squares += weight * weight;
    }
    let mean = sum / f64::from(samples);
    let variance = squares / f64::from(samples) - mean * mean;
    (mean, (variance.max(0.0) / f64::from(samples)).sqrt())
}

/// Nothing is lost in a groove that absorbs nothing: every tool, tilt and view up to 85 degrees.
#[test]
fn white_stays_white() {
    let mut random = random(6);
    let mirror = Brdf::Ggx {
        alpha: 0.001,
        fresnel: Fresnel::Schlick { f0: [1.0; 3] },
    };
    let mut failed = Vec::new();
    let mut worst = 0.0_f64;
    for (name, brdf) in [("white", lambert(1.0)), ("mirror", mirror)] {
        for (tool_name, tool) in [
            ("rockwell", Tool::rockwell_c()),
            ("vickers", Tool::vickers()),
            ("graver", Tool::round_graver()),
            ("nail", Tool::nail()),
            ("grain", Tool::abrasive_grain()),
        ] {
            for [tilt, azimuth] in [[0.0, 0.0], [20.0, 90.0], [10.0, 45.0]] {
                let points = section(&tool, 100.0, 0.5, tilt, azimuth);
                for zenith in [0.0, 40.0, 75.0, 85.0] {
                    for view_azimuth in [0.0, 70.0, 180.0] {
                        let view = direction(zenith, view_azimuth);
                        let pixel = CrossFootprint::Box {
                            center_mm: 0.0,
                            extents_mm: [3.0 * f64::from(width(&points)), 0.01],
                        };
                        let shading = shaded(&points, &brdf, pixel, view, Bounces::All);
                        let (albedo, chance) = albedo(&shading, 4000, &mut random);
                        worst = worst.max((albedo - 1.0).abs());
                        if (albedo - 1.0).abs() > 2e-3 + 4.0 * chance {
                            failed.push(format!(
                                "{name} {tool_name} {tilt} {azimuth} from {zenith} {view_azimuth}: {albedo} ± {chance}"
                            ));
                        }
                    }
                }
            }
        }
    }
    println!("farthest from white: {worst:.1e}");
    assert!(failed.is_empty(), "{} failed: {failed:#?}", failed.len());
}
