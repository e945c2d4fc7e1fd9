//! What facets of one finish reflect: those of one scratch side by side, or of several scratches all together.

use super::{ANISOTROPIC_GGX, Finish, GGX, HOSTED_DIFFUSE, HOSTED_GLOSSY};
use crate::brdf::{Local, Pair, ggx};
use crate::lanes::{Lanes, Number};

/// Facets of several scratches of one cross-section.
#[derive(Clone, Copy)]
pub(crate) struct Facets<'a, F> {
    /// Across and upward components.
    pub normals: [&'a [f32]; 2],
    /// How much of each counts, scratch beside scratch.
    pub shares: &'a [F],
}

impl<F: Number> Facets<'_, F> {
    #[inline(always)]
    fn sum<L: Lanes<F = F>>(&self, lanes: L, of: impl Fn([f32; 2], F) -> F) -> F {
        let [xs, zs] = self.normals;
        let mut sum = lanes.all(0.0);
        for ((&x, &z), &share) in xs.iter().zip(zs).zip(self.shares) {
            if share.any() {
                sum = share.times_plus(of([x, z], share), sum);
            }
        }
        sum
    }
}

impl Finish {
    /// The lobes of facets side by side, times n · light; the pair in the frame of their scratch. Where a direction is below
    /// a facet it may be any number.
    #[inline(always)]
    pub(crate) fn facet_lobes<L: Lanes>(&self, lanes: L, pair: &Pair, normal: [L::F; 2]) -> L::F {
        match self.lobe {
            GGX | ANISOTROPIC_GGX => {
                let tilting = ggx::Tilting::new(self.alphas(), &pair.local()).all(lanes);
                tilting.lobe_cos(normal) * tilting.scale
            }
            _ => lanes.call(
                #[inline(always)]
                || self.lobes_cos(lanes, &pair.tilted(normal[0], normal[1])),
            ),
        }
    }

    /// With what density their samples go to the light.
    #[inline(always)]
    pub(crate) fn facet_pdfs<L: Lanes>(&self, lanes: L, pair: &Pair, normal: [L::F; 2]) -> L::F {
        match self.lobe {
            GGX | ANISOTROPIC_GGX => {
                let tilting = ggx::Tilting::new(self.alphas(), &pair.local()).all(lanes);
                tilting.pdf(normal) * tilting.scale
            }
            _ => lanes.call(
                #[inline(always)]
                || self.pdfs(lanes, &pair.tilted(normal[0], normal[1])),
            ),
        }
    }

    /// Both; the density together with that at the light of another pair of the same view. What they share is found once.
    #[inline(always)]
    pub(crate) fn facet_lobes_and_pdfs<L: Lanes>(
        &self,
        lanes: L,
        [pair, other]: [&Pair; 2],
        normal: [L::F; 2],
    ) -> [L::F; 2] {
        match self.lobe {
            GGX | ANISOTROPIC_GGX => {
                let alphas = self.alphas();
                let tilting = ggx::Tilting::new(alphas, &pair.local()).all(lanes);
                let other = ggx::Tilting::new(alphas, &other.local()).all(lanes);
                // What depends on the view alone is the same in both.
                let pdfs = tilting.pdf(normal) + other.pdf(normal);
                [tilting.lobe_cos(normal), pdfs].map(
                    #[inline(always)]
                    |of| of * tilting.scale,
                )
            }
            _ => {
                let pdfs =
                    self.facet_pdfs(lanes, pair, normal) + self.facet_pdfs(lanes, other, normal);
                [self.facet_lobes(lanes, pair, normal), pdfs]
            }
        }
    }

    /// What facets with these normals reflect together, so much of each being lit; the pair in the frames of their scratches.
    #[inline(always)]
    pub(crate) fn lit_lobes<L: Lanes>(
        &self,
        lanes: L,
        pair: &Local<L::F>,
        facets: Facets<'_, L::F>,
    ) -> L::F {
        match self.lobe {
            GGX | ANISOTROPIC_GGX => {
                let tilting = ggx::Tilting::new(self.alphas(), pair);
                let sum = facets.sum(
                    lanes,
                    #[inline(always)]
                    |normal, _| tilting.lobe_cos(normal.map(|x| lanes.all(x))),
                );
                sum * tilting.scale
            }
            HOSTED_DIFFUSE | HOSTED_GLOSSY => lanes.all(0.0),
            _ => facets.sum(
                lanes,
                #[inline(always)]
                |normal, share| if_any(share, self.lobes_cos(lanes, &pair.tilted(normal))),
            ),
        }
    }

    /// With what density facets' samples go to the light, as [`Self::lit_lobes`].
    #[inline(always)]
    pub(crate) fn seen_pdfs<L: Lanes>(
        &self,
        lanes: L,
        pair: &Local<L::F>,
        facets: Facets<'_, L::F>,
    ) -> L::F {
        match self.lobe {
            GGX | ANISOTROPIC_GGX => {
                let tilting = ggx::Tilting::new(self.alphas(), pair);
                let sum = facets.sum(
                    lanes,
                    #[inline(always)]
                    |normal, _| tilting.pdf(normal.map(|x| lanes.all(x))),
                );
                sum * tilting.scale
            }
            _ => facets.sum(
                lanes,
                #[inline(always)]
                |normal, share| if_any(share, self.pdfs(lanes, &pair.tilted(normal))),
            ),
        }
    }
}

/// `value` where it counts: elsewhere it may be anything.
#[inline(always)]
fn if_any<F: Number>(share: F, value: F) -> F {
    share.if_above(share.like(0.0), value, share.like(0.0))
}
