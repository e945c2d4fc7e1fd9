//! What a prepared point looks like to renderers that want a few numbers: one lobe in place of many.

use super::shading::Shading;
use super::visit::Zone;
use crate::brdf::{ACROSS_SURFACE, Lobe, Pair};
use glam::{Vec2, Vec3};

/// Samples that an estimate of reflectance takes.
const ALBEDO_SAMPLES: u32 = 128;

/// Slopes are no steeper than this: 89.4 degrees.
const STEEPEST: f32 = 100.0;

/// Slopes that differ by less than this share in any two directions have none that stands out.
const EVEN: f32 = 1e-4;

/// The scratches of a point as a single lobe: GGX microfacets whose slopes deviate as much along either axis as the
/// seen zones' and those of their own microfacets do together. Of an unscratched point: the surface's own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub struct Parameters {
    /// The share of what the pixel shows that scratches are, 0 to 1.
    pub coverage: f32,
    /// Along the scratches, where the lobe is narrowest: from the local frame's x towards its y, degrees, 0 up to 180. 0
    /// where no direction stands out.
    pub tangent_deg: f32,
    /// Width alpha of the distribution of slopes along that direction, 0.001 to 1.
    pub alpha_along: f32,
    /// Width across it, from `alpha_along` to 1.
    pub alpha_across: f32,
    /// Alpha of an isotropic lobe as wide: the geometric mean of both.
    pub roughness: f32,
    /// 0 (none) up to 1: 1 less `alpha_along` over `alpha_across`.
    pub anisotropy: f32,
    /// The lobe's unit normal in the local frame: scratches that show one wall lean.
    pub normal: [f32; 3],
}

/// Slopes seen, weighed.
#[derive(Clone, Copy, Debug, Default)]
struct Slopes {
    weight: f32,
    sum: Vec2,
    /// Of squares: xx, xy, yy.
    squares: Vec3,
}

impl Slopes {
    /// A zone's own slope, and those of its microfacets: alphas across and along.
    fn add(&mut self, zone: &Zone, across: Vec2, alphas: Vec2) {
        let slope =
            (zone.normal[0] / zone.normal[1].max(1.0 / STEEPEST)).clamp(-STEEPEST, STEEPEST);
        let along = Vec2::new(-across.y, across.x);
        let variance = 0.5 * alphas * alphas;
        self.weight += zone.seen;
        self.sum += zone.seen * slope * across;
        self.squares += zone.seen
            * ((slope * slope + variance.x) * squares(across) + variance.y * squares(along));
    }

    fn mean(&self) -> Vec2 {
        self.sum / self.weight.max(f32::MIN_POSITIVE)
    }

    /// The lobe that has the same deviations.
    fn lobe(&self, coverage: f32) -> Parameters {
        let mean = self.mean();
        let variances = self.squares / self.weight.max(f32::MIN_POSITIVE) - squares(mean);
        let [xx, xy, yy] = variances.to_array();
        let (middle, apart) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let alpha = |variance: f32| (2.0 * variance.max(0.0)).sqrt().clamp(0.001, 1.0);
        let (along, across) = (alpha(middle - apart), alpha(middle + apart));
        let widest = 0.5 * (2.0 * xy).atan2(xx - yy);
        let tangent_deg = (widest.to_degrees() + 90.0).rem_euclid(180.0);
        Parameters {
            coverage,
            tangent_deg: if apart > EVEN * middle && tangent_deg < 180.0 {
                tangent_deg
            } else {
                0.0
            },
            alpha_along: along,
            alpha_across: across,
            roughness: (along * across).sqrt(),
            anisotropy: 1.0 - along / across,
            normal: mean.extend(1.0).normalize().to_array(),
        }
    }
}

fn squares(v: Vec2) -> Vec3 {
    Vec3::new(v.x * v.x, v.x * v.y, v.y * v.y)
}

impl Shading {
    /// The scratches as a single lobe, for materials that take no other: mixed with the surface by its coverage.
    pub fn parameters(&self) -> Parameters {
        let mut scratches = Slopes::default();
        self.each_seen_zone(|zone, across| {
            if zone.facet.is_some() {
                scratches.add(zone, across, self.zones.finish_of(zone.finish).alphas());
            }
        });
        if scratches.weight > 0.0 {
            return scratches.lobe(self.coverage());
        }
        let surface = self.zones.finish_of(0).alphas();
        scratches.add(&Zone::flat(1.0, 1.0), ACROSS_SURFACE, surface);
        scratches.lobe(0.0)
    }

    /// How rough the point is, scratches and surface together: the alpha of GGX microfacets that spread light about as
    /// far, 0.001 to 1.
    pub fn roughness(&self) -> f32 {
        let mut slopes = Slopes::default();
        self.each_seen_zone(|zone, across| {
            slopes.add(zone, across, self.zones.finish_of(zone.finish).alphas());
        });
        if slopes.weight > 0.0 {
            slopes.lobe(0.0).roughness
        } else {
            1.0
        }
    }

    /// An estimate of the share of light that the point reflects towards the view, RGB: the mean of 128 samples, within
    /// about 0.05. It costs as much as 128 lights do.
    pub fn albedo(&self) -> [f32; 3] {
        // Each by itself: what a host reflects may be large, and their sum beyond single precision.
        let share = |i| Some(Vec3::from(self.sample(evenly(i))?.weight) / ALBEDO_SAMPLES as f32);
        let sum: Vec3 = (0..ALBEDO_SAMPLES).filter_map(share).sum();
        sum.to_array()
    }

    /// Whether the viewer sees zones of this kind.
    pub fn has_lobe(&self, lobe: Lobe) -> bool {
        let mut found = false;
        self.each_seen_zone(|zone, _| found |= self.zones.finish_of(zone.finish).kind() == lobe);
        found
    }

    /// Visits each zone that the viewer sees, with its scratch's first axis.
    fn each_seen_zone(&self, mut visit: impl FnMut(&Zone, Vec2)) {
        if !self.is_seen() {
            return;
        }
        // No light matters here.
        self.each_zone(&Pair::new(self.view, self.view), |zone, _, across| {
            if zone.seen > 0.0 {
                visit(zone, across);
            }
        });
    }
}

/// Points spread evenly over the unit cube.
fn evenly(i: u32) -> [f32; 3] {
    // The inverses of the root of x⁴ = x + 1, squared and cubed: Roberts's sequence in three dimensions.
    const STEPS: [f64; 3] = [
        0.819_172_513_396_164_4,
        0.671_043_606_703_789_2,
        0.549_700_477_901_970_5,
    ];
    STEPS.map(|step| crate::single((0.5 + f64::from(i) * step).fract()))
}
