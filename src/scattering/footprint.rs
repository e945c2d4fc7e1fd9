//! How much of a pixel's box filter falls between two lines along a scratch (section 3 of the model: the
//! distribution T, here from any convex region).

mod build;
mod merge;
mod steps;

pub(super) use merge::Surplus;
pub(super) use steps::Steps;

use crate::lanes::Number;

/// Pieces of density that a shading point holds for all its scratches together: three for each that crosses the
/// pixel, more where others cross it.
pub(super) const MOST_DENSITIES: usize = 86;

/// Regions that have one density together.
pub(super) const MOST_PARTS: usize = 8;

/// A place is found by so many halvings.
const HALVINGS: u32 = 20;

/// The densities of all scratches of a shading point.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Densities<const MOST: usize = MOST_DENSITIES> {
    pieces: [Piece; MOST],
    used: u32,
}

/// The density of a pixel's filter across one scratch: piecewise linear in x, the place across the scratch
/// relative to its centre line, mm. The whole pixel weighs 1.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Weight {
    first: u32,
    count: u32,
    /// What of the flat surface beside the scratch belongs to the pixel, mm.
    window: [f32; 2],
}

/// Between two neighbouring corners of a region. Its weight is kept as such, not as a density: a pixel far
/// smaller than the scratch has places that single precision hardly tells apart, and must still weigh 1.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct Piece {
    from: f32,
    to: f32,
    weight: f32,
    /// Density at the right end over the mean density, minus 1: -1 to 1.
    skew: f32,
}

impl Weight {
    pub(crate) const NONE: Self = Self {
        first: 0,
        count: 0,
        window: [0.0; 2],
    };

    /// The same of a scratch that leaves the flat surface beneath it as it is.
    #[cfg(feature = "files")]
    pub(crate) fn taking_nothing(self) -> Self {
        Self {
            window: [0.0; 2],
            ..self
        }
    }
}

impl<const MOST: usize> Densities<MOST> {
    pub(crate) const EMPTY: Self = Self {
        pieces: [Piece {
            from: 0.0,
            to: 0.0,
            weight: 0.0,
            skew: 0.0,
        }; MOST],
        used: 0,
    };

    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        self.used = 0;
    }

    /// What was added since there were `first` pieces.
    fn weight_from(&self, first: u32) -> Weight {
        let mut weight = Weight {
            first,
            count: self.used - first,
            window: [0.0; 2],
        };
        weight.window = self.support(&weight);
        weight
    }

    fn pieces(&self, weight: &Weight) -> &[Piece] {
        let first = weight.first as usize;
        &self.pieces[first..first + weight.count as usize]
    }

    /// Where the density is above 0, from and to.
    fn support(&self, weight: &Weight) -> [f32; 2] {
        let pieces = self.pieces(weight).iter();
        let all = pieces.map(|piece| [piece.from, piece.to]);
        let all = all.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        all.unwrap_or([0.0; 2])
    }

    /// The weight between x = `from` and x = `to`; 0 if they are swapped.
    #[inline(always)]
    pub(crate) fn between<F: Number>(&self, weight: &Weight, from: F, to: F) -> F {
        let mut sum = from.like(0.0);
        for piece in self.pieces(weight) {
            sum = sum + piece.between(from, to);
        }
        sum
    }

    /// The weight of the flat surface that the scratch takes from the pixel between x = `from` and `to`.
    #[inline(always)]
    pub(crate) fn taken<F: Number>(&self, weight: &Weight, ends: [F; 2]) -> F {
        let [first, last] = weight.window;
        let [from, to] = ends;
        let (first, last) = (from.like(first), from.like(last));
        let (from, to) = (from.max(first).min(last), to.max(first).min(last));
        self.between(weight, from, to)
    }

    /// Where between two places the share `u` of the weight between them is reached.
    pub(crate) fn place(&self, weight: &Weight, [from, to]: [f32; 2], u: f32) -> f32 {
        let wanted = u * self.between(weight, from, to);
        let (mut low, mut high) = (from, to);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.between(weight, from, middle) < wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// Whether any of `from..to` weighs anything.
    #[inline(always)]
    pub(crate) fn touches(&self, weight: &Weight, [from, to]: [f32; 2]) -> bool {
        let meets = |[first, last]: [f32; 2]| from <= last && to >= first;
        // Mostly that is where it weighs anything, and never more.
        weight.count > 0 && (meets(weight.window) || meets(self.support(weight)))
    }
}

impl Piece {
    /// A share of what lies between two places within it.
    fn part(&self, [from, to]: [f32; 2], share: f32) -> Self {
        if [from, to] == [self.from, self.to] {
            return Self {
                weight: share * self.weight,
                ..*self
            };
        }
        // From -1 at its left end to 1 at its right one.
        let off_middle = |at: f32| ((at - self.from) - (self.to - at)) / (self.to - self.from);
        let [left, right] = [from, to].map(|at| off_middle(at) * self.skew + 1.0);
        Self {
            from,
            to,
            weight: share * self.between(from, to),
            skew: (right - left) / (right + left).max(f32::MIN_POSITIVE),
        }
    }

    /// The part of its weight between x = `from` and x = `to`. Differences are taken of places, never of
    /// running sums, so that a facet a millionth of the pixel keeps its digits.
    #[inline(always)]
    fn between<F: Number>(&self, from: F, to: F) -> F {
        let (none, all) = (from.like(0.0), from.like(self.weight));
        let (first, last) = (from.like(self.from), from.like(self.to));
        let width = self.to - self.from;
        if width <= 0.0 {
            // Thinner than single precision can tell: all of it lies at one place.
            let ends_after = to.if_above(first, all, none);
            return from.if_above(first, none, ends_after);
        }
        let (a, b) = (from.max(first), to.min(last));
        let off_middle = ((a - self.from) - (-b + self.to)) / width;
        let share = (b - a) / width * (off_middle * self.skew + 1.0);
        let inside = b.if_above(a, share * self.weight, none);
        // Exactly all of it, if both ends lie outside.
        let to_the_end = last.if_above(to, inside, all);
        from.if_above(first, inside, to_the_end)
    }
}

#[cfg(test)]
mod tests;
