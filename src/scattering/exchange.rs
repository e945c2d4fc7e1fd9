//! What the zones of a scratch reflect to one another, without chance: as if each scattered that light evenly.
//!
//! The geometry is constant along the scratch, so how much of one facet's light reaches another follows from
//! lengths of strings pulled tight between their ends, over whatever stands in between (Hottel and Sarofim 1967,
//! "Radiative transfer"). Exact where zones are Lambertian; glossy ones count with all that they reflect, but for the
//! light's first way from one to another (`gloss.rs`).

use glam::{DVec2, Vec3};

/// The flat surface beside a scratch exchanges light with it as far as the last of these many times its height; it is
/// cut there, for less and less of that light gets farther.
const FLAT_HEIGHTS: [f64; 4] = [1.0, 3.0, 8.0, 20.0];

/// Flat facets on each side.
pub(crate) const FLATS: usize = FLAT_HEIGHTS.len();

/// Corners of most cross-sections, and of all (100 vertices), with the flat surface on both sides.
pub(crate) const FEW_CORNERS: usize = 32;
pub(crate) const MOST_CORNERS: usize = 100 + 2 * FLATS;

/// Rounds of exchange, and the change that is too little for another one.
const MOST_ROUNDS: u32 = 64;
const SETTLED: f32 = 1e-5;

/// The facets of a cross-section, between the flat surface on its left and that on its right.
#[derive(Debug)]
pub(crate) struct Exchange<const CORNERS: usize> {
    corners: [DVec2; CORNERS],
    pub facets: usize,
    /// Of each facet and each later one: the share of one's light that gets to the other, times the one's width.
    shares: [[f32; CORNERS]; CORNERS],
}

impl<const CORNERS: usize> Exchange<CORNERS> {
    /// From where to where a facet reaches across.
    pub(crate) fn ends(&self, facet: usize) -> [f32; 2] {
        [facet, facet + 1].map(|corner| crate::single(self.corners[corner].x))
    }

    /// Both ends of a facet.
    pub(crate) fn corners(&self, facet: usize) -> [DVec2; 2] {
        [self.corners[facet], self.corners[facet + 1]]
    }

    /// The share of what a facet sees that is another one.
    pub(crate) fn share(&self, facet: usize, other: usize) -> f32 {
        let [a, b] = self.corners(facet);
        let width = crate::single(a.distance(b));
        let share = self.shares[facet.min(other)][facet.max(other)];
        if share > 0.0 && width > 0.0 {
            share / width
        } else {
            0.0
        }
    }

    /// Of a cross-section of no more vertices than there is room for beside the flat surface.
    pub(crate) fn new(xs: &[f32], zs: &[f32]) -> Self {
        let mut corners = [DVec2::ZERO; CORNERS];
        let vertices = xs.len().min(CORNERS - 2 * FLATS);
        let height = f64::from(zs.iter().fold(0.0_f32, |most, z| most.max(z.abs())));
        let inner = &mut corners[FLATS..FLATS + vertices];
        for (corner, (&x, &z)) in inner.iter_mut().zip(xs.iter().zip(zs)) {
            *corner = DVec2::new(x.into(), z.into());
        }
        let (first, last) = (corners[FLATS], corners[FLATS + vertices - 1]);
        for (i, heights) in FLAT_HEIGHTS.into_iter().enumerate() {
            let reach = DVec2::new(heights * height, 0.0);
            corners[FLATS - 1 - i] = first - reach;
            corners[FLATS + vertices + i] = last + reach;
        }
        let mut exchange = Self {
            corners,
            facets: vertices + 2 * FLATS - 1,
            shares: [[0.0; CORNERS]; CORNERS],
        };
        exchange.pull_strings();
        exchange
    }

    /// Crossed strings less uncrossed ones, halved.
    fn pull_strings(&mut self) {
        let mut outer = self.strings_from(0);
        for i in 0..self.facets {
            let inner = self.strings_from(i + 1);
            for j in i + 1..self.facets {
                let crossed = outer[j] + inner[j + 1];
                let share = 0.5 * (crossed - outer[j + 1] - inner[j]);
                self.shares[i][j] = crate::single(share.max(0.0));
            }
            outer = inner;
        }
    }

