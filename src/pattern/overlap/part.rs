//! The pairs of a part of the plate that holds few strips. What single precision cannot tell of them is looked at in
//! double.

use super::cell::Cell;
use super::cover::{HIDDEN, Left, cut};
use super::meet::{EIGHT, NOWHERE, Numbers, PLACE, Seen, Window};
use crate::lanes::{Lanes, Number, apart, first_of, in_lanes};
use crate::single;
use glam::DVec2;

/// Strips of a part that are compared with all others. Of more, every so manyth counts for its neighbours, so that
/// heaps take no longer than they must.
const MOST: usize = 128;

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
    numbers: Numbers,
    /// What is left of each quarter.
    left: [[f32; EIGHT]; 4],
}

impl Part {
    /// Takes from what is left of strips of a list what pairs say whose place lies in the box.
    pub(super) fn pairs(&mut self, cell: &mut Cell, list: &[u32], within: [DVec2; 2]) {
        self.fill(cell, list, within);
        if list.len() > MOST {
            in_lanes!(lanes => self.look_at_heap(lanes, cell, list, within));
        } else {
            in_lanes!(lanes => self.look(lanes, cell, list, within));
        }
        for (i, &place) in list.iter().enumerate() {
            let block = &self.blocks[i / EIGHT];
            let left = &mut cell.left[place as usize];
            (0..4).for_each(|quarter| left[quarter] *= block.left[quarter][i % EIGHT]);
        }
    }

    fn fill(&mut self, cell: &Cell, list: &[u32], [low, high]: [DVec2; 2]) {
        let (middle, half_size) = (0.5 * (low + high), 0.5 * (high - low));
        self.blocks.clear();
        let nowhere = Block::of(NOWHERE.map(|number| [single(number); EIGHT]));
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
                -normal.dot(ends[0]),
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
        let window = self.window.map(|number| lanes.all(*number));
        for later in 1..list.len() {
            let other = Seen::one(lanes, &self.blocks[later / EIGHT].numbers, later % EIGHT);
            let count = count_before(cell, list, later);
            self.unsure.clear();
            cover(
                lanes,
                &mut self.blocks,
                count,
                &other,
                &window,
                &mut self.unsure,
            );
            for &earlier in &self.unsure {
                let [earlier, later] = [list[earlier], list[later]].map(|i| i as usize);
                let left = &mut cell.left[earlier];
                cut(left, &cell.lines[earlier], &cell.lines[later], within);
            }
        }
    }

    /// The same of a list that is too long: eight after eight meet those next to them, and of all later ones so many that
    /// stand for the others.
    #[inline(always)]
    fn look_at_heap<L: Lanes>(
        &mut self,
        lanes: L,
        cell: &mut Cell,
        list: &[u32],
        within: [DVec2; 2],
    ) {
        let window = self.window.map(|number| lanes.all(*number));
        for number in 0..self.blocks.len() {
            let first = number * EIGHT;
            let own = &list[first..list.len().min(first + EIGHT)];
            let is_hidden = |left: &Left| left.iter().all(|left| *left < HIDDEN);
            if own.iter().all(|&i| is_hidden(&cell.left[i as usize])) {
                continue;
            }
            let numbers = self.blocks[number].numbers;
            let [mut near, mut far] = [Block::of(numbers), Block::of(numbers)];
            let mut unsure = [[[1.0; 4]; EIGHT]; 2];
            let behind = list.len().min(first + EIGHT + 1);
            let stride = (list.len() - behind).div_ceil(MOST).max(1);
            let next = (first + 1..behind).map(|later| (later, true));
            let others = (behind..list.len()).step_by(stride);
            for (later, is_near) in next.chain(others.map(|later| (later, false))) {
                let (block, unsure) = match is_near {
                    true => (&mut near, &mut unsure[0]),
                    false => (&mut far, &mut unsure[1]),
                };
                let other = Seen::one(lanes, &self.blocks[later / EIGHT].numbers, later % EIGHT);
                let count = (count_before(cell, list, later) - first).min(own.len());
                let block = core::slice::from_mut(block);
                self.unsure.clear();
                cover(lanes, block, count, &other, &window, &mut self.unsure);
                for &k in &self.unsure {
                    let [a, b] = [own[k], list[later]].map(|i| &cell.lines[i as usize]);
                    cut(&mut unsure[k], a, b, within);
                }
            }
            let all = (list.len() - behind) as f64;
            let weight = single(all / (all / stride as f64).ceil().max(1.0));
            for (quarter, left) in self.blocks[number].left.iter_mut().enumerate() {
                for (k, left) in left.iter_mut().enumerate() {
                    let [near, far] = [(&near, 0), (&far, 1)]
                        .map(|(block, i)| block.left[quarter][k] * unsure[i][k][quarter]);
                    // Much is not covered at all.
                    *left = near * if far < 1.0 { far.powf(weight) } else { 1.0 };
                }
            }
        }
    }
}

impl Block {
    /// Strips that nothing covers.
    fn of(numbers: Numbers) -> Self {
        Self {
            numbers,
            left: [[1.0; EIGHT]; 4],
        }
    }
}

/// Takes what a strip covers from what is left of the first `count` of others, but for those of which it is unsure.
#[inline(always)]
fn cover<L: Lanes>(
    lanes: L,
    blocks: &mut [Block],
    count: usize,
    strip: &Seen<L::F>,
    window: &Window<L::F>,
    unsure: &mut Vec<usize>,
) {
    for (first, block) in (0..count).step_by(EIGHT).zip(blocks) {
        for k in (0..EIGHT).step_by(L::WIDTH) {
            let own = Seen::some(lanes, &block.numbers, k);
            let Some(meeting) = own.met_by(strip, window) else {
                continue;
            };
            let count = count.saturating_sub(first + k);
            for quarter in 0..4 {
                let left = &mut block.left[quarter][k..];
                let rest = -first_of(lanes, count, meeting.quarters[quarter]) + 1.0;
                lanes.store(lanes.load(left) * rest, left);
            }
            if first_of(lanes, count, meeting.unsure).any() {
                let held = 0..L::WIDTH.min(count);
                // Seldom, and one by one: registers are to keep what they hold.
                let is_unsure = |lane: &usize| meeting.unsure.lane(*lane) > 0.0;
                apart(|| unsure.extend(held.filter(is_unsure).map(|lane| first + k + lane)));
            }
        }
    }
}

/// How many of a list one of it may cover: those before it, but a scratch's own next piece does not cover it.
fn count_before(cell: &Cell, list: &[u32], place: usize) -> usize {
    let number = |place: usize| cell.lines[list[place] as usize].number;
    let is_next = number(place - 1) + 1 == number(place);
    place - usize::from(is_next)
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
