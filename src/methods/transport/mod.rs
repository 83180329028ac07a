//! Where rays meet surfaces and what these do with light: shared by photons, which go with the light, and by the rays of a
//! camera, which go against it.

mod bsdf;
mod emitter;
mod emitter_tree;
mod emitters;
mod filter;
mod fresnel;
mod media;
mod phong;
mod surface;

pub use bsdf::{Bsdf, LobeProbabilities, Sample};
pub use emitters::{Emission, EmitterSample, Emitters};
pub use filter::colour;
pub use fresnel::{fresnel_reflectance, reflect, refract};
pub use media::Media;
pub use surface::Surface;

use crate::effects::{Effect, Effects, Switches, needed};
use crate::math::polygon::vector_area;
use crate::math::rgb::Rgb;
use crate::scene::{Lobes, Material};
use crate::tracer::{Hit, Ray, SurfacePoint};
use crate::world::World;
use glam::{DVec3, Vec3, Vec3A};
use std::sync::Arc;

/// A world made ready for rays that are reflected, refracted and absorbed.
pub struct Transport {
    pub world: Arc<World>,
    /// Those that are simulated.
    pub effects: Effects,
    /// Whether shadow rays pass through what stands in the way: shadows are left out of a scene that calls for them. Rays that
    /// meet surfaces cannot do so, and are of no use then to find emitters.
    pub ignores_occluders: bool,
    /// Of each material.
    looks: Vec<MaterialLook>,
    facets: Vec<Facet>,
    emitters: Emitters,
    has_glass: bool,
}

/// What the simulated effects leave of a material.
struct MaterialLook {
    lobes: Lobes,
    /// With those of all effects but colour.
    whole: Lobes,
    /// W/(m²·sr)
    emission: Rgb,
    /// Effects that it would have, if they were simulated.
    skipped: Effects,
}

/// A ray that looks for the glass round a point meets at most so many surfaces.
const MOST_SURFACES: usize = 256;
/// In which it looks, of unit length but for rounding: along no axis, since scenes have edges there.
const LOOK: Vec3A = Vec3A::new(0.357_6, 0.863_4, 0.356_1);

/// What is asked of a polygon at every hit.
#[derive(Clone, Copy)]
struct Facet {
    /// Unit normal of the front.
    normal: Vec3A,
    /// A corner.
    origin: Vec3A,
}

