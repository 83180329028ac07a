//! Radiosity: light between diffuse patches as a system of linear equations, B_i = M_i + ρ_i Σ_j F_ij B_j (Goral, Torrance,
//! Greenberg, Battaile 1984). Form factors come from [`form_factor`]; they are either computed when a patch shoots
//! ([`Progressive`]) or all of them first ([`FullMatrix`]).

mod balance;
mod equation;
pub mod form_factor;
mod full_matrix;
mod ledger;
mod matrix;
mod pick;
mod progressive;
mod relax;
mod sensor;
mod surfaces;

pub use balance::PickedLight;
pub use equation::Points;
pub use full_matrix::FullMatrix;
pub use pick::pick;
pub use progressive::Progressive;
pub use relax::{Relaxation, System};
pub use sensor::irradiance_in_space;
pub use surfaces::mean_indirect_irradiance;

use crate::effects::{Effect, Effects, needed};
use crate::methods::{Method, Settings, Solver, repertoire};
use crate::world::World;
use std::sync::Arc;

/// The effects that radiosity simulates in a world. Form factors are shown where there is no light, too, so that shadows
/// count there.
pub fn simulated(world: &World, settings: &Settings) -> Effects {
    let needed = needed(world);
    let needed = if world.has_occluders { needed.and(Effects::of(&[Effect::Shadows])) } else { needed };
    settings.effects.among(repertoire::of_radiosity(settings.form_factor)).simulated(needed)
}

/// A run of the solver that the settings ask for, in which all light is still in the emitters.
pub fn start(world: Arc<World>, settings: &Settings) -> Box<dyn Method> {
    match settings.solver {
        Solver::Progressive => Box::new(Progressive::new(world, *settings)),
        Solver::Jacobi | Solver::GaussSeidel | Solver::Southwell => Box::new(FullMatrix::new(world, *settings)),
    }
}
