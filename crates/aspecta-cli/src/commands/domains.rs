//! `aspecta domains`: basic regions and uniqueness domains.

use crate::args::det::DetArg;
use crate::args::drawing::Drawing;
use crate::args::fix::{FixArg, OF_FIX_AND_TABLES};
use crate::args::format::TableArgs;
use crate::args::help::{help, value_name};
use crate::args::making::Making;
use crate::args::mode::ModeArg;
use crate::args::out::OutDir;
use crate::args::threads::{self, Threads};
use crate::failure::{Answer, Failure};
use crate::input;
use crate::output::{self, FORMAT_VERSION, Target, note};
use crate::work::mapping::{Part, Source, Wanted};
use crate::work::watch::watched;
use aspecta::aspect::{Analysis, AspectId, Count};
use aspecta::domain::characteristic::GivenUp;
use aspecta::domain::{DomainError, Domains as Found, Map, MappedAspect, Surfaces};
use aspecta::paving::Stop;
use aspecta::robot::Robot;
use aspecta::text::{DomainsAdvice, DomainsSummary};
use aspecta_view::words::count;
use aspecta_view::{Cut, write_domains};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Arguments of `domains`.
#[derive(Args)]
#[command(mut_args(help("out", OUT)))]
#[command(mut_args(help("fix", FIX)))]
#[command(mut_args(help(
    "json",
    "Print the whole result as JSON, and nothing else, on stdout (angles in radians)"
)))]
#[command(mut_args(help("deg", OF_FIX_AND_TABLES)))]
#[command(mut_args(help(
    "mode",
    "Only aspects of this working mode, such as `+-+`: only that mode is analysed, unless --save or --aspect asks for the numbers that all aspects have"
)))]
#[command(mut_args(value_name("mode", "SIGNS")))]
#[command(mut_args(help("det", "Only aspects with this sign of det A")))]
#[command(mut_args(help("threads", threads::OF_NO_WEIGHT)))]
pub struct Domains {
    /// Name from `aspecta robots`, path of a robot file, or a file written by --save: then nothing is
    /// computed
    robot: String,
    #[command(flatten)]
    mode: ModeArg,
    #[command(flatten)]
    det: DetArg,
    /// Only the aspect with this number, as `aspecta analyze` with the same budget (and --fix, and with that
    /// --mode) numbers them
    #[arg(long, value_name = "ID")]
    aspect: Option<usize>,
    #[command(flatten)]
    fix: FixArg,
    #[command(flatten)]
    making: Making,
    #[command(flatten)]
    shown: TableArgs,
    /// Write all of it into this file, for `aspecta locate` and for `aspecta domains` to print and draw again
    #[arg(long, value_name = "FILE")]
    save: Option<PathBuf>,
    #[command(flatten)]
    out: OutDir,
    #[command(flatten)]
    drawing: Drawing,
    #[command(flatten)]
    threads: Threads,
}

/// The output of `--json`.
#[derive(Serialize)]
struct Output<'a> {
    format_version: u32,
    robot: &'a Robot,
    /// Names and values of the coordinates that are held.
    fixed: Vec<(&'a str, f64)>,
    aspects: Count,
    domains: Vec<&'a Found>,
}

const FIX: &str = "\
    Hold a coordinate at a value and cut that slice: x=-4, phi=0.5 (radians) or phi=30deg; again, or \
    separated by commas, for several. Solutions are counted wherever they are, in the whole class of \
    the aspect (working mode and sign of det A). Robots with 6 coordinates \
    have 3 free ones at most";

const OUT: &str = "\
    Write pictures into this directory: basic regions, the largest uniqueness domain, basic \
    components and the sheets over joint space; for robots with 3 coordinates also the boundary and \
    the characteristic surface as meshes. On slices the first two only, of 2 or 3 free coordinates";

/// Where the rows are that the tables leave out, and what makes more cells.
const ADVICE: DomainsAdvice = DomainsAdvice { on_rows: " (--json lists all)", cells: "--cells" };

impl Domains {
    pub fn run(&self, out: &mut dyn Write) -> Result<Answer, Failure> {
        let source = Source::new(&self.robot)?;
        let wanted = self.wanted(source.robot())?;
        let part = self.part(source.robot(), wanted)?;
        if self.out.directory().is_some() && part.free(source.robot()) < 2 {
            return Err(Failure::Input(
                "--out: there are pictures of two or three free coordinates: free one more, or leave it out for the tables".into(),
            ));
        }
        self.out.check()?;
        let save = self.save.as_deref().map(target).transpose()?;
        let with_surfaces = self.out.directory().is_some() || self.save.is_some();
        let (map, stop) = watched(self.threads, |control| {
            source.map(&self.making, part, with_surfaces, control, |analysis| self.ids(analysis, wanted))
        })??;
        let cancelled = stop == Some(Stop::Cancelled);
        if cancelled {
            note("stopped, or the time was over: this is the result so far");
        }
        let is_wanted = |sheet: &&MappedAspect| {
            let Found { mode, det_a, aspect, .. } = sheet.domains;
            wanted.is(mode, det_a, aspect)
        };
        let sheets: Vec<&MappedAspect> = map.sheets.iter().filter(is_wanted).collect();
        self.print(out, &map, &sheets)?;
        if let Some(target) = save {
            let file = map.to_bytes().map_err(|e| Failure::Input(format!("--save: {e}")))?;
            self.written(out, &target.write(file)?)?;
        }
        if let Some(directory) = self.out.directory() {
            self.draw(out, &map, &sheets, directory)?;
        }
        let sound = sheets.iter().all(|sheet| sheet.domains.violations.is_empty());
        Ok(Answer::from(!sheets.is_empty() && sound && !cancelled))
    }