impl Transport {
    /// With the effects that the world calls for, but for what the switches say.
    pub fn new(world: Arc<World>, switches: Switches) -> Self {
        let needed = needed(&world);
        let effects = switches.simulated(needed);
        let ignores_occluders = needed.contains(Effect::Shadows) && !effects.contains(Effect::Shadows);
        let scene = &world.scene;
        let facet = |corners: &[u32]| {
            let corners: Vec<Vec3> = corners.iter().map(|&corner| scene.positions[corner as usize]).collect();
            let precise: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3()).collect();
            Facet { normal: vector_area(&precise).normalize_or_zero().as_vec3a(), origin: corners[0].into() }
        };
        let facets: Vec<Facet> = scene.polygons.iter().map(|polygon| facet(polygon.corners())).collect();
        let looks: Vec<_> = scene.materials.iter().map(|material| MaterialLook::new(material, effects)).collect();
        let emission = |polygon: usize| looks[scene.polygons[polygon].material as usize].emission;
        let emitters = Emitters::new(&world, |polygon| (facets[polygon].normal, emission(polygon)));
        let has_glass = scene.materials.iter().any(Material::is_glass);
        let mut transport = Self { effects, ignores_occluders, looks, facets, emitters, has_glass, world };
        let mut emitters = std::mem::take(&mut transport.emitters);
        emitters.place_in_media(|from, facing| transport.media_beside(from, facing));
        Self { emitters, ..transport }
    }

    pub fn emitters(&self) -> &Emitters {
        &self.emitters
    }

    /// The first surface along a ray.
    pub fn meet(&self, ray: &Ray) -> Option<Surface> {
        Some(self.surface_hit(&self.world.tracer.closest(ray)?))
    }

    fn surface_hit(&self, hit: &Hit) -> Surface {
        Surface { distance: hit.distance, ..self.surface_on(hit.polygon, hit.is_front, hit.point) }
    }

    /// The surface at a point of a side of a polygon, as a ray meets it that comes from there.
    pub fn surface_on(&self, polygon: u32, is_front: bool, point: Vec3A) -> Surface {
        let Facet { normal, origin } = self.facets[polygon as usize];
        let facing = if is_front { normal } else { -normal };
        let point = point - facing * (point - origin).dot(facing);
        let shading = self.world.scene.shading_normal(polygon as usize, point.into());
        Surface {
            polygon,
            is_front,
            distance: 0.0,
            point,
            facing,
            normal: shading.map_or(facing, |normal| towards(normal.into(), facing)),
            material: self.world.scene.polygons[polygon as usize].material,
        }
    }

    /// The surface at a point, seen from the side that the unit `normal` faces; `None` where there is none.
    pub fn surface_at(&self, point: Vec3A, normal: Vec3A) -> Option<Surface> {
        Some(self.surface_hit(&self.world.meet_at(point, normal)?))
    }

    pub fn material(&self, surface: &Surface) -> &Material {
        &self.world.scene.materials[surface.material as usize]
    }

    /// Which shares of the light that arrives at surfaces of a material go where.
    pub fn lobes(&self, material: u32) -> &Lobes {
        &self.looks[material as usize].lobes
    }

    /// Effects that a surface would have, if they were simulated.
    pub fn skipped(&self, surface: &Surface) -> Effects {
        self.looks[surface.material as usize].skipped
    }

    /// What a surface does with light that arrives from, or leaves to, this unit direction, which points away from it.
    pub fn bsdf(&self, surface: &Surface, towards: Vec3A, media: &Media) -> Bsdf {
        let bsdf = self.bsdf_of(self.lobes(surface.material), surface, towards, media);
        if self.effects.contains(Effect::SpecularReflection) { bsdf } else { bsdf.without_reflection() }
    }

    /// The same with the lobes of effects that are not simulated, for those who tell them apart by [`Sample::effect`].
    pub fn whole_bsdf(&self, surface: &Surface, towards: Vec3A, media: &Media) -> Bsdf {
        self.bsdf_of(&self.looks[surface.material as usize].whole, surface, towards, media)
    }

    fn bsdf_of(&self, lobes: &Lobes, surface: &Surface, towards: Vec3A, media: &Media) -> Bsdf {
        let index = if lobes.glass > 0.0 { media.index_across(surface, &self.world.scene.materials) } else { 1.0 };
        Bsdf::new(lobes, surface, towards, index)
    }

    /// The media behind a surface, for light that goes through it.
    pub fn media_behind(&self, surface: &Surface, media: Media) -> Media {
        if self.lobes(surface.material).glass > 0.0 { media.across(surface) } else { media }
    }

    /// The glass that a point in space is in.
    pub fn media_at(&self, point: Vec3A) -> Media {
        self.media_round(Ray::new(point, LOOK.normalize()))
    }

    /// The glass before a point of a polygon, on the side of a unit normal.
    pub fn media_beside(&self, from: SurfacePoint, facing: Vec3A) -> Media {
        let look = LOOK.normalize();
        self.media_round(Ray::leaving(from, if look.dot(facing) > 0.0 { look } else { -look }))
    }

    /// The glass that a ray starts in: of each body, it meets more backs than fronts.
    fn media_round(&self, mut ray: Ray) -> Media {
        let (mut entered, mut around) = (Vec::new(), Vec::new());
        for _ in 0..if self.has_glass { MOST_SURFACES } else { 0 } {
            let Some(surface) = self.meet(&ray) else { break };
            if self.material(&surface).is_glass() {
                if surface.is_front {
                    entered.push(surface.material);
                } else if let Some(place) = entered.iter().rposition(|&body| body == surface.material) {
                    entered.remove(place);
                } else {
                    around.push(surface.material);
                }
            }
            ray = self.leave(&surface, ray.direction);
        }
        Media::inside_of(&around)
    }

    /// Radiance that a surface itself sends, W/(m²·sr). Emitters shine from their front.
    pub fn emission(&self, surface: &Surface) -> Rgb {
        if surface.is_front { self.looks[surface.material as usize].emission } else { Rgb::ZERO }
    }

    /// The ray that leaves a surface in a unit direction, on whichever side that lies.
    pub fn leave(&self, surface: &Surface, direction: Vec3A) -> Ray {
        Ray::leaving(surface.surface_point(), direction)
    }

    /// Whether nothing stands between two points of different polygons: by a ray.
    pub fn sees(&self, surface: &Surface, point: SurfacePoint) -> bool {
        self.world.tracer.is_unoccluded(surface.surface_point(), point)
    }
}

impl MaterialLook {
    fn new(material: &Material, effects: Effects) -> Self {
        let all = material.lobes();
        Self {
            lobes: filter::without(&all, effects),
            whole: filter::without(&all, effects.and(filter::SPECULAR)),
            emission: colour(material.emission, effects),
            skipped: filter::effects_of(&all).but(effects),
        }
    }
}

/// `normal`, or its opposite, whichever is on the side of `facing`.
fn towards(normal: Vec3A, facing: Vec3A) -> Vec3A {
    if normal.dot(facing) < 0.0 { -normal } else { normal }
}
