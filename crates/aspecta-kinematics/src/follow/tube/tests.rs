//! Faults planted in what the certificate is given: none may be certified.

use super::*;
use crate::Kinematics;
use aspecta_robot::catalogue;

type Planar<'a> = Model<'a, 2, 3>;

const Q: [f64; 3] = [14.98, 15.38, 12.0];
const NEXT: [f64; 3] = [14.981, 15.379, 12.001];

/// The direct solutions of the 3-RPR at `Q`, each proved.
fn solutions<'a>(model: &Planar<'a>) -> Vec<Located<3>> {
    let proved = |pose: &[f64]| {
        let pose: [f64; 3] = std::array::from_fn(|k| pose[k]);
        let inverse = model.linearised(&pose, &Q, &plain(&model.turns(&Q))).1.try_inverse().unwrap();
        model.prove_alone(&Located { pose, q: Q, radius: 0.0, inverse }).unwrap().end
    };
    let all: Vec<_> = model.robot.direct(&Q).unwrap().iter().map(|s| proved(&s.pose)).collect();
    assert_eq!(all.len(), 6);
    all
}

/// Returns the verdict on an honest stretch to `NEXT` in which a fault was planted.
fn planted(
    model: &Planar<'_>,
    start: &Located<3>,
    fault: impl Fn(&mut Stretch<'_, 2, 3>, &mut Root<3>),
) -> Option<Proof<3>> {
    let turns = model.turns(&NEXT);
    let mut root = model.newton(&start.pose, &start.inverse, &NEXT, &plain(&turns)).unwrap();
    let mut stretch = Stretch::moving(model, start, &root, &NEXT, &turns, &[1e-14; 3]);
    fault(&mut stretch, &mut root);
    model.certify::<Ball>(&stretch, &root).ok()
}

#[test]
fn planted_faults_are_not_certified() {
    let robot = catalogue::find("3-rpr").unwrap();
    let model = Planar::new(&robot, &[10.0, 10.0, 1.0, 1.0, 1.0, 1.0]);
    for start in solutions(&model) {
        assert!(planted(&model, &start, |_, _| {}).is_some(), "no fault: nothing is tested");
        let zero = Ball::point(0.0);
        type Fault = fn(&mut Stretch<'_, 2, 3>);
        let faults: [(&str, Fault); 8] = [
            ("Y with the wrong sign", |s| s.y = s.y.map(|row| row.map(|y| -y))),
            ("Y = 0", |s| s.y = [[Ball::point(0.0); 3]; 3]),
            ("Y unknown", |s| s.y[1][1] = Ball::point(f64::NAN)),
            ("no room", |s| s.room = 0.0),
            ("endless room", |s| s.room = f64::INFINITY),
            ("room unknown", |s| s.room = f64::NAN),
            ("joints anywhere", |s| s.off[0] = Ball::about_zero(f64::INFINITY)),
            ("the start elsewhere", |s| s.known[0] = s.known[0] + Ball::point(1.0)),
        ];
        for (name, fault) in faults {
            assert!(planted(&model, &start, |stretch, _| fault(stretch)).is_none(), "{name}");
        }
        // Equations that do not hold at X₁: f is off by 0.1.
        let off = |s: &mut Stretch<'_, 2, 3>, _: &mut Root<3>| {
            let y = s.y;
            s.miss = std::array::from_fn(|i| s.miss[i] + dot(&y[i], &[Ball::point(0.1), zero, zero]));
        };
        assert!(planted(&model, &start, off).is_none_or(|proof| proof.end.radius > 1e-5));
    }
}

/// From one solution of a joint vector to another is no motion.
#[test]
fn jumps_between_solutions_are_not_certified() {
    let robot = catalogue::find("3-rpr").unwrap();
    let model = Planar::new(&robot, &[10.0, 10.0, 1.0, 1.0, 1.0, 1.0]);
    let all = solutions(&model);
    let turns = model.turns(&NEXT);
    for (i, from) in all.iter().enumerate() {
        for (j, to) in all.iter().enumerate() {
            let root = model.newton(&to.pose, &to.inverse, &NEXT, &plain(&turns)).unwrap();
            let stretch = Stretch::moving(&model, from, &root, &NEXT, &turns, &[1e-14; 3]);
            let ball = model.certify::<Ball>(&stretch, &root).is_ok();
            let slope = model.certify::<Slope<Ball, 1>>(&stretch, &root).is_ok();
            assert_eq!((ball, slope), (i == j, i == j), "from {i} to {j}");
        }
    }
}

/// A pose that is off is certified only with a bound that says so.
#[test]
fn a_pose_that_is_off_gets_its_error() {
    let robot = catalogue::find("3-rpr").unwrap();
    let unit = [10.0, 10.0, 1.0];
    let model = Planar::new(&robot, &[10.0, 10.0, 1.0, 1.0, 1.0, 1.0]);
    let turns = model.turns(&NEXT);
    let mut certified = 0;
    for start in solutions(&model) {
        let honest = model.newton(&start.pose, &start.inverse, &NEXT, &plain(&turns)).unwrap();
        for exponent in 3..14 {
            let off = 10f64.powi(-exponent);
            let mut root = Root { pose: honest.pose, inverse: honest.inverse };
            root.pose[0] += off;
            let stretch = Stretch::moving(&model, &start, &root, &NEXT, &turns, &[1e-14; 3]);
            if let Ok(proof) = model.certify::<Ball>(&stretch, &root) {
                certified += 1;
                assert!(proof.end.radius * unit[0] > 0.99 * off, "{off}: {}", proof.end.radius);
            }
        }
    }
    assert!(certified > 20, "{certified}");
}
