//! Photons and pictures from a camera, run to their end on the calling thread.

use super::{CliError, effect_options};
use crate::cancel::Cancel;
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
use std::time::{Duration, Instant};

/// A world to be lit by photons and looked at from cameras.
pub struct Tracing {
    pub world: Arc<World>,
    pub settings: Settings,
    /// Solver time after which no more is begun.
    time: Duration,
    methods: Methods,
    photons: Option<PhotonRun<TracedPhotons>>,
}

impl Tracing {
    pub fn new(world: Arc<World>, settings: Settings, time: Option<Duration>) -> Self {
        let time = time.unwrap_or(Duration::MAX);
        Self { world, settings, time, methods: Methods::default(), photons: None }
    }

    /// The photons, before their first step if nothing has asked for them.
    pub fn photons(&mut self) -> Result<&mut PhotonRun<TracedPhotons>, CliError> {
        let run = match self.photons.take() {
            Some(run) => run,
            None => PhotonRun::of(self.methods.photons(&self.world, &self.settings)?),
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
        let start = Instant::now();
        let has_time = |rounds: u32| rounds == 0 || start.elapsed() < self.time;
        while has_time(method.rounds()) && method.step(&Cancel::default()) == Step::Advanced {}
        VertexShares { elapsed: start.elapsed(), ..method.solution() }
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
        let mut exposing = Exposing { image: None, elapsed: Duration::ZERO };
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
        exposing.elapsed + self.photons.as_ref().map_or(Duration::ZERO, PhotonRun::elapsed)
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
        let start = Instant::now();
        let photons = self.photons.as_mut().filter(|_| shot.view.needs_photons()).map(PhotonRun::method);
        let lights = Lights { world: &self.world, radiosity, photons };
        let image = ImageSettings { samples: ImageSettings::MAX_SAMPLES, ..self.settings.image };
        match &mut exposing.image {
            Some(image) => self.methods.go_on(image, lights),
            None => exposing.image = Some(self.methods.image(lights, shot, &Settings { image, ..self.settings })),
        }
        exposing.elapsed += start.elapsed();
        Ok(())
    }
}

/// A picture in the making, with its clock.
struct Exposing {
    image: Option<<Methods as Workshop>::Image>,
    elapsed: Duration,
}

impl Exposing {
    /// Goes on until every pixel has so many samples.
    fn expose(&mut self, samples: u32) {
        let Some(image) = &mut self.image else { return };
        let start = Instant::now();
        while image.samples() < samples && image.step(&Cancel::default()) == Step::Advanced {}
        self.elapsed += start.elapsed();
    }

    fn finished(&self) -> Option<CameraImage> {
        let image = self.image.as_ref()?.image()?;
        Some(CameraImage { elapsed: self.elapsed, is_complete: true, ..image })
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
