//! The sizes that pavings and certificates have in common.

/// A set of classes of aspects, one bit each: bit 2m for mode m and det A > 0, bit 2m + 1 for mode m and det
/// A < 0.
pub type ClassSet = u16;

/// The greatest number of working modes that one paving, or one certificate, describes.
pub const MODES: usize = 8;

/// The greatest number of coordinates that vary in one paving.
pub const AXES: usize = 3;

/// The greatest number of boxes that a paving holds (32 bytes each, so about 1 GiB).
pub const MAX_BOXES: u64 = 40_000_000;
