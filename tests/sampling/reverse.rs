//! The density the other way round.

use super::scenes::{ALL, PATTERNS};
use super::support::{any_direction, random};
use striae::scattering::Shading;

/// It is what a point prepared from the light's side says of the view.
#[test]
fn is_the_density_from_the_other_side() {
    let mut random = random(81);
    let (mut worst, mut failed, mut all) = (0.0_f64, Vec::new(), 0);
    for prepared in &*ALL {
        let Some((number, point)) = &prepared.place else {
            continue;
        };
        for _ in 0..20 {
            let light = any_direction(&mut random, 85.0);
            let mut other = Shading::default();
            other.shade(&PATTERNS[*number].1, point, light).unwrap();
            let truth = f64::from(other.pdf(prepared.view));
            let ours = f64::from(prepared.shading.pdf_reverse(light));
            let off = (ours - truth).abs() / truth.max(1e-3);
            worst = worst.max(off);
            all += 1;
            if off > 1e-3 {
                failed.push(format!(
                    "{} for {light:?}: {ours}, not {truth}",
                    prepared.name
                ));
            }
        }
    }
    println!("{all} pairs: off by {worst:.1e}");
    assert!(
        failed.is_empty(),
        "{} failed: {}",
        failed.len(),
        failed.join("\n")
    );
}
