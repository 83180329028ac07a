//! Where the light of diffuse surfaces is known from, one for each view.

use super::direct::Receiver;
use super::eye_path::{DiffuseLight, Seen, Tools};
use crate::effects::Effect;
use crate::math::rgb::Rgb;
use crate::methods::transport::Transport;
use crate::solution::{Path, PathMatcher, Scattering, Solution};
use std::f32::consts::PI;
use std::sync::Arc;

/// Straight from the emitters, and nothing else: the light of classic ray tracing.
pub struct DirectLight {
    pub transport: Arc<Transport>,
    pub rays: u32,
    pub matcher: PathMatcher,
}

impl DiffuseLight for DirectLight {
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        if !self.matcher.passes(Path::LIGHT, Some(Scattering::Diffuse), seen.to_eye) {
            return Rgb::ZERO;
        }
        direct_light(&self.transport, seen, self.rays, tools)
    }
}

/// Radiance that a diffuse lobe sends on of direct light, W/(m²·sr), by so many rays to emitters.
pub fn direct_light(transport: &Transport, seen: &Seen<'_>, rays: u32, tools: &mut Tools<'_>) -> Rgb {
    let rays = seen.light_rays(rays);
    if !transport.effects.contains(Effect::DirectLight) {
        tools.cost.save(Effect::DirectLight, rays);
        return Rgb::ZERO;
    }
    Receiver { transport, surface: seen.surface, bsdf: seen.bsdf, is_spread: seen.is_direct() }
        .sample_direct(rays, tools)
}

/// Read off a radiosity solution as it was computed: one value an element.
pub struct PatchLight {
    pub transport: Arc<Transport>,
    pub solution: Arc<Solution>,
}

impl DiffuseLight for PatchLight {
    fn leaving(&self, seen: &Seen<'_>, _tools: &mut Tools<'_>) -> Rgb {
        let element =
            self.transport.world.mesh.element_at(seen.surface.polygon, seen.surface.is_front, seen.surface.point);
        let irradiance = element.map_or(Rgb::ZERO, |element| self.solution.light.irradiance[element as usize]);
        seen.bsdf.diffuse() * irradiance / PI
    }
}

/// Read off a radiosity solution, smooth between the vertices of its mesh.
pub struct RadiosityLight {
    transport: Arc<Transport>,
    /// E, W/m².
    vertex_irradiance: Vec<Rgb>,
    /// Rays to find light with that comes straight from emitters; `None` where that is read off, too.
    light_rays: Option<u32>,
}

impl RadiosityLight {
    /// With `light_rays`, only light between surfaces is read off, which is smooth; shadows keep their edges by so many rays
    /// to the emitters (Chen, Rushmeier, Miller, Turner 1991).
    pub fn new(transport: Arc<Transport>, solution: &Solution, light_rays: Option<u32>) -> Self {
        let light = &solution.light;
        let parts = light.irradiance.iter().zip(&light.direct);
        let read_off =
            parts.map(|(all, direct)| if light_rays.is_some() { (*all - *direct).max(Rgb::ZERO) } else { *all });
        let mut vertex_irradiance = Vec::new();
        transport.world.mesh.smooth(&read_off.collect::<Vec<_>>(), &mut vertex_irradiance);
        Self { transport, vertex_irradiance, light_rays }
    }
}

impl DiffuseLight for RadiosityLight {
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        let mesh = &self.transport.world.mesh;
        let location = mesh.locate(seen.surface.polygon, seen.surface.is_front, seen.surface.point);
        let irradiance = location.map_or(Rgb::ZERO, |location| mesh.interpolate(&location, &self.vertex_irradiance));
        let direct = self.light_rays.map(|rays| direct_light(&self.transport, seen, rays, tools));
        direct.unwrap_or_default() + seen.bsdf.diffuse() * irradiance / PI
    }
}
