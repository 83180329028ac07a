//! Photon mapping (Jensen 1996, 2001): photons are traced from the emitters and kept where they land on diffuse surfaces;
//! where they are dense, there is much light. Irradiance does not depend on what a surface reflects: where photons arrive at
//! black surfaces, mirrors and glass they are kept as well, apart from the others, for estimates there.
//!
//! - `trace` follows one photon, `batch` many, `tally` keeps their books, `trail` follows one again.
//! - `tree` and `nearest` find the photons near a point.
//! - `facet`, `ground`, `border` and `horizon` tell which of them landed on the same surface, and where that ends.
//! - `maps` puts the two together into an estimate (`density`, `kernel`), and `radius` says over how large a disc.
//!
//! With shading normals, photons are scattered round them, none of them into the polygon, but what they carry is counted on the
//! true surface: irradiance is that of the polygon.

mod batch;
mod border;
mod density;
mod facet;
mod ground;
mod horizon;
mod kernel;
mod maps;
mod nearest;
mod points;
mod radius;
mod tally;
mod trace;
mod trail;
mod tree;

pub use density::Estimate;
pub use maps::{PhotonFilter, PhotonMaps, Scratch, Which};
pub use nearest::Nearest;
pub use points::ProgressivePoints;
pub use trace::MAX_BOUNCES;
pub use trail::trail;
pub use tree::{Entry, Found, Tree};

use crate::cancel::{Cancel, Cancelled};
use crate::effects::Effect;
use crate::math::rgb::Rgb;
use crate::methods::transport::Transport;
use crate::methods::{PhotonSettings, Settings, Step, repertoire};
use crate::solution::{Photon, PhotonSolution, PhotonTrail};
use batch::Batch;
use ground::Ground;
use maps::{Emitted, Gathering, Kept, Stock, Trees};
use std::ops::Range;
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use tally::Tally;
use trace::{MapKind, Shower};

/// Photons of a batch, unless they bounce for long.
const BATCH: u64 = 1 << 14;
/// Rays of a batch, at most, as far as those before it tell.
const RAYS_PER_BATCH: f64 = (1 << 17) as f64;
/// Photons are handed out, and put into trees, when their number has grown by this factor: in all they are copied a few
/// times only, however many there are.
const GROWTH: f64 = 1.25;
/// Where no radius is set, the disc of an estimate may become so many times as large as one that holds the wanted number
/// of photons where light is as bright as on average.
const LARGEST_DISC: f64 = 4.0;
/// No disc is larger than one of this share of the scene's radius.
const LARGEST_RADIUS: f32 = 0.25;

/// Photon mapping as state and a step.
pub struct PhotonMapping {
    transport: Arc<Transport>,
    settings: Settings,
    /// Whether photons of caustics have a map of their own.
    has_caustic_map: bool,
    /// Area on which photons can land, m²: of diffuse surfaces, or of all where none is diffuse.
    area: f64,
    ground: Arc<OnceLock<Arc<Ground>>>,
    /// The present pass, from 0.
    pass: u64,
    /// How far the present pass is, in [0, `PhotonMapping::length`].
    position: u64,
    batches: u64,
    tally: Tally,
    /// As handed out.
    photons: Kept,
    /// How far the pass was when they were.
    shown_position: u64,
    /// Those that came since: on diffuse surfaces, and on others.
    fresh: [Vec<Photon>; 2],
    /// Radius of the first pass, m, once it is known.
    first_radius: Option<f32>,
    maps: OnceLock<Arc<PhotonMaps>>,
}

impl PhotonMapping {
    pub fn new(transport: Arc<Transport>, settings: &Settings) -> Self {
        let is_diffuse = |material: u32| transport.lobes(material).diffuse != Rgb::ZERO;
        let patches = &transport.world.mesh.patches;
        let landing: f64 = patches.iter().filter(|patch| is_diffuse(patch.material)).map(|patch| patch.area).sum();
        Self {
            has_caustic_map: transport.effects.contains(Effect::Caustics) && settings.photons.caustic_count > 0,
            area: if landing > 0.0 { landing } else { transport.world.mesh.area() },
            ground: Arc::default(),
            settings: *settings,
            pass: 0,
            position: 0,
            batches: 0,
            tally: Tally::default(),
            photons: Kept::default(),
            shown_position: 0,
            fresh: Default::default(),
            first_radius: None,
            maps: OnceLock::new(),
            transport,
        }
    }

