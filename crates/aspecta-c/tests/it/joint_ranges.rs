//! Joint values that C is told lie within the joints' own ranges, and are those that Rust is told, to the last bit.
//!
//! `ASPECTA_CASES` sets the number of random robots and poses (2000 by default).

#![allow(unsafe_code)]

use aspecta_c::{aspecta_inverse_free, aspecta_inverse_last, aspecta_inverse_start, aspecta_inverse_step};
use aspecta_kinematics::Kinematics;
use aspecta_robot::num::Random;
use aspecta_robot::{Robot, catalogue};
use std::ffi::CString;
use std::ptr;

/// The text of a robot whose every motor turns within a random range, in degrees, and these ranges.
fn limited(name: &str, random: &mut Random) -> (String, Vec<(f64, f64)>) {
    let text = catalogue::all().iter().find(|entry| entry.name == name).unwrap().text;
    let mut ranges = Vec::new();
    let lines = text.lines().map(|line| {
        if !line.starts_with("actuator") {
            return format!("{line}\n");
        }
        let (middle, half) = (random.within((-540.0, 540.0)), random.within((20.0, 179.0)));
        ranges.push((middle - half, middle + half));
        format!("{line}\nlimits = {{ actuator = {{ deg = [{}, {}] }} }}\n", middle - half, middle + half)
    });
    (lines.collect(), ranges)
}

/// What C is told at the start and after a step that stays where it is.
fn told(text: &str, pose: &[f64], mode: &str) -> Option<[Vec<f64>; 2]> {
    let (robot, mode) = (CString::new(text).unwrap(), CString::new(mode).unwrap());
    let n = pose.len();
    let mut q = [vec![0.0; n], vec![0.0; n]];
    // SAFETY: all pointers are to live buffers of the lengths given; the handle is freed once.
    unsafe {
        let handle =
            aspecta_inverse_start(robot.as_ptr(), pose.as_ptr(), n, mode.as_ptr(), ptr::null_mut(), 0);
        if handle.is_null() {
            return None;
        }
        assert_eq!(aspecta_inverse_last(handle, ptr::null_mut(), q[0].as_mut_ptr()), 0);
        let status = aspecta_inverse_step(handle, pose.as_ptr(), q[1].as_mut_ptr(), ptr::null_mut());
        aspecta_inverse_free(handle);
        assert_eq!(status, 0);
    }
    Some(q)
}

#[test]
fn joint_values_are_those_of_the_joints_range() {
    let cases = std::env::var("ASPECTA_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(2000);
    let random = &mut Random::new(23);
    let mut within = 0;
    for case in 0..cases {
        let (text, ranges) = limited(["five-bar", "3-rrr", "delta", "hexa"][case % 4], random);
        let robot = Robot::from_toml(&text, "limited").unwrap();
        let window = robot.workspace_window().unwrap();
        let pose: Vec<f64> = window.ranges.iter().map(|&range| random.within(range)).collect();
        let solutions = robot.inverse(&pose).unwrap();
        for solution in solutions.iter().filter(|s| s.within_limits) {
            let Some(told) = told(&text, &pose, &solution.mode.to_string()) else { continue };
            let bits = |q: &[f64]| q.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert!(told.iter().all(|q| bits(q) == bits(&solution.q)), "{told:?} {:?}", solution.q);
            let inside = |(q, &(lo, hi)): (&f64, &(f64, f64))| (lo..=hi).contains(&q.to_degrees());
            assert!(told[0].iter().zip(&ranges).all(inside), "{told:?} {ranges:?}");
            within += 1;
        }
    }
    assert!(within > cases / 10, "{within}");
}
