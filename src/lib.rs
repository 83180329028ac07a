pub mod cancel;
pub mod math;
pub mod mesh;
pub mod methods;
pub mod scene;
pub mod solution;
pub mod tracer;
pub mod world;
