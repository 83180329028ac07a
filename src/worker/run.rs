//! A method with a clock.

use super::workshop::{OcclusionMethod, PhotonMethod, PhotonProgress};
use crate::cancel::Cancel;
use crate::clock::{Clock, Stopwatch};
use crate::effects::Effect;
use crate::mesh::Patch;
use crate::methods::photon_map::MAX_BOUNCES;
use crate::methods::radiosity::{self, FullMatrix};
use crate::methods::transport::Transport;
use crate::methods::{Method, PhotonSettings, Settings, Step};
use crate::scene::Lobes;
use crate::solution::{Photon, PhotonSolution, Progress, Solution, VertexShares};
use crate::world::World;
use std::sync::Arc;
use std::time::Duration;

/// 2 GiB
const CAREFUL_GUESS: u64 = 2 << 30;

/// A photon where it landed is handed out and being added to at the same time, and is in a tree.
const BYTES_PER_LANDING: u64 = 2 * size_of::<Photon>() as u64 + 40;
/// Film and picture, byte by byte: sums over samples 20, means of them 16, in a texture and on the way from it 32, and then in
/// linear radiance 16, as sRGB 4 and encoded 16.
const BYTES_PER_PIXEL: u64 = 104;

/// A method at work, and the time that its steps took.
pub struct Run {
    method: Box<dyn Method>,
    watch: Stopwatch,
    /// The part of its time that went into what can be kept for another start.
    preparation: Duration,
}

impl Run {
    /// A run of the method that the settings ask for, before its first step.
    ///
    /// # Errors
    /// If it needs more memory than there is.
    pub fn start(world: Arc<World>, settings: &Settings) -> Result<Self, Refused> {
        Ok(Self::of(start_method(world, settings)?))
    }

    /// A run of this method, before its first step.
    pub fn of(method: Box<dyn Method>) -> Self {
        Self { method, watch: Stopwatch::default(), preparation: Duration::ZERO }
    }

    /// The same before its first step, timed by this clock.
    #[must_use]
    pub fn with_clock(self, clock: Clock) -> Self {
        Self { watch: Stopwatch::new(clock), ..self }
    }

    /// One step on the clock.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        let step = self.watch.time(|| self.method.step(cancel));
        if step == Step::Prepared {
            self.preparation = self.watch.elapsed();
        }
        step
    }

    /// Starts over with what is prepared, which keeps its price; false if these settings need another preparation.
    pub fn restart(&mut self, settings: &Settings) -> bool {
        let is_kept = self.method.restart(settings);
        if is_kept {
            self.watch.turn_back(self.preparation);
        }
        is_kept
    }

    /// Takes new settings over; false if they need a new run.
    pub fn configure(&mut self, settings: &Settings) -> bool {
        self.method.configure(settings)
    }

    pub fn elapsed(&self) -> Duration {
        self.watch.elapsed()
    }

    /// How far the method has come.
    pub fn progress(&self) -> Progress {
        self.method.progress()
    }

    /// What the method knows, with the time that it took.
    pub fn solution(&self) -> Solution {
        Solution { elapsed: self.watch.elapsed(), ..self.method.solution() }
    }
}

/// Photons at work, and the time that their steps took.
pub struct PhotonRun<P> {
    method: P,
    watch: Stopwatch,
}

impl<P: PhotonMethod> PhotonRun<P> {
    /// A run of this method, before its first step.
    pub fn of(method: P) -> Self {
        Self { method, watch: Stopwatch::default() }
    }

    /// The same before its first step, timed by this clock.
    #[must_use]
    pub fn with_clock(self, clock: Clock) -> Self {
        Self { watch: Stopwatch::new(clock), ..self }
    }

    /// One step on the clock.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        self.watch.time(|| self.method.step(cancel))
    }

    /// Takes new settings over; false if they need a new run.
    pub fn configure(&mut self, settings: &Settings) -> bool {
        self.method.configure(settings)
    }

    pub fn progress(&self) -> PhotonProgress {
        self.method.progress()
    }

    pub fn elapsed(&self) -> Duration {
        self.watch.elapsed()
    }

    pub fn method(&mut self) -> &mut P {
        &mut self.method
    }

    /// What the photons brought, with the time that it took.
    pub fn solution(&mut self) -> PhotonSolution {
        PhotonSolution { elapsed: self.watch.elapsed(), ..self.method.solution() }
    }
}

/// Ambient occlusion on the mesh at work, and the time that its steps took.
pub struct OcclusionRun {
    method: Box<dyn OcclusionMethod>,
    watch: Stopwatch,
}

impl OcclusionRun {
    /// A run of this method, before its first step.
    pub fn of(method: Box<dyn OcclusionMethod>) -> Self {
        Self { method, watch: Stopwatch::default() }
    }

    /// The same before its first step, timed by this clock.
    #[must_use]
    pub fn with_clock(self, clock: Clock) -> Self {
        Self { watch: Stopwatch::new(clock), ..self }
    }

    /// One step on the clock.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        self.watch.time(|| self.method.step(cancel))
    }

    /// Takes new settings over; false if they need a new run.
    pub fn configure(&mut self, settings: &Settings) -> bool {
        self.method.configure(settings)
    }

    /// What is known, with the time that it took.
    pub fn solution(&self) -> VertexShares {
        VertexShares { elapsed: self.watch.elapsed(), ..self.method.solution() }
    }
}

