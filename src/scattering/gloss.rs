//! What the glossy zones of a scratch reflect of one another's first light: by direction, where [`Exchange`] takes all to
//! scatter evenly.

use super::exchange::Exchange;
use super::relief::MOST_FINISHES;
use super::shading::Shading;
use crate::brdf::{Finish, Lobe, Pair, Pairs};
use crate::lanes::{Lanes, Number, Vector, in_lanes};
use crate::single;
use core::f32::consts::{FRAC_1_PI, FRAC_2_PI, PI};
use glam::{Vec2, Vec3};

/// Directions between two facets that are looked at, for each of the ways between [`PLACES`].
const LEANINGS: usize = 16;

/// Places on each of two facets, as shares of it.
const PLACES: [f32; 2] = [0.211_324_87, 0.788_675_1];

/// A zone that fills less of what another sees is not worth the look: its light counts as scattered evenly.
const LEAST_SHARE: f32 = 1e-4;

/// One that fills more is looked at from each of [`PLACES`] to each, others from middle to middle.
const LARGE_SHARE: f32 = 0.005;

/// Lobes narrower than this would fall between the directions that are looked at.
const LEAST_ALPHA: f32 = 0.06;

impl Shading {
    /// What glossy facets send of one another's first light, by its direction, beyond what they would if they scattered it
    /// evenly: `direct` gives what falls on each.
    pub(super) fn gloss<const CORNERS: usize>(
        &self,
        exchange: &Exchange<CORNERS>,
        number: &[u8; CORNERS],
        direct: &[f32; CORNERS],
        pair: &Pair,
    ) -> [Vec3; CORNERS] {
        let mut more = [Vec3::ZERO; CORNERS];
        let known = self.zones.finishes();
        if known.iter().all(|finish| finish.kind() == Lobe::Diffuse) {
            return more;
        }
        let mut finishes = [Finish::BLACK; MOST_FINISHES];
        for (number, (own, finish)) in (0_u8..).zip(finishes.iter_mut().zip(known)) {
            let looked_at = finish.without_host(self.zones.albedo_of(number));
            *own = looked_at.no_sharper_than(LEAST_ALPHA);
        }
        // What is diffuse is known already.
        let is_glossy = |i: usize| finishes[number[i] as usize].kind() != Lobe::Diffuse;
        let mut leanings = [const { [const { None }; MOST_FINISHES] }; MOST_FINISHES];
        let strip = |i: usize| {
            let number = number[i] as usize;
            strip_of(exchange, i, [&finishes[number], &known[number]])
        };
        for (near, more) in more.iter_mut().enumerate().take(exchange.facets) {
            let own = strip(near);
            if Vec2::from(own.normal).dot(Vec2::new(pair.view.x, pair.view.z)) <= 0.0 {
                continue;
            }
            for far in (0..exchange.facets).filter(|&far| direct[far] > 0.0) {
                let share = exchange.share(near, far);
                if share <= LEAST_SHARE || !(is_glossy(near) || is_glossy(far)) {
                    continue;
                }
                let [i, j] = [near, far].map(|facet| number[facet]);
                let even = self.zones.albedo_of(i) * self.zones.albedo_of(j) * FRAC_1_PI;
                let other = strip(far);
                let leanings = leanings[i as usize][j as usize]
                    .get_or_insert_with(|| Leanings::new(own.finish, other.finish, pair));
                let places = if share > LARGE_SHARE {
                    &PLACES[..]
                } else {
                    &[0.5]
                };
                let passed_on = passed_on(&own, &other, places, leanings, pair);
                *more += share * direct[far] * (passed_on - even);
            }
        }
        more
    }
}

/// One facet of two that see each other.
#[derive(Clone, Copy)]
struct Strip<'f> {
    ends: [Vec2; 2],
    normal: [f32; 2],
    /// What is looked at in the place of its own finish, which a host may have given or be too sharp.
    finish: &'f Finish,
    own: &'f Finish,
}

impl Strip<'_> {
    /// What its reflection has beside the lobe for a pair of directions, RGB. A host's own is asked this once.
    fn colour(&self, pair: &Pair) -> Vec3 {
        let shared = self.finish.shared(pair);
        // Where its lobe is sharp, one direction tells nothing.
        if self.own.hosted().is_none() || self.own.alpha() < LEAST_ALPHA {
            return shared;
        }
        let normal = Vec3::new(self.normal[0], 0.0, self.normal[1]);
        let lobe = self.finish.lobe_cos(normal, pair);
        let colour = self.own.hosted_cos(normal, pair) / lobe;
        if colour.is_finite() {
            colour.min(Vec3::ONE)
        } else {
            shared
        }
    }

    fn place(&self, share: f32) -> Vec2 {
        self.ends[0].lerp(self.ends[1], share)
    }
}

