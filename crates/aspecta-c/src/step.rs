//! Steps.

use crate::{BAD_INPUT, NULL, OK, PARALLEL, SERIAL, TOO_LONG, aspecta_follower, aspecta_inverse};
use aspecta::kinematics::WorkingMode;
use aspecta::motion::follow::Refusal;

/// See `aspecta.h`.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct aspecta_report {
    /// Share of the step that is proved.
    pub proved: f64,
    /// Where the singularity is estimated.
    pub singular_at: f64,
    /// Distance left.
    pub distance: f64,
    /// Bound of the error of translations.
    pub length_error: f64,
    /// Bound of the error of rotations.
    pub angle_error: f64,
    /// Bit j: B_jj < 0.
    pub negative_legs: u32,
    /// Stretches tried.
    pub stretches: u32,
    /// Whether the aspect is proved to be the same.
    pub same_aspect: u32,
    /// Whether all joints are within their limits.
    pub within_limits: u32,
    /// The leg of a serial singularity.
    pub leg: u32,
}

impl aspecta_report {
    fn new(mode: WorkingMode) -> Self {
        let negative = |(j, sign): (usize, i8)| u32::from(sign < 0) << j;
        Self {
            proved: 0.0,
            singular_at: f64::NAN,
            distance: f64::NAN,
            length_error: f64::NAN,
            angle_error: f64::NAN,
            negative_legs: mode.signs().enumerate().map(negative).sum(),
            stretches: 0,
            same_aspect: 0,
            within_limits: 0,
            leg: 0,
        }
    }

    /// Fills in what is known of a certified step.
    fn certify(&mut self, stretches: u32, same_aspect: bool, within_limits: bool) {
        (self.proved, self.stretches) = (1.0, stretches);
        (self.same_aspect, self.within_limits) = (same_aspect.into(), within_limits.into());
    }

    /// Fills in why a step was refused.
    fn refuse(&mut self, refusal: Refusal) -> i32 {
        match refusal {
            Refusal::Input(_) => BAD_INPUT,
            Refusal::Parallel { proved, singular_at, distance } => {
                (self.proved, self.singular_at, self.distance) = (proved, singular_at, distance);
                PARALLEL
            }
            Refusal::Serial { leg, proved, singular_at, distance } => {
                (self.proved, self.singular_at, self.distance) = (proved, singular_at, distance);
                self.leg = leg as u32;
                SERIAL
            }
            Refusal::TooLong { proved, distance } => {
                (self.proved, self.distance) = (proved, distance);
                TOO_LONG
            }
        }
    }
}

/// See `aspecta.h`.
///
/// # Safety
/// `follower` is null or a live handle that no other thread uses; `q` and `pose` are null or hold n numbers; `report` is
/// null or valid.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_step(
    follower: *mut aspecta_follower,
    q: *const f64,
    pose: *mut f64,
    report: *mut aspecta_report,
) -> i32 {
    if follower.is_null() || q.is_null() || pose.is_null() {
        return NULL;
    }
    // SAFETY: not null, and the rest is the caller's promise.
    let (follower, q) = unsafe {
        let follower = &mut (*follower).0;
        let n = follower.robot().dof();
        (follower, std::slice::from_raw_parts(q, n))
    };
    let mut said = aspecta_report::new(follower.mode());
    let status = match follower.step(q) {
        Ok(step) => {
            // SAFETY: not null, and room for n numbers; `q` is not read any more, should they be the same.
            unsafe { write(pose, step.pose()) };
            said = aspecta_report::new(step.mode);
            said.certify(step.stretches, step.mode_kept, step.within_limits);
            (said.length_error, said.angle_error) = (step.length_error, step.angle_error);
            OK
        }
        Err(refusal) => said.refuse(refusal),
    };
    // SAFETY: the caller's promise.
    unsafe { tell(report, said) };
    status
}

/// See `aspecta.h`.
///
/// # Safety
/// As [`aspecta_step`].
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_inverse_step(
    follower: *mut aspecta_inverse,
    pose: *const f64,
    q: *mut f64,
    report: *mut aspecta_report,
) -> i32 {
    if follower.is_null() || q.is_null() || pose.is_null() {
        return NULL;
    }
    // SAFETY: not null, and the rest is the caller's promise.
    let (follower, pose) = unsafe {
        let follower = &mut (*follower).0;
        let n = follower.robot().dof();
        (follower, std::slice::from_raw_parts(pose, n))
    };
    let mut said = aspecta_report::new(follower.mode());
    let status = match follower.step(pose) {
        Ok(step) => {
            // SAFETY: not null, and room for n numbers; `pose` is not read any more, should they be the same.
            unsafe { write(q, step.q()) };
            said.certify(step.stretches, step.regular, step.within_limits);
            OK
        }
        Err(refusal) => said.refuse(refusal),
    };
    // SAFETY: the caller's promise.
    unsafe { tell(report, said) };
    status
}

/// See `aspecta.h`.
///
/// # Safety
/// `follower` is null or a live handle that no other thread changes; `pose` and `q` are null or have room for n numbers.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_last(follower: *const aspecta_follower, pose: *mut f64, q: *mut f64) -> i32 {
    // SAFETY: null or valid, by the caller's promise.
    let last = unsafe { follower.as_ref() }.map(|follower| (follower.0.pose(), follower.0.q()));
    // SAFETY: the caller's promise.
    unsafe { copy(last, pose, q) }
}

/// See `aspecta.h`.
///
/// # Safety
/// As [`aspecta_last`].
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_inverse_last(
    follower: *const aspecta_inverse,
    pose: *mut f64,
    q: *mut f64,
) -> i32 {
    // SAFETY: null or valid, by the caller's promise.
    let last = unsafe { follower.as_ref() }.map(|follower| (follower.0.pose(), follower.0.q()));
    // SAFETY: the caller's promise.
    unsafe { copy(last, pose, q) }
}

/// See `aspecta.h`.
///
/// # Safety
/// `follower` is null or a live handle.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_dof(follower: *const aspecta_follower) -> usize {
    // SAFETY: null or valid, by the caller's promise.
    unsafe { follower.as_ref() }.map_or(0, |follower| follower.0.robot().dof())
}

/// Writes the report, if it is wanted.
///
/// # Safety
/// `report` is null or valid.
#[allow(unsafe_code)]
unsafe fn tell(report: *mut aspecta_report, said: aspecta_report) {
    if !report.is_null() {
        // SAFETY: the caller's promise.
        unsafe { report.write(said) };
    }
}

/// Copies a handle's pose and joint vector.
///
/// # Safety
/// `pose` and `q` are null or have room for them.
#[allow(unsafe_code)]
unsafe fn copy(last: Option<(&[f64], &[f64])>, pose: *mut f64, q: *mut f64) -> i32 {
    let Some(last) = last else { return NULL };
    // SAFETY: the caller's promise.
    unsafe {
        write(pose, last.0);
        write(q, last.1);
    }
    OK
}

/// Copies `values` to `to`, if that is not null.
///
/// # Safety
/// `to` is null or has room for them.
#[allow(unsafe_code)]
unsafe fn write(to: *mut f64, values: &[f64]) {
    if !to.is_null() {
        // SAFETY: room by the caller's promise; `values` belong to this crate and do not overlap it.
        unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), to, values.len()) };
    }
}
