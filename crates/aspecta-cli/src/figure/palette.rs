//! Colours that colour-blind readers can tell apart.

/// Okabe & Ito's colours (without black), then those of Tol's *muted* scheme that stay distinct from them.
const ASPECTS: [&str; 12] = [
    "#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#0072b2", "#d55e00", "#f0e442", "#882255", "#44aa99",
    "#332288", "#999933", "#ddcc77",
];

/// Undecided cells.
pub const UNDECIDED: &str = "#9b9b9b";

/// Where a path fails.
pub const OBSTACLE: &str = "#c1121f";

/// Curves and axes.
pub const INK: &str = "#222";

/// The colour of the aspect with this number (from 1): neighbours in number differ.
pub fn aspect(id: usize) -> &'static str {
    ASPECTS[id.saturating_sub(1) % ASPECTS.len()]
}

/// A sequence from light to dark for small counts, 1 upward (Tol's *YlOrBr*, and a step beyond).
pub fn count(n: usize) -> &'static str {
    const STEPS: [&str; 8] =
        ["#fee391", "#fec44f", "#fb9a29", "#ec7014", "#cc4c02", "#993404", "#662506", "#331203"];
    STEPS[n.saturating_sub(1).min(STEPS.len() - 1)]
}
