//! Methods whose steps do what a test says.

use glam::Vec3A;
use lightwell::accuracy::{Cache, Found, ProbePoint, Reference};
use lightwell::cancel::Cancel;
use lightwell::clock::Clock;
use lightwell::effects::Bill;
use lightwell::math::rgb::Rgb;
use lightwell::methods::{Method, PhotonSettings, Settings, Step};
use lightwell::solution::{
    CameraImage, ElementLight, Gathered, Path, Photon, PhotonSolution, PhotonTrail, Solution, TrailPlace, VertexShares,
};
use lightwell::worker::{
    CameraShot, ImageMethod, Lights, OcclusionMethod, PhotonMethod, PhotonProgress, Refused, Worker, Workshop,
};
use lightwell::world::World;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// What a step does, given the number of steps before it.
type Work = dyn Fn(u64, &Cancel) -> Step + Send + Sync;
type StartMethod = dyn Fn(Arc<World>, &Settings) -> Box<dyn Method> + Send;

/// A workshop of such methods.
pub struct Fakes {
    radiosity: Box<StartMethod>,
    photons: Arc<Work>,
    occlusion: Arc<Work>,
    image: Arc<Work>,
    counts: Arc<Counts>,
    has_reference: bool,
    clock: Clock,
}

/// How often something was done.
#[derive(Default)]
pub struct Counts {
    pub radiosity_starts: AtomicU64,
    pub photon_starts: AtomicU64,
    pub occlusion_starts: AtomicU64,
    pub image_starts: AtomicU64,
    /// Images that were begun with the light of another one.
    pub image_moves: AtomicU64,
    pub radiosity_steps: AtomicU64,
    pub photon_steps: AtomicU64,
    pub occlusion_steps: AtomicU64,
    pub image_steps: AtomicU64,
    pub cancelled_images: AtomicU64,
}

impl Counts {
    pub fn of(count: &AtomicU64) -> u64 {
        count.load(Ordering::SeqCst)
    }

    fn add(count: &AtomicU64, step: Step, kind: Step) {
        count.fetch_add(u64::from(step == kind), Ordering::SeqCst);
    }
}

