//! The systems that curves with a cross-section of their own replaced, for work side by side with them: scratches of a
//! [`Pattern`], a canvas over texture space and what each system lets its user state in; prepared points out, which are
//! evaluated and sampled like any others ([`Shading`]).
//!
//! All three are told as Bosch, Pueyo, Mérillou and Ghazanfarpour (2004) tell them in their sections 2, 4 and 5:
//! - BB90: Becket and Badler, "Imperfection for realistic image synthesis" (1990);
//! - BL99: Buchanan and Lalonde, "An observational model for illuminating isolated scratches" (1999);
//! - MDG01: Mérillou, Dischler and Ghazanfarpour, "Surface scratches: measuring, modeling and rendering" (2001).
//!
//! What those sections leave open is said beside each choice. Where a system deals out scratches at random, the pattern's
//! generator does (`Style::Straight`), so that all of them can have the same ones. Surface and scale are the pattern's too.

mod bb90;
mod bl99;
mod canvas;
mod image;
mod mdg01;

pub use bl99::Highlight;
pub use canvas::Canvas;
pub use mdg01::TwoAngles;

use crate::brdf::Finish;
use crate::error::Result;
use crate::pattern::{Frame, Metric, Pattern, Region, SurfacePoint};
use crate::scattering::Shading;
use bb90::Intensities;
use bl99::Lists;
use mdg01::Painted;

/// A surface scratched in the manner of an earlier system. Immutable: share it between threads as you like.
#[derive(Debug)]
pub struct Baseline {
    surface: Finish,
    mm_per_scene_unit: f64,
    system: System,
}

#[derive(Debug)]
enum System {
    Bb90(Intensities),
    Bl99(Lists),
    Mdg01(Painted),
}

/// A shading point on the tangent plane.
struct Place {
    metric: Metric,
    /// What the pixel covers, mm around the point.
    pixel: Region,
}

impl Baseline {
    /// Becket and Badler (1990): each scratch is a straight line, from where the pattern's starts to where it ends, and
    /// reflects evenly in all directions: a random share of light, from `intensity[0]` to `intensity[1]` (each 0 to 1).
    ///
    /// Left open: how lines are wide; here they are painted one texel wide. A point shows the texel it lies in.
    pub fn bb90(
        pattern: &Pattern,
        canvas: &Canvas,
        intensity: [f32; 2],
        seed: u64,
    ) -> Result<Self> {
        let system = System::Bb90(Intensities::new(pattern, canvas, intensity, seed)?);
        Ok(Self::of(pattern, system))
    }

    /// Buchanan and Lalonde (1999): each scratch is a straight line, from where the pattern's starts to where it ends; each
    /// texel lists those that pass through it, and a point adds the strongest of their highlights to what the surface
    /// reflects. All scratches shine alike.
    ///
    /// Left open: which "Phong like" highlight; here Phong's about the nearest direction to which a thin line mirrors the
    /// view. Directions are told apart by 2.5 degrees. Such a surface may reflect more light than it gets.
    pub fn bl99(pattern: &Pattern, canvas: &Canvas, highlight: &Highlight) -> Result<Self> {
        let system = System::Bl99(Lists::new(pattern, canvas, highlight)?);
        Ok(Self::of(pattern, system))
    }

    /// Mérillou, Dischler and Ghazanfarpour (2001): scratches are painted into an image, and have one symmetric
    /// cross-section of two angles. A pixel that holds a painted texel has the scratch in its middle, which takes half of
    /// the pixel at most and runs the way that neighbouring texels say.
    ///
    /// Left open: how scratches are painted (here one texel wide, without shades), which texels are neighbours (here the
    /// seven by seven about the one nearest to the pixel's centre, the direction being that in which they stray most), and
    /// how wide a pixel is (here its area over how far the scratch runs through it). Pixels of many texels look at a
    /// coarser image, a texel of which is painted if any of its four is.
    pub fn mdg01(pattern: &Pattern, canvas: &Canvas, scratch: &TwoAngles) -> Result<Self> {
        let system = System::Mdg01(Painted::new(pattern, canvas, scratch)?);
        Ok(Self::of(pattern, system))
    }

    fn of(pattern: &Pattern, system: System) -> Self {
        Self {
            surface: pattern.hosts.found(&pattern.surface),
            mm_per_scene_unit: pattern.mm_per_scene_unit,
            system,
        }
    }

    /// Prepares a point for a view, as [`Shading::shade`] does. Allocates nothing.
    pub fn shade(&self, point: &SurfacePoint, view: [f32; 3], shading: &mut Shading) -> Result<()> {
        shading.shade_flat(self.surface, view)?;
        let frame = Frame::at(point)?;
        let scale = self.mm_per_scene_unit;
        let metric = Metric::at(point, &frame, scale)?;
        let ([a, b], footprint) = metric.edges(&point.footprint, scale);
        let pixel = Region::parallelogram(a, b);
        let place = Place { metric, pixel };
        match &self.system {
            System::Bb90(intensities) => intensities.add(&place, shading),
            System::Bl99(lists) => lists.add(&place, shading),
            System::Mdg01(painted) => painted.add(&place, shading),
        }
        footprint
    }

    /// How much memory its images or lists take.
    pub fn memory_bytes(&self) -> usize {
        match &self.system {
            System::Bb90(intensities) => intensities.memory_bytes(),
            System::Bl99(lists) => lists.memory_bytes(),
            System::Mdg01(painted) => painted.memory_bytes(),
        }
    }
}
