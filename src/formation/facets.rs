//! From a smooth groove to few facets: as many as its curvature needs, corners kept.

use super::outline::Cut;
use glam::DVec2;

/// Share of the placing measure that is arc length; the rest is turning. A little length keeps vertices
/// apart where the groove is straight.
const LENGTH_SHARE: f64 = 0.05;

/// Most facets a groove is given, however smooth its zone's finish.
pub(crate) const MOST_FACETS: usize = 28;

/// `count + 1` points along the groove, spaced evenly in a mix of turning and length.
///
/// The points move continuously as the groove changes shape, whatever its shape; a corner takes as much of
/// the measure as it turns, so that points fall on it. Depth is then stretched so that the polygon holds
/// the groove's own area.
pub(crate) fn facet_points(cut: &Cut, count: usize) -> Vec<DVec2> {
    let measured = Measured::new(&cut.points, LENGTH_SHARE);
    let mut points: Vec<DVec2> = (0..=count)
        .map(|i| measured.at(i as f64 / count as f64))
        .collect();
    let area: f64 = points
        .windows(2)
        .map(|w| -0.5 * (w[1].x - w[0].x) * (w[0].y + w[1].y))
        .sum();
    if area > 0.0 {
        let stretch = cut.measures.area_mm2 / area;
        points.iter_mut().for_each(|point| point.y *= stretch);
    }
    points
}

/// The fewest facets whose slopes follow the groove as closely as facets of `step_rad` would follow an arc.
pub(crate) fn facets_needed(cut: &Cut, step_rad: f64) -> usize {
    // The slope within an arc's facet deviates evenly in +-step/2: RMS step / sqrt 12.
    let allowed = 1.05 * step_rad / 12_f64.sqrt();
    let enough = |&count: &usize| slope_deviation_rad(cut, &facet_points(cut, count)) <= allowed;
    (1..MOST_FACETS).find(enough).unwrap_or(MOST_FACETS)
}

/// RMS over arc length of the angle between the groove and the facet that stands for it.
fn slope_deviation_rad(cut: &Cut, facets: &[DVec2]) -> f64 {
    let mut facet = facets.windows(2).filter(|w| w[1].x > w[0].x).peekable();
    let (mut sum, mut length) = (0.0, 0.0);
    for w in cut.points.windows(2) {
        let middle_x = 0.5 * (w[0].x + w[1].x);
        while facet.peek().is_some_and(|f| f[1].x < middle_x) {
            facet.next();
        }
        let Some(f) = facet.peek() else { break };
        let deviation = (w[1] - w[0]).angle_to(f[1] - f[0]);
        let weight = (w[1] - w[0]).length();
        sum += weight * deviation * deviation;
        length += weight;
    }
    if length > 0.0 {
        (sum / length).sqrt()
    } else {
        0.0
    }
}

/// A polyline with a running measure, in which each corner occupies an interval of its own.
pub(super) struct Measured<'a> {
    points: &'a [DVec2],
    /// (measure when arriving at the point, measure when leaving it)
    spans: Vec<[f64; 2]>,
}

impl<'a> Measured<'a> {
    /// `length_share` of the whole measure is length, the rest turning.
    pub(super) fn new(points: &'a [DVec2], length_share: f64) -> Self {
        let steps: Vec<DVec2> = points.windows(2).map(|w| w[1] - w[0]).collect();
        let turns: Vec<f64> = steps
            .windows(2)
            .map(|w| w[0].angle_to(w[1]).abs())
            .collect();
        let length: f64 = steps.iter().map(|step| step.length()).sum();
        let turning: f64 = turns.iter().sum();
        let per_length = if turning > 1e-9 { length_share } else { 1.0 } / length.max(1e-300);
        let per_turn = (1.0 - length_share) / turning.max(1e-9);
        let mut spans = Vec::with_capacity(points.len());
        let mut at = 0.0;
        for i in 0..points.len() {
            let arrive = at;
            if i > 0 && i + 1 < points.len() {
                at += per_turn * turns[i - 1];
            }
            spans.push([arrive, at]);
            at += steps.get(i).map_or(0.0, |step| per_length * step.length());
        }
        Self { points, spans }
    }

    /// The point at a share of the whole measure, 0 to 1.
    pub(super) fn at(&self, share: f64) -> DVec2 {
        let Some(&[_, total]) = self.spans.last() else {
            return DVec2::ZERO;
        };
        let target = share * total;
        let i = self
            .spans
            .partition_point(|span| span[1] < target)
            .min(self.points.len() - 1);
        let [arrive, _] = self.spans[i];
        if i == 0 || target >= arrive {
            return self.points[i];
        }
        let leave = self.spans[i - 1][1];
        self.points[i - 1].lerp(self.points[i], (target - leave) / (arrive - leave))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formation::{Orientation, Tool};

    /// A pyramid's groove is a V: two facets say it all, and its corner is kept.
    #[test]
    fn a_v_needs_two_facets() {
        let held = Orientation {
            spin_deg: 45.0,
            ..Default::default()
        };
        let cut = Tool::vickers().outline(held).unwrap().cut(0.02);
        assert_eq!(facets_needed(&cut, 0.05), 2);
        let points = facet_points(&cut, 2);
        assert!((points[1].y + 0.02).abs() < 1e-9, "{points:?}");
    }

    /// Facets hold the groove's own area, and more of them are asked for by a finer step.
    #[test]
    fn area_is_kept() {
        let cut = Tool::rockwell_c()
            .outline(Orientation::default())
            .unwrap()
            .cut(0.02);
        let points = facet_points(&cut, 6);
        let area: f64 = points
            .windows(2)
            .map(|w| -0.5 * (w[1].x - w[0].x) * (w[0].y + w[1].y))
            .sum();
        assert!((area / cut.measures.area_mm2 - 1.0).abs() < 1e-12, "{area}");
        assert!(
            facets_needed(&cut, 0.05) > facets_needed(&cut, 0.2),
            "step has no effect"
        );
    }
}
