//! Geometry that a tree cannot split.