    fn wanted(&self, robot: &Robot) -> Result<Wanted, Failure> {
        let mode = self.mode.of(robot)?;
        let det_a = self.det.sign();
        Ok(Wanted { mode, det_a, aspect: self.aspect.map(AspectId::new) })
    }

    /// The slice, if one is asked for.
    fn part(&self, robot: &Robot, wanted: Wanted) -> Result<Part, Failure> {
        let fix = self.fix.coordinates(robot, self.shown.deg)?;
        if !fix.is_empty() && self.save.is_some() {
            return Err(Failure::Input(
                "--save keeps maps of whole workspaces: leave out --fix, or take --json".into(),
            ));
        }
        // In maps, and where one is named by its number, aspects are numbered as `analyze` numbers those of all modes; on a slice, within
        // what is analysed.
        let are_numbered = fix.is_empty() && (self.save.is_some() || self.aspect.is_some());
        let modes = if are_numbered { Vec::new() } else { wanted.mode.into_iter().collect() };
        Ok(Part { fix, modes })
    }

    /// The aspects that are wanted, of those that were found.
    fn ids(&self, analysis: &Analysis, wanted: Wanted) -> Result<Vec<AspectId>, Failure> {
        if let Some(id) = wanted.aspect
            && analysis.aspect(id).is_none()
        {
            return Err(DomainError::NoAspect { id, count: analysis.aspects.low }.into());
        }
        let of_class = |class: &aspecta::aspect::AspectClass| {
            let (mode, det_a) = (class.mode, class.det_a);
            let ids: Vec<AspectId> = class.aspects.iter().map(|aspect| aspect.id).collect();
            ids.into_iter().filter(move |id| wanted.is(mode, det_a, *id))
        };
        Ok(analysis.classes.iter().flat_map(of_class).collect())
    }

    fn print(&self, out: &mut dyn Write, map: &Map, sheets: &[&MappedAspect]) -> Result<(), Failure> {
        if self.shown.json() {
            let domains = sheets.iter().map(|sheet| &sheet.domains).collect();
            let (robot, aspects) = (&map.robot, map.aspects);
            let fixed = map.window.held().map(|(k, x)| (robot.platform.coordinates()[k].name, x)).collect();
            return output::json(
                out,
                &Output { format_version: FORMAT_VERSION, robot, fixed, aspects, domains },
            );
        }
        for (k, sheet) in sheets.iter().enumerate() {
            if k > 0 {
                writeln!(out)?;
            }
            write!(
                out,
                "{}",
                DomainsSummary { domains: &sheet.domains, degrees: self.shown.deg, advice: ADVICE }
            )?;
        }
        if sheets.is_empty() {
            let found: usize = map.classes.iter().map(|class| class.aspects.len()).sum();
            match found {
                0 => writeln!(out, "no aspect was found")?,
                _ => writeln!(
                    out,
                    "{}, but not what is asked for, or it is not cut into regions",
                    count(found, "aspect was found", "aspects were found")
                )?,
            }
        }
        Ok(())
    }

    fn draw(
        &self,
        out: &mut dyn Write,
        map: &Map,
        sheets: &[&MappedAspect],
        directory: &Path,
    ) -> Result<(), Failure> {
        for MappedAspect { domains, surfaces } in sheets {
            let Some(Surfaces { boundary, characteristic, given_up }) = surfaces else {
                note(&format!("aspect {}: the file holds no surfaces to draw", domains.aspect));
                continue;
            };
            incomplete(domains.aspect, *given_up);
            let cut = Cut { map, domains, boundary, surface: characteristic };
            let choice = self.drawing.choice();
            for path in write_domains(&cut, &choice, directory).map_err(Failure::in_directory(directory))? {
                self.written(out, &path)?;
            }
        }
        Ok(())
    }

    /// Says that a file is there: with --json not on stdout.
    fn written(&self, out: &mut dyn Write, path: &Path) -> Result<(), Failure> {
        self.shown.format().say(out, &format!("written: {}", path.display()))
    }
}

/// Returns the file that the map goes to: a new one, or another map that it replaces.
fn target(path: &Path) -> Result<Target, Failure> {
    if path.is_file() && !input::is_map(path) {
        let path = path.display();
        return Err(Failure::Input(format!(
            "--save {path}: the file is there and is no map: give another name"
        )));
    }
    Target::new("--save", path)
}

/// Says what of a characteristic surface is missing in the files.
fn incomplete(aspect: AspectId, given_up: GivenUp) {
    let GivenUp { rim, unclear, unsolved, unlocated } = given_up;
    let gaps = [
        (rim, "piece", "pieces", "of the boundary not followed at its rim"),
        (unclear, "piece", "pieces", "of the boundary not followed elsewhere"),
        (unsolved, "point", "points", "without direct solutions"),
        (unlocated, "solution", "solutions", "in no known aspect"),
    ];
    let there = gaps.iter().filter(|gap| gap.0 > 0);
    let named: Vec<_> =
        there.map(|&(n, one, many, which)| format!("{} {which}", count(n, one, many))).collect();
    if !named.is_empty() {
        note(&format!("the characteristic surface of aspect {aspect} has gaps: {}", named.join(", ")));
    }
}
