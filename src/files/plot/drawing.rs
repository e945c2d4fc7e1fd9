//! What a plot shows: the material, its zones and areas, the axes.

use super::labels::annotate;
use super::svg::{Anchor, Svg};
use super::view::{View, three_digits, ticks};
use super::{Plot, PlotStyle};
use glam::DVec2;

const MM_TO_UM: f64 = 1e3;

/// The parts of a cross-section, in pixels and from left to right. What is flat has no length.
pub(super) struct Parts {
    /// Foot and crest.
    pub left_outer: [DVec2; 2],
    /// Crest and edge of the groove.
    pub left_inner: [DVec2; 2],
    pub groove: Vec<DVec2>,
    /// Edge of the groove and crest.
    pub right_inner: [DVec2; 2],
    /// Crest and foot.
    pub right_outer: [DVec2; 2],
}

impl Parts {
    fn of(plot: &Plot<'_>, view: &View) -> Self {
        let points: Vec<DVec2> = plot.section.vertices();
        let points: Vec<DVec2> = points.into_iter().map(|point| view.at(point)).collect();
        let last = points.len() - 1;
        let groove = match &points[2..last - 1] {
            [] => vec![view.at(DVec2::ZERO)],
            groove => groove.to_vec(),
        };
        let (left_edge, right_edge) = (groove[0], groove[groove.len() - 1]);
        Self {
            left_outer: [points[0], points[1]],
            left_inner: [points[1], left_edge],
            groove,
            right_inner: [right_edge, points[last - 1]],
            right_outer: [points[last - 1], points[last]],
        }
    }

    fn profile(&self) -> impl Iterator<Item = DVec2> {
        let left = [self.left_outer[0], self.left_outer[1]];
        let right = self.right_outer;
        left.into_iter()
            .chain(self.groove.iter().copied())
            .chain(right)
    }
}

/// The whole picture.
pub(super) fn draw(plot: &Plot<'_>, view: &View) -> String {
    let size = DVec2::new(f64::from(plot.width_px), f64::from(plot.height_px));
    let mut svg = Svg::new(plot.width_px, plot.height_px, &style(view.text_px));
    let parts = Parts::of(plot, view);
    let [corner, end] = view.frame;
    svg.rectangle("paper", DVec2::ZERO, size);
    svg.begin_clip(corner, end);
    if plot.style == PlotStyle::Annotated {
        grid(&mut svg, view);
    }
    areas(&mut svg, view, &parts);
    let surface = [corner.x, end.x].map(|x| DVec2::new(x, view.at(DVec2::ZERO).y));
    svg.polyline("surface", &surface);
    if plot.section.depth_mm() > 0.0 {
        zones(&mut svg, &parts);
    }
    if plot.style == PlotStyle::Annotated {
        annotate(&mut svg, plot, view, &parts);
    }
    svg.end_clip();
    match plot.style {
        PlotStyle::Annotated => {
            axes(&mut svg, view);
            svg.rectangle("frame", corner, end);
            heading(&mut svg, plot, view);
            legend(&mut svg, view);
        }
        PlotStyle::Strip => {
            inner_scales(&mut svg, plot, view);
            let from = DVec2::new(0.7, 1.4) * view.text_px;
            title(&mut svg, plot.title.unwrap_or_default(), from, view.text_px);
        }
    }
    svg.finish()
}

fn style(text_px: f64) -> String {
    let line = text_px / 14.0;
    format!(
        "text{{font-family:'Noto Sans','DejaVu Sans',Arial,sans-serif;font-size:{text_px:.2}px;fill:#1f2933}}\
         .title{{font-weight:bold}}.scale{{font-size:{:.2}px;fill:#52606d}}\
         .paper{{fill:#fff}}.frame{{fill:none;stroke:#52606d;stroke-width:{line:.2}}}\
         .grid{{stroke:#e4e7eb;stroke-width:{line:.2}}}.tick{{stroke:#52606d;stroke-width:{line:.2}}}\
         .material{{fill:#d9dee5}}.groove-area{{fill:#c5e8db}}.peak-area{{fill:#f6d9b0}}\
         .surface{{fill:none;stroke:#7b8794;stroke-width:{line:.2};stroke-dasharray:{:.2} {:.2}}}\
         .groove,.inner,.outer{{fill:none;stroke-width:{:.2};stroke-linejoin:round;stroke-linecap:round}}\
         .groove{{stroke:#14866a}}.inner{{stroke:#d9730d}}.outer{{stroke:#2f62b5}}\
         .inner-letter{{fill:#b35a00}}.outer-letter{{fill:#2f62b5}}\
         .measure{{fill:none;stroke:#3e4c59;stroke-width:{line:.2}}}.extension{{stroke:#9aa5b1;stroke-width:{line:.2}}}",
        0.85 * text_px,
        5.0 * line,
        4.0 * line,
        2.6 * line,
    )
}

