//! Which of some numbers came before.

/// Numbers that were put in, in `PLACES` (a power of two): each where its own place is, or the next free one after that.
#[derive(Debug)]
pub(super) struct Seen<const PLACES: usize> {
    /// Numbers plus 1; 0 where none is.
    places: [u32; PLACES],
    count: usize,
}

/// What became of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Inserted {
    Now,
    /// It was there before.
    Before,
    NoRoom,
}

impl<const PLACES: usize> Seen<PLACES> {
    /// Fuller than this, numbers lie far from their places.
    const MOST: usize = PLACES / 4 * 3;

    pub(super) fn new() -> Self {
        Self {
            places: [0; PLACES],
            count: 0,
        }
    }

    #[inline]
    pub(super) fn insert(&mut self, number: u32) -> Inserted {
        // Multiplied by 2^32 over the golden ratio, neighbours lie far apart (Knuth, The Art of Computer Programming, 6.4).
        let spread = number.wrapping_mul(0x9e37_79b9);
        let mut place = (spread >> (32 - PLACES.trailing_zeros())) as usize;
        let kept = number.wrapping_add(1);
        loop {
            let there = &mut self.places[place % PLACES];
            if *there == kept {
                return Inserted::Before;
            }
            if *there == 0 {
                if self.count == Self::MOST {
                    return Inserted::NoRoom;
                }
                *there = kept;
                self.count += 1;
                return Inserted::Now;
            }
            place += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each number is new once, whatever lies around it, until there is no room; what was there stays known.
    #[test]
    fn each_is_new_once() {
        let mut seen = Seen::<64>::new();
        let numbers: Vec<u32> = (0..48).map(|i| i * i * 977 % 3001).collect();
        for (i, &number) in numbers.iter().enumerate() {
            let expected = match numbers[..i].contains(&number) {
                true => Inserted::Before,
                false => Inserted::Now,
            };
            assert_eq!(seen.insert(number), expected, "number {i}");
        }
        let room = 48 - seen.count;
        let more: Vec<Inserted> = (5000..5000 + 60).map(|i| seen.insert(i)).collect();
        assert!(more[..room].iter().all(|i| *i == Inserted::Now));
        assert!(more[room..].iter().all(|i| *i == Inserted::NoRoom));
        assert_eq!(seen.insert(numbers[7]), Inserted::Before);
    }
}
