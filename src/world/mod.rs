//! The world: a scene made ready for light. It is built once and never changes.

mod ceiling;
mod census;
mod emitters;
mod exposure;
mod nearest;
mod occluders;
mod planes;
mod shells;
mod sides;
mod surface;
mod viewpoint;

pub use ceiling::with_ceiling_light;
pub use census::Census;
pub use exposure::is_covered;

use crate::cancel::{Cancel, Cancelled};
use crate::math::bounds::Bounds;
use crate::mesh::{Mesh, MeshSettings, element_size_for, estimated_elements, subdivide};
use crate::scene::{Finding, Scene, Viewpoint};
use crate::tracer::{Hit, Ray, Tracer};
use glam::Vec3A;
use sides::Reach;
use std::sync::Arc;
use surface::Surfaces;

/// Surfaces that are nearer to each other than this share of the scene's radius touch: no light gets between them.
const TOUCHING: f32 = 4e-4;

/// A point lies on a surface that is nearer than this share of the scene's radius.
const ON_SURFACE: f32 = 1e-3;

/// So many surfaces one behind the other are looked at for the one that a point lies on.
const MOST_STACKED: usize = 256;

/// Where an automatic mesh must be finer than usual, because the scene has many polygons.
const ELEMENTS_PER_POLYGON: f64 = 4.0;

/// A scene, its mesh and its tracer.
pub struct World {
    /// The scene as mended: emitters may have been turned or moved, and its findings say so.
    pub scene: Arc<Scene>,
    pub tracer: Arc<Tracer>,
    pub mesh: Mesh,
    /// Box round all polygons, m.
    pub bounds: Bounds,
    /// The view to begin with: the one that the scene's author measured, or one that looks into the scene.
    pub viewpoint: Viewpoint,
    /// Share of the bounces of light that leave the scene, in [0, 1], of those that explored it.
    pub escape_share: f64,
    /// Whether anything may stand between two points that light reaches, or an emitter faces what its light does not reach.
    /// If not, whatever faces each other sees each other whole, but for rounding.
    pub has_occluders: bool,
    /// What light meets.
    pub census: Census,
    /// Longest edge of an element, m.
    pub element_size: f32,
    /// For each side, as in [`Mesh::sides`], whether light can reach it.
    is_reached: Arc<[bool]>,
}

/// Why a world could not be built.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum WorldError {
    #[error("stopped while the scene was being prepared")]
    Cancelled,
    #[error("an element size of {0} m cannot be used: it must be a number above 0")]
    ElementSize(f32),
    #[error(
        "elements of {size:.1e} m would be {elements:.1e} in number; at most {:.0e} fit",
        MeshSettings::MAX_ELEMENTS
    )]
    TooFine { size: f64, elements: f64 },
}

impl From<Cancelled> for WorldError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

impl World {
    /// Mends the emitters, builds the tracer, finds out which sides light can reach, and cuts these into elements. Where
    /// no emitter lights anything, these are the sides that the eye or the light of the sky can reach, and the emitters.
    ///
    /// # Errors
    /// If cancelled, or if the element size is not a positive number or too fine for memory.
    pub fn build(mut scene: Scene, settings: &MeshSettings, cancel: &Cancel) -> Result<Self, WorldError> {
        let mut tracer = Tracer::new(&triangles(&scene));
        let mut findings = emitters::turn(&mut scene, &tracer);
        findings.extend(emitters::move_off_walls(&mut scene));
        if !findings.is_empty() {
            tracer = Tracer::new(&triangles(&scene));
        }
        let surfaces = Surfaces::new(&scene);
        let bounds = Bounds::of(surfaces.corners());
        let start = scene.viewpoint.unwrap_or_else(|| viewpoint::most_open(&bounds, &tracer));
        let tolerance = tracer.offset().min(TOUCHING * bounds.radius());
        let emitters = sides::emitting_sides(&scene);
        let mut reach = sides::explore(&scene, &emitters, &surfaces, &tracer, start.eye, cancel)?;
        let arrives = census::light_arrives(&surfaces, &emitters, &reach.is_reached, tolerance.into());
        if !emitters.is_empty() && !arrives {
            // Lamps that light nothing are no reason not to look round.
            let lit = reach;
            reach = sides::explore(&scene, &[], &surfaces, &tracer, start.eye, cancel)?;
            reach.add_lit(&lit);
        }
        let Reach { is_reached, is_walked, escape_share, rooms } = reach;
        let hidden = emitters::hidden(&scene, &surfaces, &tracer);
        let unseen_emitters = hidden.len();
        findings.extend(hidden);
        scene.findings.extend::<Vec<Finding>>(findings);
        let viewpoint =
            scene.viewpoint.unwrap_or_else(|| viewpoint::choose(&bounds, &surfaces, &tracer, &is_walked, &rooms));
        let has_occluders = occluders::may_exist(&surfaces, &emitters, &is_reached, tolerance.into());
        let census = Census::take(&scene, &surfaces, &is_reached, unseen_emitters, arrives, tolerance.into());
        let (mesh, element_size) = mesh(&scene, &surfaces, &tracer, &is_reached, settings, cancel)?;
        Ok(Self {
            scene: Arc::new(scene),
            tracer: Arc::new(tracer),
            mesh,
            bounds,
            viewpoint,
            escape_share,
            has_occluders,
            census,
            element_size,
            is_reached: is_reached.into(),
        })
    }

