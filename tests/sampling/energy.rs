//! Nothing shines brighter than its light, and whole pixels look the same both ways.

use super::distribution::INTEGRALS;
use super::scenes::{ALL, materials};
use super::support::{SHEET_MM, any_direction, random, sheet_of, single};
use striae::formation::{Material, Tool};
use striae::pattern::{Footprint, Key, Path, Pattern, Scratch, SurfacePoint};
use striae::scattering::{Output, Shading};

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
