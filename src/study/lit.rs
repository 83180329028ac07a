//! The light that views are read off, computed to its end.

use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::methods::image::Sources;
use crate::methods::photon_map::PhotonMaps;
use crate::methods::radiosity::FullMatrix;
use crate::methods::transport::Transport;
use crate::methods::{Settings, Step};
use crate::solution::{CameraView, Photon, PhotonSolution, Solution};
use crate::worker::{Methods, PhotonRun, Refused, Run, TracedPhotons, Workshop};
use crate::world::World;
use std::sync::Arc;
use std::time::Instant;

/// Light that a recipe has computed, in the world that it was computed in.
#[derive(Clone)]
pub enum Light {
    Radiosity(Arc<World>, Arc<Solution>),
    Photons(Arc<World>, Arc<PhotonSolution>),
}

/// What a view is read off, and what that took.
pub struct Lit {
    pub sources: Sources,
    /// `None` where rays from the camera find all light themselves.
    pub light: Option<Light>,
    pub rays: u64,
    /// Memory that it holds besides the scene.
    pub bytes: u64,
}

/// The light of a view; `None` where there is no time for it.
///
/// # Errors
/// If there is not enough memory.
pub fn light_of(
    world: &Arc<World>,
    view: CameraView,
    settings: &Settings,
    end: Instant,
    cancel: &Cancel,
) -> Result<Option<Lit>, Refused> {
    let transport = Arc::new(Transport::new(world.clone(), settings.effects));
    let mut lit =
        Lit { sources: Sources { transport, radiosity: None, photons: None }, light: None, rays: 0, bytes: 0 };
    if view.needs_radiosity() {
        let Some(solution) = solve(world, settings, end, cancel)? else { return Ok(None) };
        (lit.rays, lit.bytes) = (solution.counters.rays, bytes_of_radiosity(world, settings));
        lit.light = Some(Light::Radiosity(world.clone(), solution.clone()));
        lit.sources.radiosity = Some(solution);
    }
    if view.needs_photons() {
        let mut run = PhotonRun::of(Methods::default().photons(world, settings)?);
        if !trace_pass(&mut run, end, cancel) {
            return Ok(None);
        }
        let (solution, maps) = (run.solution(), run.method().maps());
        (lit.rays, lit.bytes) = (solution.counters.rays, bytes_of_photons(&maps));
        lit.light = Some(Light::Photons(world.clone(), Arc::new(solution)));
        lit.sources.photons = Some(maps);
    }
    Ok(Some(lit))
}

/// Radiosity until its stop rule holds; `None` if there was no time for it.
fn solve(
    world: &Arc<World>,
    settings: &Settings,
    end: Instant,
    cancel: &Cancel,
) -> Result<Option<Arc<Solution>>, Refused> {
    let mut run = Run::start(world.clone(), settings)?;
    loop {
        match run.step(cancel) {
            Step::Converged => return Ok(Some(Arc::new(run.solution()))),
            Step::Cancelled => return Ok(None),
            Step::Prepared | Step::Advanced if Instant::now() >= end => return Ok(None),
            Step::Prepared | Step::Advanced => {}
        }
    }
}

/// All photons of one pass; false if there was no time for them.
pub fn trace_pass(run: &mut PhotonRun<TracedPhotons>, end: Instant, cancel: &Cancel) -> bool {
    loop {
        if Instant::now() >= end || run.step(cancel) != Step::Advanced {
            return false;
        }
        if run.progress().is_complete {
            return true;
        }
    }
}

/// Light of each element and, where it is kept, the matrix.
pub fn bytes_of_radiosity(world: &World, settings: &Settings) -> u64 {
    let light = 4 * size_of::<Rgb>() * world.mesh.elements.len();
    let matrix = if settings.solver.needs_matrix() { FullMatrix::bytes(&world.mesh) } else { 0 };
    light as u64 + matrix
}

/// Photons where they landed, and the tree of them.
pub fn bytes_of_photons(maps: &PhotonMaps) -> u64 {
    (2 * size_of::<Photon>() * maps.kept()) as u64
}
