//! Making and freeing handles.

use crate::{aspecta_follower, aspecta_inverse};
use aspecta_kinematics::follow::{Follower, InverseFollower};
use aspecta_robot::WorkingMode;
use aspecta_robot::{Robot, catalogue};
use std::ffi::{CStr, c_char};

/// Starts at the pose that a joint vector means, at least roughly.
///
/// `robot` is a name of the catalogue ("five-bar") or the text of a robot file, `n` the length of both vectors.
/// Returns NULL if that cannot be; then `message` says why, in at most `size` bytes, the terminating zero included.
/// `message` may be NULL.
///
/// # Safety
/// `robot` is null or a terminated string; `pose` and `q` are null or hold `n` numbers; `message` is null or has room for
/// `size` bytes.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_start(
    robot: *const c_char,
    pose: *const f64,
    q: *const f64,
    n: usize,
    message: *mut c_char,
    size: usize,
) -> *mut aspecta_follower {
    // SAFETY: the caller's promises above are those of the three helpers.
    let (name, pose, q) = unsafe { (text(robot), numbers(pose, n), numbers(q, n)) };
    let started = || {
        let (name, pose, q) = (name.ok_or(NO_ROBOT)?, pose.ok_or("pose is NULL")?, q.ok_or("q is NULL")?);
        Follower::new(&resolve(name)?, pose, q).map_err(|e| e.to_string())
    };
    // SAFETY: as above.
    unsafe { handle(started().map(aspecta_follower), message, size) }
}

/// The inverse problem: starts at a pose, in the working mode given as signs of B_jj, such as "+-+".
///
/// # Safety
/// As of aspecta_start; `mode` is null or a terminated string.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_inverse_start(
    robot: *const c_char,
    pose: *const f64,
    n: usize,
    mode: *const c_char,
    message: *mut c_char,
    size: usize,
) -> *mut aspecta_inverse {
    // SAFETY: the caller's promises above are those of the three helpers.
    let (name, pose, mode) = unsafe { (text(robot), numbers(pose, n), text(mode)) };
    let started = || {
        let (name, pose, mode) =
            (name.ok_or(NO_ROBOT)?, pose.ok_or("pose is NULL")?, mode.ok_or("mode is NULL or not UTF-8")?);
        let mode: WorkingMode = mode.parse().map_err(|e: aspecta_robot::NotAMode| e.to_string())?;
        InverseFollower::new(&resolve(name)?, pose, mode).map_err(|e| e.to_string())
    };
    // SAFETY: as above.
    unsafe { handle(started().map(aspecta_inverse), message, size) }
}

/// Frees a handle; NULL is allowed.
///
/// # Safety
/// `follower` is null or comes from aspecta_start, and is not used again.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_free(follower: *mut aspecta_follower) {
    if !follower.is_null() {
        // SAFETY: it came from a Box, and the caller gives it back once.
        drop(unsafe { Box::from_raw(follower) });
    }
}

/// Frees a handle of the inverse problem; NULL is allowed.
///
/// # Safety
/// `follower` is null or comes from aspecta_inverse_start, and is not used again.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_inverse_free(follower: *mut aspecta_inverse) {
    if !follower.is_null() {
        // SAFETY: it came from a Box, and the caller gives it back once.
        drop(unsafe { Box::from_raw(follower) });
    }
}

const NO_ROBOT: &str = "robot is NULL or not UTF-8";

/// The robot of the catalogue, or of a robot file's text: a name has no line breaks and no `=`.
fn resolve(text: &str) -> Result<Robot, String> {
    if text.contains(['\n', '=']) {
        return Robot::from_toml(text, "robot file").map_err(|e| e.to_string());
    }
    catalogue::find(text).ok_or_else(|| {
        let names: Vec<_> = catalogue::all().iter().map(|entry| entry.name).collect();
        format!(
            "no robot `{text}` in the catalogue, which has {}; or give the text of a robot file",
            names.join(", ")
        )
    })
}

/// The handle, or null with the message written.
///
/// # Safety
/// `message` is null or has room for `size` bytes.
#[allow(unsafe_code)]
unsafe fn handle<T>(made: Result<T, String>, message: *mut c_char, size: usize) -> *mut T {
    match made {
        Ok(handle) => Box::into_raw(Box::new(handle)),
        Err(why) => {
            if !message.is_null() && size > 0 {
                // A character that does not fit is left out whole.
                let fits = |k: &usize| why.is_char_boundary(*k);
                let length = (0..=why.len().min(size - 1)).rev().find(fits).unwrap_or(0);
                // SAFETY: length < size, for which the caller has made room; a String does not overlap it.
                unsafe {
                    std::ptr::copy_nonoverlapping(why.as_ptr(), message.cast(), length);
                    *message.add(length) = 0;
                }
            }
            std::ptr::null_mut()
        }
    }
}

/// # Safety
/// `text` is null or a terminated string that outlives the call.
#[allow(unsafe_code)]
unsafe fn text<'a>(text: *const c_char) -> Option<&'a str> {
    if text.is_null() {
        return None;
    }
    // SAFETY: the caller's promise.
    unsafe { CStr::from_ptr(text) }.to_str().ok()
}

/// # Safety
/// `numbers` is null or holds `n` numbers that outlive the call.
#[allow(unsafe_code)]
unsafe fn numbers<'a>(numbers: *const f64, n: usize) -> Option<&'a [f64]> {
    if numbers.is_null() {
        return None;
    }
    // SAFETY: the caller's promise.
    Some(unsafe { std::slice::from_raw_parts(numbers, n) })
}
