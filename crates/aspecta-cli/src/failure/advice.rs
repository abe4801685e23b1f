//! Which command or option helps, said after messages of the library, which knows of none.

use aspecta::aspect::AnalysisError;
use aspecta::domain::MapError;
use aspecta::kinematics::start::NoStart;
use aspecta::motion::PathError;
use aspecta::motion::explore::ExploreError;
use aspecta::motion::follow::StartError;

/// What to do about a robot, or a slice of it, that is not analysed.
pub fn on_analysis(error: &AnalysisError) -> String {
    match error {
        AnalysisError::Dimension { hold, .. } => format!(", for instance with `--fix {hold}`"),
        AnalysisError::Certificate { .. } => " with `--mode`".into(),
        _ => String::new(),
    }
}

/// What to do about a robot that is not explored.
pub fn on_exploring(error: &ExploreError) -> &'static str {
    if matches!(error, ExploreError::NotFree { .. }) { " (`aspecta analyze`)" } else { "" }
}

/// What to do about a pose and a joint vector that following does not start with.
pub fn on_start(error: &StartError) -> &'static str {
    match error {
        StartError::NoSolution => "; look at both with `aspecta state`, and at all poses with `aspecta fk`",
        _ => "",
    }
}

/// What to do where no configuration to start from is found.
pub fn on_no_start(error: &NoStart) -> &'static str {
    match error {
        NoStart::Unbounded(_) | NoStart::NotFound { .. } => " with --pose",
        _ => "",
    }
}

/// What to do about the start of a path.
pub fn on_path(error: &PathError) -> &'static str {
    if let PathError::Start(error) = error { on_start(error) } else { "" }
}

/// Why a file is no map, and what writes one.
pub fn of_map(error: &MapError) -> String {
    match error {
        MapError::Damaged(why) => format!("damaged, or not written by `aspecta domains --save`: {why}"),
        MapError::Version { .. } => format!("{error} with `aspecta domains --save`"),
        _ => error.to_string(),
    }
}
