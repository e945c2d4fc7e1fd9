//! Zones cut where a cross-section passes from one layer of the material into the next.

use super::track::MOST_VERTICES;

/// As many vertices as a cross-section has at most once it is cut.
pub(crate) const MOST_CUT: usize = MOST_VERTICES + 16;

/// Where a cross-section goes whose every facet lies in one layer.
#[derive(Debug)]
pub(crate) struct Layered<'s> {
    pub x: &'s mut [f32],
    pub z: &'s mut [f32],
    /// The layer of the facet that each vertex begins, 0 the top one.
    pub layer: &'s mut [u8],
}

impl Layered<'_> {
    /// Whether any vertex lies where the one before it does.
    pub(crate) fn has_doubles(xs: &[f32], zs: &[f32]) -> bool {
        let pairs = xs.windows(2).zip(zs.windows(2));
        let doubles = pairs.map(|(x, z)| (x[0] == x[1]) & (z[0] == z[1]));
        doubles.fold(false, |any, double| any | double)
    }

    /// Cuts a cross-section (its outermost two facets on each side are a peak's flanks) at the `interfaces`,
    /// z from the surface down, mm; how many vertices that gives. Where room runs out (the shape's own vertices must
    /// find some), interfaces are left out.
    ///
    /// Piled-up material keeps the layer that it came from: the outer flanks show the top layer, the inner
    /// flanks the deepest one that the groove reaches.
    pub(crate) fn cut(
        self,
        xs: &[f32],
        zs: &[f32],
        interfaces: impl Iterator<Item = f32> + Clone,
    ) -> usize {
        let mut cut = Cut {
            slots: self,
            count: 0,
        };
        if interfaces.clone().next().is_none() {
            xs.iter().zip(zs).for_each(|(&x, &z)| cut.push([x, z], 0));
            return cut.count;
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
        cut.count
    }
}

/// A cross-section as far as it is cut.
struct Cut<'s> {
    slots: Layered<'s>,
    count: usize,
}

impl Cut<'_> {
    fn room(&self) -> usize {
        self.slots.x.len().min(MOST_CUT)
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
            if from == 0.0 || self.count + to_come < self.room() {
                self.push(at(from), layer_at(at(0.5 * (from + to))[1]));
            }
            from = to;
        }
    }

    /// A vertex where the last one is takes its place: facets without length would fill a shading point for
    /// nothing.
    fn push(&mut self, [x, z]: [f32; 2], layer: u8) {
        let Layered {
            x: xs,
            z: zs,
            layer: layers,
        } = &mut self.slots;
        if self.count > 0 && xs[self.count - 1] == x && zs[self.count - 1] == z {
            self.count -= 1;
        }
        if self.count < xs.len() {
            (xs[self.count], zs[self.count], layers[self.count]) = (x, z, layer);
            self.count += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(xs: &[f32], zs: &[f32], interfaces: &[f32]) -> (Vec<f32>, Vec<f32>, Vec<u8>) {
        let (mut x, mut z, mut layer) = (vec![0.0; 20], vec![0.0; 20], vec![0; 20]);
        let slots = Layered {
            x: &mut x,
            z: &mut z,
            layer: &mut layer,
        };
        let count = slots.cut(xs, zs, interfaces.iter().copied());
        x.truncate(count);
        z.truncate(count);
        layer.truncate(count);
        (x, z, layer)
    }

    /// A V through two interfaces: its walls are cut at both, each part shows its layer, the peaks theirs.
    #[test]
    fn v_through_two_layers() {
        let xs = [-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0];
        let zs = [0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0];
        let (x, z, layer) = cut(&xs, &zs, &[-0.25, -0.75]);
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
        let (x, _, layer) = cut(&xs, &zs, &[]);
        assert_eq!(x, xs);
        assert_eq!(layer, [0; 5]);
    }
}
