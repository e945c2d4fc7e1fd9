//! Nothing shines brighter than its light, and whole pixels look the same both ways.

use super::distribution::INTEGRALS;
use super::each;
use super::scenes::{ALL, PATTERNS, materials};
use super::support::{SHEET_MM, any_direction, direction, random, sheet_of, single};
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, Scratch, SurfacePoint};
use striae::scattering::{Output, Sample, Shading, Vectors};

/// White scratches on a white surface reflect no more than they get, from wherever they are seen.
#[test]
fn no_light_is_gained() {
    let (mut most, mut failed) = (0.0_f64, Vec::new());
    for (prepared, integrals) in ALL.iter().zip(&*INTEGRALS) {
        let reflected: f64 = integrals.iter().map(|[_, f]| f).sum();
        most = most.max(reflected);
        if reflected > 1.0 + 1e-3 {
            failed.push(format!("{}: {reflected}", prepared.name));
        }
    }
    println!("{} points: {most:.5} reflected at most", ALL.len());
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Samples that a mean takes: its error is a tenth of what may be gained.
const SAMPLES: usize = 8192;

/// What all samples of a point count on average: the share of light that it reflects. Roberts's sequence, evenly spread.
fn reflected(shading: &Shading) -> f64 {
    let steps = [0.819_172_513_396, 0.671_043_606_704, 0.549_700_477_902];
    let [x, y, z] = steps.map(|step: f64| {
        let places = (0..SAMPLES).map(|i| single((0.5 + i as f64 * step).fract()));
        places.collect::<Vec<f32>>()
    });
    let all = Vectors {
        x: &x,
        y: &y,
        z: &z,
        stride: 1,
    };
    let mut sum = 0.0;
    let tell =
        |_, sample: Option<Sample>| sum += sample.map_or(0.0, |one| f64::from(one.weight[0]));
    shading.sample_many(&all, SAMPLES, tell).unwrap();
    sum / SAMPLES as f64
}

/// The same from a regular grid of views, in a pixel within scratches and in one around them, told apart and as a crowd.
#[test]
fn no_light_is_gained_on_a_grid_of_views() {
    let grid: Vec<_> = [0.0, 20.0, 40.0, 60.0, 75.0, 85.0]
        .into_iter()
        .flat_map(|zenith_deg| (0..8).map(move |k| (zenith_deg, 45.0 * f64::from(k))))
        .collect();
    let size = single(SHEET_MM);
    let judge = |_: usize, (name, pattern): &(String, Pattern)| {
        let mut most = (0.0_f64, String::new());
        for radius_mm in [0.05, 1.0] {
            let point = SurfacePoint {
                uv: [0.5; 2],
                dp_du: [size, 0.0, 0.0],
                dp_dv: [0.0, size, 0.0],
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Radius(radius_mm),
            };
            for &(zenith_deg, azimuth_deg) in &grid {
                let mut shading = Shading::default();
                let view = direction(zenith_deg, azimuth_deg);
                shading.shade(pattern, &point, view).unwrap();
                let share = reflected(&shading);
                if share > most.0 {
                    most = (
                        share,
                        format!("{name}, {radius_mm} mm, from {view:?}: {share:.5}"),
                    );
                }
            }
        }
        most
    };
    for (most, told) in each(&PATTERNS, judge) {
        println!("at most {told}");
        assert!(most < 1.003, "{told}");
    }
}

/// So many scratches side by side across the sheet's middle, this far apart.
fn side_by_side(material: &Material, count: u32, apart_mm: f64) -> Pattern {
    let mut builder = sheet_of(material);
    let tool = Tool::rockwell_c();
    for i in 0..count {
        let v = 0.5 + apart_mm * (f64::from(i) - 0.5 * f64::from(count - 1)) / SHEET_MM;
        builder
            .add(&Scratch {
                path: Path::Polyline(&[[0.2, v], [0.8, v]]),
                keys: &[Key::force(0.0, 1.0)],
                ..Scratch::new(&tool)
            })
            .unwrap();
    }
    builder.build()
}

/// Light and view swapped give the same, wherever the pixel holds all of its scratches: few, told apart, and a crowd.
#[test]
fn whole_pixels_are_reciprocal() {
    let mut random = random(75);
    let size = single(SHEET_MM);
    let mut worst = 0.0_f64;
    for (name, [scratched, surface]) in materials() {
        let material = Material::new(150.0, surface, scratched);
        for (count, apart_mm) in [(3, 0.7), (12, 0.7), (300, 0.7)] {
            let pattern = side_by_side(&material, count, apart_mm);
            let half_mm = 0.5 * apart_mm * f64::from(count) + 5.0;
            let point = SurfacePoint {
                uv: [0.5; 2],
                dp_du: [size, 0.0, 0.0],
                dp_dv: [0.0, size, 0.0],
                normal: [0.0, 0.0, 1.0],
                footprint: Footprint::Radius(single(half_mm)),
            };
            let f = |view, light| {
                let mut shading = Shading::default();
                shading.shade(&pattern, &point, view).unwrap();
                f64::from(shading.eval(light, Output::Brdf)[0])
            };
            for _ in 0..100 {
                let [a, b] = [0, 1].map(|_| any_direction(&mut random, 85.0));
                let (there, back) = (f(a, b), f(b, a));
                let off = (there - back).abs() / there.max(back).max(1e-4);
                worst = worst.max(off);
                assert!(
                    off < 1e-4,
                    "{name}, {count} scratches: {there} from {a:?} to {b:?}, {back} back"
                );
            }
        }
    }
    println!("reciprocity: {worst:.1e}");
}