impl Fakes {
    pub fn radiosity(self, work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Self {
        let (work, counts): (Arc<Work>, _) = (Arc::new(work), self.counts.clone());
        self.starting(move |world, settings| {
            let elements = world.mesh.elements.len();
            let (work, counts) = (work.clone(), counts.clone());
            Box::new(Fake { work, counts, steps: 0, settings: *settings, elements })
        })
    }

    /// With radiosity of one's own.
    pub fn starting(self, start: impl Fn(Arc<World>, &Settings) -> Box<dyn Method> + Send + 'static) -> Self {
        Self { radiosity: Box::new(start), ..self }
    }

    pub fn photons(self, work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Self {
        Self { photons: Arc::new(work), ..self }
    }

    pub fn occlusion(self, work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Self {
        Self { occlusion: Arc::new(work), ..self }
    }

    pub fn image(self, work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Self {
        Self { image: Arc::new(work), ..self }
    }

    /// With a reference that errors are measured against.
    pub fn with_reference(self) -> Self {
        Self { has_reference: true, ..self }
    }

    /// On a thread that lives by this clock.
    pub fn on(self, clock: Clock) -> Self {
        Self { clock, ..self }
    }

    /// How often its methods do what.
    pub fn counts(&self) -> Arc<Counts> {
        self.counts.clone()
    }

    /// The worker, and how often its methods did what.
    pub fn spawn(self) -> (Worker, Arc<Counts>) {
        let (counts, clock) = (self.counts(), self.clock.clone());
        (Worker::spawn_with(self, clock, || ()), counts)
    }
}

/// All steps are short.
impl Default for Fakes {
    fn default() -> Self {
        let nothing = |_: Arc<World>, _: &Settings| -> Box<dyn Method> { unreachable!() };
        let fakes = Self {
            radiosity: Box::new(nothing),
            photons: Arc::new(short_step),
            occlusion: Arc::new(short_step),
            image: Arc::new(short_step),
            counts: Arc::default(),
            has_reference: false,
            clock: Clock::default(),
        };
        fakes.radiosity(short_step)
    }
}

impl Workshop for Fakes {
    type Photons = FakePhotons;
    type Image = FakeImage;

    fn radiosity(&mut self, world: &Arc<World>, settings: &Settings) -> Result<Box<dyn Method>, Refused> {
        self.counts.radiosity_starts.fetch_add(1, Ordering::SeqCst);
        Ok((self.radiosity)(world.clone(), settings))
    }

    fn photons(&mut self, _: &Arc<World>, settings: &Settings) -> Result<FakePhotons, Refused> {
        let count = u64::from(settings.photons.count);
        if count > 1_000_000 {
            return Err(Refused::Photons { photons: count, landings: count, needed_mib: 2, available_mib: 1 });
        }
        self.counts.photon_starts.fetch_add(1, Ordering::SeqCst);
        let (work, counts) = (self.photons.clone(), self.counts.clone());
        Ok(FakePhotons { work, counts, steps: 0, batches: 0, passes: 0, settings: *settings })
    }

    fn occlusion(&mut self, _: &Arc<World>, settings: &Settings) -> Box<dyn OcclusionMethod> {
        self.counts.occlusion_starts.fetch_add(1, Ordering::SeqCst);
        let (work, counts) = (self.occlusion.clone(), self.counts.clone());
        Box::new(FakeOcclusion { work, counts, rounds: 0, settings: *settings })
    }

    fn reference(&mut self, world: &Arc<World>) -> Option<(Reference, Option<Cache>)> {
        self.has_reference.then(|| (Reference::new(world.clone()), None))
    }

    fn image(&mut self, lights: Lights<'_, FakePhotons>, shot: &CameraShot, _: &Settings) -> FakeImage {
        assert_eq!(lights.photons.is_some(), shot.view.needs_photons());
        assert_eq!(lights.radiosity.is_some(), shot.view.needs_radiosity());
        self.counts.image_starts.fetch_add(1, Ordering::SeqCst);
        let (work, counts) = (self.image.clone(), self.counts.clone());
        FakeImage { work, counts, shot: *shot, steps: 0, light: light(&lights), passes: 1 }
    }

    fn go_on(&mut self, image: &mut FakeImage, lights: Lights<'_, FakePhotons>) {
        image.light = light(&lights);
        image.passes += 1;
    }
}

/// Steps of radiosity or batches of photons that a picture is made of.
fn light(lights: &Lights<'_, FakePhotons>) -> u64 {
    let photons = lights.photons.as_ref().map(|photons| photons.batches);
    photons.or(lights.radiosity.as_ref().map(|solution| solution.steps)).unwrap_or_default()
}

struct Fake {
    work: Arc<Work>,
    counts: Arc<Counts>,
    steps: u64,
    settings: Settings,
    elements: usize,
}

impl Method for Fake {
    fn step(&mut self, cancel: &Cancel) -> Step {
        let step = (self.work)(self.steps, cancel);
        Counts::add(&self.counts.radiosity_steps, step, Step::Advanced);
        self.steps += u64::from(step == Step::Advanced);
        step
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        self.settings.is_same_radiosity(settings)
    }

    fn solution(&self) -> Solution {
        let light = vec![Rgb::ZERO; self.elements];
        Solution {
            steps: self.steps,
            light: ElementLight {
                irradiance: light.clone(),
                direct: light.clone(),
                radiosity: light.clone(),
                unshot: light,
            },
            ..Solution::default()
        }
    }
}

/// A batch a step, ten batches a pass.
pub struct FakePhotons {
    work: Arc<Work>,
    counts: Arc<Counts>,
    steps: u64,
    batches: u64,
    passes: u64,
    settings: Settings,
}

/// Batches of a pass of photons.
pub const BATCHES: u64 = 10;

impl PhotonMethod for FakePhotons {
    fn step(&mut self, cancel: &Cancel) -> Step {
        let photons = self.settings.photons;
        let passes = if photons.is_progressive { photons.passes.into() } else { 1 };
        if self.passes == passes {
            return Step::Converged;
        }
        let step = (self.work)(self.steps, cancel);
        Counts::add(&self.counts.photon_steps, step, Step::Advanced);
        if step == Step::Advanced {
            self.steps += 1;
            self.batches = self.batches % BATCHES + 1;
            self.passes += u64::from(self.batches == BATCHES);
        }
        step
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        // As photons are that are read off in another way.
        let photons = PhotonSettings { kernel: settings.photons.kernel, ..self.settings.photons };
        let is_same = self.settings.seed == settings.seed && photons == settings.photons;
        if is_same {
            self.settings = *settings;
        }
        is_same
    }

    fn progress(&self) -> PhotonProgress {
        PhotonProgress { batches: self.batches, passes: self.passes, is_complete: self.batches == BATCHES }
    }

    fn solution(&mut self) -> PhotonSolution {
        let photon = |batch| Photon {
            position: glam::Vec3::ZERO,
            flux: Rgb::ONE,
            direction: glam::Vec3::NEG_Y,
            side: 0,
            path: Path::LIGHT,
            emission: batch as u32,
        };
        let PhotonProgress { batches, passes, is_complete } = self.progress();
        let photons = Arc::new((0..batches).map(photon).collect());
        PhotonSolution { batches, passes, is_complete, photons, ..PhotonSolution::default() }
    }

    fn irradiance(&mut self, points: &[ProbePoint]) -> Found {
        Found { irradiance: vec![Rgb::ONE; points.len()], variance: None }
    }

    fn count_pass(&mut self, _: &[ProbePoint]) {}

    fn trail(&mut self, photon: &Photon) -> Option<PhotonTrail> {
        let place = TrailPlace { point: photon.position, flux: photon.flux, survival: 1.0, scattering: None };
        Some(PhotonTrail { places: vec![place; photon.emission as usize + 1], escape: None })
    }

    fn gathered(&mut self, point: Vec3A, normal: Vec3A) -> Option<Gathered> {
        assert!(point.x < 1e6, "that is far away");
        let used = (0..self.batches as u32).collect();
        Some(Gathered { point: point.into(), normal: normal.into(), used, ..Gathered::default() })
    }
}

/// A round a step, as many as samples are wanted.
struct FakeOcclusion {
    work: Arc<Work>,
    counts: Arc<Counts>,
    rounds: u32,
    settings: Settings,
}

impl OcclusionMethod for FakeOcclusion {
    fn step(&mut self, cancel: &Cancel) -> Step {
        if self.rounds >= self.settings.image.samples {
            return Step::Converged;
        }
        let step = (self.work)(self.rounds.into(), cancel);
        Counts::add(&self.counts.occlusion_steps, step, Step::Advanced);
        self.rounds += u32::from(step == Step::Advanced);
        step
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        let is_same = self.settings.seed == settings.seed && self.settings.occlusion == settings.occlusion;
        if is_same {
            self.settings = *settings;
        }
        is_same
    }

    fn solution(&self) -> VertexShares {
        VertexShares { rounds: self.rounds, ..VertexShares::default() }
    }
}

/// A coarse pass, then a sample of every pixel a step. `rays` of its images tell of how much light they were made, and
/// their background of how many passes of photons.
pub struct FakeImage {
    work: Arc<Work>,
    counts: Arc<Counts>,
    shot: CameraShot,
    steps: u64,
    light: u64,
    passes: u64,
}

impl ImageMethod for FakeImage {
    fn moved_to(&self, shot: &CameraShot) -> Self {
        self.counts.image_moves.fetch_add(1, Ordering::SeqCst);
        let (work, counts) = (self.work.clone(), self.counts.clone());
        Self { work, counts, shot: *shot, steps: 0, ..*self }
    }

    fn step(&mut self, cancel: &Cancel) -> Step {
        let step = (self.work)(self.steps, cancel);
        Counts::add(&self.counts.image_steps, step, Step::Advanced);
        Counts::add(&self.counts.cancelled_images, step, Step::Cancelled);
        self.steps += u64::from(step == Step::Advanced);
        step
    }

    fn samples(&self) -> u32 {
        self.steps.saturating_sub(1) as u32
    }

    fn is_between_passes(&self) -> bool {
        self.samples() > 0
    }

    fn image(&self) -> Option<CameraImage> {
        let CameraShot { view, camera, size } = self.shot;
        (self.steps > 0).then(|| CameraImage {
            view,
            camera,
            size,
            resolution: if self.steps > 1 { size } else { [1, 1] },
            radiance: vec![Rgb::ZERO],
            coverage: vec![self.passes as f32],
            comparison: None,
            samples: self.samples(),
            rays: self.light,
            bill: Bill::default(),
            elapsed: Duration::ZERO,
            is_complete: false,
        })
    }
}

/// A worker whose radiosity does this work in every step.
pub fn worker(work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Worker {
    method(work).spawn().0
}

/// The workshop of it, for a worker of one's own.
pub fn method(work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Fakes {
    Fakes::default().radiosity(work)
}

/// A step that is over soon.
pub fn short_step(_: u64, _: &Cancel) -> Step {
    // So that a run without an end leaves the machine to others.
    std::thread::sleep(Duration::from_micros(100));
    Step::Advanced
}
