//! How much of each class a track holds on the way to a place, so that the mean of any stretch takes two look-ups.

use super::chords::{ClassAreas, add_shares};
use super::palette::MOST_CLASSES;
use super::tracks::{TrackRef, Tracks};
use crate::single;
use core::array::from_fn;

impl Tracks {
    /// For each station of all tracks, what [`TrackRef::areas_to`] says there.
    pub(crate) fn class_sums(&self) -> Vec<ClassAreas> {
        let mut all = Vec::with_capacity(self.station_count());
        for track in self.iter() {
            let mut sums = [0.0; MOST_CLASSES];
            for station in 0..track.station_count() {
                all.push(sums.map(single));
                track.add_areas(station, 1.0, &mut sums);
            }
        }
        all
    }
}

impl TrackRef<'_> {
    /// The width of each class at a place, mm.
    pub(super) fn areas_at(&self, at: f64) -> ClassAreas {
        let ([left, right], classes) = self.ends_and_classes(at);
        let mut areas = ClassAreas::default();
        add_shares(&mut areas, &classes, right - left);
        areas
    }

    /// The same on average from one place to another.
    pub(super) fn mean_areas(&self, from: f64, to: f64) -> ClassAreas {
        let step = to - from;
        if step.abs() <= self.least_step() {
            return self.areas_at(0.5 * (from + to));
        }
        let [before, upto] = [from, to].map(|at| self.areas_to(at));
        from_fn(|class| single(((upto[class] - before[class]) / step).max(0.0)))
    }

    /// The width of each class, added up from the first station to a place: mm times what places are measured in.
    pub(super) fn areas_to(&self, at: f64) -> [f64; MOST_CLASSES] {
        let (last, mix) = self.locate(at);
        let sums = self.sums().get(last).copied().unwrap_or_default();
        let mut areas = sums.map(f64::from);
        if mix > 0.0 {
            self.add_areas(last, mix.into(), &mut areas);
        }
        areas
    }

    /// Adds what lies between a station and so much of the way to the next, if there is one: widths and shares of
    /// classes change evenly.
    fn add_areas(&self, station: usize, mix: f64, areas: &mut [f64; MOST_CLASSES]) {
        let next = station + 1;
        let Some([a, b]) = self
            .blends()
            .get(station..=next)
            .and_then(|b| b.first_chunk())
        else {
            return;
        };
        let [from, to] = [station, next].map(|station| {
            let [left, right] = self.ends_of((station, 0.0)).map(f64::from);
            right - left
        });
        let way = self.station_at(next) - self.station_at(station);
        let (square, cube) = (mix * mix / 2.0, mix * mix * mix / 3.0);
        let second = from * square + (to - from) * cube;
        let first = from * mix + (to - from) * square - second;
        for (blend, area) in [(a, first), (b, second)] {
            let share = f64::from(blend.second);
            for (class, share) in blend.classes.into_iter().zip([1.0 - share, share]) {
                // A damaged file may claim any class.
                if let Some(sum) = areas.get_mut(usize::from(class)) {
                    *sum += way * area * share;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::brdf::Metal;
    use crate::formation::{Material, Tool};
    use crate::pattern::{Key, Path, PatternBuilder, Scratch};

    /// Over any stretch of a track, sums differ by the integral of widths and shares of classes, place by place.
    #[test]
    fn sums_are_integrals() {
        let builder = PatternBuilder::new(Material::metal(Metal::Steel), 1.0, [100.0; 2]);
        let mut builder = builder.unwrap();
        let tool = Tool::rockwell_c();
        for (i, force) in [0.1, 0.15, 0.4, 1.0, 3.0].into_iter().enumerate() {
            let v = 0.1 + 0.1 * i as f64;
            builder
                .add(&Scratch {
                    keys: &[Key::force(0.0, 0.0), Key::force(1.0, force)],
                    path: Path::Polyline(&[[0.1, v], [0.9, v]]),
                    ..Scratch::new(&tool)
                })
                .unwrap();
        }
        let pattern = builder.build();
        let track = pattern.tracks.iter().next().unwrap();
        assert!(track.station_count() > 2, "nothing to interpolate");
        for [from, to] in [[0.0, 3.0], [0.052, 0.065], [0.12, 0.9], [2.0, 2.5]] {
            let sums = [from, to].map(|at| track.areas_to(at));
            let steps = 20_000;
            let mut truth = [0.0; super::MOST_CLASSES];
            for i in 0..steps {
                let at = from + (to - from) * (f64::from(i) + 0.5) / f64::from(steps);
                let width = track.width(at) * (to - from) / f64::from(steps);
                for (class, share) in track.classes(at) {
                    truth[class] += width * f64::from(share);
                }
            }
            let whole: f64 = truth.iter().sum();
            for (class, truth) in truth.into_iter().enumerate() {
                let ours = sums[1][class] - sums[0][class];
                let off = (ours - truth).abs() / whole;
                assert!(
                    off < 2e-5,
                    "{from} to {to}, class {class}: {ours} and {truth}"
                );
            }
        }
    }
}
