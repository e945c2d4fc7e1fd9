//! Which of a pattern's cross-sections stand for all.

use super::{MOST_CLASSES, SAMPLES, Signature, distance, squared};
use crate::single;

/// Rounds of settling: few choices move after some.
const MOST_ROUNDS: usize = 20;

/// The numbers of the few that stand for all, which take these areas: so many that none is so far from one of them, or else as
/// many as there may be, settled among all.
pub(super) fn chosen(signatures: &[Signature], areas: &[f64], least_apart: f32) -> Vec<usize> {
    let mut chosen = far_apart(signatures, areas, least_apart);
    let mut rounds = 0;
    while chosen.len() == MOST_CLASSES
        && rounds < MOST_ROUNDS
        && settle(&mut chosen, signatures, areas)
    {
        rounds += 1;
    }
    chosen
}

/// The one that takes the largest area, and always the one that is farthest from all so far (Gonzalez 1985).
fn far_apart(signatures: &[Signature], areas: &[f64], least_apart: f32) -> Vec<usize> {
    let mut apart = vec![f32::INFINITY; signatures.len()];
    let mut chosen: Vec<usize> = Vec::new();
    let all = 0..signatures.len();
    let mut next = all.clone().max_by(|&a, &b| areas[a].total_cmp(&areas[b]));
    while let Some(number) = next.filter(|_| chosen.len() < MOST_CLASSES) {
        for (apart, signature) in apart.iter_mut().zip(signatures) {
            *apart = apart.min(distance(signature, &signatures[number]));
        }
        chosen.push(number);
        let farthest = all.clone().max_by(|&a, &b| apart[a].total_cmp(&apart[b]));
        next = farthest.filter(|&farthest| apart[farthest] > least_apart);
    }
    chosen
}

/// Moves each into the middle of what is nearest to it (Lloyd 1982); whether any moved. Farthest ones halve gaps, and leave some
/// twice as wide as others: what lies in a gap is blended from both sides, which blurs it by the gap's square.
fn settle(chosen: &mut [usize], signatures: &[Signature], areas: &[f64]) -> bool {
    let mut middles: Vec<Middle> = chosen.iter().map(|_| Middle::NONE).collect();
    for (signature, area) in signatures.iter().zip(areas) {
        let of_class = chosen.iter().map(|&number| &signatures[number]);
        if let Some(class) = nearest(signature, of_class) {
            middles[class].add(signature, *area);
        }
    }
    let mut moves = false;
    for (number, middle) in chosen.iter_mut().zip(&middles) {
        let settled = nearest(&middle.mean(), signatures.iter());
        if let Some(settled) = settled.filter(|_| middle.area > 0.0) {
            moves |= settled != *number;
            *number = settled;
        }
    }
    moves
}

/// The number of the nearest one.
fn nearest<'s>(
    signature: &Signature,
    others: impl Iterator<Item = &'s Signature>,
) -> Option<usize> {
    let apart = others.map(|other| squared(signature, other)).enumerate();
    let least = apart.min_by(|a, b| a.1.total_cmp(&b.1));
    least.map(|(number, _)| number)
}

/// The mean of signatures by area, while they are added up.
#[derive(Clone)]
struct Middle {
    sum: [f64; 3 * SAMPLES],
    area: f64,
}

impl Middle {
    const NONE: Self = Self {
        sum: [0.0; 3 * SAMPLES],
        area: 0.0,
    };

    fn add(&mut self, signature: &Signature, area: f64) {
        self.area += area;
        for (sum, value) in self.sum.iter_mut().zip(signature) {
            *sum += area * f64::from(*value);
        }
    }

    fn mean(&self) -> Signature {
        self.sum.map(|sum| single(sum / self.area))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of slopes evenly spread, those chosen lie about evenly apart: none twice as far as others, as halving would have it.
    #[test]
    fn even_ones_are_shared_out_evenly() {
        let signatures: Vec<Signature> =
            (0..1000).map(|i| [i as f32 * 1e-3; 3 * SAMPLES]).collect();
        let mut chosen = chosen(&signatures, &[1.0; 1000], 1e-3);
        chosen.sort_unstable();
        assert_eq!(chosen.len(), MOST_CLASSES, "{chosen:?}");
        let gaps: Vec<usize> = chosen.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (least, most) = (gaps.iter().min(), gaps.iter().max());
        let [least, most] = [least, most].map(|gap| *gap.unwrap() as f64);
        assert!(most < 1.4 * least, "{chosen:?}");
    }

    /// What is alike needs one; what takes little but is unlike all has its own.
    #[test]
    fn as_few_as_it_takes() {
        let mut signatures = vec![[0.1; 3 * SAMPLES]; 50];
        assert_eq!(chosen(&signatures, &[1.0; 50], 0.01).len(), 1, "all alike");
        signatures[7] = [0.9; 3 * SAMPLES];
        let mut areas = [1.0; 50];
        areas[7] = 1e-3;
        let mut two = chosen(&signatures, &areas, 0.01);
        two.sort_by(|a, b| areas[*a].total_cmp(&areas[*b]));
        assert_eq!(two.len(), 2, "{two:?}");
        assert_eq!(two[0], 7, "{two:?}");
    }
}
