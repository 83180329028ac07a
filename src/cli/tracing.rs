//! Photons and pictures from a camera, run to their end on the calling thread.

use super::{CliError, effect_options};
use crate::cancel::Cancel;
use crate::clock::{Clock, Stopwatch};
use crate::math::rgb::total;
use crate::methods::ambient_occlusion::VertexOcclusion;
use crate::methods::image::{Meters, Sources};
use crate::methods::transport::{Surface, Transport};
use crate::methods::{ImageSettings, Settings, Step};
use crate::solution::{CameraImage, CameraView, PhotonSolution, Solution, VertexShares};
use crate::worker::{CameraShot, Lights, Methods, PhotonRun, Subject, TracedPhotons, Workshop};
use crate::world::World;
use serde_json::{Map, Value, json};
use std::sync::Arc;
use std::time::Duration;

/// A world to be lit by photons and looked at from cameras.
pub struct Tracing {
    pub world: Arc<World>,
    pub settings: Settings,
    /// Solver time after which no more is begun.
    time: Duration,
    clock: Clock,
    methods: Methods,
    photons: Option<PhotonRun<TracedPhotons>>,
}

impl Tracing {
    pub fn new(world: Arc<World>, settings: Settings, time: Option<Duration>) -> Self {
        let time = time.unwrap_or(Duration::MAX);
        Self { world, settings, time, clock: Clock::default(), methods: Methods::default(), photons: None }
    }

    /// The photons, before their first step if nothing has asked for them.
    pub fn photons(&mut self) -> Result<&mut PhotonRun<TracedPhotons>, CliError> {
        let run = match self.photons.take() {
            Some(run) => run,
            None => {
                let method = self.methods.photons(&self.world, &self.settings)?;
                PhotonRun::of(method).with_clock(self.clock.clone())
            }
        };
        Ok(self.photons.insert(run))
    }

    /// Traces the photons of all passes, as far as the time allows. `each` is called when those of a pass are there.
    pub fn trace(&mut self, mut each: impl FnMut(&mut PhotonRun<TracedPhotons>)) -> Result<PhotonSolution, CliError> {
        while self.trace_pass()? {
            each(self.photons()?);
        }
        Ok(self.photons()?.solution())
    }

    /// The photons of the first pass, and of no other if they are the first thing that is asked for.
    pub fn first_pass(&mut self) -> Result<PhotonSolution, CliError> {
        if self.photons()?.progress().passes == 0 {
            self.trace_pass()?;
        }
        Ok(self.photons()?.solution())
    }

    /// Traces the photons of one more pass; false where there is none, or no time for it.
    fn trace_pass(&mut self) -> Result<bool, CliError> {
        let time = self.time;
        let run = self.photons()?;
        loop {
            if run.elapsed() >= time || run.step(&Cancel::default()) != Step::Advanced {
                return Ok(false);
            }
            if run.progress().is_complete {
                return Ok(true);
            }
        }
    }

    /// Ambient occlusion on the mesh: all rounds that the settings ask for, or as many as the time allows, but one at least.
    pub fn occlusion(&self) -> VertexShares {
        let transport = Arc::new(Transport::new(self.world.clone(), self.settings.effects));
        let mut method = VertexOcclusion::new(transport, &self.settings);
        let start = self.clock.now();
        let has_time = |rounds: u32| rounds == 0 || self.clock.since(start) < self.time;
        while has_time(method.rounds()) && method.step(&Cancel::default()) == Step::Advanced {}
        VertexShares { elapsed: self.clock.since(start), ..method.solution() }
    }

    /// Light meters at surfaces, which read what a view shows of the light that there is.
    pub fn meters(
        &mut self,
        view: CameraView,
        radiosity: Option<Arc<Solution>>,
        surfaces: impl FnOnce(&Transport) -> Result<Vec<Surface>, CliError>,
    ) -> Result<Meters, CliError> {
        let photons = if view.needs_photons() { Some(self.photons()?.method().maps()) } else { None };
        let transport = Arc::new(Transport::new(self.world.clone(), self.settings.effects));
        let surfaces = surfaces(&transport)?;
        let sources = Sources { transport, radiosity, photons };
        Ok(Meters::new(&sources, view, surfaces, &self.settings).expect("the light of the view is there"))
    }

    /// A picture from a camera: of `samples` a pixel, or as many as the time allows, but one at least. With progressive
    /// photons it has one from each pass. What is known of the photons is in the second part.
    pub fn picture(
        &mut self,
        shot: &CameraShot,
        solution: Option<Arc<Solution>>,
        samples: Option<u32>,
    ) -> Result<(CameraImage, Option<PhotonSolution>), CliError> {
        let mut exposing = Exposing { image: None, watch: Stopwatch::new(self.clock.clone()) };
        let passes = self.settings.photons.passes;
        let has_passes = shot.view.needs_photons() && self.settings.photons.is_progressive;
        if has_passes {
            // Another picture has used up what there was.
            if self.photons()?.progress().passes > 0 {
                self.photons = None;
            }
            let mut taken = 0;
            while taken < passes && (taken == 0 || self.spent(&exposing) < self.time) && self.trace_pass()? {
                taken += 1;
                self.light(&mut exposing, shot, solution.clone())?;
                exposing.expose(taken);
            }
        } else if shot.view.needs_photons() {
            self.trace_pass()?;
        }
        if exposing.image.is_none() {
            self.light(&mut exposing, shot, solution)?;
            let wanted = samples.unwrap_or(ImageSettings::MAX_SAMPLES);
            for sample in 1..=wanted {
                exposing.expose(sample);
                if self.spent(&exposing) >= self.time {
                    break;
                }
            }
        }
        let image = exposing.finished().expect("it has a sample of every pixel");
        let photons = if shot.view.needs_photons() { Some(self.photons()?.solution()) } else { None };
        Ok((image, photons))
    }

