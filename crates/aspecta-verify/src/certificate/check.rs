//! Whether the parts of a certificate fit together, so that whoever reads on need not look out for nonsense.

use super::{Certificate, TreeError};
use aspecta_robot::AXES;
use aspecta_robot::chart::{Chain, Chart, Fold};
use aspecta_robot::{
    Leg, LegIndex, Platform, Robot, Unsound as Part, Window, holds, sane, takes, usable, wanted,
};

/// Parts that do not fit together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unsound {
    /// A part of it, or the robot, makes no sense by itself.
    #[error(transparent)]
    Part(#[from] Part),
    /// A bound beyond all that leaves can prove.
    #[error(
        "the claim of class {class} counts {claimed} aspects, more than there are leaves ({leaves}) to prove them"
    )]
    Claim {
        /// The class.
        class: usize,
        /// Aspects claimed.
        claimed: usize,
        /// Leaves of all sheets.
        leaves: usize,
    },
    /// A scale far beyond what it is to be the mean magnitude of.
    #[error(
        "{key} = {value:e}: a scale is the mean magnitude of a function that bounds the aspects, and this function is far smaller wherever \
         the robot is: positive numbers up to {most:e} are allowed"
    )]
    Scale {
        /// The key.
        key: String,
        /// Its value.
        value: f64,
        /// The most that is allowed.
        most: f64,
    },
    /// Text that is not the encoding of a tree.
    #[error("sheet {sheet}: {error}")]
    Tree {
        /// The sheet.
        sheet: usize,
        /// Why.
        error: TreeError,
    },
}

impl Certificate {
    pub(super) fn check(&self) -> Result<(), Unsound> {
        self.robot.check()?;
        let n = self.robot.dof();
        self.check_window(n)?;
        self.check_modes(n)?;
        self.check_scale(n)?;
        self.check_sizes()?;
        let classes = 2 * self.modes.len();
        wanted("claims", self.claims.len(), classes)?;
        self.check_sheets(classes)?;
        self.check_claims()?;
        let class = |index: usize| {
            if index < classes { Ok(()) } else { Err(Part::Index { what: "class", index }) }
        };
        let point = |point: &Vec<f64>| {
            wanted("coordinates of a point", point.len(), n)?;
            holds(point.iter().all(|x| usable(*x)), "a point has a coordinate beyond ±1e7")
        };
        for join in &self.joins {
            class(join.class)?;
            if join.sheet >= self.sheets.len() {
                return Err(Part::Index { what: "sheet of a join", index: join.sheet }.into());
            }
            holds(join.path.len() >= 2, "a path has fewer than two poses")?;
            join.path.iter().try_for_each(point)?;
        }
        for seam in &self.seams {
            class(seam.class)?;
            point(&seam.point)?;
            if seam.sheet == 0 || seam.sheet >= self.sheets.len() {
                return Err(Part::Index { what: "sheet of a seam", index: seam.sheet }.into());
            }
        }
        Ok(())
    }

    fn check_window(&self, n: usize) -> Result<(), Part> {
        let window = &self.window;
        for (what, found) in [
            ("window.ranges", window.ranges.len()),
            ("window.glued", window.glued.len()),
            ("window.angles", window.angles.len()),
            ("window.cut", window.cut.len()),
        ] {
            wanted(what, found, n)?;
        }
        let ranges = || window.ranges.iter();
        holds(
            ranges().all(|r| usable(r.0) && usable(r.1) && r.0 <= r.1),
            "a range of the window is empty or beyond ±1e7",
        )?;
        holds(
            ranges().any(|r| r.0 < r.1),
            "all coordinates of the window are held: there is nothing to analyse",
        )?;
        holds(
            ranges().filter(|r| r.0 < r.1).count() <= AXES,
            "more than three coordinates of the window vary",
        )
    }

    fn check_modes(&self, n: usize) -> Result<(), Part> {
        let modes = &self.modes;
        holds((1..=8).contains(&modes.len()), "there are 1 to 8 working modes in a certificate")?;
        modes.iter().try_for_each(|mode| wanted("signs of a mode", mode.legs(), n))?;
        holds((1..modes.len()).all(|m| !modes[..m].contains(&modes[m])), "a working mode is listed twice")?;
        let strut = |j: usize| self.robot.legs[j].actuator.postures() == 1;
        holds(
            modes.iter().all(|mode| (0..n).all(|j| !strut(j) || mode.sign(j) < 0)),
            "a strut has the sign + in a working mode",
        )
    }

