//! The methods of this program, as the solver thread works with them.

use super::Refused;
use super::run::{check_photons, start_method};
use super::workshop::{CameraShot, ImageMethod, Lights, OcclusionMethod, PhotonMethod, PhotonProgress, Workshop};
use crate::accuracy::{Cache, Found, ProbePoint, Reference, by_photons, surfaces};
use crate::cancel::Cancel;
use crate::effects::Switches;
use crate::methods::ambient_occlusion::VertexOcclusion;
use crate::methods::image::{ImageRun, Sources};
use crate::methods::photon_map::{PhotonMapping, PhotonMaps, ProgressivePoints, Which};
use crate::methods::transport::{Surface, Transport};
use crate::methods::{Method, Settings, Step};
use crate::solution::{CameraImage, Gathered, Photon, PhotonSolution, PhotonTrail, VertexShares};
use crate::world::World;
use glam::Vec3A;
use std::sync::{Arc, Weak};

/// The methods of this program.
#[derive(Default)]
pub struct Methods {
    /// Shared by all that trace rays through a world, for as long as one of them does.
    transport: Weak<Transport>,
    cache: Option<Cache>,
}

impl Methods {
    /// Those that keep in this cache what they find out about scenes.
    pub fn with_cache(cache: Option<Cache>) -> Self {
        Self { cache, ..Self::default() }
    }

    fn transport(&mut self, world: &Arc<World>, switches: Switches) -> Arc<Transport> {
        let known = self.transport.upgrade().filter(|transport| {
            Arc::ptr_eq(&transport.world, world) && transport.effects == switches.simulated_in(world)
        });
        known.unwrap_or_else(|| {
            let transport = Arc::new(Transport::new(world.clone(), switches));
            self.transport = Arc::downgrade(&transport);
            transport
        })
    }

    fn sources(&mut self, lights: Lights<'_, TracedPhotons>, switches: Switches) -> Sources {
        Sources {
            transport: self.transport(lights.world, switches),
            radiosity: lights.radiosity,
            photons: lights.photons.map(|photons| photons.maps()),
        }
    }
}

impl Workshop for Methods {
    type Photons = TracedPhotons;
    type Image = ImageRun;

    fn radiosity(&mut self, world: &Arc<World>, settings: &Settings) -> Result<Box<dyn Method>, Refused> {
        start_method(world.clone(), settings)
    }

    fn photons(&mut self, world: &Arc<World>, settings: &Settings) -> Result<TracedPhotons, Refused> {
        TracedPhotons::start(self.transport(world, settings.effects), settings)
    }

    fn occlusion(&mut self, world: &Arc<World>, settings: &Settings) -> Box<dyn OcclusionMethod> {
        Box::new(VertexOcclusion::new(self.transport(world, settings.effects), settings))
    }

    fn reference(&mut self, world: &Arc<World>) -> Option<(Reference, Option<Cache>)> {
        Some((Reference::open(world.clone(), self.cache.as_ref()), self.cache.clone()))
    }

    fn image(&mut self, lights: Lights<'_, TracedPhotons>, shot: &CameraShot, settings: &Settings) -> ImageRun {
        let CameraShot { view, camera, size } = *shot;
        ImageRun::new(&self.sources(lights, settings.effects), view, camera, size, settings)
            .expect("the light of the view is there")
    }

    fn go_on(&mut self, image: &mut ImageRun, lights: Lights<'_, TracedPhotons>) {
        let is_there = image.go_on_with(&self.sources(lights, image.settings().effects));
        debug_assert!(is_there, "the light of the view is there");
    }
}

/// Photon mapping, with what is needed to look into it.
pub struct TracedPhotons {
    mapping: PhotonMapping,
    transport: Arc<Transport>,
    /// Of progressive photons, at the points where they are measured.
    means: Option<ProgressivePoints>,
}

impl TracedPhotons {
    /// Photon mapping before its first step.
    ///
    /// # Errors
    /// If it needs more memory than there is.
    pub fn start(transport: Arc<Transport>, settings: &Settings) -> Result<Self, Refused> {
        check_photons(&transport, &settings.photons)?;
        Ok(Self { mapping: PhotonMapping::new(transport.clone(), settings), transport, means: None })
    }

    /// The photons that are there, in trees.
    pub fn maps(&self) -> Arc<PhotonMaps> {
        self.mapping.maps()
    }

    /// The surfaces at points that were spread over them.
    pub fn surfaces(&self, points: &[ProbePoint]) -> Vec<Surface> {
        surfaces(&self.transport, points)
    }

    /// The surface at a point, seen from the side that the unit `normal` faces; `None` where there is none.
    pub fn surface(&self, point: Vec3A, normal: Vec3A) -> Option<Surface> {
        self.transport.surface_at(point, normal)
    }
}

impl PhotonMethod for TracedPhotons {
    fn step(&mut self, cancel: &Cancel) -> Step {
        self.mapping.step(cancel)
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        let kernel = self.mapping.settings().photons.kernel;
        let goes_on = self.mapping.configure(settings);
        if goes_on && settings.photons.kernel != kernel {
            self.means = None;
        }
        goes_on
    }

    fn progress(&self) -> PhotonProgress {
        PhotonProgress {
            batches: self.mapping.batches(),
            passes: self.mapping.passes(),
            is_complete: self.mapping.is_pass_complete(),
        }
    }

    fn solution(&mut self) -> PhotonSolution {
        self.mapping.solution()
    }

    fn irradiance(&mut self, points: &[ProbePoint]) -> Found {
        match &self.means {
            Some(means) => Found::of_samples(means.irradiance()),
            None => by_photons(&self.mapping.maps(), points),
        }
    }

    fn count_pass(&mut self, points: &[ProbePoint]) {
        let transport = &self.transport;
        let means = self.means.get_or_insert_with(|| ProgressivePoints::new(surfaces(transport, points)));
        means.add(&self.mapping.maps(), Which::All);
    }

    fn trail(&mut self, photon: &Photon) -> Option<PhotonTrail> {
        Some(self.mapping.trail(photon))
    }

    fn gathered(&mut self, point: Vec3A, normal: Vec3A) -> Option<Gathered> {
        Some(self.mapping.maps().gathered(&self.surface(point, normal)?))
    }
}

impl OcclusionMethod for VertexOcclusion {
    fn step(&mut self, cancel: &Cancel) -> Step {
        Self::step(self, cancel)
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        Self::configure(self, settings)
    }

    fn solution(&self) -> VertexShares {
        Self::solution(self)
    }
}

impl ImageMethod for ImageRun {
    fn moved_to(&self, shot: &CameraShot) -> Self {
        Self::moved_to(self, shot.camera, shot.size)
    }

    fn step(&mut self, cancel: &Cancel) -> Step {
        Self::step(self, cancel)
    }

    fn samples(&self) -> u32 {
        Self::samples(self)
    }

    fn is_between_passes(&self) -> bool {
        Self::is_between_passes(self)
    }

    fn image(&self) -> Option<CameraImage> {
        Self::image(self)
    }
}
