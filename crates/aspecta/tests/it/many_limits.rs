//! Robots with more limits than a robot file can give them.

use aspecta::aspect::{Options, analyze};
use aspecta::certificate::Claim;
use aspecta::paving::{Budget, Control, Stop};
use aspecta::robot::catalogue;
use aspecta::verify::verify;

/// Where more functions bound the aspects than are compared over a box (64), nothing is proved that rests on
/// comparing them: what is found stays, and has no upper bound.
#[test]
fn more_constraints_than_are_compared_prove_no_upper_bound() {
    let robot = catalogue::find("2-prr").unwrap();
    let mut crowded = robot.clone();
    crowded.legs[0].limits = vec![robot.legs[0].limits[0]; 70];
    let budget = Budget { depth: Some(7), ..Budget::default() };
    let options =
        Options { budget, modes: vec!["++".parse().unwrap()], certificate: true, ..Options::default() };
    let [few, many] =
        [&robot, &crowded].map(|robot| analyze(robot, &options, &Control::unwatched()).unwrap());
    assert!(few.aspects.certified, "{:?}", few.aspects);
    assert_eq!((many.aspects.low, many.aspects.high), (few.aspects.low, None));
    assert_eq!(many.run.stop, Stop::Resolution);
    let verdict = verify(&many.certificate.unwrap(), &Control::unwatched());
    assert!(verdict.is_verified(), "{:?}", verdict.faults);
    let bounds = |claim: &Claim| (claim.low, claim.high);
    assert!(verdict.classes.iter().any(|class| bounds(&class.proved).1.is_none()));
}
