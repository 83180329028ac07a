//! Shapes and oracles that several tests share.

pub mod shapes;
