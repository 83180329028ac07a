//! Numbers: random streams, warps, colours, polygon integrals and statistics. Nothing here knows of a scene.

pub mod bounds;
pub mod box_tree;
pub mod polygon;
pub mod random;
pub mod rgb;
pub mod sparse;
pub mod spherical_triangle;
pub mod stats;
pub mod warp;