    /// Traces one batch of photons, all of it or nothing. When the photons of a pass are all there, the next step begins the
    /// next pass, if there is one.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        if self.transport.emitters().is_empty() || self.is_pass_complete() && !self.has_more_passes() {
            return Step::Converged;
        }
        let begins = self.is_pass_complete();
        let (pass, from) = if begins { (self.pass + 1, 0) } else { (self.pass, self.position) };
        let to = (from + self.batch_size()).min(self.length());
        let Ok(parts) = self.trace(pass, from, to, cancel) else { return Step::Cancelled };
        if begins {
            self.begin(pass);
        }
        for mut part in parts {
            self.tally.merge(&part.tally);
            self.fresh[0].append(&mut part.photons);
            self.fresh[1].append(&mut part.arrivals);
        }
        if !self.transport.effects.contains(Effect::Caustics) {
            let skipped = |position| u64::from(self.settings.photons.caustic_count) * position / self.length();
            self.tally.save(Effect::Caustics, skipped(to) - skipped(from));
        }
        self.position = to;
        self.batches += 1;
        let (kept, fresh) = (self.photons.len(), self.fresh.iter().map(Vec::len).sum::<usize>());
        let grown = (kept + fresh) as f64 >= GROWTH * kept as f64;
        if self.is_pass_complete() || (grown && fresh > 0) {
            self.show();
        }
        Step::Advanced
    }

    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Takes settings over that need no other photons; false, and nothing changes, if they do.
    pub fn configure(&mut self, settings: &Settings) -> bool {
        let (old, new) = (&self.settings.photons, &settings.photons);
        let PhotonSettings { count, caustic_count, is_progressive, .. } = *old;
        // Passes whose radii do not belong together have no mean.
        let keeps_radii = !is_progressive || (old.nearest, old.max_radius) == (new.nearest, new.max_radius);
        let effects = settings.effects.simulated_in(&self.transport.world).among(repertoire::of_photons());
        let same = PhotonSettings { count, caustic_count, is_progressive, ..*new } == *new
            && self.settings.seed == settings.seed
            && self.transport.effects.among(repertoire::of_photons()) == effects;
        if !(same && keeps_radii) {
            return false;
        }
        self.settings = *settings;
        let trees = self.maps.get().map(|maps| maps.trees.clone());
        self.maps = OnceLock::new();
        if let Some(trees) = trees {
            let _ = self.maps.set(Arc::new(PhotonMaps { trees, gathering: self.gathering() }));
        }
        true
    }

    /// What is known so far. Its `elapsed` is zero: whoever steps the method holds the clock. While photons are still
    /// coming, those handed out may be fewer than the counters say, by up to a fifth. Splits are there once the tree is,
    /// which is built when the photons of a pass are complete, or when [`PhotonMapping::maps`] asks for it.
    pub fn solution(&self) -> PhotonSolution {
        let is_complete = self.is_pass_complete();
        let maps = if is_complete { Some(self.maps()) } else { self.maps.get().cloned() };
        PhotonSolution {
            batches: self.batches,
            passes: self.passes(),
            elapsed: Duration::ZERO,
            is_complete,
            photons: self.photons.landed.clone(),
            splits: maps.map(|maps| maps.splits().clone()).unwrap_or_default(),
            max_radius: self.gathering().max_radius,
            energy: self.tally.energy,
            counters: self.tally.counters(),
        }
    }

    /// The photons in trees, built when they are first asked for and kept until there are more.
    pub fn maps(&self) -> Arc<PhotonMaps> {
        self.maps
            .get_or_init(|| Arc::new(PhotonMaps { trees: Arc::new(self.trees()), gathering: self.gathering() }))
            .clone()
    }

    /// The whole way of a photon of the present pass.
    pub fn trail(&self, photon: &Photon) -> PhotonTrail {
        let is_caustic = self.has_caustic_map && photon.path.is_caustic();
        trail(&self.transport, &self.settings, self.pass, photon.emission, is_caustic)
    }

    fn trees(&self) -> Trees {
        let ground = self.ground.get_or_init(|| Arc::new(Ground::new(&self.transport))).clone();
        let emitted = |kind| {
            let count = self.photons_up_to(kind, self.shown_position);
            Emitted { count, scale: if count > 0 { self.count(kind) as f32 / count as f32 } else { 0.0 } }
        };
        let stock = Stock {
            photons: self.photons.clone(),
            has_caustic_map: self.has_caustic_map,
            emitted: [emitted(MapKind::Global), emitted(MapKind::Caustic)],
            is_complete: self.shown_position == self.length(),
        };
        Trees::new(self.transport.clone(), ground, stock)
    }

    fn gathering(&self) -> Gathering {
        let PhotonSettings { nearest, kernel, is_progressive, .. } = self.settings.photons;
        if is_progressive {
            let first = self.first_radius.unwrap_or_else(|| self.radius(1.0));
            let max_radius = (f64::from(first) * radius::shrinkage(self.pass)) as f32;
            return Gathering { nearest: None, kernel, max_radius };
        }
        // Of k photons within, k − 1 count.
        Gathering { nearest: Some(nearest.max(2) as usize), kernel, max_radius: self.radius(LARGEST_DISC) }
    }

    /// The radius that was set, or that of a disc which is so many times as large as one that holds the wanted number of
    /// photons on average, m.
    fn radius(&self, times: f64) -> f32 {
        let PhotonSettings { nearest, max_radius, .. } = self.settings.photons;
        max_radius.unwrap_or_else(|| {
            let is_all_dark = self.photons.landed.is_empty();
            let landings = if is_all_dark { self.photons.len() } else { self.photons.landed.len() };
            let radius = radius::radius_for(times * f64::from(nearest), landings as f64, self.area);
            (radius as f32).min(LARGEST_RADIUS * self.transport.world.bounds.radius())
        })
    }

    fn trace(&self, pass: u64, from: u64, to: u64, cancel: &Cancel) -> Result<Vec<Batch>, Cancelled> {
        let trace = |kind| {
            let photons: Range<u64> = self.photons_up_to(kind, from)..self.photons_up_to(kind, to);
            let shower = Shower::new(&self.transport, &self.settings, pass, kind);
            let keeps_caustics = self.transport.effects.contains(Effect::Caustics) && !self.has_caustic_map;
            Batch::trace(&shower, photons, keeps_caustics, cancel)
        };
        let mut parts = trace(MapKind::Global)?;
        parts.append(&mut trace(MapKind::Caustic)?);
        Ok(parts)
    }

    /// Forgets the photons of the pass before.
    fn begin(&mut self, pass: u64) {
        self.pass = pass;
        self.batches = 0;
        self.tally = Tally::default();
        self.photons = Kept::default();
        self.maps = OnceLock::new();
    }

    /// Hands the fresh photons out.
    fn show(&mut self) {
        let [landed, arrived] = &mut self.fresh;
        append(&mut self.photons.landed, landed);
        append(&mut self.photons.arrived, arrived);
        self.shown_position = self.position;
        self.maps = OnceLock::new();
        if self.is_pass_complete() && self.first_radius.is_none() {
            self.first_radius = Some(self.radius(1.0));
        }
    }

    /// Batches of the present pass.
    pub fn batches(&self) -> u64 {
        self.batches
    }

    /// Passes that are done.
    pub fn passes(&self) -> u64 {
        self.pass + u64::from(self.is_pass_complete())
    }

    /// Whether all photons of the present pass are there.
    pub fn is_pass_complete(&self) -> bool {
        self.position == self.length() || self.transport.emitters().is_empty()
    }

    fn has_more_passes(&self) -> bool {
        let PhotonSettings { is_progressive, passes, .. } = self.settings.photons;
        is_progressive && self.pass + 1 < u64::from(passes)
    }

    /// Photons of the larger of the two maps: both grow alike.
    fn length(&self) -> u64 {
        self.count(MapKind::Global).max(self.count(MapKind::Caustic))
    }

    /// Photons that a map emits.
    fn count(&self, kind: MapKind) -> u64 {
        match kind {
            MapKind::Global => self.settings.photons.count.into(),
            MapKind::Caustic if self.has_caustic_map => self.settings.photons.caustic_count.into(),
            MapKind::Caustic => 0,
        }
    }

    /// How many photons of a map are emitted when the pass has come to a position.
    fn photons_up_to(&self, kind: MapKind, position: u64) -> u64 {
        if position == 0 { 0 } else { self.count(kind) * position / self.length() }
    }

    /// As many photons as the rays so far allow, in powers of two so that the first of a sequence stay together.
    fn batch_size(&self) -> u64 {
        let counts = self.tally.counts();
        let rays = counts.rays as f64 / (counts.emitted + counts.caustic_emitted).max(1) as f64;
        let photons = (RAYS_PER_BATCH / rays.max(1.0)) as u64;
        if photons >= BATCH { BATCH } else { (1 << photons.max(1).ilog2()).max(256) }
    }
}

/// Moves `fresh` to the end, in a copy where others still read what was there.
fn append(photons: &mut Arc<Vec<Photon>>, fresh: &mut Vec<Photon>) {
    match Arc::get_mut(photons) {
        Some(photons) => photons.append(fresh),
        None if fresh.is_empty() => {}
        None => {
            let mut copy = Vec::with_capacity(photons.len() + fresh.len());
            copy.extend_from_slice(photons);
            copy.append(fresh);
            *photons = Arc::new(copy);
        }
    }
}
