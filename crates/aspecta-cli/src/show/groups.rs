//! Groups of aspects that changes of working mode join.

/// The message about a group whose aspects are not all proved to be one.
pub const AS_FAR: &str = "crossings certified, but not that each aspect is one in boxes as fine as these";
