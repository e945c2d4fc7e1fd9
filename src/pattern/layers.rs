//! Zones cut where a cross-section passes from one layer of the material into the next.

use super::track::MOST_VERTICES;

/// Interfaces crossed by one cross-section are cut as long as there is room for this many vertices.
const MOST_CUT: usize = MOST_VERTICES + 16;

/// A cross-section whose every facet lies in one layer.
#[derive(Debug)]
pub(crate) struct Layered {
    x: [f32; MOST_CUT],
    z: [f32; MOST_CUT],
    /// The layer of each facet, 0 the top one.
    layer: [u8; MOST_CUT],
    count: usize,
}

impl Layered {
    /// Cuts a cross-section (its outermost two facets on each side are a peak's flanks) at the `interfaces`,
    /// z from the surface down, mm.
    ///
    /// Piled-up material keeps the layer that it came from: the outer flanks show the top layer, the inner
    /// flanks the deepest one that the groove reaches.
    pub(crate) fn cut(
        xs: &[f32],
        zs: &[f32],
        interfaces: impl Iterator<Item = f32> + Clone,
    ) -> Self {
        let mut cut = Self {
            x: [0.0; MOST_CUT],
            z: [0.0; MOST_CUT],
            layer: [0; MOST_CUT],
            count: 0,
        };
        if interfaces.clone().next().is_none() {
            xs.iter().zip(zs).for_each(|(&x, &z)| cut.push([x, z], 0));
            return cut;
        }
        let layer_at = |z: f32| {
            interfaces
                .clone()
                .map(|interface| u8::from(z < interface))
                .sum()
        };
        let deepest: u8 = layer_at(zs.iter().copied().fold(0.0, f32::min));
        let facets = xs.len() - 1;
        for k in 0..facets {
            let (a, b) = ([xs[k], zs[k]], [xs[k + 1], zs[k + 1]]);
            match k.min(facets - 1 - k) {
                0 => cut.push(a, 0),
                1 => cut.push(a, deepest),
                _ => cut.push_groove(a, b, facets - k + 1, interfaces.clone(), layer_at),
            }
        }
        cut.push([xs[facets], zs[facets]], 0);
        cut
    }

    /// Appends the start of a groove facet, and its crossings with the interfaces in order, as far as there
    /// is room besides the vertices still `to_come`.
    fn push_groove(
        &mut self,
        a: [f32; 2],
        b: [f32; 2],
        to_come: usize,
        interfaces: impl Iterator<Item = f32>,
        layer_at: impl Fn(f32) -> u8,
    ) {
        let mut shares = [1.0_f32; 8];
        let mut crossings = 0;
        for interface in interfaces {
            let share = (interface - a[1]) / (b[1] - a[1]);
            if share > 0.0 && share < 1.0 && crossings < 7 {
                shares[crossings] = share;
                crossings += 1;
            }
        }
        shares[..crossings].sort_unstable_by(f32::total_cmp);
        let mut from = 0.0;
        for &to in &shares[..=crossings] {
            let at = |share: f32| [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
            if from == 0.0 || self.count + to_come < MOST_CUT {
                self.push(at(from), layer_at(at(0.5 * (from + to))[1]));
            }
            from = to;
        }
    }

    /// Vertices x and z, and the layer of the facet that each begins.
    pub(crate) fn parts(&self) -> (&[f32], &[f32], &[u8]) {
        (
            &self.x[..self.count],
            &self.z[..self.count],
            &self.layer[..self.count],
        )
    }

    /// A vertex where the last one is takes its place: facets without length would fill a shading point for
    /// nothing.
    fn push(&mut self, [x, z]: [f32; 2], layer: u8) {
        if self.count > 0 && [self.x[self.count - 1], self.z[self.count - 1]] == [x, z] {
            self.count -= 1;
        }
        if self.count < MOST_CUT {
            self.x[self.count] = x;
            self.z[self.count] = z;
            self.layer[self.count] = layer;
            self.count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A V through two interfaces: its walls are cut at both, each part shows its layer, the peaks theirs.
    #[test]
    fn v_through_two_layers() {
        let xs = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0];
        let zs = [0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0];
        let cut = Layered::cut(&xs, &zs, [-0.25, -0.75].into_iter());
        let (x, z, layer) = cut.parts();
        assert_eq!(
            x,
            [
                -3.0, -2.0, -1.0, -0.75, -0.25, 0.0, 0.25, 0.75, 1.0, 2.0, 3.0
            ]
        );
        assert_eq!(z[3..8], [-0.25, -0.75, -1.0, -0.75, -0.25]);
        assert_eq!(layer, [0, 2, 0, 1, 2, 2, 1, 0, 2, 0, 0]);
    }

    /// Without interfaces nothing is cut.
    #[test]
    fn nothing_to_cut() {
        let (xs, zs) = ([-1.0, -0.5, 0.0, 0.5, 1.0], [0.0, 0.5, -1.0, 0.5, 0.0]);
        let cut = Layered::cut(&xs, &zs, core::iter::empty());
        assert_eq!(cut.parts().0, xs);
        assert_eq!(cut.parts().2, [0; 5]);
    }
}
