//! Mérillou, Dischler and Ghazanfarpour (2001): scratches painted into an image, one cross-section of two angles, and the
//! direction that neighbouring texels tell.

use super::Place;
use super::canvas::Canvas;
use super::image::{Image, Level, Line};
use crate::brdf::{Brdf, Finish};
use crate::error::{Result, in_range};
use crate::pattern::{Pattern, Region};
use crate::scattering::{Centred, Shading};
use crate::single;
use glam::{DVec2, IVec2};

/// A pixel's scratch takes no more of it than this.
const MOST_SHARE: f64 = 0.5;

/// Neighbouring texels are so far from the middle one at most.
const NEIGHBOURS: i32 = 3;

/// A cross-section of four zones of equal width: a peak, a groove, and the same peak again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoAngles {
    /// Width of all four zones together, mm, 1e-6 to 1e6.
    pub width_mm: f64,
    /// How steeply the peaks rise from the surface, degrees, 0 to 85.
    pub peak_deg: f64,
    /// How steeply the groove falls from their tops, degrees, 0 to 85.
    pub groove_deg: f64,
    /// Base BRDFs of the zones, from left to right.
    pub zones: [Brdf; 4],
}

impl TwoAngles {
    fn check(&self) -> Result<()> {
        in_range("width_mm", self.width_mm, 1e-6, 1e6)?;
        in_range("peak_deg", self.peak_deg, 0.0, 85.0)?;
        in_range("groove_deg", self.groove_deg, 0.0, 85.0)?;
        for (i, zone) in self.zones.iter().enumerate() {
            zone.check().map_err(|error| error.within("zones", i))?;
        }
        Ok(())
    }

    /// Points (x, z) of the cross-section, mm.
    fn vertices(&self) -> [[f32; 2]; 5] {
        let zone = 0.25 * self.width_mm;
        let peak = zone * self.peak_deg.to_radians().tan();
        let bottom = peak - zone * self.groove_deg.to_radians().tan();
        let points = [
            [-2.0 * zone, 0.0],
            [-zone, peak],
            [0.0, bottom],
            [zone, peak],
            [2.0 * zone, 0.0],
        ];
        points.map(|point| point.map(single))
    }
}

/// The painted scratches.
#[derive(Debug)]
pub(super) struct Painted {
    canvas: Canvas,
    image: Image,
    width_mm: f64,
    vertices: [[f32; 2]; 5],
    finishes: [Finish; 4],
}

impl Painted {
    pub(super) fn new(pattern: &Pattern, canvas: &Canvas, scratch: &TwoAngles) -> Result<Self> {
        canvas.check()?;
        scratch.check()?;
        let count = u32::try_from(pattern.scratch_count()).unwrap_or(u32::MAX);
        let image = Image::paint(canvas, count, |number| {
            let way = pattern.way(number);
            let placed = way.map(|curve| curve.map(|uv| canvas.place(uv)));
            Some((Line::Curved(placed), u8::MAX))
        });
        Ok(Self {
            canvas: *canvas,
            image: image.with_coarser(),
            width_mm: scratch.width_mm,
            vertices: scratch.vertices(),
            finishes: scratch.zones.map(|zone| Finish::new(&zone)),
        })
    }

    /// A pixel that holds a painted texel has the scratch in its middle.
    pub(super) fn add(&self, place: &Place, shading: &mut Shading) {
        let Some((level, at, texel)) = self.image.nearest(place) else {
            return;
        };
        let texel = texel / self.canvas.per_uv();
        let travel = direction(level, at, |step| place.metric.to_mm * (step * texel));
        let pixel_mm = width_across(&place.pixel, travel).max(self.width_mm / MOST_SHARE);
        shading.add_centred(&Centred {
            vertices: &self.vertices,
            finishes: &self.finishes,
            across: DVec2::new(travel.y, -travel.x).as_vec2(),
            pixel_mm: single(pixel_mm),
            is_added: false,
        });
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.image.memory_bytes()
    }
}

/// How wide a pixel is across this direction, on average of all that it covers.
fn width_across(pixel: &Region, travel: DVec2) -> f64 {
    let corners = pixel.corners().iter();
    let reach = corners.map(|corner| corner.length()).fold(0.0, f64::max);
    let end = reach * travel;
    let inside = pixel.part_of_segment([-end, end]);
    let length = inside.map_or(0.0, |[from, to]| (to - from) * 2.0 * reach);
    // Of a point it is nothing.
    pixel.area() / length.max(f64::MIN_POSITIVE)
}

/// The direction in which the painted texels about one stray most from their middle; along x if they are alone. `to_mm`
/// places steps of texels on the surface.
fn direction(level: &Level, at: IVec2, to_mm: impl Fn(DVec2) -> DVec2) -> DVec2 {
    let around = -NEIGHBOURS..=NEIGHBOURS;
    let steps = around
        .clone()
        .flat_map(|y| around.clone().map(move |x| IVec2::new(x, y)));
    let painted = steps.filter(|step| level.is_painted(at + *step));
    let (mut count, mut sum) = (0.0, DVec2::ZERO);
    // Sums of xx, yy and xy.
    let mut squares = [0.0; 3];
    for step in painted {
        let place = to_mm(step.as_dvec2());
        count += 1.0;
        sum += place;
        squares[0] += place.x * place.x;
        squares[1] += place.y * place.y;
        squares[2] += place.x * place.y;
    }
    let mean = sum / count;
    let apart = squares[0] - squares[1] - count * (mean.x * mean.x - mean.y * mean.y);
    let both = squares[2] - count * mean.x * mean.y;
    DVec2::from_angle(0.5 * (2.0 * both).atan2(apart))
}
