//! Single scratches of a generator, each from a stream of random numbers of its own.

use super::Generator;
use super::distribution::Inverse;
use super::normal;
use crate::formation::{DepthLaw, Tool};
use crate::pattern::{Held, Key, Path, Scratch};
use core::ops::Range;
use glam::DVec2;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};

/// A single curve never turns by more.
const MOST_TURN_DEG: f64 = 90.0;

/// What the random numbers are keyed with besides the seed. Changes when the same seed is to mean other scratches.
const KEY: &[u8; 24] = b"striae generator, 2026.1";

/// A generator's scratches, each of which can be asked for by its number, in any order and from any thread.
#[derive(Clone, Debug)]
pub struct Strokes {
    generator: Generator,
    count: u32,
    mm_per_uv: DVec2,
    length_mm: Inverse,
    force_kgf: Inverse,
    depth_mm: Inverse,
    random: ChaCha8Rng,
}

/// One generated scratch: a buffer that is filled again and again.
#[derive(Clone, Debug, Default)]
pub struct Stroke {
    points_uv: Vec<[f64; 2]>,
    keys: Vec<Key>,
    depth_law: DepthLaw,
    held: Held,
}

impl Stroke {
    /// Control points of its cubic Bézier curves, (u, v).
    pub fn points_uv(&self) -> &[[f64; 2]] {
        &self.points_uv
    }

    /// Force, depth and orientation along it.
    pub fn keys(&self) -> &[Key] {
        &self.keys
    }

    /// As a scratch to add, made by `tool` in the pattern's own material.
    pub fn scratch<'a>(&'a self, tool: &'a Tool) -> Scratch<'a> {
        Scratch {
            depth_law: self.depth_law,
            held: self.held,
            path: Path::CubicBezier(&self.points_uv),
            keys: &self.keys,
            ..Scratch::new(tool)
        }
    }
}

/// The random numbers of one scratch, in an order that never changes, each evenly spread between 0 and 1.
struct Draws(ChaCha8Rng);

impl Draws {
    /// Above 0 and below 1.
    fn share(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) * f64::EPSILON
    }

    /// Normally distributed about 0.
    fn normal(&mut self, deviation: f64) -> f64 {
        let share = self.share();
        if deviation > 0.0 {
            deviation * normal::quantile(share)
        } else {
            0.0
        }
    }
}

impl Strokes {
    pub(super) fn new(generator: &Generator, count: u32, mm_per_uv: [f64; 2], seed: u64) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..].copy_from_slice(KEY);
        Self {
            generator: generator.clone(),
            count,
            mm_per_uv: DVec2::from(mm_per_uv),
            length_mm: Inverse::new(&generator.length_mm),
            force_kgf: Inverse::new(&generator.force_kgf),
            depth_mm: Inverse::new(&generator.depth_mm),
            random: ChaCha8Rng::from_seed(key),
        }
    }

    /// How many scratches there are.
    pub fn count(&self) -> u32 {
        self.count
    }

    /// Calls with each scratch whose number lies in `numbers`, in order, until a call fails.
    pub fn try_for_each<E>(
        &self,
        numbers: Range<u32>,
        mut call: impl FnMut(u32, &Stroke) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut stroke = Stroke::default();
        for number in numbers {
            self.stroke(number, &mut stroke);
            call(number, &stroke)?;
        }
        Ok(())
    }

    /// Writes scratch `number` into `stroke`. The same number is the same scratch, however many there are: a
    /// denser pattern holds the sparser one.
    pub fn stroke(&self, number: u32, stroke: &mut Stroke) {
        let mut draws = Draws(self.random.clone());
        draws.0.set_stream(u64::from(number));
        let generator = &self.generator;
        let [from, to] = generator.area_uv.map(DVec2::from);
        let middle_uv = from + (to - from) * DVec2::new(draws.share(), draws.share());
        let heading_deg = generator.direction_deg + draws.normal(generator.spread_deg);
        let length_mm = self.length_mm.at(draws.share());
        let force_kgf = self.force_kgf.at(draws.share());
        let depth_mm = self.depth_mm.at(draws.share());
        let most_deg = f64::from(generator.curves) * MOST_TURN_DEG;
        let turn_deg = generator.turn_deg + draws.normal(generator.turn_spread_deg);
        let spin_deg = draws.normal(generator.spin_spread_deg);

        self.keys(force_kgf, depth_mm, spin_deg, &mut stroke.keys);
        let hand = Hand {
            curves: generator.curves,
            length_mm,
            heading_deg,
            turn_deg: turn_deg.clamp(-most_deg, most_deg),
            wander_deg: generator.wander_deg,
        };
        hand.draw(&mut draws, &mut stroke.points_uv);
        let to_middle = middle_uv - middle(&stroke.points_uv) / self.mm_per_uv;
        for point in &mut stroke.points_uv {
            *point = (DVec2::from(*point) / self.mm_per_uv + to_middle).to_array();
        }
        (stroke.depth_law, stroke.held) = (generator.depth_law, generator.held);
    }

    /// Force and depth in full between the two tapers, nothing at tapered ends.
    fn keys(&self, force_kgf: f64, depth_mm: f64, spin_deg: f64, keys: &mut Vec<Key>) {
        let mut orientation = self.generator.orientation;
        orientation.spin_deg = (orientation.spin_deg + spin_deg).clamp(-3600.0, 3600.0);
        let full = Key {
            depth_mm,
            orientation,
            ..Key::force(0.0, force_kgf)
        };
        tapered(full, self.generator.taper, keys);
    }
}

