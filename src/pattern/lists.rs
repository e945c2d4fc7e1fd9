//! What lies in each of many cells, sorted by cell on all cores; the same on any number of them.

use super::grid::number;
use bytemuck::Zeroable;
use bytemuck::allocation::zeroed_vec;
use rayon::prelude::*;

/// Cells are sorted in so many groups, each small enough for a processor's own memory; in more if cells are so many that
/// their numbers in a group would take more than 16 bits.
const GROUPS: usize = 256;

/// Sources that are looked at in one go: their numbers in it take 16 bits, and what they put fits a processor's own memory.
const PORTION: usize = 1 << 14;

/// Items of each cell, in the order of their sources.
#[derive(Clone, Debug)]
pub(crate) struct Lists<T> {
    /// Where each cell's items start; one more than there are cells.
    pub starts: Vec<u32>,
    pub items: Vec<T>,
}

/// Takes items of some sources: the cell of each, and the item.
#[derive(Debug)]
pub(crate) struct Sink<T>(Vec<(u32, T)>);

impl<T> Sink<T> {
    /// An item of a cell.
    pub(crate) fn put(&mut self, cell: u32, item: T) {
        self.0.push((cell, item));
    }
}

/// Items of some sources, group by group: the cell's number in its group, and the item.
struct Grouped<I> {
    /// Where each group's items end.
    ends: Vec<u32>,
    cells: Vec<u16>,
    items: Vec<I>,
}

impl<I: Copy + Zeroable> Grouped<I> {
    /// Of so many groups of 2 to the power of `shift` cells.
    fn of(put: &[(u32, I)], groups: usize, shift: u32) -> Self {
        let mut ends = vec![0; groups];
        let mut cells = zeroed_vec(put.len());
        let mut items = zeroed_vec(put.len());
        for (cell, _) in put {
            ends[(cell >> shift) as usize] += 1;
        }
        let mut next = 0;
        for end in &mut ends {
            next += core::mem::replace(end, next);
        }
        for &(cell, item) in put {
            let end = &mut ends[(cell >> shift) as usize];
            cells[*end as usize] = low_bits(cell as usize & ((1 << shift) - 1));
            items[*end as usize] = item;
            *end += 1;
        }
        Self { ends, cells, items }
    }

    fn of_group(&self, group: usize) -> core::ops::Range<usize> {
        let start = group.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[group] as usize
    }
}

/// A source, for which cells are named that it lies in.
#[derive(Debug)]
pub(crate) struct Source<'s> {
    sink: &'s mut Sink<u16>,
    own: u16,
}

impl Source<'_> {
    pub(crate) fn lies_in(&mut self, cell: u32) {
        self.sink.put(cell, self.own);
    }
}

/// What some sources put into cells, by groups of neighbouring cells; `item` makes the item of what was put and of the
/// number of the portion that the source lies in.
pub(crate) struct Groups<I, F> {
    portions: Vec<Grouped<I>>,
    cells: usize,
    /// A group has 2 to the power of this cells.
    shift: u32,
    item: F,
}