    fn check_scale(&self, n: usize) -> Result<(), Part> {
        let scale = &self.scale;
        wanted("scale.reach", scale.reach.len(), n)?;
        wanted("scale.limits", scale.limits.len(), n)?;
        wanted("scale.rod_angles", scale.rod_angles.len(), self.robot.rod_angles.len())?;
        wanted("scale.pairs", scale.pairs.len(), self.robot.pairs.len())?;
        for (leg, scales) in self.robot.legs.iter().zip(&scale.limits) {
            wanted("scale.limits of a leg", scales.len(), leg.limits.len())?;
        }
        let limits = scale.limits.iter().flatten().chain(&scale.rod_angles).chain(&scale.pairs);
        let mut all = limits.chain(&scale.reach).chain([&scale.det]);
        holds(
            all.all(|x| x.is_normal() && *x > 0.0),
            "a scale is not a positive number: P would not vanish at the boundary",
        )
    }

    fn check_sheets(&self, classes: usize) -> Result<(), Unsound> {
        let axes = self.window.ranges.iter().filter(|r| r.0 < r.1).count();
        holds(
            self.sheets.first().is_some_and(|sheet| sheet.chart == Chart::Pose),
            "sheet 0 is missing, or not in pose coordinates",
        )?;
        for (k, sheet) in self.sheets.iter().enumerate() {
            match &sheet.chart {
                Chart::Pose => holds(k == 0, "there is more than one sheet in pose coordinates")?,
                Chart::Fold(fold) => check_fold(&self.robot, fold)?,
                Chart::Chain(chain) => check_chain(&self.robot, &self.window, chain, k)?,
            }
            sheet.tree.check(axes, classes).map_err(|error| Unsound::Tree { sheet: k, error })?;
        }
        Ok(())
    }

    /// Bounds that could be proved count distinct leaves. Greater ones say nothing, and their sums could
    /// overflow.
    fn check_claims(&self) -> Result<(), Unsound> {
        let leaves = self.leaves().count();
        for (class, claim) in self.claims.iter().enumerate() {
            let claimed = claim.low.max(claim.high.unwrap_or(0));
            if claimed > leaves {
                return Err(Unsound::Claim { class, claimed, leaves });
            }
        }
        Ok(())
    }
}

/// The leg in whose own coordinates a sheet is.
fn leg_of<'a>(robot: &'a Robot, leg: LegIndex, what: &'static str) -> Result<&'a Leg, Part> {
    robot.legs.get(leg.index()).ok_or(Part::Index { what, index: leg.index() })
}

fn check_fold(robot: &Robot, fold: &Fold) -> Result<(), Part> {
    let leg = leg_of(robot, fold.leg, "leg of a fold")?;
    holds(takes(&leg.actuator).elbow, "the leg of a fold has no crank")?;
    holds(
        matches!(robot.platform, Platform::PlanePoint | Platform::PlaneBody | Platform::TranslatingBody),
        "a fold has a platform that cannot be moved to it without turning",
    )?;
    holds(fold.half_width > 0.0 && fold.half_width < 1.0, "the half-width of a fold is not in (0, 1)")?;
    let axial = match fold.axial {
        None => robot.platform.space() == 2,
        Some((lo, hi)) => robot.platform.space() == 3 && -1.0 <= lo && lo < hi && hi <= 1.0,
    };
    holds(axial, "the axial range of a fold is not one, or one too many in the plane")?;
    holds(
        sane(&fold.crank) && sane(&fold.rod),
        "a length of a fold is not finite, beyond ±1e7, or an empty range",
    )
}

fn check_chain(robot: &Robot, window: &Window, chain: &Chain, sheet: usize) -> Result<(), Part> {
    let leg = leg_of(robot, chain.leg, "leg of a chain")?;
    holds(
        robot.platform == Platform::TurningBody && takes(&leg.actuator).on_sphere,
        "a chain is that of a platform that does not turn about a point, or of a leg that is not spherical",
    )?;
    let whole = window.ranges.len() == 3 && window.cut.iter().all(|cut| *cut == (false, false));
    holds(
        whole && window.held().next().is_none(),
        "a chain holds all orientations, but the window cuts or holds some",
    )?;
    holds(
        chain.bend.is_none() == (sheet == 1),
        "sheet 1 is that of a chain which holds all configurations, and later ones are those of bends",
    )?;
    let width = chain.bend.as_ref().map_or(0.5, |bend| bend.half_width);
    holds(width > 0.0 && width < 1.0, "the half-width of a bend is not in (0, 1)")
}
