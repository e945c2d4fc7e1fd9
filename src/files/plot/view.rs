//! What of a cross-section's plane is shown, and where in the picture.

use super::{Plot, PlotStyle};
use glam::DVec2;

/// Exaggerations of heights within each power of ten.
const EXAGGERATIONS: [f64; 7] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0];

/// What is shown where there is no scratch, mm to either side.
const EMPTY_HALF_MM: f64 = 0.05;

/// From millimetres to pixels.
pub(super) struct View {
    /// Size of the text, px.
    pub text_px: f64,
    /// The drawing's upper left and lower right corners, px.
    pub frame: [DVec2; 2],
    /// What the frame spans, mm.
    pub x_mm: [f64; 2],
    pub z_mm: [f64; 2],
    /// How many times heights are drawn larger than widths.
    pub exaggeration: f64,
}

/// Room for what is written about a drawing, px.
struct Room {
    side: f64,
    above: f64,
    below: f64,
}

impl View {
    pub(super) fn of(plot: &Plot<'_>) -> Self {
        let size = DVec2::new(f64::from(plot.width_px), f64::from(plot.height_px));
        let (text_px, frame, room) = match plot.style {
            PlotStyle::Annotated => annotated(size),
            PlotStyle::Strip => strip(size, plot.title),
        };
        let [low, high] = extent(&plot.section.vertices());
        let frame_px = frame[1] - frame[0];
        let content_px = DVec2::new(
            (frame_px.x - 2.0 * room.side).max(0.1 * frame_px.x),
            (frame_px.y - room.above - room.below).max(0.1 * frame_px.y),
        );
        let content_mm = high - low;

        let mut px_per_mm = match plot.x_mm {
            Some([from, to]) => frame_px.x / (to - from),
            None => content_px.x / content_mm.x,
        };
        let room_for = content_px.y / (content_mm.y * px_per_mm);
        let exaggeration = match (plot.z_mm, plot.x_mm) {
            (Some([from, to]), _) => frame_px.y / (to - from) / px_per_mm,
            // A scratch taller than wide: equal scales, and more of the surface.
            (None, None) if room_for < 1.0 => {
                px_per_mm *= room_for;
                1.0
            }
            (None, _) if content_mm.y > 0.0 => round_below(room_for),
            _ => 1.0,
        };
        let shown_mm = frame_px / px_per_mm / DVec2::new(1.0, exaggeration);
        let middle = 0.5 * (low + high);
        let shift_z_mm = 0.5 * (room.above - room.below) / (px_per_mm * exaggeration);
        let about = |middle: f64, shown: f64| [middle - 0.5 * shown, middle + 0.5 * shown];
        Self {
            text_px,
            frame,
            x_mm: plot.x_mm.unwrap_or(about(middle.x, shown_mm.x)),
            z_mm: plot
                .z_mm
                .unwrap_or(about(middle.y + shift_z_mm, shown_mm.y)),
            exaggeration,
        }
    }

    /// Where a point (x, z) in mm lies in the picture.
    pub(super) fn at(&self, point: DVec2) -> DVec2 {
        /// Beyond, nothing can be seen; numbers stay small.
        const FAR_PX: f64 = 1e6;
        let [corner, end] = self.frame;
        let share_x = (point.x - self.x_mm[0]) / (self.x_mm[1] - self.x_mm[0]);
        let share_z = (point.y - self.z_mm[0]) / (self.z_mm[1] - self.z_mm[0]);
        DVec2::new(
            corner.x + share_x * (end.x - corner.x),
            end.y - share_z * (end.y - corner.y),
        )
        .clamp(DVec2::splat(-FAR_PX), DVec2::splat(FAR_PX))
    }
}

fn annotated(size: DVec2) -> (f64, [DVec2; 2], Room) {
    let text_px = ((size.x * size.y).sqrt() / 52.0).max(6.0);
    let frame = [
        DVec2::new(4.6, 6.0) * text_px,
        size - DVec2::new(1.6, 3.6) * text_px,
    ];
    let room = Room {
        side: 9.5 * text_px,
        above: 3.0 * text_px,
        below: 4.6 * text_px,
    };
    (text_px, frame, room)
}

