//! Shadow rays, and what they are billed to.

use super::cost::Cost;
use super::transport::{Surface, Transport};
use crate::effects::Effect;
use crate::tracer::SurfacePoint;

/// Whether nothing stands between a surface and a point of another, as far as shadows are simulated.
pub fn is_lit(transport: &Transport, surface: &Surface, point: SurfacePoint, cost: &mut Cost) -> bool {
    if transport.effects.contains(Effect::Shadows) {
        cost.spend(Effect::Shadows, 1);
        transport.sees(surface, point)
    } else {
        cost.save(Effect::Shadows, 1);
        true
    }
}
