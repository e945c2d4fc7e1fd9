//! Pearson's chi-square test of counts against what is expected.

use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Cells that fewer are expected in are put together.
const LEAST_EXPECTED: f64 = 8.0;

/// How likely counts are to be as far from what is expected, or further; nothing if all fall into one cell. `cells` are
/// pairs of count and expected count.
pub(crate) fn p_value(mut cells: Vec<(f64, f64)>) -> Option<f64> {
    cells.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (mut statistic, mut used, mut rest) = (0.0, 0_u32, (0.0, 0.0));
    for (count, expected) in cells {
        rest = (rest.0 + count, rest.1 + expected);
        if rest.1 >= LEAST_EXPECTED {
            statistic += (rest.0 - rest.1).powi(2) / rest.1;
            used += 1;
            rest = (0.0, 0.0);
        }
    }
    let freedom = used.checked_sub(1).filter(|freedom| *freedom > 0)?;
    Some(ChiSquared::new(f64::from(freedom)).unwrap().sf(statistic))
}
