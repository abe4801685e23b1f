//! Numbers of aspects, and places of classes, in an analysis.

use crate::id::id;

id! {
    /// The number of an aspect in its analysis, from 1 in the order of [`Analysis::classes`](super::Analysis::classes),
    /// in a class the largest first: [`Aspect::id`](super::Aspect::id).
    ///
    /// Another analysis, of other modes or with finer boxes, may number the same aspects otherwise. What is looked up
    /// by a number that no aspect has is `None`, or an error.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{AspectId, Budget, Control, Options, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(6), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let first = AspectId::new(1);
    /// let (_, aspect) = analysis.aspect(first).expect("there is one");
    /// assert_eq!((aspect.id, first.number(), first.to_string().as_str()), (first, 1, "1"));
    /// assert!(analysis.aspect(AspectId::new(99)).is_none());
    /// # Ok(())
    /// # }
    /// ```
    AspectId, number
}

id! {
    /// The index of a class (a working mode and a sign of det A) in [`Analysis::classes`](super::Analysis::classes), from 0.
    ///
    /// # Examples
    /// ```
    /// use aspecta::{Budget, ClassId, Control, DetSign, Options, Robot, analyze};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(6), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let class = analysis.class_of("++".parse()?, DetSign::Negative).expect("analysed");
    /// assert_eq!(class, ClassId::new(1)); // mode by mode, + before −
    /// assert_eq!(analysis.classes[class.index()].det_a, DetSign::Negative);
    /// # Ok(())
    /// # }
    /// ```
    ClassId, index
}
