//! What flocks reflect of lights: flocks of one cross-section side by side, facet after facet.
//!
//! The same equations as in `eval.rs` and `reverse.rs`, with numbers for a cross-section's facets and registers for flocks: so
//! registers are full however few facets there are, and what the view alone decides is found once for all lights.

use super::flocks::Abreast;
use super::relief::MOST_FINISHES;
use super::shading::Shading;
use super::slopes::{MOST_FACETS, Section, Slope, Widths};
use crate::brdf::{Local, Pair, turned_each};
use crate::lanes::{Lanes, Number, in_lanes};
use glam::Vec3;

/// A light with the view, and where densities are asked for also mirrored below the surface.
#[derive(Clone, Copy)]
pub(super) struct Light {
    pub pair: Pair,
    pub below: Option<Pair>,
}

/// What flocks reflect of one light, flock beside flock or all together.
#[derive(Clone, Copy)]
pub(super) struct Reflected<F> {
    /// By finish.
    pub lobes: [F; MOST_FINISHES],
    /// What of the flat surface they take from the light.
    pub taken: F,
    /// How often their zones' samples go to the light, where that is asked for.
    pub density: F,
}

impl Light {
    pub(super) fn new(pair: Pair) -> Self {
        Self { pair, below: None }
    }

    pub(super) fn with_density(pair: Pair) -> Self {
        Self {
            pair,
            below: Some(pair.below()),
        }
    }
}

impl Reflected<f32> {
    pub(super) const NONE: Self = Self {
        lobes: [0.0; MOST_FINISHES],
        taken: 0.0,
        density: 0.0,
    };
}

impl<F: Number> Reflected<F> {
    #[inline(always)]
    fn none<L: Lanes<F = F>>(lanes: L) -> Self {
        let none = lanes.all(0.0);
        Self {
            lobes: [none; MOST_FINISHES],
            taken: none,
            density: none,
        }
    }

    /// All flocks together.
    #[inline(always)]
    fn sum(&self) -> Reflected<f32> {
        let mut lobes = [0.0; MOST_FINISHES];
        for (sum, lobe) in lobes.iter_mut().zip(self.lobes) {
            *sum = lobe.sum();
        }
        Reflected {
            lobes,
            taken: self.taken.sum(),
            density: self.density.sum(),
        }
    }
}

impl Shading {
    /// What all flocks together reflect of each light; kept apart, for few points have any.
    #[inline(always)]
    pub(super) fn by_flocks<L: Lanes, const LIGHTS: usize>(
        &self,
        lanes: L,
        lights: &[Light; LIGHTS],
    ) -> [Reflected<f32>; LIGHTS] {
        lanes.call(
            #[inline(always)]
            || {
                let mut sums = [Reflected::none(lanes); LIGHTS];
                self.add_flocks(lanes, lights, &mut sums);
                sums.map(
                    #[inline(always)]
                    |sum| sum.sum(),
                )
            },
        )
    }

    /// In what share of the pixel a viewer sees all flocks, and what share they cover.
    pub(super) fn seen_of_flocks(&self, from: Vec3) -> [f32; 2] {
        if self.flocks.is_empty() {
            return [0.0; 2];
        }
        in_lanes!(lanes => self.seen_in(lanes, from))
    }

    #[inline(always)]
    fn seen_in<L: Lanes>(&self, lanes: L, from: Vec3) -> [f32; 2] {
        let (mut seen, mut shares) = (lanes.all(0.0), lanes.all(0.0));
        let mut widths = Widths::none(lanes);
        for (slots, flocks) in self.flocks.classes() {
            let mut up = [0.0; MOST_FACETS];
            let section = self.zones.section(slots, &mut up);
            for first in flocks.clone().step_by(L::WIDTH) {
                let flocks = self.flocks.abreast(lanes, first..flocks.end);
                let view = Slope::of(lanes, &turned_each(from, flocks.across));
                let (_, [own, _]) = section.see(lanes, &view, &flocks.strips, &mut widths);
                seen = seen + own;
                shares = shares + flocks.share;
            }
        }
        [seen.sum(), shares.sum()]
    }

