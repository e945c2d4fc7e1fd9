//! Raw pointers from C, checked and turned into what Rust works with.

use crate::error::{Error, Result};
use std::sync::Arc;

/// # Safety
/// `pointer` is NULL or points to a valid `T` that lives, unchanged, as long as the call.
#[inline(always)]
pub(super) unsafe fn borrowed<'a, T>(name: &'static str, pointer: *const T) -> Result<&'a T> {
    // SAFETY: as promised by the caller.
    match unsafe { pointer.as_ref() } {
        Some(pointer) => Ok(pointer),
        None => Err(null(name)),
    }
}

/// # Safety
/// `pointer` is NULL or points to a valid `T` that nothing else uses during the call.
#[inline(always)]
pub(super) unsafe fn exclusive<'a, T>(name: &'static str, pointer: *mut T) -> Result<&'a mut T> {
    // SAFETY: as promised by the caller.
    match unsafe { pointer.as_mut() } {
        Some(pointer) => Ok(pointer),
        None => Err(null(name)),
    }
}

#[cold]
fn null(name: &'static str) -> Error {
    Error::text(name, "NULL", "a valid pointer")
}

/// An array from C: NULL is fine for no elements. `names` are those of the pointer and of the count.
///
/// # Safety
/// `pointer` is NULL or points to `count` valid elements that live, unchanged, as long as the call.
pub(super) unsafe fn array<'a, T>(
    names: [&'static str; 2],
    pointer: *const T,
    count: usize,
) -> Result<&'a [T]> {
    check_array(names, pointer, count)?;
    if count == 0 {
        return Ok(&[]);
    }
    // SAFETY: not NULL, no longer than an object can be; the rest as promised by the caller.
    Ok(unsafe { core::slice::from_raw_parts(pointer, count) })
}

/// An array that C wants filled; as [`array`].
///
/// # Safety
/// `pointer` is NULL or points to `count` elements, valid whatever their bits, that nothing else uses during the call.
pub(super) unsafe fn exclusive_array<'a, T>(
    names: [&'static str; 2],
    pointer: *mut T,
    count: usize,
) -> Result<&'a mut [T]> {
    check_array(names, pointer, count)?;
    if count == 0 {
        return Ok(&mut []);
    }
    // SAFETY: not NULL, no longer than an object can be; the rest as promised by the caller.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer, count) })
}

fn check_array<T>(names: [&'static str; 2], pointer: *const T, count: usize) -> Result<()> {
    if pointer.is_null() && count > 0 {
        let accepted = "a valid pointer (or a count of 0)";
        return Err(Error::text(names[0], "NULL", accepted));
    }
    if count > isize::MAX.unsigned_abs() / size_of::<T>().max(1) {
        let accepted = "no more elements than memory can hold";
        return Err(Error::count(names[1], count, accepted));
    }
    Ok(())
}

/// Makes a new shared handle and writes it to `out`; on failure `out` (if not NULL) becomes NULL.
///
/// # Safety
/// `out` is NULL or points to a writable pointer.
pub(super) unsafe fn make_shared<T, E: From<Error>>(
    name: &'static str,
    out: *mut *mut T,
    make: impl FnOnce() -> core::result::Result<T, E>,
) -> core::result::Result<(), E> {
    // SAFETY: as promised by the caller.
    let out = unsafe { exclusive(name, out) }?;
    *out = core::ptr::null_mut();
    *out = Arc::into_raw(Arc::new(make()?)).cast_mut();
    Ok(())
}

/// # Safety
/// `handle` is NULL or came from [`make_shared`] and has not been released since.
pub(super) unsafe fn retain<T>(handle: *const T) {
    if !handle.is_null() {
        // SAFETY: a live handle that Arc::into_raw gave.
        unsafe { Arc::increment_strong_count(handle) };
    }
}

/// # Safety
/// `handle` is NULL or came from [`make_shared`] and has not been released since.
pub(super) unsafe fn release<T>(handle: *const T) {
    if !handle.is_null() {
        // SAFETY: a live handle that Arc::into_raw gave.
        unsafe { Arc::decrement_strong_count(handle) };
    }
}
