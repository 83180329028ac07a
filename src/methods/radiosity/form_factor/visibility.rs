//! How much of a shooting patch a receiving element sees, by shadow rays.

use crate::math::random::unit_vec4;
use crate::mesh::{Element, Patch, Sampler};
use crate::methods::Settings;
use crate::tracer::SurfacePoint;
use crate::world::{World, is_covered};
use glam::{Vec3A, Vec4, Vec4Swizzles};

/// 1/g, 1/g², 1/g³, 1/g⁴, where g solves g⁵ = g + 1: multiples of these fill [0, 1)⁴ evenly at every length (Roberts
/// 2018). Two coordinates are on the receiver, two on the shooter, so that the mean is over both areas and a shadow's
/// edge is not a staircase of elements.
const STEP: Vec4 = Vec4::new(0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_3);
/// Points tried for each ray on an element that is partly covered.
const TRIES: u32 = 16;

/// How many rays a receiver gets.
#[derive(Clone, Copy, Debug)]
pub struct Rays {
    /// At most this many.
    pub most: u32,
    /// This many times its form factor, [`Settings::MIN_SHADOW_RAYS`] or more.
    pub per_form_factor: f64,
}

impl Rays {
    fn to(&self, form_factor: f64) -> u32 {
        ((self.per_form_factor * form_factor).ceil() as u32).max(Settings::MIN_SHADOW_RAYS).min(self.most)
    }
}

/// The receivers and the shooter that rays run between.
pub struct Sightline<'a> {
    world: &'a World,
    shooter: &'a Patch,
    points: Sampler,
    rays: Rays,
}

impl<'a> Sightline<'a> {
    pub fn new(world: &'a World, shooter: &'a Patch, rays: Rays) -> Self {
        Self { world, shooter, points: shooter.region().sampler(), rays }
    }

    /// How many rays go to a receiver with this form factor, at most.
    pub fn rays_to(&self, form_factor: f64) -> u32 {
        self.rays.to(form_factor)
    }

    /// Share of point pairs of element and shooter that see each other, among those that face each other, and the
    /// number of rays traced. `form_factor` is what it would be with nothing between them. `shift` moves the pattern of
    /// points, so that neighbours do not err alike.
    pub fn visible_share(&self, element: &Element, normal: Vec3A, form_factor: f64, shift: u64) -> (f64, u32) {
        let World { mesh, tracer, .. } = self.world;
        let receiver = mesh.region(element).sampler();
        let polygon = mesh.patches[element.patch as usize].polygon;
        let rays = self.rays.to(form_factor);
        let is_partly_covered = element.exposed < 1.0;
        let tries = if is_partly_covered { TRIES * rays } else { rays };
        let mut at = unit_vec4(shift);
        let (mut pairs, mut facing, mut visible) = (0, 0, 0);
        for _ in 0..tries {
            at = (at + STEP).fract();
            let from = SurfacePoint { point: receiver.point(at.xy()), polygon };
            if is_partly_covered && is_covered(mesh, tracer, from, normal) {
                continue;
            }
            let to = self.shooter.surface_point(self.points.point(at.zw()));
            let way = to.point - from.point;
            if way.dot(normal) > 0.0 && way.dot(self.shooter.normal) < 0.0 {
                facing += 1;
                visible += u32::from(tracer.is_unoccluded(from, to));
            }
            pairs += 1;
            if pairs == rays {
                break;
            }
        }
        let share = if facing > 0 { f64::from(visible) / f64::from(facing) } else { 0.0 };
        (share, facing)
    }
}
