//! What lies in each of many cells, sorted by cell on all cores; the same on any number of them.

use rayon::prelude::*;

/// Cells are sorted in so many groups, each small enough for a processor's own memory.
const GROUPS: usize = 256;

/// Sources that are looked at in one go.
const PORTION: usize = 1 << 16;

/// Items of each cell, in the order of their sources.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lists<T> {
    groups: Vec<Group<T>>,
    /// A group is 2 to the power of this cells.
    shift: u32,
}

/// Neighbouring cells.
#[derive(Clone, Debug)]
struct Group<T> {
    /// Where each cell's items start; one more than there are cells.
    starts: Vec<u32>,
    items: Vec<T>,
}

/// Takes items of some sources, group by group.
#[derive(Debug)]
pub(crate) struct Sink<T> {
    groups: Vec<Vec<(u32, T)>>,
    shift: u32,
}

impl<T> Sink<T> {
    /// An item of a cell.
    pub(crate) fn put(&mut self, cell: u32, item: T) {
        self.groups[(cell >> self.shift) as usize].push((cell, item));
    }
}

impl<T: Copy + Default + Send + Sync> Lists<T> {
    /// What `sort_in` puts into so many cells for each source from 0 to `sources`.
    pub(crate) fn new(
        cells: usize,
        sources: usize,
        sort_in: impl Fn(usize, &mut Sink<T>) + Sync,
    ) -> Self {
        let shift = cells.div_ceil(GROUPS).max(1).next_power_of_two().ilog2();
        let count = cells.div_ceil(1 << shift);
        let expected = 2 * sources.min(PORTION) / count.max(1);
        let portions: Vec<Sink<T>> = (0..sources.div_ceil(PORTION))
            .into_par_iter()
            .map(|portion| {
                let groups = (0..count).map(|_| Vec::with_capacity(expected)).collect();
                let mut sink = Sink { groups, shift };
                let first = portion * PORTION;
                for source in first..(first + PORTION).min(sources) {
                    sort_in(source, &mut sink);
                }
                sink
            })
            .collect();
        let groups = (0..count).into_par_iter().map(|group| {
            let items = || portions.iter().flat_map(move |sink| &sink.groups[group]);
            Group::new(1 << shift, items)
        });
        Self {
            groups: groups.collect(),
            shift,
        }
    }

    /// Of these items, each behind its cell's number.
    pub(crate) fn few(cells: usize, items: &[(u32, T)]) -> Self {
        let shift = cells.next_power_of_two().ilog2();
        let group = Group::new(1 << shift, || items.iter());
        Self {
            groups: vec![group],
            shift,
        }
    }

    /// A cell's items.
    pub(crate) fn of(&self, cell: usize) -> &[T] {
        let group = &self.groups[cell >> self.shift];
        let own = cell & ((1 << self.shift) - 1);
        &group.items[group.starts[own] as usize..group.starts[own + 1] as usize]
    }

    /// How many items there are.
    pub(crate) fn len(&self) -> usize {
        self.groups.iter().map(|group| group.items.len()).sum()
    }
}

impl<T: Copy + Default> Group<T> {
    fn new<'a, I>(cells: usize, items: impl Fn() -> I) -> Self
    where
        I: Iterator<Item = &'a (u32, T)>,
        T: 'a,
    {
        let own = |cell: u32| cell as usize & (cells - 1);
        let mut starts = vec![0; cells + 1];
        for &(cell, _) in items() {
            starts[own(cell) + 1] += 1;
        }
        for cell in 0..cells {
            starts[cell + 1] += starts[cell];
        }
        let mut next = starts.clone();
        let mut sorted = vec![T::default(); starts[cells] as usize];
        for &(cell, item) in items() {
            let place = &mut next[own(cell)];
            sorted[*place as usize] = item;
            *place += 1;
        }
        Self {
            starts,
            items: sorted,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each item comes back in its cell, in order, whatever the number of cells.
    #[test]
    fn items_come_back() {
        for cells in [1, 5, 1000, 5000] {
            let place = |source: usize| (source * 7919 + 13) % cells;
            let lists = Lists::new(cells, 200_000, |source, sink| {
                sink.put(u32::try_from(place(source)).unwrap(), source);
                if source % 3 == 0 {
                    sink.put(0, source);
                }
            });
            assert_eq!(lists.len(), 200_000 + 66_667);
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
