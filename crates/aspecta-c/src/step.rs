//! Steps.

use crate::aspecta_status::{
    self, ASPECTA_BAD_INPUT, ASPECTA_NULL, ASPECTA_OK, ASPECTA_PARALLEL, ASPECTA_SERIAL, ASPECTA_TOO_LONG,
};
use crate::{aspecta_follower, aspecta_inverse};
use aspecta_kinematics::follow::Refusal;
use aspecta_robot::WorkingMode;
use std::ffi::c_int;

/// What is said of a step.
#[allow(non_camel_case_types)]
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct aspecta_report {
    /// Up to where the step is proved, a share of it; 1 if it is certified.
    pub proved: f64,
    /// Refused steps: where the singularity is estimated, a share of the step; NaN if there is none. Numerical.
    pub singular_at: f64,
    /// Refused steps: distance left from the singularity at `proved`, without unit: the smallest singular value of the
    /// homogeneous A, or |B_jj| / max. NaN if certified. Numerical.
    pub distance: f64,
    /// Certified direct steps: bound of the error of each translation.
    pub length_error: f64,
    /// Certified direct steps: bound of the error of each rotation (rad).
    pub angle_error: f64,
    /// Bit j: B_jj < 0 for leg j + 1. The working mode.
    pub negative_legs: u32,
    /// Stretches that were tried.
    pub stretches: u32,
    /// Certified steps, 1 or 0: the configuration is proved to stay in its generalized aspect. 0 after a direct step: a
    /// leg may have met a serial singularity; after an inverse step: det A may have vanished.
    pub same_aspect: u32,
    /// Certified steps, 1 or 0: at the end all joints are within their limits and the pose in the
    /// robot's window. Numerical.
    pub within_limits: u32,
    /// ASPECTA_SERIAL: the leg, from 1; else 0.
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
    fn refuse(&mut self, refusal: Refusal) -> aspecta_status {
        match refusal {
            Refusal::Input(_) => ASPECTA_BAD_INPUT,
            Refusal::Parallel { proved, singular_at, distance } => {
                (self.proved, self.singular_at, self.distance) = (proved, singular_at, distance);
                ASPECTA_PARALLEL
            }
            Refusal::Serial { leg, proved, singular_at, distance } => {
                (self.proved, self.singular_at, self.distance) = (proved, singular_at, distance);
                self.leg = leg.number() as u32;
                ASPECTA_SERIAL
            }
            Refusal::TooLong { proved, distance } => {
                (self.proved, self.distance) = (proved, distance);
                ASPECTA_TOO_LONG
            }
        }
    }
}

/// Goes on to the joint vector `q`; writes the pose, if certified, and the report. `report` may be NULL.
///
/// Returns a status.
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
) -> c_int {
    if follower.is_null() || q.is_null() || pose.is_null() {
        return ASPECTA_NULL as c_int;
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
            ASPECTA_OK
        }
        Err(refusal) => said.refuse(refusal),
    };
    // SAFETY: the caller's promise.
    unsafe { tell(report, said) };
    status as c_int
}

/// Goes on to `pose`; writes the joint vector, if certified, and the report. `report` may be NULL.
///
/// Returns a status.
///
/// # Safety
/// As of aspecta_step.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_inverse_step(
    follower: *mut aspecta_inverse,
    pose: *const f64,
    q: *mut f64,
    report: *mut aspecta_report,
) -> c_int {
    if follower.is_null() || q.is_null() || pose.is_null() {
        return ASPECTA_NULL as c_int;
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
            ASPECTA_OK
        }
        Err(refusal) => said.refuse(refusal),
    };
    // SAFETY: the caller's promise.
    unsafe { tell(report, said) };
    status as c_int
}

/// The pose and the joint vector of the last certified step. Either may be NULL.
///
/// Returns a status.
///
/// # Safety
/// `follower` is null or a live handle that no other thread changes; `pose` and `q` are null or have room for n numbers.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_last(
    follower: *const aspecta_follower,
    pose: *mut f64,
    q: *mut f64,
) -> c_int {
    // SAFETY: null or valid, by the caller's promise.
    let last = unsafe { follower.as_ref() }.map(|follower| (follower.0.pose(), follower.0.q()));
    // SAFETY: the caller's promise.
    unsafe { copy(last, pose, q) }
}

/// The pose and the joint vector of the last certified step of the inverse problem. Either may be NULL.
///
/// Returns a status.
///
/// # Safety
/// As of aspecta_last.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub unsafe extern "C" fn aspecta_inverse_last(
    follower: *const aspecta_inverse,
    pose: *mut f64,
    q: *mut f64,
) -> c_int {
    // SAFETY: null or valid, by the caller's promise.
    let last = unsafe { follower.as_ref() }.map(|follower| (follower.0.pose(), follower.0.q()));
    // SAFETY: the caller's promise.
    unsafe { copy(last, pose, q) }
}

/// Degrees of freedom; 0 for NULL.
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
unsafe fn copy(last: Option<(&[f64], &[f64])>, pose: *mut f64, q: *mut f64) -> c_int {
    let Some(last) = last else { return ASPECTA_NULL as c_int };
    // SAFETY: the caller's promise.
    unsafe {
        write(pose, last.0);
        write(q, last.1);
    }
    ASPECTA_OK as c_int
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
