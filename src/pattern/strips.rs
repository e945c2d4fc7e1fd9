//! Strips side by side across a scratch: on a smooth finish the slopes of some of them decide what is seen.

/// Strips of equal width, from the left end of a cross-section to its right one.
pub(crate) const STRIPS: usize = 8;

/// A number for each of them.
pub(crate) type Strips = [f32; STRIPS];

/// Shares of strips that are all alike.
pub(crate) const EVEN: Strips = [1.0 / STRIPS as f32; STRIPS];

/// Shares that add up to 1.
pub(super) fn shares(of: Strips) -> Strips {
    let sum: f32 = of.iter().sum();
    if sum > 0.0 && sum.is_finite() {
        of.map(|strip| strip / sum)
    } else {
        EVEN
    }
}
