//! `aspecta domains`: basic regions and uniqueness domains.

use super::drawing::Drawing;
use super::queries::Labels;
use super::{budget, watch};
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, Align, FORMAT_VERSION, Table, brief, note};
use aspecta::aspect::{Analysis, Count, DetSign, Options, analyze};
use aspecta::domain::boundary::Boundary;
use aspecta::domain::characteristic::{Characteristic, GivenUp};
use aspecta::domain::{DomainError, DomainOptions, Domains as Found, domains};
use aspecta::paving::{Budget, Stop};
use aspecta::robot::Robot;
use aspecta_cli::figure::regions::Cut;
use aspecta_cli::{domains as figures, file};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;

/// Arguments of `domains`.
#[derive(Args)]
pub struct Domains {
    /// Name from `aspecta robots`, or path of a robot file
    robot: String,
    /// Only aspects of this working mode, such as `+-+`
    #[arg(long, value_name = "SIGNS", allow_hyphen_values = true)]
    mode: Option<String>,
    /// Only aspects with this sign of det A
    #[arg(long, value_name = "SIGN", allow_hyphen_values = true)]
    det: Option<Sign>,
    /// Only the aspect with this number, as `aspecta analyze` with the same budget numbers them
    #[arg(long, value_name = "ID")]
    aspect: Option<usize>,
    /// How fine: cells are 1/N of the workspace's width in each coordinate [default: 500 for 2 coordinates, 100 for 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=2000))]
    cells: Option<u16>,
    /// Print the whole result as JSON, and nothing else, on stdout (angles in radians)
    #[arg(long)]
    json: bool,
    /// Write pictures into this directory: basic regions, the largest uniqueness domain, basic components and the sheets over joint
    /// space; for robots with 3 coordinates also the boundary and the characteristic surface as meshes
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    drawing: Drawing,
    /// When to stop telling the aspects apart, as for `analyze` [default: depth=11 for 2 coordinates, depth=7 for 3]
    #[arg(long, value_parser = budget::parse, allow_hyphen_values = true)]
    budget: Option<Budget>,
    /// Number of threads [default: all cores]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

/// A sign of det A.
#[derive(Clone, Copy, ValueEnum)]
enum Sign {
    #[value(name = "+")]
    Plus,
    #[value(name = "-")]
    Minus,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Output<'a> {
    format_version: u32,
    robot: &'a Robot,
    aspects: Count,
    domains: &'a [Found],
}

impl Domains {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let robot = input::robot(&self.robot)?;
        let mode = self.mode.as_deref().map(|mode| input::mode(&robot, mode)).transpose()?;
        let det = self.det.map(|sign| match sign {
            Sign::Plus => DetSign::Positive,
            Sign::Minus => DetSign::Negative,
        });
        if let Some(directory) = &self.out {
            file::writable(directory).map_err(Failure::in_directory(directory))?;
        }
        let in_plane = robot.dof() == 2;
        let coarse = Budget { depth: Some(if in_plane { 11 } else { 7 }), ..Budget::default() };
        let options = Options { budget: self.budget.unwrap_or(coarse), ..Options::default() };
        let usual = DomainOptions::default();
        let cells = self.cells.map_or(if in_plane { 5 * usual.cells } else { usual.cells }, usize::from);
        let (analysis, found, surfaces) = watch::watched(self.threads, |control| {
            let analysis = analyze(&robot, &options, control)?;
            let wanted = self.wanted(&analysis, mode, det)?;
            let of = |id: &usize| domains(&analysis, *id, DomainOptions { cells, ..usual }, control);
            let found = wanted.iter().map(of).collect::<Result<Vec<Found>, DomainError>>()?;
            let drawn = wanted.iter().filter(|_| self.out.is_some());
            let surfaces =
                drawn.map(|id| surfaces(&analysis, *id, cells)).collect::<Result<Vec<_>, Failure>>()?;
            Ok::<_, Failure>((analysis, found, surfaces))
        })??;
        if analysis.run.stop == Stop::Cancelled {
            note("cancelled: this is the result so far");
        }
        if self.json {
            let (aspects, domains) = (analysis.aspects, found.as_slice());
            output::json(
                out,
                &Output { format_version: FORMAT_VERSION, robot: &analysis.robot, aspects, domains },
            )?;
        } else {
            for domains in &found {
                print(out, &robot, domains)?;
            }
            if found.is_empty() {
                writeln!(out, "no aspect was found there")?;
            }
        }
        if let Some(directory) = &self.out {
            for (domains, (boundary, surface)) in found.iter().zip(&surfaces) {
                incomplete(surface);
                let cut = Cut { analysis: &analysis, domains, boundary, surface };
                let choice = self.drawing.choice();
                for path in
                    figures::write(&cut, &choice, directory).map_err(Failure::in_directory(directory))?
                {
                    let written = path.display();
                    if self.json {
                        note(&format!("written: {written}"))
                    } else {
                        writeln!(out, "written: {written}")?
                    }
                }
            }
        }
        let sound = found.iter().all(|d| d.violations.is_empty());
        Ok(Answer::from(!found.is_empty() && sound))
    }

