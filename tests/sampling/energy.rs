//! Nothing shines brighter than its light, and whole pixels look the same both ways.

use super::distribution::INTEGRALS;
use super::scenes::ALL;

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