/// How far light between two facets leans along the scratch: sines, close together where both lobes are high, and how
/// much each counts. Between endless strips light goes by the squared cosine.
struct Leanings {
    middle: f32,
    sines: [f32; LEANINGS],
    shares: [f32; LEANINGS],
}

impl Leanings {
    /// Between facets of these finishes, towards the viewer from the first and from the light to the second.
    fn new(near: &Finish, far: &Finish, pair: &Pair) -> Self {
        let [a, b] = [near, far].map(|finish| finish.alphas().y.powi(-2));
        // Mirrors keep what of a direction runs along the scratch; at a grazing view lobes are less wide along than alpha.
        let middle = (pair.light.y * b - pair.view.y * a) / (a + b);
        let width = 0.5 * (a + b).sqrt().recip();
        let [from, to] = [-1.0, 1.0].map(|end: f32| ((end - middle) / width).atan());
        let (mut sines, mut shares) = ([0.0; LEANINGS], [0.0; LEANINGS]);
        let step = (to - from) / LEANINGS as f32;
        for (i, (sine, share)) in sines.iter_mut().zip(&mut shares).enumerate() {
            let at = (from + (i as f32 + 0.5) * step).tan();
            *sine = (middle + width * at).clamp(-1.0, 1.0);
            let cos = (1.0 - *sine * *sine).sqrt();
            *share = FRAC_2_PI * cos * width * (1.0 + at * at) * step;
        }
        Self {
            middle,
            sines,
            shares,
        }
    }
}

/// Radiance to the viewer from `near` per irradiance of the light on `far`, were all that `near` sees of such a
/// radiance: RGB. Directions in the scratch's frame.
fn passed_on(
    near: &Strip<'_>,
    far: &Strip<'_>,
    places: &[f32],
    leanings: &Leanings,
    pair: &Pair,
) -> Vec3 {
    let lobes = in_lanes!(lanes => lobes(lanes, near, far, places, leanings, pair));
    let sine = leanings.middle;
    let e = (far.place(0.5) - near.place(0.5)).normalize_or(Vec2::Y) * (1.0 - sine * sine).sqrt();
    let onwards = Vec3::new(e.x, sine, e.y);
    let colour =
        near.colour(&Pair::new(pair.view, onwards)) * far.colour(&Pair::new(pair.light, -onwards));
    PI * lobes * colour
}

/// The mean product of both lobes over all directions from one to the other.
#[inline(always)]
fn lobes<L: Lanes>(
    lanes: L,
    near: &Strip<'_>,
    far: &Strip<'_>,
    places: &[f32],
    leanings: &Leanings,
    pair: &Pair,
) -> f32 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..places.len() * places.len() {
        let way = far.place(places[i / places.len()]) - near.place(places[i % places.len()]);
        let length = way.length();
        let e = way / length;
        let near_cos = e.dot(Vec2::from(near.normal));
        let far_cos = -e.dot(Vec2::from(far.normal));
        let weight = near_cos * far_cos / length;
        if near_cos <= 1e-4 || far_cos <= 1e-4 || !weight.is_finite() {
            continue;
        }
        weights += weight;
        for first in (0..LEANINGS).step_by(L::WIDTH) {
            let sine = lanes.load(&leanings.sines[first..]);
            let cos = (-(sine * sine) + 1.0).max(lanes.all(1e-6)).sqrt();
            let onwards = Vector {
                x: cos * e.x,
                y: sine,
                z: cos * e.y,
            };
            let back = Vector {
                x: -onwards.x,
                y: -onwards.y,
                z: -onwards.z,
            };
            let seen = Pairs::new(pair.view, onwards).tilted(near.normal);
            let lit = Pairs::new(pair.light, back).tilted(far.normal);
            let both = near.finish.lobes_cos(lanes, &seen) * far.finish.lobes_cos(lanes, &lit);
            let share = lanes.load(&leanings.shares[first..]) / (cos * cos);
            sum += weight / (near_cos * far_cos) * (both * share).sum();
        }
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

/// A facet of the exchange as one of two.
fn strip_of<'f, const CORNERS: usize>(
    exchange: &Exchange<CORNERS>,
    facet: usize,
    [finish, own]: [&'f Finish; 2],
) -> Strip<'f> {
    let ends = exchange.corners(facet);
    let run = (ends[1] - ends[0]).normalize_or(glam::DVec2::X);
    Strip {
        ends: ends.map(|end| end.as_vec2()),
        normal: [single(-run.y), single(run.x)],
        finish,
        own,
    }
}