    fn spent(&self, exposing: &Exposing) -> Duration {
        exposing.watch.elapsed() + self.photons.as_ref().map_or(Duration::ZERO, PhotonRun::elapsed)
    }

    /// Begins the picture with the light that there is now, or goes on with it.
    fn light(
        &mut self,
        exposing: &mut Exposing,
        shot: &CameraShot,
        radiosity: Option<Arc<Solution>>,
    ) -> Result<(), CliError> {
        if shot.view.needs_photons() {
            self.photons()?;
        }
        let photons = self.photons.as_mut().filter(|_| shot.view.needs_photons()).map(PhotonRun::method);
        let lights = Lights { world: &self.world, radiosity, photons };
        let image = ImageSettings { samples: ImageSettings::MAX_SAMPLES, ..self.settings.image };
        let Exposing { image: picture, watch } = exposing;
        watch.time(|| match picture {
            Some(picture) => self.methods.go_on(picture, lights),
            None => *picture = Some(self.methods.image(lights, shot, &Settings { image, ..self.settings })),
        });
        Ok(())
    }
}

/// A picture in the making, with its clock.
struct Exposing {
    image: Option<<Methods as Workshop>::Image>,
    watch: Stopwatch,
}

impl Exposing {
    /// Goes on until every pixel has so many samples.
    fn expose(&mut self, samples: u32) {
        let Some(image) = &mut self.image else { return };
        self.watch.time(|| while image.samples() < samples && image.step(&Cancel::default()) == Step::Advanced {});
    }

    fn finished(&self) -> Option<CameraImage> {
        let image = self.image.as_ref()?.image()?;
        Some(CameraImage { elapsed: self.watch.elapsed(), is_complete: true, ..image })
    }
}

/// Energies are in W, summed over red, green and blue; counters are of the last pass, paths in Heckbert's notation.
pub fn photon_report(world: &World, settings: &Settings, photons: &PhotonSolution) -> Value {
    let energy = &photons.energy;
    let by_path: Map<String, Value> =
        photons.counters.by_path.iter().map(|(path, count)| (path.clone(), json!(count))).collect();
    let mut counters = json!(photons.counters);
    counters["by_path"] = Value::Object(by_path);
    let mut report = json!({
        "scene": world.scene.name,
        "method": "photon-map",
        "passes": photons.passes,
        "batches": photons.batches,
        "seconds": photons.elapsed.as_secs_f64(),
        "complete": photons.is_complete,
        "warnings": Vec::from_iter(photons.warning()),
        "max_radius": photons.max_radius,
        "nearest": settings.photons.nearest,
        "kernel": settings.photons.kernel,
        "energy": {
            "emitted": total(energy.emitted),
            "absorbed": total(energy.absorbed),
            "escaped": total(energy.escaped),
            "truncated": total(energy.truncated),
            "defect": total(energy.defect()),
        },
        "counters": counters,
    });
    effect_options::report(&mut report, Subject::Photons, world, settings, &photons.counters.bill);
    report
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::clock::ManualTime;
    use crate::mesh::MeshSettings;
    use crate::methods::PhotonSettings;
    use crate::scene::Scene;

    /// The furnace, and so many seconds for it, on a clock on which each piece of work takes one.
    fn tracing(seconds: u64) -> Tracing {
        let scene = Scene::open("furnace").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let photons = PhotonSettings { count: 100_000, ..PhotonSettings::default() };
        let settings = Settings { photons, ..Settings::default() };
        let clock = ManualTime::ticking(Duration::from_secs(1));
        Tracing { clock, ..Tracing::new(Arc::new(world), settings, Some(Duration::from_secs(seconds))) }
    }

    #[test]
    fn photons_are_traced_until_the_time_is_up() {
        let photons = tracing(3).trace(|_| ()).expect("photons");
        assert_eq!((photons.batches, photons.is_complete, photons.elapsed), (3, false, Duration::from_secs(3)));
    }

    #[test]
    fn a_picture_has_the_samples_that_there_is_time_for() {
        let mut tracing = tracing(5);
        let camera = Camera::new(&tracing.world.viewpoint, &tracing.world.bounds);
        let shot = CameraShot { view: CameraView::Reference, camera, size: [8, 8] };
        let (image, _) = tracing.picture(&shot, None, None).expect("a picture");
        // A second goes into its light.
        assert_eq!((image.samples, image.elapsed), (4, Duration::from_secs(5)));
        // One sample there is in any case.
        tracing.time = Duration::ZERO;
        let (image, _) = tracing.picture(&shot, None, None).expect("a picture");
        assert_eq!(image.samples, 1);
    }

    #[test]
    fn one_round_of_ambient_occlusion_there_is_in_any_case() {
        let mut tracing = tracing(0);
        tracing.settings.image.samples = ImageSettings::MAX_SAMPLES;
        assert_eq!(tracing.occlusion().rounds, 1);
    }
}