/// For each of so many cells the numbers of the sources, from 0 to `sources`, that `sort_in` says lie in it.
pub(crate) fn of_sources(
    cells: usize,
    sources: usize,
    sort_in: impl Fn(usize, &mut Source<'_>) + Sync,
) -> Groups<u16, impl Fn(usize, u16) -> u32 + Sync> {
    let put = |(): &mut (), source: usize, sink: &mut Sink<u16>| {
        let own = low_bits(source % PORTION);
        sort_in(source, &mut Source { sink, own });
    };
    let item = |portion, own| number(portion * PORTION) + u32::from(own);
    Groups::of(cells, sources, || (), put, item)
}

/// What `sort_in` puts into so many cells for each source from 0 to `sources`. It is told what `begin` made for this
/// and some other sources.
pub(crate) fn of_items<T: Copy + Zeroable + Send + Sync, R>(
    cells: usize,
    sources: usize,
    begin: impl Fn() -> R + Sync,
    sort_in: impl Fn(&mut R, usize, &mut Sink<T>) + Sync,
) -> Groups<T, impl Fn(usize, T) -> T + Sync> {
    Groups::of(cells, sources, begin, sort_in, |_, item| item)
}

impl<I, T, F> Groups<I, F>
where
    I: Copy + Zeroable + Send + Sync,
    T: Copy + Zeroable + Send + Sync,
    F: Fn(usize, I) -> T + Sync,
{
    fn of<R>(
        cells: usize,
        sources: usize,
        begin: impl Fn() -> R + Sync,
        sort_in: impl Fn(&mut R, usize, &mut Sink<I>) + Sync,
        item: F,
    ) -> Self {
        let per_group = cells.div_ceil(GROUPS).max(1).next_power_of_two();
        let shift = per_group.ilog2().min(u16::BITS);
        let count = cells.div_ceil(1 << shift);
        // What is put is sorted by group at once, into memory of the very size.
        let group_portion = |sink: &mut Sink<I>, portion: usize| {
            sink.0.clear();
            let (mut reader, first) = (begin(), portion * PORTION);
            for source in first..(first + PORTION).min(sources) {
                sort_in(&mut reader, source, sink);
            }
            Grouped::of(&sink.0, count, shift)
        };
        let portions = (0..sources.div_ceil(PORTION))
            .into_par_iter()
            .map_init(|| Sink(Vec::new()), group_portion)
            .collect();
        Self {
            portions,
            cells,
            shift,
            item,
        }
    }

    /// The lists of all cells.
    pub(crate) fn lists(&self) -> Lists<T> {
        let lengths: Vec<usize> = (0..self.count()).map(|group| self.length(group)).collect();
        let mut lists = Lists {
            starts: vec![0; self.cells + 1],
            items: zeroed_vec(lengths.iter().sum()),
        };
        let starts = lists.starts[..self.cells].chunks_mut(1 << self.shift);
        let (mut rest, mut before) = (&mut lists.items[..], 0);
        let mut groups = Vec::new();
        for (length, starts) in lengths.into_iter().zip(starts) {
            let (items, behind) = rest.split_at_mut(length);
            groups.push((before, starts, items));
            rest = behind;
            before += number(length);
        }
        let groups = groups.into_par_iter().enumerate();
        groups.for_each(|(group, (before, starts, items))| {
            sort(before, starts, items, || self.items(group));
        });
        lists.starts[self.cells] = before;
        lists
    }

    /// What `look` makes of the lists of each group, one after the other in the same memory. It is told what `begin` made
    /// for this and some other groups, and the number of the group's first cell.
    pub(crate) fn map<S, R: Send>(
        &self,
        begin: impl Fn() -> S + Sync,
        look: impl Fn(&mut S, usize, &Lists<T>) -> R + Sync,
    ) -> Vec<R> {
        let begin = || (begin(), Lists::empty());
        let of_group = |(state, lists): &mut (S, Lists<T>), group: usize| {
            let first = group << self.shift;
            let cells = (self.cells - first).min(1 << self.shift);
            lists.starts.clear();
            lists.starts.resize(cells + 1, 0);
            lists.items.resize(self.length(group), T::zeroed());
            let starts = &mut lists.starts[..cells];
            sort(0, starts, &mut lists.items, || self.items(group));
            lists.starts[cells] = number(lists.items.len());
            look(state, first, lists)
        };
        let groups = (0..self.count()).into_par_iter();
        groups.map_init(begin, of_group).collect()
    }

    fn count(&self) -> usize {
        self.cells.div_ceil(1 << self.shift)
    }

    fn length(&self, group: usize) -> usize {
        let portions = self.portions.iter();
        portions.map(|portion| portion.of_group(group).len()).sum()
    }

    /// A group's items in the order of their sources, each behind its cell's number in the group.
    fn items(&self, group: usize) -> impl Iterator<Item = (usize, T)> {
        let portions = self.portions.iter().enumerate();
        portions.flat_map(move |(number, portion)| {
            let held = portion.of_group(group);
            let cells = portion.cells[held.clone()].iter();
            cells
                .zip(&portion.items[held])
                .map(move |(&cell, &held)| (usize::from(cell), (self.item)(number, held)))
        })
    }
}

impl<T: Copy + Zeroable> Lists<T> {
    fn empty() -> Self {
        Self {
            starts: Vec::new(),
            items: Vec::new(),
        }
    }

    /// Of these items, each behind its cell's number.
    pub(crate) fn few(cells: usize, items: &[(u32, T)]) -> Self {
        let mut lists = Self {
            starts: vec![0; cells + 1],
            items: zeroed_vec(items.len()),
        };
        let all = || items.iter().map(|&(cell, item)| (cell as usize, item));
        sort(0, &mut lists.starts, &mut lists.items, all);
        lists.starts[cells] = number(items.len());
        lists
    }

    /// How many cells there are.
    pub(crate) fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// A cell's items.
    pub(crate) fn of(&self, cell: usize) -> &[T] {
        &self.items[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }
}

/// Sorts the items of neighbouring cells, counted from the first of them, `before` which there are so many others.
fn sort<T, I: Iterator<Item = (usize, T)>>(
    before: u32,
    starts: &mut [u32],
    sorted: &mut [T],
    items: impl Fn() -> I,
) {
    items().for_each(|(cell, _)| starts[cell] += 1);
    let mut next = before;
    for start in &mut *starts {
        next += core::mem::replace(start, next);
    }
    items().for_each(|(cell, item)| {
        let place = &mut starts[cell];
        sorted[(*place - before) as usize] = item;
        *place += 1;
    });
    // Each has come to where the next one starts.
    starts.copy_within(..starts.len() - 1, 1);
    starts[0] = before;
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "the rest is known by the group or the portion"
)]
fn low_bits(number: usize) -> u16 {
    number as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each item comes back in its cell, in order, whatever the number of cells.
    #[test]
    fn items_come_back() {
        for cells in [1, 5, 1000, 5000] {
            let place = |source: usize| (source * 7919 + 13) % cells;
            let groups = of_items(
                cells,
                200_000,
                || (),
                |(), source, sink| {
                    sink.put(u32::try_from(place(source)).unwrap(), source);
                    if source % 3 == 0 {
                        sink.put(0, source);
                    }
                },
            );
            let lists = groups.lists();
            assert_eq!(lists.items.len(), 200_000 + 66_667);
            let by_group = groups.map(
                || (),
                |(), first, own| {
                    let all = (0..own.count()).map(|cell| (first + cell, own.of(cell)));
                    all.for_each(|(cell, items)| assert_eq!(items, lists.of(cell), "cell {cell}"));
                    own.count()
                },
            );
            assert_eq!(by_group.iter().sum::<usize>(), cells, "some were left out");
            for cell in 0..cells {
                let truth = (0..200_000).flat_map(|source| {
                    let here = usize::from(place(source) == cell);
                    let first = usize::from(cell == 0 && source % 3 == 0);
                    std::iter::repeat_n(source, here + first)
                });
                if cell < 3 || cell + 1 == cells {
                    assert!(truth.eq(lists.of(cell).iter().copied()), "cell {cell}");
                }
            }
        }
    }
}
