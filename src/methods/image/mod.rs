//! Pictures from a camera: rays go from the eye over specular surfaces to diffuse ones, whose light is known from shadow rays,
//! from a radiosity solution, or from photons.

mod ambient;
mod arrivals;
mod contrast;
mod direct;
mod draws;
mod error;
mod eye_path;
mod film;
mod gather;
mod lights;
mod meters;
mod photon_batches;
mod photon_light;
mod pixels;
mod reference;
mod shutter;

use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::effects::Switches;
use crate::methods::path_trace::PathTracer;
use crate::methods::photon_map::PhotonMaps;
use crate::methods::transport::{Media, Transport};
use crate::methods::{ImageSettings, Settings, Step};
use crate::solution::{CameraImage, CameraView, Comparison, Judged, PathFilter, Solution};
use ambient::{AmbientLook, Parts};
use arrivals::ArrivalMaps;
use contrast::ContrastLook;
use error::ErrorLook;
use eye_path::{DiffuseLight, EyePath, Look};
use film::Film;
use gather::GatherLight;
use lights::{DirectLight, PatchLight, RadiosityLight};
pub use meters::{Meters, Reading};
use photon_light::{PhotonLight, Shown};
pub use pixels::{Pixels, spread_pixels};
use std::sync::Arc;
use std::time::Duration;

/// What a picture can be read off.
#[derive(Clone)]
pub struct Sources {
    pub transport: Arc<Transport>,
    pub radiosity: Option<Arc<Solution>>,
    pub photons: Option<Arc<PhotonMaps>>,
}

impl Sources {
    /// What the diffuse surfaces of a view send on; `None` also where a view has no such light.
    fn light(&self, view: CameraView, all: &Settings) -> Option<Box<dyn DiffuseLight>> {
        let (transport, settings) = (self.transport.clone(), &all.image);
        Some(match view {
            CameraView::RayTraced => {
                Box::new(DirectLight { transport, rays: settings.light_rays, matcher: settings.filter.matcher() })
            }
            CameraView::RadiositySpecular => Box::new(RadiosityLight::new(transport, self.radiosity.as_ref()?, None)),
            CameraView::RadiosityDirect => {
                Box::new(RadiosityLight::new(transport, self.radiosity.as_ref()?, Some(settings.light_rays)))
            }
            CameraView::PhotonIrradiance => Box::new(self.photon_light(Shown::Irradiance, false, settings)?),
            CameraView::PhotonRadiance => Box::new(self.photon_light(Shown::Radiance, false, settings)?),
            CameraView::Caustics => Box::new(self.photon_light(Shown::Radiance, true, settings)?),
            CameraView::FinalGather => Box::new(GatherLight {
                transport,
                caustics: self.photon_light(Shown::Radiance, true, settings)?,
                arrivals: ArrivalMaps::new(self.photons.clone()?),
                gather_rays: settings.gather_rays,
                light_rays: settings.light_rays,
                matcher: settings.filter.matcher(),
            }),
            CameraView::DiffuseAmbient => Box::new(AmbientLook::new(transport, Parts::DiffuseAmbient, all)),
            CameraView::AmbientOcclusion
            | CameraView::Diffuse
            | CameraView::AmbientMinusIndirect
            | CameraView::Reference
            | CameraView::Error(_) => return None,
        })
    }

    fn photon_light(&self, shown: Shown, is_caustic: bool, settings: &ImageSettings) -> Option<PhotonLight> {
        let matcher = settings.filter.matcher();
        Some(PhotonLight::new(self.photons.clone()?, shown, is_caustic, &matcher, self.transport.effects))
    }

    fn look(&self, view: CameraView, settings: &Settings) -> Option<Arc<dyn Look>> {
        let parts = match view {
            CameraView::AmbientOcclusion => Parts::Occlusion,
            CameraView::Diffuse => Parts::Diffuse,
            CameraView::DiffuseAmbient => Parts::DiffuseAmbient,
            CameraView::AmbientMinusIndirect => {
                return Some(Arc::new(ContrastLook::new(self.transport.clone(), settings)));
            }
            CameraView::Reference => {
                let matcher = settings.image.filter.matcher();
                return Some(Arc::new(PathTracer::new(self.transport.clone(), matcher)));
            }
            CameraView::Error(judged) => return self.error(judged, settings),
            _ => return Some(Arc::new(self.eye_path(view, settings)?)),
        };
        Some(Arc::new(AmbientLook::new(self.transport.clone(), parts, settings)))
    }

