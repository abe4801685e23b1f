//! Numbers of basic regions.

use crate::id::id;

id! {
    /// The number of a basic region in its [`Domains`](super::Domains), from 1, the largest first:
    /// [`BasicRegion::number`](super::BasicRegion::number).
    ///
    /// # Examples
    /// ```
    /// use aspecta::{AspectId, Budget, Control, DomainOptions, Options, RegionId, Robot, analyze, domains};
    ///
    /// # fn main() -> Result<(), aspecta::Error> {
    /// let robot = Robot::resolve("five-bar")?;
    /// let budget = Budget { depth: Some(7), ..Budget::default() };
    /// let modes = vec!["++".parse()?];
    /// let options = Options { budget, modes, ..Options::default() };
    /// let analysis = analyze(&robot, &options, &Control::unwatched())?;
    ///
    /// let options = DomainOptions { cells: 20, samples: 100 };
    /// let found = domains(&analysis, AspectId::new(1), &options, &Control::unwatched())?;
    /// let largest = &found.regions[0];
    /// assert_eq!(largest.number, RegionId::new(1));
    /// assert_eq!(found.region_at(&analysis, &largest.pose), Some(largest.number));
    /// # Ok(())
    /// # }
    /// ```
    RegionId, number
}