/// The material, what the groove lacks and what the peaks hold.
fn areas(svg: &mut Svg, view: &View, parts: &Parts) {
    let [corner, end] = view.frame;
    let surface_y = view.at(DVec2::ZERO).y;
    let below = end.y + view.text_px;
    let mut material = vec![
        DVec2::new(corner.x - view.text_px, below),
        DVec2::new(corner.x - view.text_px, surface_y),
    ];
    material.extend(parts.profile());
    material.extend([
        DVec2::new(end.x + view.text_px, surface_y),
        DVec2::new(end.x + view.text_px, below),
    ]);
    svg.polygon("material", &material);
    svg.polygon("groove-area", &parts.groove);
    for [foot, crest, edge] in [
        [
            parts.left_outer[0],
            parts.left_outer[1],
            parts.left_inner[1],
        ],
        [
            parts.right_outer[1],
            parts.right_outer[0],
            parts.right_inner[0],
        ],
    ] {
        svg.polygon("peak-area", &[foot, crest, edge]);
    }
}

/// The profile itself, each zone in its colour.
fn zones(svg: &mut Svg, parts: &Parts) {
    svg.polyline("groove", &parts.groove);
    for inner in [parts.left_inner, parts.right_inner] {
        svg.polyline("inner", &inner);
    }
    for outer in [parts.left_outer, parts.right_outer] {
        svg.polyline("outer", &outer);
    }
}

/// Ticks along x and z: the place in mm, and what to write, in µm.
fn scales(view: &View) -> [Vec<(f64, String)>; 2] {
    let size = view.frame[1] - view.frame[0];
    let most = [size.x / (4.2 * view.text_px), size.y / (2.6 * view.text_px)];
    let in_um = |range: [f64; 2]| range.map(|mm| mm * MM_TO_UM);
    let in_mm = |ticks: Vec<(f64, String)>| {
        let ticks = ticks.into_iter();
        ticks.map(|(um, text)| (um / MM_TO_UM, text)).collect()
    };
    [
        in_mm(ticks(in_um(view.x_mm), most[0])),
        in_mm(ticks(in_um(view.z_mm), most[1])),
    ]
}

fn grid(svg: &mut Svg, view: &View) {
    let [corner, end] = view.frame;
    let [across, upwards] = scales(view);
    for (x_mm, _) in across {
        let x = view.at(DVec2::new(x_mm, 0.0)).x;
        svg.polyline("grid", &[DVec2::new(x, corner.y), DVec2::new(x, end.y)]);
    }
    for (z_mm, _) in upwards {
        let y = view.at(DVec2::new(0.0, z_mm)).y;
        svg.polyline("grid", &[DVec2::new(corner.x, y), DVec2::new(end.x, y)]);
    }
}

/// Scales around the frame, with what they measure.
fn axes(svg: &mut Svg, view: &View) {
    let [corner, end] = view.frame;
    let text_px = view.text_px;
    let [across, upwards] = scales(view);
    for (x_mm, text) in across {
        let x = view.at(DVec2::new(x_mm, 0.0)).x;
        svg.polyline(
            "tick",
            &[DVec2::new(x, end.y), DVec2::new(x, end.y + 0.35 * text_px)],
        );
        let at = DVec2::new(x, end.y + 1.35 * text_px);
        svg.text("scale", at, Anchor::Middle, &text);
    }
    for (z_mm, text) in upwards {
        let y = view.at(DVec2::new(0.0, z_mm)).y;
        svg.polyline(
            "tick",
            &[
                DVec2::new(corner.x - 0.35 * text_px, y),
                DVec2::new(corner.x, y),
            ],
        );
        let at = DVec2::new(corner.x - 0.6 * text_px, y + 0.3 * text_px);
        svg.text("scale", at, Anchor::End, &text);
    }
    let below = DVec2::new(0.5 * (corner.x + end.x), end.y + 2.9 * text_px);
    let across = "across the scratch, to the right of travel (µm)";
    svg.text("axis", below, Anchor::Middle, across);
    let left = DVec2::new(1.25 * text_px, 0.5 * (corner.y + end.y));
    let upwards = format!(
        "height (µm), {}",
        exaggeration(view).replace('×', "exaggerated ×")
    );
    svg.text_upwards("axis", left, Anchor::Middle, &upwards);
}

/// How heights compare with widths.
fn exaggeration(view: &View) -> String {
    if (view.exaggeration - 1.0).abs() < 0.005 {
        return "to the same scale".to_owned();
    }
    let digits = three_digits(view.exaggeration);
    let digits = match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.'),
        false => &digits,
    };
    format!("×{digits}")
}

