//! One cross-section shaded by itself: in a pixel of any place, or, as in earlier systems, in the middle of it.

use super::footprint::Weight;
use super::relief::MOST_SLOTS;
use super::shading::{LEAST_COS, Shading};
use crate::brdf::{Brdf, Finish};
use crate::error::{Error, Result, all_finite, in_range};
use crate::pattern::{CenterLine, Region};
use glam::{DVec2, Vec2};

/// Points of a cross-section that is shaded by itself.
const MOST_POINTS: usize = 100;

const _: () = assert!(
    MOST_POINTS <= MOST_SLOTS,
    "it finds room in a shading point"
);

/// Which part of the surface a pixel covers when a cross-section is shaded by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CrossFootprint {
    /// The whole cross-section and so many mm of flat surface on each side, as in the paper's section 4.1.
    Whole {
        /// Flat surface on each side, mm, 0 to 1e6. As in the paper, relief that hides or shadows more than
        /// that is not accounted for: at grazing angles the margin must be wide.
        margin_mm: f32,
    },
    /// A pixel's box filter.
    Box {
        /// The pixel's centre, mm to the right of the centre line, -1e6 to 1e6.
        center_mm: f64,
        /// How long the footprint's two edges are across the scratch, mm, 0 to 1e6.
        extents_mm: [f64; 2],
    },
}

/// A cross-section in the middle of a pixel, whose sides run along it.
#[cfg(feature = "files")]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Centred<'a> {
    /// (x, z) in mm, x not descending, the first and last at z = 0.
    pub vertices: &'a [[f32; 2]],
    /// One for each facet.
    pub finishes: &'a [Finish],
    /// Unit vector to the right of travel, in the local frame.
    pub across: Vec2,
    /// How far the pixel reaches across.
    pub pixel_mm: f32,
    /// Whether it adds to what the flat surface reflects, rather than to take the surface's place.
    pub is_added: bool,
}

impl Shading {
    /// Prepares one cross-section for a view, without a pattern: 2 to 100 points (x, z) in mm, x not descending,
    /// the first and last at z = 0; the scratch runs along y.
    pub fn shade_cross_section(
        &mut self,
        vertices: &[[f32; 2]],
        scratched: &Brdf,
        surface: &Brdf,
        pixel: CrossFootprint,
        view: [f32; 3],
    ) -> Result<()> {
        self.begin(&Finish::new(&surface.check()?), view)?;
        check_cross_section(vertices)?;
        let finish = Finish::new(&scratched.check()?);
        let weight = match pixel {
            CrossFootprint::Whole { margin_mm } => {
                in_range("margin_mm", f64::from(margin_mm), 0.0, 1e6)?;
                let (first, last) = (vertices[0][0], vertices[vertices.len() - 1][0]);
                let window = [first - margin_mm, last + margin_mm];
                self.zones.densities.add_uniform(window)
            }
            CrossFootprint::Box {
                center_mm,
                extents_mm: [a, b],
            } => {
                in_range("center_mm", center_mm, -1e6, 1e6)?;
                in_range("extents_mm", a, 0.0, 1e6)?;
                in_range("extents_mm", b, 0.0, 1e6)?;
                let region = Region::parallelogram(DVec2::new(a, 1.0), DVec2::new(b, -1.0));
                let line = CenterLine::even(DVec2::new(-center_mm, 0.0), DVec2::Y);
                let densities = &mut self.zones.densities;
                densities.add_regions(&[region], &line, region.area())
            }
        };
        if let Some(weight) = weight {
            self.add_alone(vertices, core::iter::repeat(finish), Vec2::X, weight);
        }
        Ok(())
    }

    /// Prepares a point of the flat surface, for [`Self::add_centred`].
    #[cfg(feature = "files")]
    pub(crate) fn shade_flat(&mut self, surface: Finish, view: [f32; 3]) -> Result<()> {
        self.begin(&surface, view)
    }

    /// Puts a scratch into a pixel that has none yet.
    #[cfg(feature = "files")]
    pub(crate) fn add_centred(&mut self, scratch: &Centred<'_>) {
        let half = 0.5 * scratch.pixel_mm;
        let weight = self.zones.densities.add_uniform([-half, half]);
        let Some(weight) = weight else { return };
        let weight = if scratch.is_added {
            weight.taking_nothing()
        } else {
            weight
        };
        let finishes = scratch.finishes.iter().copied();
        self.add_alone(scratch.vertices, finishes, scratch.across, weight);
        self.scratch_count = 1;
    }

    /// Adds the only scratch; `finishes` are those of its facets.
    fn add_alone(
        &mut self,
        vertices: &[[f32; 2]],
        finishes: impl Iterator<Item = Finish>,
        across: Vec2,
        weight: Weight,
    ) {
        if self.view.z < LEAST_COS {
            return;
        }
        let mut numbers = [0; MOST_POINTS];
        for (number, finish) in numbers[..vertices.len()].iter_mut().zip(finishes) {
            *number = self.zones.finish(&finish);
        }
        let vertices = self.zones.place_points(vertices, &numbers);
        let prepared = self.zones.prepare(vertices, across, weight, self.view);
        if let Some(relief) = prepared {
            self.reliefs[0] = relief;
            self.relief_count = 1;
        }
        self.share_out();
    }
}

fn check_cross_section(vertices: &[[f32; 2]]) -> Result<()> {
    if !(2..=MOST_POINTS).contains(&vertices.len()) {
        return Err(Error::count("vertex_count", vertices.len(), "2 to 100"));
    }
    let last = vertices.len() - 1;
    for (i, &[x, z]) in vertices.iter().enumerate() {
        let before = if i == 0 { f32::MIN } else { vertices[i - 1][0] };
        in_range("x", f64::from(x), f64::from(before), f64::from(f32::MAX))
            .and_then(|_| all_finite("z", &[z]))
            .map_err(|error| error.within("vertices", i))?;
    }
    for i in [0, last] {
        in_range("z", f64::from(vertices[i][1]), 0.0, 0.0)
            .map_err(|error| error.within("vertices", i))?;
    }
    Ok(())
}
