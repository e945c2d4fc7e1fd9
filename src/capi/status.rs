//! Status codes, this thread's error text, and the guard that every entry runs in.

use crate::error::{Error, Result};
use core::ffi::c_char;
use core::fmt::Write;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Major version of the header.
pub const STRIAE_VERSION_MAJOR: u32 = 0;
/// Minor version of the header. Before 1.0 each minor version may change the ABI.
pub const STRIAE_VERSION_MINOR: u32 = 1;
/// Patch version of the header.
pub const STRIAE_VERSION_PATCH: u32 = 0;

/// What a call says of its outcome. After anything but `STRIAE_STATUS_OK`, striae_last_error() has the details.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StriaeStatus {
    /// All went well.
    Ok = 0,
    /// An argument was refused. Nothing was made or changed.
    InvalidArgument = 1,
    /// A fault of the library's own: it is caught, and what the call was to write may be there in part. Please report it.
    Internal = 2,
    /// A file could not be read, used or written. Nothing was made or changed.
    File = 3,
}

/// Longest error text, its final NUL included.
const TEXT_BYTES: usize = 512;

struct Text {
    bytes: [u8; TEXT_BYTES],
    used: usize,
}

thread_local! {
    // Plain bytes: no allocation, no destructor, and never touched by a call that succeeds.
    static LAST_ERROR: RefCell<Text> =
        const { RefCell::new(Text { bytes: [0; TEXT_BYTES], used: 0 }) };
}

impl Write for Text {
    fn write_str(&mut self, s: &str) -> core::fmt::Result {
        let room = TEXT_BYTES - 1 - self.used;
        let taken = s.floor_char_boundary(room);
        self.bytes[self.used..self.used + taken].copy_from_slice(&s.as_bytes()[..taken]);
        self.used += taken;
        self.bytes[self.used] = 0;
        Ok(())
    }
}

/// Why a call failed, as a text and a status.
pub(super) trait Refusal: core::fmt::Display {
    fn status(&self) -> StriaeStatus;
}

impl Refusal for Error {
    fn status(&self) -> StriaeStatus {
        StriaeStatus::InvalidArgument
    }
}

fn remember(error: &impl core::fmt::Display) {
    LAST_ERROR.with_borrow_mut(|text| {
        text.used = 0;
        // Writing to a fixed buffer cannot fail; what does not fit is cut.
        let _ = write!(text, "{error}");
    });
}

/// Runs a call: errors become a status and a text, and a panic never crosses the boundary.
pub(super) fn guard(call: impl FnOnce() -> Result<()>) -> StriaeStatus {
    guard_any(call)
}

/// As [`guard`], for calls that fail in other ways too.
pub(super) fn guard_any<E: Refusal>(
    call: impl FnOnce() -> core::result::Result<(), E>,
) -> StriaeStatus {
    match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(())) => StriaeStatus::Ok,
        Ok(Err(error)) => {
            remember(&error);
            error.status()
        }
        Err(_) => {
            remember(&"internal error in striae: please report it");
            StriaeStatus::Internal
        }
    }
}

/// The structure's size as its caller knows it must be the library's own.
pub(super) fn check_struct_size(given: usize, own: usize, accepted: &'static str) -> Result<()> {
    if given == own {
        return Ok(());
    }
    Err(Error::count("struct_size", given, accepted))
}

/// The library's version at run time: (major << 16) | (minor << 8) | patch. Any thread; never fails.
#[unsafe(no_mangle)]
pub extern "C" fn striae_version() -> u32 {
    (STRIAE_VERSION_MAJOR << 16) | (STRIAE_VERSION_MINOR << 8) | STRIAE_VERSION_PATCH
}

/// The text of this thread's last failed call: which argument, what was given, what is accepted. UTF-8, cut after 511
/// bytes, never NULL, empty before the first failure. The library's own: valid until this thread fails again or ends. Calls
/// that succeed leave it as it is. Allocates nothing; but where a library was opened at run time (dlopen), the system
/// may have to make room for a thread's first text when its first call fails.
#[unsafe(no_mangle)]
pub extern "C" fn striae_last_error() -> *const c_char {
    LAST_ERROR.with(|text| text.borrow().bytes.as_ptr().cast())
}
