//! Buchanan and Lalonde (1999): straight lines, listed by texel; the strongest highlight of a texel's lines counts.

use super::Place;
use super::canvas::{Canvas, straight};
use crate::brdf::{ACROSS_SURFACE, Directions, Finish};
use crate::error::{Result, in_range, rgb_in_range};
use crate::pattern::Pattern;
use crate::scattering::{Centred, Shading};
use glam::DVec2;

/// How all scratches shine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Highlight {
    /// Colour per channel, 0 to 1: as bright as Phong's lobe of this colour is in the mirrored direction.
    pub specular: [f32; 3],
    /// Of the lobe's cosine, 1 (wide) to 100000 (sharp).
    pub exponent: f32,
}

/// Which lines pass through each texel.
#[derive(Debug)]
pub(super) struct Lists {
    canvas: Canvas,
    /// Doubled: the scratch counts with half of the pixel, see [`Self::add`].
    highlight: Highlight,
    /// Of each line, in (u, v).
    directions: Vec<DVec2>,
    /// Where each texel's list begins in `lines`, and where the last one ends.
    first: Vec<u32>,
    lines: Vec<u32>,
}

impl Lists {
    pub(super) fn new(pattern: &Pattern, canvas: &Canvas, highlight: &Highlight) -> Result<Self> {
        canvas.check()?;
        rgb_in_range("specular", highlight.specular, 0.0, 1.0)?;
        in_range("exponent", f64::from(highlight.exponent), 1.0, 100_000.0)?;
        let count = u32::try_from(pattern.scratch_count()).unwrap_or(u32::MAX);
        let lines: Vec<Option<[DVec2; 2]>> = (0..count)
            .map(|scratch| straight(pattern, canvas, scratch))
            .collect();
        let along = |line: &Option<[DVec2; 2]>| {
            line.map_or(DVec2::ZERO, |[from, to]| (to - from) / canvas.per_uv())
        };
        let mut lists = Self {
            canvas: *canvas,
            highlight: *highlight,
            directions: lines.iter().map(along).collect(),
            first: vec![0; canvas.count() + 1],
            lines: Vec::new(),
        };
        lists.fill(&lines);
        Ok(lists)
    }

    /// Counts each texel's lines, then writes them.
    fn fill(&mut self, lines: &[Option<[DVec2; 2]>]) {
        let Self { canvas, first, .. } = self;
        for line in lines.iter().flatten() {
            each_texel(canvas, line, |texel| first[texel + 1] += 1);
        }
        for texel in 0..canvas.count() {
            first[texel + 1] += first[texel];
        }
        let mut next = first.clone();
        self.lines = vec![0; first[canvas.count()] as usize];
        for (number, line) in (0_u32..).zip(lines) {
            let Some(line) = line else { continue };
            each_texel(canvas, line, |texel| {
                self.lines[next[texel] as usize] = number;
                next[texel] += 1;
            });
        }
    }

    /// The highlight adds to what the surface reflects, and takes nothing from it. So that both are sampled, the pixel
    /// counts half as scratch, which shines twice as brightly.
    pub(super) fn add(&self, place: &Place, shading: &mut Shading) {
        let Some(texel) = self.canvas.texel(place.metric.uv) else {
            return;
        };
        let texel = texel.y * self.canvas.columns() + texel.x;
        let list = self.first[texel] as usize..self.first[texel + 1] as usize;
        if list.is_empty() {
            return;
        }
        let mut directions = Directions::default();
        for &line in &self.lines[list] {
            let along = place.metric.to_mm * self.directions[line as usize];
            directions.insert(along.as_vec2().to_angle());
        }
        let Highlight { specular, exponent } = self.highlight;
        let finish = Finish::threads(specular.map(|c| 2.0 * c), exponent, &directions);
        shading.add_centred(&Centred {
            vertices: &[[-0.5, 0.0], [0.5, 0.0]],
            finishes: &[finish; 2],
            across: ACROSS_SURFACE,
            pixel_mm: 2.0,
            is_added: true,
        });
    }

    pub(super) fn memory_bytes(&self) -> usize {
        size_of_val(&self.directions[..])
            + size_of_val(&self.first[..])
            + size_of_val(&self.lines[..])
    }
}

/// Visits each texel that a line passes through, once (Amanatides and Woo 1987).
fn each_texel(canvas: &Canvas, line: &[DVec2; 2], mut visit: impl FnMut(usize)) {
    let size = DVec2::new(canvas.columns() as f64, canvas.rows() as f64);
    let Some([from, to]) = clipped(line, size) else {
        return;
    };
    let way = to - from;
    let last = size - 1.0;
    let mut at = from.floor().clamp(DVec2::ZERO, last);
    let end = to.floor().clamp(DVec2::ZERO, last);
    let step = way.signum();
    let per_texel = (1.0 / way).abs();
    // Shares of the way at which it passes into the next column and row.
    let ahead = DVec2::select(way.cmpgt(DVec2::ZERO), at + 1.0 - from, from - at);
    let mut next = DVec2::select(way.cmpeq(DVec2::ZERO), DVec2::INFINITY, ahead * per_texel);
    let steps = (end - at).abs().element_sum();
    let mut left = steps;
    loop {
        visit(index(canvas, at));
        if left < 1.0 {
            return;
        }
        left -= 1.0;
        // Not beyond the end in either, however places were rounded.
        if (next.x < next.y && at.x != end.x) || at.y == end.y {
            at.x += step.x;
            next.x += per_texel.x;
        } else {
            at.y += step.y;
            next.y += per_texel.y;
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole numbers on the canvas"
)]
fn index(canvas: &Canvas, at: DVec2) -> usize {
    at.y as usize * canvas.columns() + at.x as usize
}

/// The part of a line within a rectangle from (0, 0) (Liang and Barsky 1984).
fn clipped(&[from, to]: &[DVec2; 2], size: DVec2) -> Option<[DVec2; 2]> {
    let way = to - from;
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for i in 0..2 {
        if way[i] == 0.0 {
            if !(0.0..size[i]).contains(&from[i]) {
                return None;
            }
            continue;
        }
        let at = [-from[i] / way[i], (size[i] - from[i]) / way[i]];
        enters = enters.max(at[0].min(at[1]));
        leaves = leaves.min(at[0].max(at[1]));
    }
    (enters < leaves).then(|| [from + enters * way, from + leaves * way])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line is listed where it passes and nowhere else, whichever way it runs, also where it leaves the canvas.
    #[test]
    fn lines_are_listed_where_they_pass() {
        let canvas = Canvas {
            area_uv: [[0.0; 2], [1.0; 2]],
            texels: [23, 17],
        };
        for line in [
            [[2.3, 1.2], [20.9, 14.4]],
            [[20.9, 14.4], [2.3, 1.2]],
            [[-5.0, 20.0], [30.0, -3.0]],
            [[4.5, 3.5], [4.5, 11.5]],
            [[11.0, 30.0], [11.4, -9.0]],
        ] {
            let line = line.map(DVec2::from);
            let mut listed = vec![0; canvas.count()];
            each_texel(&canvas, &line, |texel| listed[texel] += 1);
            let mut passed = vec![0; canvas.count()];
            for i in 0..400_000 {
                let at = line[0].lerp(line[1], (f64::from(i) + 0.5) / 400_000.0);
                let size = DVec2::new(23.0, 17.0);
                if at.cmpge(DVec2::ZERO).all() && at.cmplt(size).all() {
                    passed[index(&canvas, at.floor())] = 1;
                }
            }
            assert_eq!(listed, passed, "{line:?}");
        }
    }
}