    /// Whether no light can leave: not one of the rays that explored the scene did.
    pub fn is_closed(&self) -> bool {
        self.escape_share == 0.0
    }

    /// The side nearest to a point among those that face along the unit `normal`, up to a thousandth of the scene's radius
    /// before or behind the point along the normal; `None` where there is none. Of surfaces that coincide, the first
    /// whose front faces along the normal.
    pub fn meet_at(&self, point: Vec3A, normal: Vec3A) -> Option<Hit> {
        let reach = ON_SURFACE * self.bounds.radius();
        let mut ray = Ray::new(point + reach * normal, -normal);
        let distance = |hit: &Hit| (hit.point - point).dot(normal).abs();
        let mut nearest: Option<Hit> = None;
        for _ in 0..MOST_STACKED {
            let left = reach + (ray.origin - point).dot(normal);
            let Some(hit) = self.tracer.closest_within(&ray, left) else { break };
            let is_nearer = |nearest: Hit| {
                let gain = distance(&nearest) - distance(&hit);
                gain > self.tracer.offset() || (gain >= -self.tracer.offset() && hit.is_front && !nearest.is_front)
            };
            if nearest.is_none_or(is_nearer) {
                nearest = Some(hit);
            }
            ray = Ray::leaving(hit.surface_point(), -normal);
        }
        nearest
    }

    /// The same scene cut differently; costs only the new mesh.
    ///
    /// # Errors
    /// If cancelled, or if the element size is not a positive number or too fine for memory.
    pub fn remeshed(&self, settings: &MeshSettings, cancel: &Cancel) -> Result<Self, WorldError> {
        let (mesh, element_size) =
            mesh(&self.scene, &Surfaces::new(&self.scene), &self.tracer, &self.is_reached, settings, cancel)?;
        Ok(Self {
            scene: self.scene.clone(),
            tracer: self.tracer.clone(),
            mesh,
            bounds: self.bounds,
            viewpoint: self.viewpoint,
            escape_share: self.escape_share,
            has_occluders: self.has_occluders,
            census: self.census,
            element_size,
            is_reached: self.is_reached.clone(),
        })
    }
}

/// The mesh of the reached sides and its element size, m.
fn mesh(
    scene: &Scene,
    surfaces: &Surfaces,
    tracer: &Tracer,
    is_reached: &[bool],
    settings: &MeshSettings,
    cancel: &Cancel,
) -> Result<(Mesh, f32), WorldError> {
    let size = match settings.element_size {
        Some(size) if size > 0.0 && size.is_finite() => f64::from(size),
        Some(size) => return Err(WorldError::ElementSize(size)),
        None => {
            let area =
                is_reached.iter().enumerate().filter(|(_, reached)| **reached).map(|(side, _)| surfaces.area(side));
            let wanted = MeshSettings::DEFAULT_ELEMENTS.max(ELEMENTS_PER_POLYGON * scene.polygons.len() as f64);
            element_size_for(scene, is_reached, settings.elements_per_patch_edge, area.sum(), wanted)
        }
    };
    let elements = estimated_elements(scene, is_reached, settings.elements_per_patch_edge, size);
    if elements > MeshSettings::MAX_ELEMENTS {
        return Err(WorldError::TooFine { size, elements });
    }
    let mut mesh = subdivide(scene, is_reached, settings.elements_per_patch_edge, size, cancel)?;
    let shares = exposure::shares(&mesh, tracer, cancel)?;
    mesh.expose(&shares);
    Ok((mesh, size as f32))
}

/// Every polygon as one or two triangles, each with the polygon's index.
fn triangles(scene: &Scene) -> Vec<(u32, [glam::Vec3; 3])> {
    let mut triangles = Vec::with_capacity(2 * scene.polygons.len());
    for (index, polygon) in scene.polygons.iter().enumerate() {
        let corners = polygon.corners();
        for pair in corners[1..].windows(2) {
            let triangle = [corners[0], pair[0], pair[1]].map(|corner| scene.positions[corner as usize]);
            triangles.push((index as u32, triangle));
        }
    }
    triangles
}
