//! One track read: what lies at a place on it, between its stations.

use super::*;

impl<'p> TrackRef<'p> {
    /// Vertices of each of its cross-sections.
    #[inline(always)]
    pub(crate) fn vertex_count(&self) -> usize {
        self.record.vertex_count as usize
    }

    /// Layers that it may cut through, from the surface down.
    #[inline(always)]
    pub(crate) fn layers(&self) -> &'p [LayerFinish] {
        let first = self.record.first_layer as usize;
        let count = self.record.layer_count as usize;
        // Mostly there are none.
        match count {
            0 => &[],
            _ => self.all.layers.get(first..first + count).unwrap_or(&[]),
        }
    }

    /// The finish of what lies below them.
    pub(crate) fn bulk(&self) -> &'p Finish {
        &self.record.bulk
    }

    /// How far its widest cross-section reaches from the centre line, mm.
    pub(crate) fn half_width_mm(&self) -> f64 {
        self.record.extent.half_width_mm.into()
    }

    /// Number of its first station among all.
    pub(crate) fn first_station(&self) -> usize {
        self.record.first_station as usize
    }

    /// How each station is shared between the palette's classes.
    pub(in crate::pattern) fn blends(&self) -> &'p [Blend] {
        self.of_stations(&self.all.blends)
    }

    /// Up to each station, what [`Self::areas_to`] says.
    pub(in crate::pattern) fn sums(&self) -> &'p [ClassAreas] {
        self.of_stations(&self.all.sums)
    }

    fn of_stations<T>(&self, all: &'p [T]) -> &'p [T] {
        let first = self.first_station();
        let own = all.get(first..first + self.stations.len());
        own.unwrap_or(&[])
    }

    pub(crate) fn station_count(&self) -> usize {
        self.stations.len()
    }

    /// Where a station is.
    pub(crate) fn station_at(&self, station: usize) -> f64 {
        self.stations[station].at.into()
    }

    /// The finishes of its zones, from the surface down.
    pub(crate) fn finishes(&self) -> impl Iterator<Item = Finish> {
        let layers = self.layers().iter().map(|layer| layer.finish);
        layers.chain([*self.bulk()])
    }

    /// Classes that stand for the cross-section at a place, and the share of each.
    pub(crate) fn classes(&self, at: f64) -> [(usize, f32); 4] {
        self.classes_of(self.locate(at))
    }

    fn classes_of(&self, (last, mix): (usize, f32)) -> [(usize, f32); 4] {
        let of = |station: usize, share: f32| {
            let blend = self.blends().get(station).copied().unwrap_or_default();
            let [a, b] = blend.classes.map(usize::from);
            [(a, share * (1.0 - blend.second)), (b, share * blend.second)]
        };
        let next = (last + 1).min(self.stations.len() - 1);
        let ([a, b], [c, d]) = (of(last, 1.0 - mix), of(next, mix));
        [a, b, c, d]
    }

    /// The station before a place, and how far the place is on the way to the next.
    #[inline(always)]
    pub(crate) fn locate(&self, at: f64) -> (usize, f32) {
        match self.stations.len() {
            1 => (0, 0.0),
            _ => self.locate_among(at),
        }
    }

    /// The same where there are several.
    fn locate_among(&self, at: f64) -> (usize, f32) {
        let place = |i: usize| f64::from(self.stations[i].at);
        let final_one = self.stations.len() - 1;
        // Most ask for where scratches set in.
        if at <= place(0) {
            return (0, 0.0);
        }
        let count = self.stations.len() as f64;
        let share = (at - place(0)) / (place(final_one) - place(0));
        let guide = |i: usize| self.stations.get(i).map(|station| station.guide as usize);
        let near = cell_number(share * count).min(number(final_one)) as usize;
        let low = guide(near).unwrap_or(0);
        let high = guide(near + 1).unwrap_or(final_one);
        // A damaged file may lead anywhere.
        let (low, near) = match self.stations.get(low..=high) {
            Some(near) => (low, near),
            None => (0, self.stations),
        };
        let next = low + near.partition_point(|station| f64::from(station.at) <= at);
        let last = next.saturating_sub(1);
        let next = next.min(final_one);
        let span = place(next) - place(last);
        let mix = if span > 0.0 {
            single(((at - place(last)) / span).clamp(0.0, 1.0))
        } else {
            0.0
        };
        (last, mix)
    }

    /// The cross-section at a place.
    #[inline(always)]
    pub(crate) fn profile(&self, at: f64) -> Profile<'p> {
        let (last, mix) = self.locate(at);
        Profile::between(
            self.shapes_from(last),
            self.vertex_count(),
            self.vertex_count(),
            mix,
        )
    }

    /// Shapes from a station on, one after the other.
    #[inline(always)]
    pub(in crate::pattern) fn shapes_from(&self, station: usize) -> &'p [Vec2] {
        self.vertices
            .get(station * self.vertex_count()..)
            .unwrap_or(&[])
    }

    /// How wide the cross-section is at a place, mm.
    pub(crate) fn width(&self, at: f64) -> f64 {
        let [left, right] = self.ends(at).map(f64::from);
        right - left
    }

    /// How wide it is on average on an even way from one place to another, mm.
    pub(crate) fn mean_width(&self, from: f64, to: f64) -> f64 {
        if (to - from).abs() <= self.least_step() {
            return self.width(0.5 * (from + to));
        }
        (self.area_to(to) - self.area_to(from)) / (to - from)
    }

    /// Of less of the way, differences of sums would be rounding.
    pub(in crate::pattern) fn least_step(&self) -> f64 {
        1e-4 * f64::from(self.stations[self.stations.len() - 1].at - self.stations[0].at)
    }

    /// The width added up from the first station to a place.
    fn area_to(&self, at: f64) -> f64 {
        let (last, mix) = self.locate(at);
        let station = &self.stations[last];
        let [width, end] = [(last, 0.0), (last, mix)].map(|place| {
            let [left, right] = self.ends_of(place).map(f64::from);
            right - left
        });
        let next = self.stations.get(last + 1).unwrap_or(station);
        let way = f64::from(mix) * f64::from(next.at - station.at);
        f64::from(station.area) + 0.5 * (width + end) * way
    }

    /// Where the cross-section begins and ends at a place, mm across from the centre line.
    pub(crate) fn ends(&self, at: f64) -> [f32; 2] {
        self.ends_of(self.locate(at))
    }

    /// The same, and [`Self::classes`].
    pub(crate) fn ends_and_classes(&self, at: f64) -> ([f32; 2], [(usize, f32); 4]) {
        let place = self.locate(at);
        (self.ends_of(place), self.classes_of(place))
    }

    /// The same, of a place that was located.
    pub(crate) fn ends_of(&self, (last, mix): (usize, f32)) -> [f32; 2] {
        let ends = |station: usize| {
            let shape = self.shapes_from(station);
            let x = |vertex: usize| shape.get(vertex).map_or(0.0, |vertex| vertex.x);
            [x(0), x(self.vertex_count() - 1)]
        };
        if mix <= 0.0 {
            return ends(last);
        }
        let (a, b) = (ends(last), ends(last + 1));
        [0, 1].map(|i| a[i] * (1.0 - mix) + b[i] * mix)
    }

    /// How far from the centre line it reaches at a place that was located, mm.
    pub(crate) fn half_width_of(&self, place: (usize, f32)) -> f64 {
        let [left, right] = self.ends_of(place);
        right.max(-left).into()
    }

    /// How much the cross-section has changed from the first station to a place.
    pub(crate) fn change(&self, at: f64) -> f64 {
        self.change_to(self.locate(at))
    }

    /// The same, of a place that was located.
    pub(crate) fn change_to(&self, (last, mix): (usize, f32)) -> f64 {
        let next = (last + 1).min(self.stations.len() - 1);
        let (a, b) = (self.stations[last].change, self.stations[next].change);
        f64::from(a) + f64::from(b - a) * f64::from(mix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places are found between the stations where a search from the first one on finds them, however unevenly
    /// stations lie.
    #[test]
    fn places_lie_between_their_stations() {
        for (count, power) in [(1, 1), (2, 1), (3, 2), (200, 1), (200, 6)] {
            let at = (0..count).map(|i| (0.5 + f64::from(i)).powi(power));
            let at: Vec<f64> = at.map(|at| f64::from(single(at))).collect();
            let mut tracks = Tracks::default();
            tracks.push(&Track {
                vertices: vec![Vec2::ZERO; 6 * at.len()],
                at: at.clone(),
                vertex_count: 6,
                caps: Default::default(),
                finishes: Default::default(),
            });
            let track = tracks.get(0).unwrap();
            for i in -10..=1010 {
                let place = at[at.len() - 1] * f64::from(i) / 1000.0;
                let (last, mix) = track.locate(place);
                let before = at.iter().filter(|station| **station <= place).count();
                let truth = before.saturating_sub(1);
                let next = at.get(truth + 1).copied().unwrap_or(f64::INFINITY);
                let share = ((place - at[truth]) / (next - at[truth])).clamp(0.0, 1.0);
                let off = last as f64 + f64::from(mix) - (truth as f64 + share);
                assert!(off.abs() < 1e-6, "{count}, {power}, {place}: off by {off}");
            }
        }
    }
}
