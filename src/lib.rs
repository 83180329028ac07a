pub mod cancel;
pub mod math;
pub mod tracer;
