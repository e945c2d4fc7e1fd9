//! Scratches painted into an image, and coarser images of it.

use super::Place;
use super::canvas::Canvas;
use glam::{DVec2, IVec2};
use rayon::prelude::*;
use tiny_skia::{Color, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

/// Rows that are painted at once.
const STRIP: usize = 1024;

/// A footprint looks at so coarse an image that it is no more texels wide or high.
const MOST_ACROSS: f64 = 16.0;

/// Shades by texel, 0 where nothing is painted.
#[derive(Debug)]
pub(super) struct Image {
    canvas: Canvas,
    /// The painted one, then each half as fine as the one before.
    levels: Vec<Level>,
}

#[derive(Debug)]
pub(super) struct Level {
    columns: usize,
    rows: usize,
    texels: Vec<u8>,
}

/// A line on the canvas, in texels.
pub(super) enum Line<I> {
    Straight([DVec2; 2]),
    /// Cubic Bézier curves, each of which starts where the last one ends.
    Curved(I),
}

impl Image {
    /// Paints lines in their order, one texel wide, each in its shade.
    pub(super) fn paint<I: Iterator<Item = [DVec2; 4]>>(
        canvas: &Canvas,
        count: u32,
        line: impl Fn(u32) -> Option<(Line<I>, u8)> + Sync,
    ) -> Self {
        let columns = canvas.columns();
        let mut texels = vec![0; canvas.count()];
        let strips = texels.par_chunks_mut(STRIP * columns).enumerate();
        strips.for_each(|(i, strip)| paint_strip(strip, columns, i * STRIP, count, &line));
        let finest = Level {
            columns,
            rows: canvas.rows(),
            texels,
        };
        Self {
            canvas: *canvas,
            levels: vec![finest],
        }
    }

    /// Adds coarser images, a texel of which is painted if any of its four is: the brightest of them.
    pub(super) fn with_coarser(mut self) -> Self {
        while let Some(finer) = self.levels.last()
            && finer.texels.len() > 1
        {
            let coarser = finer.coarser();
            self.levels.push(coarser);
        }
        self
    }

    /// The shade of the texel that holds (u, v).
    pub(super) fn shade_at(&self, uv: DVec2) -> u8 {
        let texel = self.canvas.texel(uv);
        texel.map_or(0, |texel| {
            self.levels[0].texels[texel.y * self.canvas.columns() + texel.x]
        })
    }

    /// The painted texel in a pixel that is nearest to its centre, in as fine an image as the pixel can be searched in.
    pub(super) fn nearest(&self, place: &Place) -> Option<(&Level, IVec2, f64)> {
        let corners = place.pixel.corners().iter();
        let corners = corners.map(|&mm| self.canvas.place(place.metric.place_uv(mm)));
        let mut pixel = [DVec2::ZERO; 4];
        for (own, corner) in pixel.iter_mut().zip(corners) {
            *own = corner;
        }
        let extent = |pixel: &[DVec2; 4]| {
            let low = pixel.iter().copied().fold(DVec2::INFINITY, DVec2::min);
            let high = pixel.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
            [low, high]
        };
        let [low, high] = extent(&pixel);
        let coarser = ((high - low).max_element() / MOST_ACROSS)
            .log2()
            .ceil()
            .max(0.0);
        let number = (0..self.levels.len() - 1).find(|&n| n as f64 >= coarser);
        let number = number.unwrap_or(self.levels.len() - 1);
        let (level, texel) = (&self.levels[number], (1_u64 << number) as f64);
        let pixel = pixel.map(|corner| corner / texel);
        let centre = self.canvas.place(place.metric.uv) / texel;
        let [low, high] = extent(&pixel);
        let found = level.nearest_within(&pixel, [low, high], centre)?;
        Some((level, found, texel))
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.levels.iter().map(|level| level.texels.len()).sum()
    }
}

impl Level {
    /// Whether a texel is painted; none is beside the image.
    pub(super) fn is_painted(&self, at: IVec2) -> bool {
        let (Ok(x), Ok(y)) = (usize::try_from(at.x), usize::try_from(at.y)) else {
            return false;
        };
        x < self.columns && y < self.rows && self.texels[y * self.columns + x] > 0
    }

    fn coarser(&self) -> Self {
        let (columns, rows) = (self.columns.div_ceil(2), self.rows.div_ceil(2));
        let mut texels = vec![0; columns * rows];
        texels
            .par_chunks_mut(columns)
            .enumerate()
            .for_each(|(y, row)| {
                for finer in [2 * y, 2 * y + 1] {
                    let from = finer * self.columns;
                    let finer = self.texels.get(from..from + self.columns).unwrap_or(&[]);
                    for (x, shade) in finer.iter().enumerate() {
                        row[x / 2] = row[x / 2].max(*shade);
                    }
                }
            });
        Self {
            columns,
            rows,
            texels,
        }
    }

    /// The painted texel that a convex quadrilateral touches and whose middle is nearest to `centre`; all in this image's
    /// texels.
    fn nearest_within(
        &self,
        pixel: &[DVec2; 4],
        [low, high]: [DVec2; 2],
        centre: DVec2,
    ) -> Option<IVec2> {
        let last = DVec2::new(self.columns as f64 - 1.0, self.rows as f64 - 1.0);
        let low = low.floor().max(DVec2::ZERO).as_ivec2();
        let high = high.floor().min(last).as_ivec2();
        let mut best: Option<(f64, IVec2)> = None;
        for y in low.y..=high.y {
            for x in low.x..=high.x {
                let at = IVec2::new(x, y);
                if !self.is_painted(at) {
                    continue;
                }
                let distance = (at.as_dvec2() + 0.5).distance_squared(centre);
                let is_nearer = best.is_none_or(|(nearest, _)| distance < nearest);
                if is_nearer && touches(pixel, at.as_dvec2()) {
                    best = Some((distance, at));
                }
            }
        }
        best.map(|(_, at)| at)
    }
}

/// Whether no side of a convex quadrilateral parts it from the texel at `low`; the texel touches its box.
fn touches(pixel: &[DVec2; 4], low: DVec2) -> bool {
    let edge = |i: usize| (pixel[i], pixel[(i + 1) % 4] - pixel[i]);
    let turn = (pixel[1] - pixel[0]).perp_dot(pixel[2] - pixel[1]).signum();
    (0..4).all(|i| {
        let (from, along) = edge(i);
        let inward = turn * along.perp();
        let farthest = low + DVec2::select(inward.cmpgt(DVec2::ZERO), DVec2::ONE, DVec2::ZERO);
        (farthest - from).dot(inward) >= 0.0
    })
}

fn paint_strip<I: Iterator<Item = [DVec2; 4]>>(
    strip: &mut [u8],
    columns: usize,
    first_row: usize,
    count: u32,
    line: impl Fn(u32) -> Option<(Line<I>, u8)>,
) {
    let rows = strip.len() / columns;
    let side = |texels: usize| u32::try_from(texels).unwrap_or(0);
    let Some(mut pixels) = Pixmap::new(side(columns), side(rows)) else {
        return;
    };
    let low = DVec2::new(-1.0, first_row as f64 - 1.0);
    let high = DVec2::new(columns as f64, (first_row + rows) as f64) + 1.0;
    let hairline = Stroke {
        width: 0.0,
        ..Stroke::default()
    };
    for number in 0..count {
        let path = line(number).and_then(|(line, shade)| Some((drawn(line, low, high)?, shade)));
        let Some((path, shade)) = path else { continue };
        let mut paint = Paint {
            anti_alias: false,
            ..Paint::default()
        };
        paint.set_color(Color::from_rgba8(shade, shade, shade, 255));
        let down = Transform::from_translate(0.0, -(first_row as f32));
        pixels.stroke_path(&path, &paint, &hairline, down, None);
    }
    for (texel, pixel) in strip.iter_mut().zip(pixels.pixels()) {
        *texel = pixel.red();
    }
}

/// A line as tiny-skia draws it, if it may touch a box.
fn drawn<I: Iterator<Item = [DVec2; 4]>>(line: Line<I>, low: DVec2, high: DVec2) -> Option<Path> {
    let mut path = PathBuilder::new();
    let mut meets = false;
    let mut note = |points: &[DVec2]| {
        let from = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let to = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        meets |= from.cmple(high).all() && to.cmpge(low).all();
    };
    match line {
        Line::Straight([from, to]) => {
            note(&[from, to]);
            let [from, to] = [from, to].map(|point| point.as_vec2());
            path.move_to(from.x, from.y);
            path.line_to(to.x, to.y);
        }
        Line::Curved(curves) => {
            for curve in curves {
                note(&curve);
                let [a, b, c, d] = curve.map(|point| point.as_vec2());
                if path.is_empty() {
                    path.move_to(a.x, a.y);
                }
                path.cubic_to(b.x, b.y, c.x, c.y, d.x, d.y);
            }
        }
    }
    if meets { path.finish() } else { None }
}
