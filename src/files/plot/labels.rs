//! What is written on an annotated plot: widths, depth, areas, and each peak's height and angles.

use super::Plot;
use super::drawing::Parts;
use super::svg::{Anchor, Svg};
use super::view::{View, three_digits};
use crate::formation::Peak;
use glam::DVec2;

pub(super) fn annotate(svg: &mut Svg, plot: &Plot<'_>, view: &View, parts: &Parts) {
    if plot.section.depth_mm() <= 0.0 {
        return;
    }
    groove(svg, plot, view, parts);
    let (left, right) = (plot.section.left(), plot.section.right());
    if left.height_mm + right.height_mm > 0.0 {
        crests(svg, plot, view, parts);
    }
    peak(svg, view, &left, parts.left_outer[0], -1.0);
    peak(svg, view, &right, parts.right_outer[1], 1.0);
    if left.height_mm > 0.0 {
        letter(svg, view, "inner-letter", "α", parts.left_inner);
        letter(svg, view, "outer-letter", "β", parts.left_outer);
    }
    if right.height_mm > 0.0 {
        letter(svg, view, "inner-letter", "α", parts.right_inner);
        letter(svg, view, "outer-letter", "β", parts.right_outer);
    }
}

/// A length between two places on one height or above each other, with short bars at its ends.
fn measure(svg: &mut Svg, from: DVec2, to: DVec2, text_px: f64) {
    svg.polyline("measure", &[from, to]);
    let bar = (to - from).normalize_or_zero().perp() * 0.3 * text_px;
    for end in [from, to] {
        svg.polyline("measure", &[end - bar, end + bar]);
    }
}

/// Depth, width and area of the groove, under it.
fn groove(svg: &mut Svg, plot: &Plot<'_>, view: &View, parts: &Parts) {
    let (section, text_px) = (plot.section, view.text_px);
    let (left, right) = (parts.left_inner[1], parts.right_inner[0]);
    let bottom_y = parts
        .groove
        .iter()
        .map(|point| point.y)
        .fold(left.y, f64::max);
    let deepest = parts.groove.iter().filter(|point| bottom_y - point.y < 0.5);
    let (sum_x, count) = deepest.fold((0.0, 0.0), |(sum, count), point| {
        (sum + point.x, count + 1.0)
    });
    let deepest_x = sum_x / count;
    measure(
        svg,
        DVec2::new(deepest_x, left.y),
        DVec2::new(deepest_x, bottom_y),
        text_px,
    );
    let below = bottom_y + text_px;
    for edge in [left, right] {
        svg.polyline(
            "extension",
            &[edge, DVec2::new(edge.x, below + 0.3 * text_px)],
        );
    }
    measure(
        svg,
        DVec2::new(left.x, below),
        DVec2::new(right.x, below),
        text_px,
    );
    let um = |mm: f64| three_digits(mm * 1e3);
    let lines = [
        format!(
            "{} µm wide, {} µm deep",
            um(section.groove_width_mm()),
            um(section.depth_mm())
        ),
        format!(
            "groove {} µm²",
            three_digits(section.groove_area_mm2() * 1e6)
        ),
    ];
    let mut at = DVec2::new(0.5 * (left.x + right.x), below + 1.5 * text_px);
    for line in lines {
        svg.text("label", at, Anchor::Middle, &line);
        at.y += 1.3 * text_px;
    }
}

/// The width between the crests, above them.
fn crests(svg: &mut Svg, plot: &Plot<'_>, view: &View, parts: &Parts) {
    let (left, right) = (parts.left_outer[1], parts.right_outer[0]);
    let above = left.y.min(right.y) - 1.2 * view.text_px;
    for crest in [left, right] {
        let top = DVec2::new(crest.x, above - 0.3 * view.text_px);
        svg.polyline("extension", &[crest, top]);
    }
    let [from, to] = [left, right].map(|crest| DVec2::new(crest.x, above));
    measure(svg, from, to, view.text_px);
    let at = 0.5 * (from + to) - DVec2::new(0.0, 0.5 * view.text_px);
    let width = three_digits(plot.section.crest_width_mm() * 1e3);
    let text = format!("{width} µm between crests");
    svg.text("label", at, Anchor::Middle, &text);
}

/// Area, height and angles of a peak, on the surface outside its foot; `side` is -1 left and 1 right.
fn peak(svg: &mut Svg, view: &View, peak: &Peak, foot: DVec2, side: f64) {
    let area_mm2 = 0.5 * peak.height_mm * (peak.inner_width_mm + peak.outer_width_mm);
    let lines = if peak.height_mm > 0.0 {
        vec![
            format!("β = {:.1}°", peak.beta_deg),
            format!("α = {:.1}°", peak.alpha_deg),
            format!("{} µm high", three_digits(peak.height_mm * 1e3)),
            format!("peak {}", area(area_mm2)),
        ]
    } else {
        vec![format!("α = {:.1}°", peak.alpha_deg), "no peak".to_owned()]
    };
    let anchor = if side < 0.0 {
        Anchor::End
    } else {
        Anchor::Start
    };
    let mut at = foot + DVec2::new(1.1 * side, -0.55) * view.text_px;
    for line in lines {
        svg.text("label", at, anchor, &line);
        at.y -= 1.3 * view.text_px;
    }
}

/// An area in µm², a large one in mm².
fn area(mm2: f64) -> String {
    if mm2 < 0.1 {
        format!("{} µm²", three_digits(mm2 * 1e6))
    } else {
        format!("{} mm²", three_digits(mm2))
    }
}

/// An angle's letter above the flank that has it, if it can be seen.
pub(super) fn letter(svg: &mut Svg, view: &View, class: &str, text: &str, flank: [DVec2; 2]) {
    let along = flank[1] - flank[0];
    if along.x.abs() < view.text_px {
        return;
    }
    // Flanks run from left to right, so that this points away from the material.
    let outward = DVec2::new(along.y, -along.x).normalize_or_zero();
    let middle = 0.5 * (flank[0] + flank[1]) + 0.75 * view.text_px * outward;
    let at = middle + DVec2::new(0.0, 0.3 * view.text_px);
    svg.text(class, at, Anchor::Middle, text);
}
