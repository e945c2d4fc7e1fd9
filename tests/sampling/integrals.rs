//! Integrals over all lights of a shading point, cell by cell, as finely as they need.

use super::scenes::Prepared;
use super::support::single;
use std::f64::consts::TAU;

/// Cells, by the cosine to the normal and by azimuth: equal solid angles.
pub(crate) const CELLS: [usize; 2] = [16, 32];

/// A cell is divided until that changes its integrals by no more than this, but not more often than this.
const SETTLED: f64 = 3e-6;
const MOST_DIVISIONS: u32 = 4;

/// Gauss and Legendre's places and weights, as shares of an interval.
const PLACES: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// Density, and BRDF times cosine (first channel).
type Both = [f64; 2];

/// The cell that a light lies in.
pub(crate) fn cell(light: [f32; 3]) -> usize {
    let [x, y, z] = light.map(f64::from);
    let around = y.atan2(x).rem_euclid(TAU) / TAU;
    number(z, CELLS[0]) * CELLS[1] + number(around, CELLS[1])
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "0 to 1 times a small count"
)]
fn number(share: f64, count: usize) -> usize {
    ((share * count as f64) as usize).min(count - 1)
}

/// The integrals over each cell.
pub(crate) fn cells(prepared: &Prepared) -> Vec<Both> {
    let size = [1.0 / CELLS[0] as f64, 1.0 / CELLS[1] as f64];
    let mut all = Vec::new();
    for (i, j) in (0..CELLS[0]).flat_map(|i| (0..CELLS[1]).map(move |j| (i, j))) {
        let corner = [i as f64 * size[0], j as f64 * size[1]];
        let coarse = rule(prepared, corner, size);
        all.push(divided(prepared, corner, size, coarse, MOST_DIVISIONS));
    }
    all
}

fn divided(prepared: &Prepared, [z, t]: [f64; 2], size: [f64; 2], coarse: Both, left: u32) -> Both {
    let half = size.map(|s| 0.5 * s);
    let corners = [
        [z, t],
        [z + half[0], t],
        [z, t + half[1]],
        [z + half[0], t + half[1]],
    ];
    let parts = corners.map(|corner| rule(prepared, corner, half));
    let sum = parts.into_iter().fold([0.0; 2], plus);
    let change = (sum[0] - coarse[0]).abs().max((sum[1] - coarse[1]).abs());
    if change < SETTLED || left == 0 {
        return sum;
    }
    corners
        .into_iter()
        .zip(parts)
        .map(|(corner, part)| divided(prepared, corner, half, part, left - 1))
        .fold([0.0; 2], plus)
}

fn plus(a: Both, b: Both) -> Both {
    [a[0] + b[0], a[1] + b[1]]
}

fn rule(prepared: &Prepared, [z, t]: [f64; 2], size: [f64; 2]) -> Both {
    let mut sum = [0.0; 2];
    for [i, a] in PLACES {
        let z = z + i * size[0];
        let radius = (1.0 - z * z).max(0.0).sqrt();
        for [j, b] in PLACES {
            let (y, x) = (TAU * (t + j * size[1])).sin_cos();
            let light = [radius * x, radius * y, z].map(single);
            let both = prepared.shading.eval_pdf(light);
            let weight = a * b * size[0] * size[1] * TAU;
            let here = [both.pdf, both.brdf_cos[0]].map(|value| weight * f64::from(value));
            sum = plus(sum, here);
        }
    }
    sum
}