    fn wanted(
        &self,
        analysis: &Analysis,
        mode: Option<aspecta::kinematics::WorkingMode>,
        det: Option<DetSign>,
    ) -> Result<Vec<usize>, Failure> {
        if let Some(id) = self.aspect
            && analysis.aspect(id).is_none()
        {
            return Err(DomainError::NoAspect { id, count: analysis.aspects.low }.into());
        }
        let classes = analysis
            .classes
            .iter()
            .filter(|c| mode.is_none_or(|mode| c.mode == mode) && det.is_none_or(|det| c.det_a == det));
        let ids = classes.flat_map(|c| c.aspects.iter().map(|a| a.id));
        Ok(ids.filter(|id| self.aspect.is_none_or(|wanted| *id == wanted)).collect())
    }
}

/// Says what of a characteristic surface is missing in the files.
fn incomplete(surface: &Characteristic) {
    let GivenUp { rim, unclear, unsolved, unlocated } = surface.given_up;
    if rim + unclear + unsolved + unlocated > 0 {
        note(&format!(
            "the characteristic surface of aspect {} has gaps: {rim} pieces of the boundary at its rim and {unclear} others are \
             not followed, {unsolved} points have no direct solutions, {unlocated} solutions are in no known aspect",
            surface.aspect
        ));
    }
}

/// The boundary of an aspect and its characteristic surface, about as fine as the regions: within what [`Boundary::new`] takes.
fn surfaces(analysis: &Analysis, id: usize, cells: usize) -> Result<(Boundary, Characteristic), Failure> {
    let cells = cells.clamp(4, if analysis.robot.dof() == 2 { 2000 } else { 300 });
    let boundary = Boundary::new(analysis, id, cells).map_err(|e| Failure::Input(e.to_string()))?;
    let surface = Characteristic::new(analysis, &boundary).map_err(|e| Failure::Input(e.to_string()))?;
    Ok((boundary, surface))
}

impl From<DomainError> for Failure {
    fn from(error: DomainError) -> Self {
        Self::Input(error.to_string())
    }
}

fn print(out: &mut dyn Write, robot: &Robot, found: &Found) -> Result<(), Failure> {
    let Found { aspect, mode, det_a, unit, .. } = found;
    writeln!(
        out,
        "aspect {aspect} (mode {mode}, det A {det_a}): {} {} {}, numerical, in cells of {}",
        unit.name,
        brief(found.measure),
        unit.unit,
        found.cell.iter().map(|w| brief(*w)).collect::<Vec<_>>().join(" x ")
    )?;
    regions(out, robot, found)?;
    uniqueness(out, found)?;
    checks(out, robot, found)?;
    Ok(writeln!(out)?)
}

