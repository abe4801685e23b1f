//! Colours that colour-blind readers can tell apart.

use aspecta::aspect::AspectId;
use aspecta::domain::boundary::Face;
use aspecta::kinematics::constraints::Kind;

/// Okabe & Ito's colours (without black), then those of Tol's *muted* scheme that stay distinct from them.
const ASPECTS: [&str; 12] = [
    "#56b4e9", "#e69f00", "#009e73", "#cc79a7", "#0072b2", "#d55e00", "#f0e442", "#882255", "#44aa99",
    "#332288", "#999933", "#ddcc77",
];

/// Undecided cells.
pub const UNDECIDED: &str = "#9b9b9b";

/// Basic regions without a twin: one direct solution in the aspect.
pub const SINGLE: &str = "#e3ddc9";

/// The colour of the background that a figure is not about.
pub const PALE: &str = "#f3f3f3";

/// The colour of the place where a path fails.
pub const OBSTACLE: &str = "#c1121f";

/// The style of lines of the characteristic surface.
pub(super) const CHARACTERISTIC: &str = "fill:none;stroke:#222;stroke-width:0.6;stroke-linejoin:round";

/// Curves and axes.
pub const INK: &str = "#222";

/// The colour of an aspect: neighbours in number differ.
pub fn aspect(id: AspectId) -> &'static str {
    hue(id.number())
}

/// The hue with this number, from 1: neighbours differ.
pub fn hue(number: usize) -> &'static str {
    ASPECTS[number.saturating_sub(1) % ASPECTS.len()]
}

/// A sequence from light to dark for small counts, 1 upward (Tol's *YlOrBr*, and a step beyond).
pub fn count(n: usize) -> &'static str {
    const STEPS: [&str; 8] =
        ["#fee391", "#fec44f", "#fb9a29", "#ec7014", "#cc4c02", "#993404", "#662506", "#331203"];
    STEPS[n.saturating_sub(1).min(STEPS.len() - 1)]
}

/// Shade `k` of `of` (from 0, dark to light) of the hue with this number (from 1).
pub fn shade(number: usize, k: usize, of: usize) -> String {
    let at = if of < 2 { 0.0 } else { k as f64 / (of - 1) as f64 };
    // From a quarter black to two thirds white.
    let (towards, share) =
        if of < 2 || at > 0.25 { (255.0, (at - 0.25).max(0.0) / 0.75 * 0.67) } else { (0.0, 0.25 - at) };
    let [r, g, b] = channels(hue(number)).map(|c| {
        let value = f64::from(c);
        (value + share * (towards - value)).round() as u8
    });
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Red, green and blue of a colour written `#rrggbb`.
pub fn channels(colour: &str) -> [u8; 3] {
    [1, 3, 5].map(|at| u8::from_str_radix(&colour[at..at + 2], 16).unwrap_or_default())
}

/// The colour of a face of an aspect: parallel singularities red, serial ones blue to green, limits yellow to
/// purple.
pub fn face(face: Face) -> &'static str {
    const SERIAL: [&str; 6] = ["#0072b2", "#009e73", "#56b4e9", "#332288", "#44aa99", "#999933"];
    const LIMITS: [&str; 4] = ["#e69f00", "#cc79a7", "#f0e442", "#882255"];
    match face {
        Face::Of(constraint) => match constraint.kind() {
            Kind::Parallel => "#d55e00",
            Kind::Serial(leg) => SERIAL[leg.index() % SERIAL.len()],
            Kind::Limit => LIMITS[constraint.order() % LIMITS.len()],
        },
        Face::Cut { .. } => UNDECIDED,
    }
}
