//! The lower envelope of many segments: the lowest point of a projected tool above each x.

use glam::DVec2;

/// A segment seen along the travel, from left to right (`from.x < to.x`).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Segment {
    pub from: DVec2,
    pub to: DVec2,
}

/// A part of the envelope: segment `line` between x = `from` and x = `to`.
#[derive(Clone, Copy, Debug)]
struct Span {
    from: f64,
    to: f64,
    line: u32,
}

impl Segment {
    fn at(&self, x: f64) -> f64 {
        let share = ((x - self.from.x) / (self.to.x - self.from.x)).clamp(0.0, 1.0);
        self.from.y + (self.to.y - self.from.y) * share
    }
}

/// The lower envelope from left to right: segments that meet end to end, jump where the envelope jumps, and
/// leave out where there is nothing. Divide and conquer (Hershberger 1989), O(n log n).
pub(crate) fn lower_envelope(segments: &[Segment]) -> Vec<Segment> {
    let mut order: Vec<u32> = (0_u32..).zip(segments).map(|(line, _)| line).collect();
    order.sort_unstable_by(|&a, &b| {
        segments[a as usize]
            .from
            .x
            .total_cmp(&segments[b as usize].from.x)
    });
    let alone = |&line: &u32| {
        let segment = &segments[line as usize];
        vec![Span {
            from: segment.from.x,
            to: segment.to.x,
            line,
        }]
    };
    let mut envelopes: Vec<Vec<Span>> = order.iter().map(alone).collect();
    while envelopes.len() > 1 {
        let pairs = envelopes.chunks(2);
        envelopes = pairs
            .map(|pair| match pair {
                [a, b] => lower(segments, a, b),
                _ => pair[0].clone(),
            })
            .collect();
    }
    let spans = envelopes.pop().unwrap_or_default();
    let part = |span: &Span| {
        let segment = &segments[span.line as usize];
        let place = |x: f64| DVec2::new(x, segment.at(x));
        Segment {
            from: place(span.from),
            to: place(span.to),
        }
    };
    spans.iter().map(part).collect()
}

/// The lower of two envelopes.
fn lower(segments: &[Segment], a: &[Span], b: &[Span]) -> Vec<Span> {
    let mut out = Vec::with_capacity(a.len() + b.len());
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    let mut x = f64::NEG_INFINITY;
    loop {
        // What is left of each envelope's current span.
        let rest = |span: Option<&&Span>| {
            span.map(|s| Span {
                from: s.from.max(x),
                ..**s
            })
        };
        let (next_a, next_b) = (rest(a.peek()), rest(b.peek()));
        let (start, stop) = match (next_a, next_b) {
            (None, None) => return out,
            (Some(one), None) | (None, Some(one)) => (one.from, one.to),
            (Some(one), Some(other)) => {
                let start = one.from.min(other.from);
                let later = one.from.max(other.from);
                (
                    start,
                    one.to
                        .min(other.to)
                        .min(if later > start { later } else { f64::INFINITY }),
                )
            }
        };
        let here = |span: Option<Span>| {
            span.filter(|s| s.from <= start).map(|s| Span {
                from: start,
                to: stop,
                ..s
            })
        };
        match (here(next_a), here(next_b)) {
            (Some(one), Some(other)) => push_lower(segments, &mut out, one, other),
            (Some(one), None) | (None, Some(one)) => push(&mut out, one),
            (None, None) => {}
        }
        x = stop;
        while a.peek().is_some_and(|span| span.to <= x) {
            a.next();
        }
        while b.peek().is_some_and(|span| span.to <= x) {
            b.next();
        }
    }
}

/// The lower of two lines over the same interval; they cross at most once.
fn push_lower(segments: &[Segment], out: &mut Vec<Span>, one: Span, other: Span) {
    let above = |x: f64| segments[one.line as usize].at(x) - segments[other.line as usize].at(x);
    let (at_from, at_to) = (above(one.from), above(one.to));
    let (first, second) = if at_from <= 0.0 {
        (one, other)
    } else {
        (other, one)
    };
    let crosses = (at_from < 0.0 && at_to > 0.0) || (at_from > 0.0 && at_to < 0.0);
    let crossing = one.from + (one.to - one.from) * (at_from / (at_from - at_to));
    if crosses && crossing > one.from && crossing < one.to {
        push(
            out,
            Span {
                to: crossing,
                ..first
            },
        );
        push(
            out,
            Span {
                from: crossing,
                ..second
            },
        );
    } else if at_from == 0.0 && at_to > 0.0 {
        push(out, other);
    } else {
        push(out, first);
    }
}

/// Appends a span, joined to the last one if both lie on the same segment.
fn push(out: &mut Vec<Span>, span: Span) {
    if span.to <= span.from {
        return;
    }
    match out.last_mut() {
        Some(last) if last.line == span.line && last.to == span.from => last.to = span.to,
        _ => out.push(span),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::rngs::StdRng;
    use rand::{Rng, SeedableRng};

    /// At random places the envelope is the lowest of all segments there, or absent where there is none.
    #[test]
    fn is_the_lowest_everywhere() {
        let mut rng = StdRng::seed_from_u64(3);
        for count in [1, 2, 7, 60, 400] {
            let mut segment = || {
                let (x, width) = (rng.random::<f64>(), 0.2 * rng.random::<f64>() + 1e-3);
                let (a, b) = (rng.random::<f64>(), rng.random::<f64>());
                Segment {
                    from: DVec2::new(x, a),
                    to: DVec2::new(x + width, b),
                }
            };
            let segments: Vec<Segment> = (0..count).map(|_| segment()).collect();
            let envelope = lower_envelope(&segments);
            for _ in 0..2000 {
                let x = rng.random::<f64>() * 1.3 - 0.05;
                let lowest = |all: &[Segment]| {
                    let over = all.iter().filter(|s| s.from.x <= x && x <= s.to.x);
                    over.map(|s| s.at(x)).fold(f64::INFINITY, f64::min)
                };
                let (ours, truth) = (lowest(&envelope), lowest(&segments));
                let same = ours == truth || (ours - truth).abs() < 1e-12;
                assert!(same, "{count} segments at {x}: {ours} against {truth}");
            }
        }
    }
}
