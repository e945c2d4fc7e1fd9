//! Becket and Badler (1990): straight lines, each of a random intensity.

use super::Place;
use super::canvas::{Canvas, straight};
use super::image::{Image, Line};
use crate::brdf::{Brdf, Finish};
use crate::error::{Error, Result, in_range};
use crate::pattern::Pattern;
use crate::scattering::{Centred, Shading};
use glam::{DVec2, Vec2};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// Lines painted in their intensities.
#[derive(Debug)]
pub(super) struct Intensities {
    image: Image,
    /// Of shades 0 and 255.
    range: [f32; 2],
}

impl Intensities {
    pub(super) fn new(
        pattern: &Pattern,
        canvas: &Canvas,
        intensity: [f32; 2],
        seed: u64,
    ) -> Result<Self> {
        canvas.check()?;
        for share in intensity {
            in_range("intensity", f64::from(share), 0.0, 1.0)?;
        }
        if intensity[0] > intensity[1] {
            let accepted = "the lowest intensity, then the highest";
            return Err(Error::number("intensity", intensity[0].into(), accepted));
        }
        let count = u32::try_from(pattern.scratch_count()).unwrap_or(u32::MAX);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        // Shade 0 is unpainted.
        let shades: Vec<u8> = (0..count)
            .map(|_| u8::try_from(1 + random.next_u32() % 255).unwrap_or(u8::MAX))
            .collect();
        let image = Image::paint(canvas, count, |scratch| {
            let line = Line::<core::iter::Empty<[DVec2; 4]>>::Straight(straight(
                pattern, canvas, scratch,
            )?);
            Some((line, shades[scratch as usize]))
        });
        Ok(Self {
            image,
            range: intensity,
        })
    }

    /// A pixel whose texel is painted is all scratch.
    pub(super) fn add(&self, place: &Place, shading: &mut Shading) {
        let shade = self.image.shade_at(place.metric.uv);
        if shade == 0 {
            return;
        }
        let [darkest, brightest] = self.range;
        let intensity = darkest + (brightest - darkest) * f32::from(shade - 1) / 254.0;
        let finish = Finish::new(&Brdf::Lambert {
            albedo: [intensity.clamp(0.0, 1.0); 3],
        });
        shading.add_centred(&Centred {
            vertices: &[[-0.5, 0.0], [0.5, 0.0]],
            finishes: &[finish; 2],
            across: Vec2::X,
            pixel_mm: 1.0,
            is_added: false,
        });
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.image.memory_bytes()
    }
}
