//! The scratches in a footprint, for C.

use super::handle::{borrowed, exclusive, exclusive_array};
use super::pattern::StriaePattern;
use super::shading::StriaePoint;
use super::status::{StriaeStatus, guard};
use crate::pattern::{Found, ScratchHit};

/// One scratch in a footprint. Coverage is that of the whole footprint; all else is told of the scratch's place that is
/// nearest to the footprint's centre.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeHit {
    /// Number of the scratch in order of adding, from 0: those of a generator or a file count one by one. Add those first
    /// whose numbers are to be known beforehand.
    pub scratch: u32,
    /// The share of the footprint that the scratch covers with its rims, less what later scratches cut: above 0, to 1. Where
    /// the footprint holds more than 128 runs of scratch, less what later ones cut on average.
    pub coverage: f32,
    /// From the scratch's start along its path, scene units.
    pub arc_length: f64,
    /// From the centre line to the footprint's centre, mm, to the right of travel.
    pub offset_mm: f64,
    /// Unit direction of travel in the local frame; z is 0. striae_frame_to_world() turns it into the renderer's.
    pub travel: [f32; 3],
    /// How deep the cross-section lies below the unscratched surface at the footprint's centre, mm; negative on the
    /// piled-up rims, 0 beside the scratch. What a later scratch cuts away there counts as if it were still there.
    pub depth_mm: f32,
    /// The cross-section's depth where it is deepest, mm.
    pub deepest_mm: f32,
}

/// How many scratches a footprint holds.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeHitCount {
    /// Hits that were written, from the first on: the smaller one of `found` and the capacity.
    pub written: usize,
    /// Scratches that were told apart.
    pub found: usize,
    /// 1 if these are all, 0 if not: a footprint over thousands of scratches is not searched to its end, so that it
    /// has others that are not counted, and perhaps none that is.
    pub complete: u32,
}

macro_rules! assert_same_place {
    ($($field:ident)*) => {
        const _: () = assert!(
            size_of::<StriaeHit>() == size_of::<ScratchHit>()
                && align_of::<StriaeHit>() == align_of::<ScratchHit>()
                $(&& core::mem::offset_of!(StriaeHit, $field) == core::mem::offset_of!(ScratchHit, $field))*,
            "the C structure must be a ScratchHit"
        );
    };
}

assert_same_place!(scratch coverage arc_length offset_mm travel depth_mm deepest_mm);

/// The scratches in a footprint, whoever looks: for masks, labels and what else a renderer writes beside light.
/// The one that covers the largest share comes first, of equal ones the latest, which lies on top. Never
/// allocates, locks or blocks, and a footprint with any number of scratches is no failure; any number of threads at
/// once. 256 KiB of stack suffice.
///
/// @param pattern the pattern
/// @param point the point; a STRIAE_FOOTPRINT_POINT tells what lies right there
/// @param hits receives the first `capacity` ones, may be NULL with a capacity of 0; need not be initialised
/// @param capacity how many `hits` can hold
/// @param count receives how many there are; zeros if the point is refused, so that a render goes on
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_pattern_query(
    pattern: *const StriaePattern,
    point: *const StriaePoint,
    hits: *mut StriaeHit,
    capacity: usize,
    count: *mut StriaeHitCount,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: NULL or writable, as the header asks.
        let count = unsafe { exclusive("count", count)? };
        *count = Found::default().into();
        // SAFETY: each is NULL or valid, as the header asks. A ScratchHit is made of numbers for which all bits
        // are valid, and has the same layout as a StriaeHit (asserted above).
        let (pattern, point, hits) = unsafe {
            (
                borrowed("pattern", pattern)?,
                borrowed("point", point)?,
                exclusive_array(["hits", "capacity"], hits.cast::<ScratchHit>(), capacity)?,
            )
        };
        point.check_footprint()?;
        *count = pattern.0.hits(&point.surface_point(), hits)?.into();
        Ok(())
    })
}

impl From<Found> for StriaeHitCount {
    fn from(found: Found) -> Self {
        Self {
            written: found.written,
            found: found.count,
            complete: found.complete.into(),
        }
    }
}