    /// Lengths of tight strings over the cross-section from one corner to each later one.
    fn strings_from(&self, first: usize) -> [f64; CORNERS] {
        let mut lengths = [0.0; CORNERS];
        let mut touched = [first; CORNERS];
        let mut count = 1;
        for i in first + 1..=self.facets {
            let corner = self.corners[i];
            // What lies under the string from the corner before it to this one lets go of it.
            while count > 1 {
                let (a, b) = (
                    self.corners[touched[count - 2]],
                    self.corners[touched[count - 1]],
                );
                if (b - a).perp_dot(corner - a) < 0.0 {
                    break;
                }
                count -= 1;
            }
            let last = touched[count - 1];
            lengths[i] = lengths[last] + self.corners[last].distance(corner);
            touched[count] = i;
            count += 1;
        }
        lengths
    }

    /// What reaches each facet from all others, per area: `light` gives what falls on a facet from the light, per area,
    /// and `albedo` how much of all light it reflects.
    pub(crate) fn indirect(
        &self,
        light: impl Fn(usize) -> f32,
        albedo: impl Fn(usize) -> Vec3,
    ) -> [Vec3; CORNERS] {
        let mut indirect = [Vec3::ZERO; CORNERS];
        let sent = |indirect: &[Vec3; CORNERS], j: usize| {
            albedo(j) * (Vec3::splat(light(j)) + indirect[j])
        };
        for _ in 0..MOST_ROUNDS {
            let mut change = 0.0_f32;
            for i in 0..self.facets {
                let width = crate::single(self.corners[i].distance(self.corners[i + 1]));
                let mut sum = Vec3::ZERO;
                for j in 0..self.facets {
                    let share = self.shares[i.min(j)][i.max(j)];
                    if share > 0.0 {
                        sum += share * sent(&indirect, j);
                    }
                }
                let now = if width > 0.0 { sum / width } else { Vec3::ZERO };
                change = change.max((now - indirect[i]).abs().max_element());
                indirect[i] = now;
            }
            if change < SETTLED {
                break;
            }
        }
        indirect
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In a V of 90 degrees each wall gets 1 - sin 45° of the other's light, by the closed form.
    #[test]
    fn v_groove() {
        let exchange = Exchange::<FEW_CORNERS>::new(&[-1.0, 0.0, 1.0], &[0.0, -1.0, 0.0]);
        let wall = 2.0_f32.sqrt();
        let share = exchange.shares[FLATS][FLATS + 1] / wall;
        assert!((share - (1.0 - 0.5_f32.sqrt())).abs() < 1e-6, "{share}");
        let flat = &exchange.shares[FLATS - 1];
        assert!(flat[FLATS] < 1e-9, "the flat surface does not see into it");
        assert!(flat[FLATS + 2] < 1e-9, "nor itself");
    }

    /// A peak hides what is behind it: strings lie over it.
    #[test]
    fn peak_hides() {
        let exchange =
            Exchange::<FEW_CORNERS>::new(&[-2.0, -1.0, 0.0, 1.0, 2.0], &[0.0, 1.0, 0.0, 1.0, 0.0]);
        let share = |i: usize, j: usize| exchange.shares[FLATS + i][FLATS + j];
        assert!(share(0, 1) < 1e-9, "two sides of a peak");
        assert!(share(0, 3) < 1e-9, "outer sides of two peaks");
        assert!(share(1, 2) > 0.0, "inner sides");
        let flats = exchange.shares[..FLATS].iter();
        let beside = flats.map(|shares| shares[FLATS]).sum::<f32>() / 2.0_f32.sqrt();
        // A wall of 45 degrees on a plane without end: (1 - cos 45°) / 2 of what it sees.
        let endless = 0.5 * (1.0 - 0.5_f32.sqrt());
        assert!(
            (beside - endless).abs() < 0.01,
            "{beside} against {endless}"
        );
    }
}
