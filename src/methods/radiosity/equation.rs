//! The rendering equation at a point of the picked patch.

use super::balance::PickedLight;
use super::form_factor::plane_tolerance;
use crate::math::rgb::Rgb;
use crate::mesh::Patch;
use crate::methods::transport::{Bsdf, Surface, colour};
use crate::solution::{Balance, Equation, LightSource, Visibility};
use crate::tracer::{Hit, Ray, SurfacePoint};
use crate::world::World;
use glam::{DVec3, Vec3, Vec3A};
use std::f64::consts::PI;

/// The points of an equation, m.
#[derive(Clone, Copy, Debug)]
pub struct Points {
    /// x
    pub eye: DVec3,
    /// x′, on the picked patch.
    pub point: Vec3,
    /// x″, if there is one, and the patch that it lies on.
    pub source: Option<(Vec3, u32)>,
}

impl PickedLight<'_> {
    /// All terms at these points. `balance` is that of the picked patch.
    pub fn equation(&self, points: &Points, balance: Balance) -> Equation {
        let patch = self.patch();
        let element = self.element_at(patch, points.point);
        let irradiance = self.solution.light.irradiance[element].as_dvec3();
        Equation {
            eye: points.eye,
            point: points.point,
            sight: seen_by_eye(self.world, points.eye, points.point, patch),
            emitted: self.exitance(patch) / PI,
            reflected: self.reflectance * irradiance / PI,
            source: points.source.map(|(point, other)| self.light_source(points, point, other)),
            balance,
        }
    }

    fn light_source(&self, points: &Points, source: Vec3, other: u32) -> LightSource {
        let (here, there) = (self.patch(), &self.world.mesh.patches[other as usize]);
        let way = source.as_dvec3() - points.point.as_dvec3();
        let tolerance = f64::from(plane_tolerance(self.world));
        let cosines = [cosine(way, here, tolerance), cosine(-way, there, tolerance)];
        let form_factor = self.form_factor(other);
        let element = self.element_at(there, source);
        LightSource {
            point: source,
            patch: other,
            visibility: if cosines.contains(&0.0) {
                Visibility::FacesAway
            } else {
                let (from, to) = (here.surface_point(points.point.into()), there.surface_point(source.into()));
                first_between(self.world, from, to, |_| true)
            },
            diffuse: self.reflectance / PI,
            gloss: colour(gloss(self.world, here, points, way), self.effects).as_dvec3(),
            sent: self.solution.light.radiosity[element].as_dvec3() / PI,
            cosines,
            distance: way.length(),
            form_factor,
            contribution: self.contribution(other, form_factor),
        }
    }

    /// The element of a patch that a point of it lies on.
    fn element_at(&self, patch: &Patch, point: Vec3) -> usize {
        let found = self.world.mesh.element_at(patch.polygon, patch.is_front, point.into());
        found.unwrap_or(patch.elements.start) as usize
    }
}

/// Cosine between a way that starts at a point of the patch and the normal there; 0 where it ends less than `tolerance` (m)
/// above the plane: rounding must not lift a point out of the plane that it lies in.
fn cosine(way: DVec3, patch: &Patch, tolerance: f64) -> f64 {
    let height = way.dot(patch.normal.as_dvec3().normalize());
    if height > tolerance { (height / way.length()).min(1.0) } else { 0.0 }
}

/// The glossy part of ρ(x, x″), 1/sr, where light comes along `way`, from x″ on.
fn gloss(world: &World, patch: &Patch, points: &Points, way: DVec3) -> Rgb {
    let lobes = world.scene.materials[patch.material as usize].lobes();
    let point = Vec3A::from(points.point);
    let shading = world.scene.shading_normal(patch.polygon as usize, points.point).map_or(patch.normal, Vec3A::from);
    let normal = if shading.dot(patch.normal) < 0.0 { -shading } else { shading };
    let surface = Surface {
        polygon: patch.polygon,
        is_front: patch.is_front,
        distance: 0.0,
        point,
        facing: patch.normal,
        normal,
        material: patch.material,
    };
    let toward_eye = (points.eye - points.point.as_dvec3()).normalize_or_zero().as_vec3a();
    let from_source = way.normalize_or_zero().as_vec3a();
    let [_, value] = Bsdf::new(&lobes, &surface, toward_eye, 1.0).value(from_source);
    let cosine = from_source.dot(normal);
    // The value comes with the cosine to the shading normal.
    if cosine > 0.0 { value / cosine } else { Rgb::ZERO }
}

/// δ(x, x′). As in the picture, sides without a mesh hide nothing.
fn seen_by_eye(world: &World, eye: DVec3, point: Vec3, patch: &Patch) -> Visibility {
    if cosine(eye - point.as_dvec3(), patch, plane_tolerance(world).into()) == 0.0 {
        return Visibility::FacesAway;
    }
    let is_drawn = |hit: &Hit| world.mesh.side(hit.polygon, hit.is_front).is_some();
    let eye = SurfacePoint::in_space(eye.as_vec3a());
    first_between(world, eye, patch.surface_point(point.into()), is_drawn)
}

/// What of all that `counts` stands first between two points.
fn first_between(world: &World, from: SurfacePoint, to: SurfacePoint, counts: impl Fn(&Hit) -> bool) -> Visibility {
    let mut left = from.point.distance(to.point);
    let direction = (to.point - from.point).normalize_or_zero();
    let mut ray = Ray::leaving(from, direction);
    while let Some(hit) = world.tracer.closest_within(&ray, left) {
        if hit.polygon == to.polygon {
            break;
        }
        if counts(&hit) {
            return Visibility::Blocked { polygon: hit.polygon, at: hit.point.into() };
        }
        left -= hit.distance;
        ray = Ray::leaving(hit.surface_point(), direction);
    }
    Visibility::Free
}
