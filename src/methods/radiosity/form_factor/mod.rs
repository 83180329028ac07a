//! Form factors from all elements to one shooter, by four methods behind one door.
//!
//! Whatever a method computes, what leaves here is finite, in [0, 1], 0 where nothing is seen, and comes with the share
//! of the shooter's flux that leaves the scene. How far a method had to be bent for that is counted.

pub mod centroid;
mod escape;
mod gather;
pub mod hemicube;
mod hemicubes;
pub mod pair;
mod polygon;
mod rays;
mod visibility;

use crate::cancel::Cancel;
use crate::effects::{Effect, Effects};
use crate::mesh::{Mesh, Patch};
use crate::methods::{FormFactorMethod, Settings};
use crate::solution::{Counters, Zero};
use crate::world::World;
use gather::{Receivers, Sight};
pub use hemicubes::Hemicubes;
use polygon::{Kernel, Shooter};
use rays::LightRays;

/// A patch about to shoot.
pub struct Shot<'a> {
    pub world: &'a World,
    /// Index of the shooter among the patches.
    pub patch: u32,
    /// What it shoots, ΔB, over the irradiance that is expected in the end: visibility rays follow it.
    pub relative_radiosity: f64,
    /// Share of the emitted flux that it shoots: light rays follow it.
    pub flux_share: f64,
    /// Those that are simulated.
    pub effects: Effects,
    pub seed: u64,
    /// Tells shots of one run apart.
    pub pass: u64,
    pub cancel: &'a Cancel,
}

impl<'a> Shot<'a> {
    fn shooter(&self) -> &'a Patch {
        &self.world.mesh.patches[self.patch as usize]
    }
}

/// What is known of a shot beside its form factors.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    /// Share of the shooter's flux that leaves the scene, in [0, 1].
    pub escaping: f64,
    /// The work it took. [`Counters::updates`] is not counted here.
    pub counters: Counters,
}

/// A method of computing form factors, with the memory that it needs for a scene.
pub struct FormFactors {
    settings: Settings,
    receivers: Receivers,
    light_rays: LightRays,
    hemicubes: Hemicubes,
}

impl FormFactors {
    pub fn new(mesh: &Mesh, settings: &Settings) -> Self {
        Self {
            settings: *settings,
            receivers: Receivers::new(mesh),
            light_rays: LightRays::default(),
            hemicubes: Hemicubes::new(mesh, settings),
        }
    }

    /// Fills `form_factors`, one an element, with F from each element to the shooter, in [0, 1]. If cancelled, some keep
    /// their old values.
    pub fn toward(&mut self, shot: &Shot, form_factors: &mut [f64]) -> Outcome {
        let outcome = match self.settings.form_factor {
            FormFactorMethod::Centroid => self.estimate(shot, Kernel::Centroid, form_factors),
            FormFactorMethod::Disc => self.estimate(shot, Kernel::Disc, form_factors),
            FormFactorMethod::Polygon => self.estimate(shot, Kernel::Polygon, form_factors),
            FormFactorMethod::Rays => self.light_rays.shoot(shot, self.settings.light_rays, form_factors),
            FormFactorMethod::Hemicube => self.hemicubes.look(shot, self.settings.shadow_rays, form_factors),
        };
        // Whoever looks for no way out finds none.
        if shot.effects.contains(Effect::Escape) { outcome } else { Outcome { escaping: 0.0, ..outcome } }
    }

    /// A formula, times the share of shadow rays that arrive.
    fn estimate(&self, shot: &Shot, kernel: Kernel, form_factors: &mut [f64]) -> Outcome {
        let sight = Sight::new(shot, kernel, self.settings.shadow_rays);
        let mut counters = self.receivers.gather(&sight, form_factors);
        if !shot.effects.contains(Effect::Escape) {
            counters.bill.save(Effect::Escape, escape::RAYS.into());
            return Outcome { escaping: 0.0, counters };
        }
        if counters.form_factors == 0 {
            // Nothing faces the shooter.
            return Outcome { escaping: 1.0, counters };
        }
        counters.escape_rays += u64::from(escape::RAYS);
        counters.rays += u64::from(escape::RAYS);
        counters.bill.spend(Effect::Escape, escape::RAYS.into());
        Outcome { escaping: escape::share(shot), counters }
    }
}

/// Tells of receivers why no two points of them and the shooter face each other, or `None` if some do.
pub fn out_of_sight(world: &World, shooter: &Patch) -> impl Fn(&Patch) -> Option<Zero> {
    let (shooter, tolerance) = (Shooter::new(shooter), plane_tolerance(world));
    move |receiver| shooter.out_of_sight(receiver, tolerance)
}

/// Planes that are nearer than this are one plane, m.
pub fn plane_tolerance(world: &World) -> f32 {
    2.0 * world.tracer.offset()
}

/// F in [0, 1], and whether it had to be cut down for that.
fn clamped(form_factor: f64) -> (f64, bool) {
    if form_factor > 1.0 { (1.0, true) } else { (form_factor, false) }
}