/// Writes the keys of a scratch whose force and depth rise from 0 to `full` and fall back to 0 over these shares of its
/// length, both together 1 at most.
pub(crate) fn tapered(full: Key, [rise, fall]: [f64; 2], keys: &mut Vec<Key>) {
    let key = |at: f64, share: f64| Key {
        at,
        force_kgf: share * full.force_kgf,
        depth_mm: share * full.depth_mm,
        ..full
    };
    keys.clear();
    if rise > 0.0 {
        keys.push(key(0.0, 0.0));
    }
    keys.push(key(rise, 1.0));
    if fall > 0.0 {
        if 1.0 - fall > rise {
            keys.push(key(1.0 - fall, 1.0));
        }
        keys.push(key(1.0, 0.0));
    }
}

/// How a hand moves over one scratch.
struct Hand {
    curves: u32,
    length_mm: f64,
    /// Halfway through its turn.
    heading_deg: f64,
    turn_deg: f64,
    wander_deg: f64,
}

impl Hand {
    /// Control points in mm from an origin: curves of equal length, each as near to an arc of a circle as a
    /// cubic comes, in one direction where they meet.
    fn draw(&self, draws: &mut Draws, points: &mut Vec<[f64; 2]>) {
        let count = f64::from(self.curves);
        let step_mm = self.length_mm / count;
        let turned_deg = |wander_deg: f64| {
            (self.turn_deg / count + wander_deg).clamp(-MOST_TURN_DEG, MOST_TURN_DEG)
        };
        let mut heading = direction((self.heading_deg - 0.5 * self.turn_deg).to_radians());
        let mut at = DVec2::ZERO;
        points.clear();
        points.push(at.to_array());
        for _ in 0..self.curves {
            let turn_rad = turned_deg(draws.normal(self.wander_deg)).to_radians();
            let quarter = direction(0.25 * turn_rad);
            let half = quarter.rotate(quarter);
            // An arc of this turn: its chord's length, and its handles' (4/3 tan(turn/4) times its radius).
            let (chord, handle) = if turn_rad.abs() < 1e-6 {
                (step_mm, step_mm / 3.0)
            } else {
                let radius_mm = step_mm / turn_rad;
                let handle = 4.0 / 3.0 * (quarter.y / quarter.x) * radius_mm;
                (2.0 * half.y * radius_mm, handle)
            };
            let end = at + chord * heading.rotate(half);
            let after = heading.rotate(half).rotate(half);
            points.push((at + handle * heading).to_array());
            points.push((end - handle * after).to_array());
            points.push(end.to_array());
            (at, heading) = (end, after);
        }
    }
}

/// Where half of the path lies behind.
fn middle(points: &[[f64; 2]]) -> DVec2 {
    let count = points.len() / 3;
    let point = |i: usize| DVec2::from(points[i]);
    if count.is_multiple_of(2) {
        return point(3 * (count / 2));
    }
    let i = 3 * (count / 2);
    (point(i) + 3.0 * (point(i + 1) + point(i + 2)) + point(i + 3)) / 8.0
}

fn direction(angle_rad: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(angle_rad);
    DVec2::new(cos, sin)
}