/// Scales within the frame: along its lower edge, and along its left one.
fn inner_scales(svg: &mut Svg, plot: &Plot<'_>, view: &View) {
    let [corner, end] = view.frame;
    let text_px = view.text_px;
    let [across, upwards] = scales(view);
    let with_unit = |i: usize, count: usize, text: &str| match i + 1 == count {
        true => format!("{text} µm"),
        false => text.to_owned(),
    };
    let fits = |x: f64| x > corner.x + 1.5 * text_px && x < end.x - 2.6 * text_px;
    let at_x = |x_mm: f64| view.at(DVec2::new(x_mm, 0.0)).x;
    let across: Vec<_> = across.iter().filter(|tick| fits(at_x(tick.0))).collect();
    for (i, (x_mm, text)) in across.iter().enumerate() {
        let foot = DVec2::new(at_x(*x_mm), end.y);
        let tick = [foot, foot - DVec2::new(0.0, 0.4 * text_px)];
        svg.polyline("tick", &tick);
        let at = foot - DVec2::new(0.0, 0.65 * text_px);
        let text = with_unit(i, across.len(), text);
        svg.text("scale", at, Anchor::Middle, &text);
    }
    let surface_y = view.at(DVec2::ZERO).y;
    let fits = |y: f64| {
        let title_lines = plot.title.map_or(0, |title| title.lines().count());
        let (top, bottom) = (1.35 * title_lines as f64 + 1.0, 2.2);
        y > corner.y + top * text_px
            && y < end.y - bottom * text_px
            && (y - surface_y).abs() > 0.5 * text_px
    };
    for (z_mm, text) in upwards {
        let foot = DVec2::new(corner.x, view.at(DVec2::new(0.0, z_mm)).y);
        if fits(foot.y) {
            let tick = [foot, foot + DVec2::new(0.4 * text_px, 0.0)];
            svg.polyline("tick", &tick);
            let at = foot + DVec2::new(0.65, 0.3) * text_px;
            svg.text("scale", at, Anchor::Start, &text);
        }
    }
    if exaggeration(view).starts_with('×') {
        let at = DVec2::new(end.x - 0.7 * text_px, end.y - 2.1 * text_px);
        let text = format!("heights {}", exaggeration(view));
        svg.text("scale", at, Anchor::End, &text);
    }
}

/// Lines of a text, the first in bold.
fn title(svg: &mut Svg, text: &str, mut at: DVec2, text_px: f64) {
    for (i, line) in text.lines().enumerate() {
        let class = if i == 0 { "title" } else { "subtitle" };
        svg.text(class, at, Anchor::Start, line);
        at.y += 1.35 * text_px;
    }
}

/// Title and numbers above the frame.
fn heading(svg: &mut Svg, plot: &Plot<'_>, view: &View) {
    let left = view.frame[0].x;
    let own = "Cross-section of a scratch";
    let first = plot.title.and_then(|title| title.lines().next());
    let at = |lines: f64| DVec2::new(left, lines * view.text_px);
    svg.text("title", at(1.7), Anchor::Start, first.unwrap_or(own));
    svg.text("numbers", at(3.2), Anchor::Start, &numbers(plot));
}

fn numbers(plot: &Plot<'_>) -> String {
    let section = plot.section;
    let um = |mm: f64| three_digits(mm * MM_TO_UM);
    if section.depth_mm() <= 0.0 {
        return "no scratch: the force is too small for this material".to_owned();
    }
    format!(
        "{} µm deep, {} µm wide at the surface, {} µm between crests",
        um(section.depth_mm()),
        um(section.groove_width_mm()),
        um(section.crest_width_mm()),
    )
}

/// Which colour is which zone, in a row under the numbers.
fn legend(svg: &mut Svg, view: &View) {
    let text_px = view.text_px;
    let mut at = DVec2::new(view.frame[0].x, 4.9 * text_px);
    for (class, text) in [
        ("outer", "outer flank"),
        ("inner", "inner flank"),
        ("groove", "groove"),
    ] {
        let line_y = at.y - 0.35 * text_px;
        let line = [0.0, 1.6 * text_px].map(|x| DVec2::new(at.x + x, line_y));
        svg.polyline(class, &line);
        let text_at = at + DVec2::new(2.1 * text_px, 0.0);
        svg.text("key", text_at, Anchor::Start, text);
        at.x += (3.6 + 0.52 * text.len() as f64) * text_px;
    }
    for (class, text) in [
        ("groove-area", "what the groove lacks"),
        ("peak-area", "what the peaks hold"),
    ] {
        let from = at - DVec2::new(0.0, 0.8 * text_px);
        svg.rectangle(class, from, at + DVec2::new(1.6, 0.1) * text_px);
        let text_at = at + DVec2::new(2.1 * text_px, 0.0);
        svg.text("key", text_at, Anchor::Start, text);
        at.x += (3.6 + 0.52 * text.len() as f64) * text_px;
    }
}