    /// Of all paths, whichever the view itself is asked for, and of all effects that the scene calls for: leaving one out is a
    /// part of the error.
    fn error(&self, judged: Judged, settings: &Settings) -> Option<Arc<dyn Look>> {
        let settings =
            Settings { image: ImageSettings { filter: PathFilter::default(), ..settings.image }, ..*settings };
        let transport = self.transport.clone();
        let truth = if transport.effects == Switches::default().simulated_in(&transport.world) {
            transport.clone()
        } else {
            Arc::new(Transport::new(transport.world.clone(), Switches::default()))
        };
        Some(match judged {
            Judged::DiffuseAmbient => {
                Arc::new(ErrorLook::new(truth, AmbientLook::new(transport, Parts::DiffuseAmbient, &settings)))
            }
            Judged::Patches => {
                let light = PatchLight { transport: transport.clone(), solution: self.radiosity.clone()? };
                let matcher = PathFilter::default().matcher();
                Arc::new(ErrorLook::new(truth, EyePath { transport, light: Box::new(light), matcher }))
            }
            _ => Arc::new(ErrorLook::new(truth, self.eye_path(judged.view(), &settings)?)),
        })
    }

    fn eye_path(&self, view: CameraView, settings: &Settings) -> Option<EyePath> {
        // Radiosity knows nothing of the ways that its light came.
        let filter = if view.needs_radiosity() { PathFilter::default() } else { settings.image.filter };
        Some(EyePath {
            transport: self.transport.clone(),
            light: self.light(view, settings)?,
            matcher: filter.matcher(),
        })
    }
}

/// A picture in the making: plain state and a step.
pub struct ImageRun {
    view: CameraView,
    camera: Camera,
    size: [u32; 2],
    settings: Settings,
    /// What is prepared of the light is shared by all pictures that are made of it.
    eye: Arc<dyn Look>,
    film: Film,
}

impl ImageRun {
    /// A picture of `size` pixels before its first step; `None` where the view needs light that `sources` do not have.
    pub fn new(
        sources: &Sources,
        view: CameraView,
        camera: Camera,
        size: [u32; 2],
        settings: &Settings,
    ) -> Option<Self> {
        let eye = sources.look(view, settings)?;
        let film = Film::new(&camera, media_round(&*eye, &camera), size, settings.seed);
        Some(Self { view, camera, size, settings: *settings, eye, film })
    }

    /// The same view of the same light from elsewhere, before its first step.
    #[must_use]
    pub fn moved_to(&self, camera: Camera, size: [u32; 2]) -> Self {
        let film = Film::new(&camera, media_round(&*self.eye, &camera), size, self.film.seed());
        Self { camera, size, film, eye: self.eye.clone(), ..*self }
    }

    /// Goes on with other light, so that the picture becomes the mean over both: for passes of photons. False, and nothing
    /// changes, where that light is not there.
    pub fn go_on_with(&mut self, sources: &Sources) -> bool {
        let eye = sources.look(self.view, &self.settings);
        let is_there = eye.is_some();
        if let Some(eye) = eye {
            self.eye = eye;
        }
        is_there
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Samples a pixel that are done.
    pub fn samples(&self) -> u32 {
        self.film.samples()
    }

    /// Whether a sample of every pixel was just finished.
    pub fn is_between_passes(&self) -> bool {
        self.film.is_between_passes()
    }

    /// Some tiles of the pass under way; all of it or nothing. The first passes are coarse.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        if self.film.samples() >= self.settings.image.samples {
            return Step::Converged;
        }
        if self.film.expose(&*self.eye, cancel) { Step::Advanced } else { Step::Cancelled }
    }

    /// The picture so far; `None` before the first coarse pass is whole. Its `elapsed` is zero: whoever steps it holds the
    /// clock.
    pub fn image(&self) -> Option<CameraImage> {
        let developed = self.film.develop()?;
        let comparison = Comparison::of(self.view, &developed.radiance, &developed.coverage);
        Some(CameraImage {
            view: self.view,
            camera: self.camera,
            size: self.size,
            resolution: developed.resolution,
            comparison,
            radiance: developed.radiance,
            coverage: developed.coverage,
            samples: self.film.samples(),
            rays: self.film.cost().rays,
            bill: self.film.cost().bill,
            elapsed: Duration::ZERO,
            is_complete: self.film.samples() >= self.settings.image.samples,
        })
    }
}

/// The glass that the eye of a camera is in.
fn media_round(eye: &dyn Look, camera: &Camera) -> Media {
    eye.transport().media_at(camera.eye().as_vec3a())
}