fn right(name: &str) -> (String, Align) {
    (name.to_owned(), Align::Right)
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn regions(out: &mut dyn Write, robot: &Robot, found: &Found) -> Result<(), Failure> {
    let (pose, unit) = (Labels::pose(robot, false), &found.unit);
    writeln!(out, "\nBasic regions (Def. 10)")?;
    let vector = pose.headings().map(|name| (name, Align::Right));
    let names = [right("region"), right(unit.name), right("solutions")];
    let mut table =
        Table::new(names.into_iter().chain(vector).chain([("image meets that of".into(), Align::Left)]));
    for region in found.regions.iter().take(LISTED) {
        let first = [region.number.to_string(), brief(region.measure), region.solutions.to_string()];
        let meets = found.coincidences.iter().filter_map(|c| match c.regions {
            (a, b) if a == region.number => Some(b.to_string()),
            (a, b) if b == region.number => Some(a.to_string()),
            _ => None,
        });
        let meets = meets.take(8).collect::<Vec<_>>().join(" ");
        table.row(first.into_iter().chain(region.pose.iter().map(|x| brief(*x))).chain([meets]));
    }
    write!(out, "{table}")?;
    more(out, found.regions.len())?;
    if found.unresolved.parts > 0 {
        let (parts, share) = (found.unresolved.parts, 100.0 * found.unresolved.measure / found.measure);
        writeln!(
            out,
            "  not resolved: {parts} parts thinner than two cells, {share:.3} % of the {}; --cells makes them fewer",
            unit.name
        )?;
    }
    Ok(())
}

fn uniqueness(out: &mut dyn Write, found: &Found) -> Result<(), Failure> {
    writeln!(out, "\nUniqueness domains (Theorem 3)")?;
    let names = [
        right(found.unit.name),
        right("of the aspect"),
        right("of the workspace"),
        ("regions".into(), Align::Left),
    ];
    let mut table = Table::new(names);
    for domain in found.uniqueness.iter().take(LISTED) {
        let of_workspace = domain.of_workspace.map_or(String::new(), percent);
        let listed = domain.regions.iter().take(12).map(usize::to_string).collect::<Vec<_>>().join(" ");
        let dots = if domain.regions.len() > 12 { " …" } else { "" };
        table.row([
            brief(domain.measure),
            percent(domain.of_aspect),
            of_workspace,
            format!("{listed}{dots}"),
        ]);
    }
    write!(out, "{table}")?;
    more(out, found.uniqueness.len())?;
    if !found.complete {
        writeln!(out, "  there may be more: the search for sets of regions was cut short")?;
    }
    Ok(())
}

/// What was checked, and where it does not hold.
fn checks(out: &mut dyn Write, robot: &Robot, found: &Found) -> Result<(), Failure> {
    let (pose, agreement) = (Labels::pose(robot, false), &found.agreement);
    writeln!(
        out,
        "\nchecked: {} of {} random poses away from the surfaces have as many direct solutions as their region",
        agreement.agree, agreement.away
    )?;
    for c in found.coincidences.iter().filter(|c| c.shares.0.min(c.shares.1) < WHOLE).take(LISTED) {
        let ((a, b), (in_b, in_a)) = (c.regions, c.shares);
        writeln!(
            out,
            "images of regions {a} and {b} meet in part ({}, {}): more --cells would tell regions apart or show them whole",
            percent(in_b),
            percent(in_a)
        )?;
    }
    for violation in found.violations.iter().take(LISTED) {
        let [a, b] = &violation.poses;
        writeln!(
            out,
            "Theorem 2 does not hold on region {}: {} and {} have the same joint vector",
            violation.region,
            pose.brief(a),
            pose.brief(b)
        )?;
    }
    if found.failed > 0 {
        writeln!(out, "at {} nodes the direct model failed: counted as one solution", found.failed)?;
    }
    Ok(())
}

/// Images that coincide to this share are said to coincide: the rest is as much as a grid errs near surfaces.
const WHOLE: f64 = 0.95;

/// Rows shown; the rest is in the JSON.
const LISTED: usize = 20;

fn more(out: &mut dyn Write, rows: usize) -> Result<(), Failure> {
    if rows > LISTED {
        writeln!(out, "  … and {} more (--json lists all)", rows - LISTED)?;
    }
    Ok(())
}