/// Why a run cannot begin.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    #[error(
        "the matrix of {patches} patches and {elements} elements needs up to {needed_mib} MiB, and {available_mib} MiB are \
         free; larger elements or progressive radiosity need less"
    )]
    Memory { patches: usize, elements: usize, needed_mib: u64, available_mib: u64 },
    #[error(
        "{photons} photons are expected to land {landings} times and then need {needed_mib} MiB, and {available_mib} MiB \
         are free; fewer photons need less"
    )]
    Photons { photons: u64, landings: u64, needed_mib: u64, available_mib: u64 },
    #[error(
        "a picture of {width} × {height} pixels needs {needed_mib} MiB, and {available_mib} MiB are free; a smaller size \
         needs less"
    )]
    Picture { width: u32, height: u32, needed_mib: u64, available_mib: u64 },
}

/// The method that the settings ask for.
///
/// # Errors
/// If it needs more memory than there is.
pub fn start_method(world: Arc<World>, settings: &Settings) -> Result<Box<dyn Method>, Refused> {
    if settings.solver.needs_matrix() {
        let needed = FullMatrix::bytes(&world.mesh);
        let available = available_memory();
        if needed > available {
            return Err(Refused::Memory {
                patches: world.mesh.patches.len(),
                elements: world.mesh.elements.len(),
                needed_mib: needed >> 20,
                available_mib: available >> 20,
            });
        }
    }
    Ok(radiosity::start(world, settings))
}

/// Whether there is room for the photons of a pass.
///
/// # Errors
/// If there is not.
pub fn check_photons(transport: &Transport, settings: &PhotonSettings) -> Result<(), Refused> {
    let world = &transport.world;
    let has_caustics = transport.effects.contains(Effect::Caustics);
    let caustic = if has_caustics { u64::from(settings.caustic_count) } else { 0 };
    let photons = u64::from(settings.count) + caustic;
    // Photons of the caustic map end where they land first on what is not specular.
    let landings = f64::from(settings.count) * landings_per_photon(world, Lobes::reflectance)
        + caustic as f64 * landings_per_photon(world, Lobes::specular_reflectance);
    let landings = landings as u64;
    let (needed, available) = (landings.saturating_mul(BYTES_PER_LANDING), available_memory());
    if needed > available {
        return Err(Refused::Photons { photons, landings, needed_mib: needed >> 20, available_mib: available >> 20 });
    }
    Ok(())
}

/// Whether there is room for a picture of this width and height in pixels, from its film to its file.
///
/// # Errors
/// If there is not.
pub fn check_picture(size: [u32; 2]) -> Result<(), Refused> {
    check_picture_in(size, available_memory())
}

/// The same where so many bytes are free.
fn check_picture_in([width, height]: [u32; 2], available: u64) -> Result<(), Refused> {
    let needed = (u64::from(width) * u64::from(height)).saturating_mul(BYTES_PER_PIXEL);
    if needed > available {
        return Err(Refused::Picture { width, height, needed_mib: needed >> 20, available_mib: available >> 20 });
    }
    Ok(())
}

/// How often a photon arrives at a surface until it is absorbed, where it meets all of them alike: Σ rⁿ, with the share r
/// that goes on.
fn landings_per_photon(world: &World, goes_on: fn(&Lobes) -> f32) -> f64 {
    let materials = &world.scene.materials;
    let share = |patch: &Patch| f64::from(goes_on(&materials[patch.material as usize].lobes()));
    let area = world.mesh.area();
    let kept: f64 = world.mesh.patches.iter().map(|patch| patch.area * share(patch)).sum();
    if area > 0.0 { landings((kept / area).min(1.0)) } else { 1.0 }
}

/// Σ ρⁿ over all bounces.
fn landings(reflectance: f64) -> f64 {
    if reflectance < 1.0 {
        (1.0 - reflectance.powi(MAX_BOUNCES as i32)) / (1.0 - reflectance)
    } else {
        MAX_BOUNCES as f64
    }
}

/// Bytes that can be had without pushing anything out of memory, or a careful guess where the system does not say.
fn available_memory() -> u64 {
    sysinfo::System::new().map_or(CAREFUL_GUESS, |mut system| {
        system.refresh_memory();
        system.available_memory()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nothing is allocated for any of these.
    #[test]
    fn a_picture_that_does_not_fit_is_refused_by_what_it_needs() {
        assert!(check_picture_in([1024, 1024], 104 << 20).is_ok());
        let refused = check_picture_in([1024, 1024], (104 << 20) - 1).expect_err("a byte is missing").to_string();
        assert_eq!(
            refused,
            "a picture of 1024 × 1024 pixels needs 104 MiB, and 103 MiB are free; a smaller size needs less"
        );
        assert!(check_picture_in([u32::MAX; 2], u64::MAX - 1).is_err());
        // 2^64 pixels are more than any machine has room for.
        assert!(matches!(check_picture([u32::MAX; 2]), Err(Refused::Picture { .. })));
    }

    #[test]
    fn landings_are_a_geometric_series_that_ends_with_the_bounces() {
        assert_eq!([0.0, 0.5].map(landings), [1.0, 2.0]);
        assert!((landings(0.999) / 1000.0 - 1.0).abs() < 1e-6);
        // Σ ρⁿ = (1 - ρᴺ) / (1 - ρ), close to N as ρ comes close to 1.
        assert!((landings(1.0 - 1e-9) / MAX_BOUNCES as f64 - 1.0).abs() < 1e-4);
        assert_eq!(landings(1.0), MAX_BOUNCES as f64);
    }
}
