//! The pairs of a part of the plate that holds few strips. What single precision cannot tell of them is looked at in
//! double.

use super::cell::Cell;
use super::cover::{HIDDEN, Left, cut};
use super::meet::{NOWHERE, NUMBERS, PLACE, Seen, Window};
use crate::lanes::{Lanes, Number, in_lanes};
use crate::single;
use glam::DVec2;

/// Strips of a part that are compared with all others. Of more, every so manyth counts for its neighbours, so that
/// heaps take no longer than they must.
const MOST: usize = 128;

/// Strips that lie side by side.
const EIGHT: usize = 8;

/// Strips of a part.
#[derive(Default)]
pub(super) struct Part {
    blocks: Vec<Block>,
    window: Window<f32>,
    /// Strips that one covers in a way that single precision cannot tell.
    unsure: Vec<usize>,
}

/// Eight strips, number by number.
#[derive(Clone)]
struct Block {
    numbers: [[f32; EIGHT]; NUMBERS],
    /// What is left of each quarter.
    left: [[f32; EIGHT]; 4],
}

impl Part {
    /// Takes from what is left of strips of a list what pairs say whose place lies in the box.
    pub(super) fn pairs(&mut self, cell: &mut Cell, list: &[u32], within: [DVec2; 2]) {
        if list.len() > MOST {
            return heap(cell, list, within);
        }
        self.fill(cell, list, within);
        in_lanes!(lanes => self.look(lanes, cell, list, within));
        for (i, &place) in list.iter().enumerate() {
            let block = &self.blocks[i / EIGHT];
            let left = &mut cell.left[place as usize];
            (0..4).for_each(|quarter| left[quarter] *= block.left[quarter][i % EIGHT]);
        }
    }

    fn fill(&mut self, cell: &Cell, list: &[u32], [low, high]: [DVec2; 2]) {
        let (middle, half_size) = (0.5 * (low + high), 0.5 * (high - low));
        self.blocks.clear();
        let nowhere = Block {
            numbers: NOWHERE.map(|number| [single(number); EIGHT]),
            left: [[1.0; EIGHT]; 4],
        };
        self.blocks.resize(list.len().div_ceil(EIGHT), nowhere);
        // So much further that no place on the border is lost.
        let slack = 10.0 * PLACE * half_size.max_element();
        let mut widest = 0.0_f64;
        for (i, &place) in list.iter().enumerate() {
            let line = &cell.lines[place as usize];
            let (normal, half_width) = (line.normal, line.strip.half_width);
            let ends = [line.strip.start, line.strip.end].map(|end| end - middle);
            let [from, to] = way_within(ends, half_size + (half_width + slack));
            let [start, end] = [from, to].map(|share| ends[0].lerp(ends[1], share));
            let numbers = [
                start.x,
                start.y,
                end.x,
                end.y,
                normal.x,
                normal.y,
                normal.dot(ends[0]),
                half_width,
                line.length,
                4.0 * from,
                4.0 * (to - from),
            ];
            let block = &mut self.blocks[i / EIGHT];
            for (all, number) in block.numbers.iter_mut().zip(numbers) {
                all[i % EIGHT] = single(number);
            }
            widest = widest.max(half_width);
        }
        self.window = Window::new(half_size.to_array(), widest);
    }

    #[inline(always)]
    fn look<L: Lanes>(&mut self, lanes: L, cell: &mut Cell, list: &[u32], within: [DVec2; 2]) {
        for (later, &place) in list.iter().enumerate().skip(1) {
            let line = &cell.lines[place as usize];
            let before = &cell.lines[list[later - 1] as usize];
            // A scratch's own next piece does not cover it.
            let is_next = before.number + 1 == line.number;
            self.cover(lanes, later, later - usize::from(is_next));
            for &i in &self.unsure {
                let place = list[i] as usize;
                cut(&mut cell.left[place], &cell.lines[place], line, within);
            }
        }
    }

    /// Takes what one strip covers from what is left of the first `count`, but for those of which it is unsure.
    #[inline(always)]
    fn cover<L: Lanes>(&mut self, lanes: L, later: usize, count: usize) {
        let block = &self.blocks[later / EIGHT];
        let other = |number: &[f32; EIGHT]| lanes.all(number[later % EIGHT]);
        let other = Seen::of(block.numbers.each_ref().map(other));
        let window = self.window.map(|number| lanes.all(*number));
        self.unsure.clear();
        for (first, block) in (0..count).step_by(EIGHT).zip(&mut self.blocks) {
            for k in (0..EIGHT).step_by(L::WIDTH) {
                let own = block.numbers.each_ref().map(|all| lanes.load(&all[k..]));
                let Some(meeting) = Seen::of(own).met_by(&other, &window) else {
                    continue;
                };
                let is_earlier = |lane: usize| first + k + lane < count;
                let counts = lanes.made(|lane| f32::from(u8::from(is_earlier(lane))));
                for (left, share) in block.left.iter_mut().zip(meeting.quarters) {
                    let rest = lanes.load(&left[k..]) * (-(share * counts) + 1.0);
                    lanes.store(rest, &mut left[k..]);
                }
                if (meeting.unsure * counts).any() {
                    let unsure = (0..L::WIDTH).filter(|&lane| meeting.unsure.lane(lane) > 0.0);
                    let unsure = unsure.filter(|&lane| is_earlier(lane));
                    self.unsure.extend(unsure.map(|lane| first + k + lane));
                }
            }
        }
    }
}

/// The same of a list that is too long.
fn heap(cell: &mut Cell, list: &[u32], within: [DVec2; 2]) {
    for (i, &place) in list.iter().enumerate() {
        let place = place as usize;
        let line = |j: usize| &cell.lines[list[j] as usize];
        let later = (i + 1..list.len()).filter(|&j| line(j).number != line(i).number + 1);
        let stride = (list.len() - i).div_ceil(MOST);
        let mut left = cell.left[place];
        if left.iter().all(|left| *left < HIDDEN) {
            continue;
        }
        for j in later.step_by(stride) {
            let mut one: Left = [1.0; 4];
            cut(&mut one, line(i), line(j), within);
            let weight = stride.min(list.len() - j);
            let weight = single(weight as f64);
            // Most pairs do not meet.
            for (left, one) in left.iter_mut().zip(one).filter(|(_, one)| *one < 1.0) {
                *left *= one.powf(weight);
            }
        }
        cell.left[place] = left;
    }
}

/// What of a line may lie in a box of this half size around the origin, from one share of it to another; all of one that
/// does not come near.
fn way_within([start, end]: [DVec2; 2], half_size: DVec2) -> [f64; 2] {
    let step = end - start;
    let [a, b] = [-half_size, half_size].map(|border| (border - start) / step);
    // Of one along an axis, that axis does not tell.
    let tells = step.cmpne(DVec2::ZERO);
    let from = DVec2::select(tells, a.min(b), DVec2::ZERO)
        .max_element()
        .max(0.0);
    let to = DVec2::select(tells, a.max(b), DVec2::ONE)
        .min_element()
        .min(1.0);
    if from < to { [from, to] } else { [0.0, 1.0] }
}