fn strip(size: DVec2, title: Option<&str>) -> (f64, [DVec2; 2], Room) {
    let text_px = (size.x / 22.0).clamp(6.0, 0.2 * size.y.max(30.0));
    let lines = title.map_or(0, |title| title.lines().count());
    let room = Room {
        side: 0.12 * size.x,
        above: (0.8 + 1.35 * lines as f64) * text_px,
        below: 2.2 * text_px,
    };
    (text_px, [DVec2::ZERO, size], room)
}

/// Lower left and upper right corner of what there is to see; never of zero width.
fn extent(points: &[DVec2]) -> [DVec2; 2] {
    let low = points.iter().copied().reduce(DVec2::min);
    let high = points.iter().copied().reduce(DVec2::max);
    match (low, high) {
        (Some(low), Some(high)) if high.x > low.x => [low, high],
        _ => [-EMPTY_HALF_MM, EMPTY_HALF_MM].map(|x| DVec2::new(x, 0.0)),
    }
}

/// The largest of the exaggerations that is not above `most`.
fn round_below(most: f64) -> f64 {
    let power = 10_f64.powf(most.log10().floor());
    let fits = |&&step: &&f64| step * power <= most * (1.0 + 1e-12);
    EXAGGERATIONS.iter().rev().find(fits).unwrap_or(&1.0) * power
}

/// Round numbers between two, so many at most, with what to write at each.
pub(super) fn ticks([from, to]: [f64; 2], most: f64) -> Vec<(f64, String)> {
    let raw = (to - from) / most.max(1.0);
    let power = 10_f64.powf(raw.log10().floor());
    let step = [1.0, 2.0, 5.0]
        .map(|step| step * power)
        .into_iter()
        .find(|&step| step >= raw * (1.0 - 1e-9))
        .unwrap_or(10.0 * power);
    let decimals = decimals_of(step);
    // An end that is itself round counts, whatever its last bit.
    let (first, last) = ((from / step - 1e-9).ceil(), (to / step + 1e-9).floor());
    let mut ticks = Vec::new();
    let mut at = first;
    while at <= last {
        ticks.push((at * step, with_decimals(at * step, decimals)));
        at += 1.0;
    }
    ticks
}

/// As many decimals as a round number's first digit needs.
fn decimals_of(step: f64) -> usize {
    (0..12)
        .find(|&decimals| step * 10_f64.powi(decimals) >= 1.0 - 1e-9)
        .map_or(12, i32::unsigned_abs) as usize
}

/// Three digits, more before the decimal point where there are more.
pub(super) fn three_digits(value: f64) -> String {
    let decimals = (0..12)
        .find(|&decimals| value.abs() * 10_f64.powi(decimals) >= 99.95)
        .map_or(12, i32::unsigned_abs);
    with_decimals(value, if value == 0.0 { 0 } else { decimals as usize })
}

/// With a minus sign that is as wide as a digit.
fn with_decimals(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().any(|byte| (b'1'..=b'9').contains(&byte)) => {
            format!("\u{2013}{rest}")
        }
        Some(rest) => rest.to_owned(),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ticks are round, in range, and no more than asked for.
    #[test]
    fn ticks_are_round() {
        let written = |range, most| {
            let ticks = ticks(range, most).into_iter();
            ticks.map(|(_, text)| text).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(written([-150.0, 150.0], 6.0), "–150 –100 –50 0 50 100 150");
        assert_eq!(written([-1.3, 0.4], 4.0), "–1.0 –0.5 0.0");
        assert_eq!(written([0.0, 0.000_3], 3.0), "0.0000 0.0001 0.0002 0.0003");
        assert_eq!(written([-3e7, 3e7], 2.0), "0");
    }

    #[test]
    fn three_digits_are_written() {
        let numbers = [0.0, 0.012_345, 9.996, 12.345, 138.2, 11_054.4];
        let written = numbers.map(three_digits);
        assert_eq!(written, ["0", "0.0123", "10.0", "12.3", "138", "11054"]);
    }

    /// Heights are exaggerated by round numbers only.
    #[test]
    fn exaggerations_are_round() {
        let numbers = [1.0, 1.9, 7.0, 11.0, 99.0, 0.55];
        assert_eq!(numbers.map(round_below), [1.0, 1.0, 6.0, 10.0, 80.0, 0.5]);
    }
}