    /// Adds what all flocks reflect of each light.
    #[inline(always)]
    fn add_flocks<L: Lanes>(&self, lanes: L, lights: &[Light], sums: &mut [Reflected<L::F>]) {
        let mut widths = Widths::none(lanes);
        for (slots, flocks) in self.flocks.classes() {
            let mut up = [0.0; MOST_FACETS];
            let section = self.zones.section(slots, &mut up);
            for first in flocks.clone().step_by(L::WIDTH) {
                let flocks = self.flocks.abreast(lanes, first..flocks.end);
                self.add_abreast(lanes, &section, &flocks, lights, &mut widths, sums);
            }
        }
    }

    #[inline(always)]
    fn add_abreast<L: Lanes>(
        &self,
        lanes: L,
        section: &Section<'_>,
        flocks: &Abreast<L::F>,
        lights: &[Light],
        widths: &mut Widths<L::F>,
        sums: &mut [Reflected<L::F>],
    ) {
        let view = Slope::of(lanes, &turned_each(self.view, flocks.across));
        let (seen_flat, [hidden, seen]) = section.see(lanes, &view, &flocks.strips, widths);
        let shown = flocks.shown / seen.max(lanes.all(f32::MIN_POSITIVE));
        for (light, sums) in lights.iter().zip(sums) {
            let pair = light.pair.turned_each(flocks.across);
            let slope = Slope::of(lanes, &pair.light);
            let [from, to] = section.light(lanes, &slope, &view, seen_flat, widths);
            let shadow = (to - from) - (seen_flat[1] - seen_flat[0]);
            sums.taken = flocks.share.times_plus(shadow, sums.taken + hidden);
            self.add_lobes(lanes, section, &pair, &widths.lit, sums);
            if let Some(below) = &light.below {
                let below = below.turned_each(flocks.across);
                self.add_densities(lanes, section, [&pair, &below], shown, &widths.shown, sums);
            }
        }
    }

    #[inline(always)]
    fn add_lobes<L: Lanes>(
        &self,
        lanes: L,
        section: &Section<'_>,
        pair: &Local<L::F>,
        lit: &[L::F; MOST_FACETS],
        sums: &mut Reflected<L::F>,
    ) {
        for (number, run) in &section.runs {
            let facets = section.facets(run, lit);
            let finish = self.zones.finish_of(*number);
            let lobes = finish.lit_lobes(lanes, pair, facets);
            let sum = &mut sums.lobes[*number as usize];
            *sum = *sum + lobes;
        }
    }

