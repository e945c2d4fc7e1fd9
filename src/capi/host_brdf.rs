//! Base BRDFs of the host's own, for C.

use super::brdf::StriaeBrdf;
use super::handle::{borrowed, exclusive};
use super::sampling::{STRIAE_LOBE_DIFFUSE, STRIAE_LOBE_GLOSSY};
use super::status::{StriaeStatus, check_struct_size, guard};
use crate::brdf::{Brdf, HostBrdf, Hosted, Lobe};
use crate::error::{Error, Result};
use core::any::Any;
use core::ffi::c_void;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{LazyLock, Mutex, PoisonError};

/// The host's own base BRDF, for any zones and the flat surface: three functions. Set struct_size to sizeof(StriaeHostBrdf);
/// striae_brdf_host() makes a StriaeBrdf of it.
///
/// Directions are three numbers each, in the zone's own frame: x across the scratch, to the right of its travel where the zone
/// is level, y along it (on the flat surface along dp_du), z the zone's normal. They have unit length and point away from the
/// surface. `view`, and in `eval` the light too, lie above the zone. What is reflected depends on them and on `user` alone.
/// Where it is to vary over the surface, ask for striae_zones() and add them up yourself.
///
/// The functions are called while points are shaded, sampled and evaluated, by whichever threads do that, at any time and
/// several at once; they must not throw, jump out, or call striae with the StriaeShading that is being asked. The library
/// allocates nothing around them. Both they and what `user` points to must stay as long as any pattern or StriaeShading
/// that has them is used. The library remembers each different table, about 200 bytes, until the process ends.
///
/// What they give is believed, but for this: what is negative or no number counts as 0. So it is up to them that no light is
/// gained, that samples follow their density, and that `eval` over light[2] is the same with view and light swapped.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct StriaeHostBrdf {
    /// sizeof(StriaeHostBrdf)
    pub struct_size: usize,
    /// Writes to `f` BRDF times cosine, that between light and the zone's normal (light[2]), linear RGB.
    pub eval: Option<
        unsafe extern "C" fn(user: *mut c_void, view: *const f32, light: *const f32, f: *mut f32),
    >,
    /// Writes to `light` a direction, of any length above 0, chosen by two numbers `u` from 0 up to (not including) 1. It is
    /// all zeros before: left so, no light is chosen, which counts as black. A light below the zone reflects nothing.
    pub sample: Option<
        unsafe extern "C" fn(user: *mut c_void, u: *const f32, view: *const f32, light: *mut f32),
    >,
    /// Returns the density of `sample` at a light, per steradian: also at one below the zone, 0 where `sample` never goes.
    pub pdf:
        Option<unsafe extern "C" fn(user: *mut c_void, view: *const f32, light: *const f32) -> f32>,
    /// Given to each of them; NULL if they need none.
    pub user: *mut c_void,
    /// STRIAE_LOBE_DIFFUSE or STRIAE_LOBE_GLOSSY: what samples of its zones are flagged with.
    pub lobe: u32,
    /// How far it spreads light: the width alpha of GGX microfacets that do so about as far across the scratch, 0.001 to 1 (1
    /// if it is diffuse). The smaller, the more finely a curved groove is divided into zones.
    pub alpha_across: f32,
    /// The same along the scratch. Lobes without width, of a perfect mirror, are not accepted.
    pub alpha_along: f32,
}

type Eval = unsafe extern "C" fn(*mut c_void, *const f32, *const f32, *mut f32);
type Pdf = unsafe extern "C" fn(*mut c_void, *const f32, *const f32) -> f32;

/// A table that was checked.
#[derive(Clone, Copy, Debug)]
struct Table {
    given: StriaeHostBrdf,
    eval: Eval,
    sample: Eval,
    pdf: Pdf,
    lobe: Lobe,
}

// SAFETY: the header asks that functions and user pointer may be used by any thread.
unsafe impl Send for Table {}
// SAFETY: the same.
unsafe impl Sync for Table {}

impl HostBrdf for Table {
    fn eval(&self, view: [f32; 3], light: [f32; 3]) -> [f32; 3] {
        let mut f = [0.0; 3];
        // SAFETY: the header says what the functions are given: pointers to so many numbers, for as long as the call.
        unsafe {
            (self.eval)(
                self.given.user,
                view.as_ptr(),
                light.as_ptr(),
                f.as_mut_ptr(),
            );
        }
        f
    }

