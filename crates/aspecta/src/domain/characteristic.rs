//! Characteristic surfaces (Definition 9).