    #[inline(always)]
    fn add_densities<L: Lanes>(
        &self,
        lanes: L,
        section: &Section<'_>,
        pairs: [&Local<L::F>; 2],
        shown: L::F,
        seen: &[L::F; MOST_FACETS],
        sums: &mut Reflected<L::F>,
    ) {
        for (number, run) in &section.runs {
            let finish = self.zones.finish_of(*number);
            for pair in pairs {
                let facets = section.facets(run, seen);
                let density = finish.seen_pdfs(lanes, pair, facets);
                sums.density = density.times_plus(shown, sums.density);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brdf::{Brdf, Finish, Fresnel};
    use crate::lanes::One;
    use crate::scattering::flocks::Flock;
    use core::f32::consts::{FRAC_PI_2, TAU};
    use glam::Vec2;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    const FRESNEL: Fresnel = Fresnel::Schlick {
        f0: [0.9, 0.6, 0.3],
    };

    fn brdfs() -> [Brdf; 5] {
        let albedo = [0.5, 0.6, 0.7];
        [
            Brdf::Lambert { albedo },
            Brdf::Ggx {
                alpha: 0.1,
                fresnel: FRESNEL,
            },
            Brdf::AnisotropicGgx {
                alpha_across: 0.4,
                alpha_along: 0.05,
                fresnel: FRESNEL,
            },
            Brdf::CookTorrance {
                alpha: 0.2,
                fresnel: FRESNEL,
            },
            Brdf::Phong {
                specular: albedo,
                exponent: 50.0,
            },
        ]
    }

    /// From straight above to grazing, once around.
    fn direction(random: &mut StdRng) -> Vec3 {
        let up = 0.01_f32.powf(random.random_range(0.0..1.0));
        let round = Vec2::from_angle(random.random_range(0.0..TAU));
        (round * (1.0 - up * up).sqrt()).extend(up)
    }

    /// A point that holds so many flocks of several cross-sections, of 1 to 35 facets and unlike left and right.
    fn crowded(random: &mut StdRng, flocks: u32) -> Shading {
        let mut shading = Shading::default();
        shading
            .begin(&Finish::new(&brdfs()[1]), direction(random).into())
            .unwrap();
        let numbers = brdfs().map(|brdf| shading.zones.finish(&Finish::new(&brdf)));
        let mut first = 0;
        for class in 0..4_u32 {
            let points = random.random_range(2..=36_u32);
            for k in 0..points {
                let slot = (first + k) as usize;
                shading.zones.x[slot] = k as f32 / (points - 1) as f32 - 0.5;
                shading.zones.z[slot] = random.random_range(-0.2..0.1);
                // Some facets in a row have the same one.
                let number = (k / 3 + class) as usize % numbers.len();
                shading.zones.finish[slot] = numbers[number];
            }
            for slot in (first as usize..).take(points as usize - 1) {
                let zones = &mut shading.zones;
                let run = [
                    zones.x[slot + 1] - zones.x[slot],
                    zones.z[slot + 1] - zones.z[slot],
                ];
                zones.normal_x[slot] = -Vec2::from(run).normalize().y;
            }
            for _ in 0..flocks / 4 + u32::from(class < flocks % 4) {
                let share = random.random_range(0.0..2.0) / flocks as f32;
                shading.flocks.push(&Flock {
                    across: Vec2::from_angle(random.random_range(-FRAC_PI_2..3.0)),
                    slots: [first, points],
                    share,
                    strips: core::array::from_fn(|_| random.random_range(0.0..1.0)),
                    shown: 0.0,
                });
            }
            first += points;
        }
        shading.share_out();
        shading
    }

    /// The same sums, zone after zone.
    fn one_by_one(shading: &Shading, pair: &Pair) -> Reflected<f32> {
        let mut sums = Reflected::NONE;
        let below = pair.below();
        shading.each_zone(pair, |zone, turned, across| {
            sums.lobes[zone.finish as usize] += shading.lobe(One, zone, turned);
            sums.density += shading.density(One, zone, turned, &below, across);
        });
        sums
    }

    /// RGB and density.
    fn answers(shading: &Shading, sums: &Reflected<f32>, pair: &Pair) -> [f32; 4] {
        let rgb = shading.zones.colour(One, &sums.lobes, pair.view_half);
        rgb.extend(shading.mean(sums.density)).into()
    }

    /// Flocks side by side reflect and are chosen as each does by itself: registers that are not full, cross-sections that
    /// follow one another, light and view from either side and grazing.
    #[test]
    fn side_by_side_as_one_by_one() {
        let mut random = StdRng::seed_from_u64(7);
        let mut worst = [0.0_f32; 2];
        for flocks in [1, 7, 8, 9, 31, 128].into_iter().cycle().take(600) {
            let shading = crowded(&mut random, flocks);
            let pair = Pair::new(shading.view, direction(&mut random));
            let below = pair.below();
            let wanted = answers(&shading, &one_by_one(&shading, &pair), &pair);
            let found = [
                shading.scratch_sums(One, &pair, Some(&below)),
                in_lanes!(lanes => shading.scratch_sums(lanes, &pair, Some(&below))),
            ];
            let found = found.map(|mut sums| {
                shading.add_surface(&mut sums, &pair, Some(&below));
                sums
            });
            for (worst, found) in worst.iter_mut().zip(&found) {
                for (found, wanted) in answers(&shading, found, &pair).iter().zip(wanted) {
                    let off = (found - wanted).abs() / found.max(wanted).max(1e-4);
                    assert!(off < 1e-5, "{found} against {wanted}, {flocks} flocks");
                    *worst = worst.max(off);
                }
            }
        }
        println!("off by {worst:?}");
    }
}