    fn sample(&self, u: [f32; 2], view: [f32; 3]) -> Option<[f32; 3]> {
        let mut light = [0.0; 3];
        // SAFETY: as above.
        unsafe {
            (self.sample)(
                self.given.user,
                u.as_ptr(),
                view.as_ptr(),
                light.as_mut_ptr(),
            );
        }
        (light != [0.0; 3]).then_some(light)
    }

    fn pdf(&self, view: [f32; 3], light: [f32; 3]) -> f32 {
        // SAFETY: as above.
        unsafe { (self.pdf)(self.given.user, view.as_ptr(), light.as_ptr()) }
    }

    fn lobe(&self) -> Lobe {
        self.lobe
    }

    fn alphas(&self) -> [f32; 2] {
        [self.given.alpha_across, self.given.alpha_along]
    }
}

/// Tables with the same of these are the same: functions, user pointer, lobe and widths.
type Key = ([Eval; 2], Pdf, usize, [u32; 3]);

impl Table {
    fn key(&self) -> Key {
        let [across, along] = self.alphas().map(f32::to_bits);
        let numbers = [self.given.lobe, across, along];
        let user = self.given.user.addr();
        ([self.eval, self.sample], self.pdf, user, numbers)
    }
}

/// Tables that the library knows.
static KNOWN: LazyLock<Mutex<HashMap<Key, Hosted>>> = LazyLock::new(Mutex::default);

impl StriaeHostBrdf {
    /// A table is known once, however often it is given.
    pub(super) fn known(&self) -> Result<Hosted> {
        let table = self.checked()?;
        let mut all = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        Ok(match all.entry(table.key()) {
            Entry::Occupied(same) => *same.get(),
            Entry::Vacant(new) => *new.insert(Hosted::new(table)?),
        })
    }

    fn checked(&self) -> Result<Table> {
        let size = size_of::<Self>();
        check_struct_size(self.struct_size, size, "sizeof(StriaeHostBrdf)")?;
        let missing = |name| Error::text(name, "NULL", "a function");
        Ok(Table {
            given: *self,
            eval: self.eval.ok_or(missing("eval"))?,
            sample: self.sample.ok_or(missing("sample"))?,
            pdf: self.pdf.ok_or(missing("pdf"))?,
            lobe: match self.lobe {
                STRIAE_LOBE_DIFFUSE => Lobe::Diffuse,
                STRIAE_LOBE_GLOSSY => Lobe::Glossy,
                other => {
                    let accepted = "STRIAE_LOBE_DIFFUSE or STRIAE_LOBE_GLOSSY";
                    return Err(Error::number("lobe", f64::from(other), accepted));
                }
            },
        })
    }

    /// The table that something known was made of; it stays where it is.
    pub(super) fn of(hosted: Hosted) -> *const Self {
        let brdf: Option<&dyn Any> = hosted.brdf().map(|brdf| brdf as &dyn Any);
        let table = brdf.and_then(|brdf| brdf.downcast_ref::<Table>());
        table.map_or(core::ptr::null(), |table| &raw const table.given)
    }
}

/// Fills in a base BRDF of the host's own. The table is copied.
///
/// @code{.c}
/// static void paint_eval(void *user, const float *view, const float *light, float *f) {
///   const Paint *paint = user;
///   for (int c = 0; c < 3; c++) f[c] = paint->albedo[c] * light[2] / 3.14159265f;
/// }
/// StriaeHostBrdf host = {.struct_size = sizeof host, .eval = paint_eval, .sample = paint_sample, .pdf = paint_pdf,
///                        .user = &paint, .lobe = STRIAE_LOBE_DIFFUSE, .alpha_across = 1.0f, .alpha_along = 1.0f};
/// striae_brdf_host(&host, &material.scratched);
/// @endcode
///
/// @param host the functions
/// @param brdf is written on success only
#[unsafe(no_mangle)]
pub unsafe extern "C" fn striae_brdf_host(
    host: *const StriaeHostBrdf,
    brdf: *mut StriaeBrdf,
) -> StriaeStatus {
    guard(|| {
        // SAFETY: each is NULL or valid, as the header asks.
        let (host, brdf) = unsafe { (borrowed("host", host)?, exclusive("brdf", brdf)?) };
        *brdf = Brdf::Hosted(host.known()?).into();
        Ok(())
    })
}
