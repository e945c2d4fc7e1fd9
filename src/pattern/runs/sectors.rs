//! The caps at hard ends, sector by sector.

use super::{Part, Walk};
use crate::formation::End;
use crate::pattern::caps::{LONGEST_BORDER, turned};
use crate::pattern::center_line::CenterLine;
use crate::pattern::hit::Hit;
use crate::pattern::region::Region;
use core::ops::ControlFlow;
use glam::DVec2;

impl<'p, V: FnMut(&Hit<'p>) -> ControlFlow<()>> Walk<'_, 'p, V> {
    /// The sectors of the cap at an end of a part, if that is a hard end of its scratch within reach.
    #[inline(always)]
    pub(super) fn emit_cap(&mut self, part: &Part<'p>, end: End) {
        let [low, high] = self.near;
        let (i, point) = match end {
            End::Start => (0, part.control[0]),
            End::Stop => (1, part.control[3]),
        };
        if part.is_end[i] && point.cmpge(low).all() && point.cmple(high).all() {
            self.emit_near_cap(part, end);
        }
    }

    #[inline(never)]
    fn emit_near_cap(&mut self, part: &Part<'p>, end: End) {
        let (point, travel, outward) = match end {
            End::Start => (part.control[0], part.parting[0], -part.parting[0]),
            End::Stop => (part.control[3], part.parting[1], part.parting[1]),
        };
        let Some(cap) = self.pattern.cap_at(part.number, end) else {
            return;
        };
        let alone = cap.alone(&part.track, self.thin_mm);
        self.thin_caps |= alone < 1.0;
        if alone == 0.0 {
            return;
        }
        let footprint = self.reach.footprint;
        let [_, most] = footprint.extent(point, outward);
        if most <= 0.0 {
            return;
        }
        // Where one sector ends the next one begins.
        let mut last = (f32::NAN, DVec2::NAN);
        let mut border = |angle_rad: f32| {
            if last.0 != angle_rad {
                last = (angle_rad, turned(travel, angle_rad));
            }
            last.1
        };
        for sector in cap.sectors() {
            let wedge = sector.wedge;
            let (from, axis) = (border(wedge.from_rad), turned(travel, wedge.axis_rad));
            let to = border(wedge.to_rad);
            let origin = point + sector.offset_mm * DVec2::new(travel.y, -travel.x);
            // Out of reach nothing of it matters: most caps lie within the footprint, and nothing is to be cut.
            let far = |border: DVec2| {
                let widest = border.dot(axis).max(1.0 / LONGEST_BORDER);
                origin + border * (self.reach.reach_mm / widest)
            };
            let mut region = Region::triangle([origin, far(from), far(to)]);
            if !region.keep_within(footprint) {
                continue;
            }
            let parting = [[origin, from.perp()], [origin, to.perp()]];
            let hit = Hit {
                track: part.track,
                place: cap.place,
                profile: sector.profile,
                ends_mm: [0.0, sector.outer_mm()],
                scratch: part.scratch,
                at: cap.at,
                line: CenterLine::even(origin, axis.perp()),
                parting,
                part: Some(region),
                piece: part.number,
                alone,
            };
            self.tell(&hit);
        }
    }
}
