//! Radiosity by the full matrix: all form factors first, then one of three ways to solve the equations with them.

use super::form_factor::{FormFactors, Outcome};
use super::matrix::{Columns, Matrix};
use super::relax::{Relaxation, System};
use super::simulated;
use super::surfaces::Surfaces;
use crate::cancel::Cancel;
use crate::effects::{Effect, Effects};
use crate::math::rgb::{Rgb, Rgb64};
use crate::mesh::Mesh;
use crate::methods::{Method, Settings, Solver, Step};
use crate::solution::{Counters, Energy, Progress, Solution, missing_share};
use crate::world::World;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Duration;

/// The state of a run.
pub struct FullMatrix {
    world: Arc<World>,
    settings: Settings,
    surfaces: Surfaces,
    stage: Stage,
    counters: Counters,
    steps: u64,
    shooter: Option<u32>,
    /// See [`Solution::bounces`].
    bounces: Vec<Arc<Vec<Rgb>>>,
}

/// Effects that the matrix depends on. Of colours, the number of rays does.
const SHAPING: Effects = Effects::of(&[Effect::Shadows, Effect::Colour, Effect::Escape]);

enum Stage {
    /// Columns are computed, one a step.
    Building(Box<Building>),
    Solving(Box<Matrix>, Relaxation),
}

struct Building {
    method: FormFactors,
    /// Form factor from each element to the present shooter.
    form_factors: Vec<f64>,
    columns: Columns,
}

impl FullMatrix {
    /// A run before its first form factor, in which all light is still in the emitters.
    pub fn new(world: Arc<World>, settings: Settings) -> Self {
        let mesh = &world.mesh;
        let building = Building {
            method: FormFactors::new(mesh, &settings),
            form_factors: vec![0.0; mesh.elements.len()],
            columns: Columns::new(mesh),
        };
        Self {
            surfaces: Surfaces::new(&world, simulated(&world, &settings)),
            stage: Stage::Building(Box::new(building)),
            counters: Counters::default(),
            steps: 0,
            shooter: None,
            bounces: Vec::new(),
            settings,
            world,
        }
    }

    /// Bytes that a run on this mesh takes at most.
    pub fn bytes(mesh: &Mesh) -> u64 {
        Matrix::bytes(mesh)
    }

    fn is_converged(&self, unshot: &[Rgb64]) -> bool {
        self.surfaces.share_of_emitted(unshot) <= self.settings.unshot_limit
    }

    /// Before the first sweep or shot.
    fn begin(&mut self) {
        self.steps = 0;
        self.counters.updates = 0;
        self.shooter = None;
        self.bounces.clear();
        if self.settings.solver == Solver::Jacobi {
            let dark = vec![Rgb64::ZERO; self.world.mesh.elements.len()];
            self.keep_bounce(&dark);
        }
    }

    /// One more column, or, once there are all, the matrix.
    fn build(&mut self, cancel: &Cancel) -> Step {
        let Stage::Building(building) = &mut self.stage else { return Step::Prepared };
        let patch = building.columns.len();
        if patch == self.world.mesh.patches.len() {
            let Ok(matrix) = Matrix::new(&self.world, &building.columns, cancel) else { return Step::Cancelled };
            let relaxation = Relaxation::new(&system(&self.surfaces, &matrix));
            self.stage = Stage::Solving(Box::new(matrix), relaxation);
            self.begin();
            return Step::Prepared;
        }
        if self.surfaces.area[patch] == 0.0 {
            // All of it is covered: it exchanges light with nothing.
            building.form_factors.fill(0.0);
            building.columns.push(&building.form_factors, &Outcome::default());
            return Step::Prepared;
        }
        let shot = self.surfaces.expected_shot(&self.world, patch, self.settings.seed, cancel);
        let outcome = building.method.toward(&shot, &mut building.form_factors);
        if cancel.is_requested() {
            return Step::Cancelled;
        }
        building.columns.push(&building.form_factors, &outcome);
        self.counters += outcome.counters;
        Step::Prepared
    }

    /// One sweep or shot.
    fn relax(&mut self) -> Step {
        let Stage::Solving(matrix, relaxation) = &mut self.stage else { return Step::Prepared };
        let system = system(&self.surfaces, matrix);
        let patches = self.surfaces.area.len() as u64;
        match self.settings.solver {
            Solver::Jacobi => {
                relaxation.jacobi(&system);
                self.counters.updates += patches;
            }
            Solver::GaussSeidel => {
                relaxation.gauss_seidel(&system);
                self.counters.updates += patches;
            }
            Solver::Southwell | Solver::Progressive => {
                let Some(shooter) = relaxation.southwell(&system) else { return Step::Converged };
                self.shooter = Some(shooter as u32);
                self.counters.updates += 1;
            }
        }
        self.steps += 1;
        if self.settings.solver == Solver::Jacobi && self.bounces.len() <= Solution::MAX_BOUNCES {
            let [irradiance, _] = self.irradiance();
            self.keep_bounce(&irradiance);
        }
        Step::Advanced
    }

    fn keep_bounce(&mut self, irradiance: &[Rgb64]) {
        let light = self.surfaces.light(&self.world.mesh, irradiance, &[], &self.surfaces.exitance);
        self.bounces.push(Arc::new(light.radiosity));
    }

    /// E of each element from what patches have sent, and the direct part of it, W/m². Where direct light is not simulated,
    /// there is none.
    fn irradiance(&self) -> [Vec<Rgb64>; 2] {
        let elements = self.world.mesh.elements.len();
        let dark = || vec![Rgb64::ZERO; elements];
        let Stage::Solving(matrix, relaxation) = &self.stage else { return [dark(), dark()] };
        // Whatever a patch sends first, what it emits is a part of it.
        let emitted = |(sent, exitance): (&Rgb64, &Rgb64)| if *sent == Rgb64::ZERO { Rgb64::ZERO } else { *exitance };
        let emitted: Vec<Rgb64> = relaxation.sent().iter().zip(&self.surfaces.exitance).map(emitted).collect();
        if self.surfaces.effects.contains(Effect::DirectLight) {
            return [self.brought(matrix, relaxation.sent()), self.brought(matrix, &emitted)];
        }
        let reflected: Vec<Rgb64> =
            relaxation.sent().iter().zip(&emitted).map(|(sent, emitted)| *sent - *emitted).collect();
        [self.brought(matrix, &reflected), dark()]
    }

    /// E of each element from so much radiosity of each patch, W/m².
    fn brought(&self, matrix: &Matrix, sent: &[Rgb64]) -> Vec<Rgb64> {
        let elements = self.world.mesh.elements.len();
        let sent: Vec<Rgb64> = sent.iter().zip(&matrix.closing).map(|(sent, closing)| *sent * *closing).collect();
        let mut irradiance = vec![Rgb64::ZERO; elements];
        let chunk = elements.div_ceil(4 * rayon::current_num_threads()).max(1);
        // Each element's sum runs over the patches in their order, however the elements are shared out.
        irradiance.par_chunks_mut(chunk).enumerate().for_each(|(index, part)| {
            let range = index * chunk..index * chunk + part.len();
            for (j, sent) in sent.iter().enumerate().filter(|(_, sent)| **sent != Rgb64::ZERO) {
                let (columns, values) = matrix.elements.row(j);
                let start = columns.partition_point(|element| (*element as usize) < range.start);
                let end = columns.partition_point(|element| (*element as usize) < range.end);
                for (&element, &value) in columns[start..end].iter().zip(&values[start..end]) {
                    part[element as usize - range.start] += *sent * f64::from(value);
                }
            }
        });
        irradiance
    }
}

fn system<'a>(surfaces: &'a Surfaces, matrix: &'a Matrix) -> System<'a> {
    System {
        form_factors: &matrix.patches.form_factors,
        closing: &matrix.closing,
        area: &surfaces.area,
        reflectance: &surfaces.bouncing,
        exitance: &surfaces.exitance,
    }
}

impl Method for FullMatrix {
    /// One column of the matrix while it is being built, then one sweep or shot.
    fn step(&mut self, cancel: &Cancel) -> Step {
        match &self.stage {
            Stage::Building(_) => self.build(cancel),
            Stage::Solving(_, relaxation) if self.is_converged(relaxation.unshot()) => Step::Converged,
            Stage::Solving(..) => self.relax(),
        }
    }

    /// The stop rule may change on the way.
    fn configure(&mut self, settings: &Settings) -> bool {
        let same =
            self.settings.is_same_radiosity(settings) && self.surfaces.effects == simulated(&self.world, settings);
        if same {
            self.settings = *settings;
        }
        same
    }

    /// The matrix is the same for all solvers, and with and without most effects.
    fn restart(&mut self, settings: &Settings) -> bool {
        let Settings { solver, unshot_limit, overshoot, .. } = *settings;
        let kept = Settings { solver, unshot_limit, overshoot, ..self.settings };
        let effects = simulated(&self.world, settings);
        let is_same_matrix = effects.among(SHAPING) == self.surfaces.effects.among(SHAPING);
        if !solver.needs_matrix() || !kept.is_same_radiosity(settings) || !is_same_matrix {
            return false;
        }
        self.surfaces = Surfaces::new(&self.world, effects);
        if let Stage::Solving(matrix, relaxation) = &mut self.stage {
            *relaxation = Relaxation::new(&system(&self.surfaces, matrix));
        }
        self.settings = *settings;
        self.begin();
        true
    }

    fn progress(&self) -> Progress {
        let (unshot, irradiance) = match &self.stage {
            Stage::Building(_) => (self.surfaces.exitance.as_slice(), [].as_slice()),
            Stage::Solving(_, relaxation) => (relaxation.unshot(), relaxation.irradiance()),
        };
        let ambient = self.surfaces.ambient(self.surfaces.flux(unshot));
        Progress {
            steps: self.steps,
            updates: self.counters.updates,
            rays: self.counters.rays,
            unshot_share: self.surfaces.share_of_emitted(unshot),
            missing_share: missing_share(ambient, self.surfaces.mean_irradiance(irradiance)),
        }
    }

    fn solution(&self) -> Solution {
        let mesh = &self.world.mesh;
        let [irradiance, direct] = self.irradiance();
        let (unshot, sent, matrix) = match &self.stage {
            Stage::Building(_) => (self.surfaces.exitance.clone(), None, None),
            Stage::Solving(matrix, relaxation) => (relaxation.unshot().to_vec(), Some(relaxation.sent()), Some(matrix)),
        };
        let escaped = sent.zip(matrix).map(|(sent, matrix)| {
            let escaping = sent.iter().zip(&matrix.escaping).map(|(sent, share)| *sent * *share);
            self.surfaces.flux(&escaping.collect::<Vec<_>>())
        });
        let unshot_flux = self.surfaces.flux(&unshot);
        // From the patches, in double precision; what elements get of it is kept in single precision.
        let (absorbed, mean_irradiance) = match &self.stage {
            Stage::Building(_) => (Rgb64::ZERO, 0.0),
            Stage::Solving(_, relaxation) => {
                let irradiance = relaxation.irradiance();
                (self.surfaces.absorbed(irradiance), self.surfaces.mean_irradiance(irradiance))
            }
        };
        let built = match &self.stage {
            Stage::Building(building) => Some(building.columns.len() as f32 / mesh.patches.len().max(1) as f32),
            Stage::Solving(..) => None,
        };
        Solution {
            steps: self.steps,
            elapsed: Duration::ZERO,
            converged: self.is_converged(&unshot),
            energy: Energy {
                emitted: self.surfaces.emitted,
                absorbed,
                unshot: unshot_flux,
                escaped: escaped.unwrap_or(Rgb64::ZERO),
            },
            closure: matrix.map(|matrix| matrix.closure).unwrap_or_default(),
            counters: self.counters,
            unshot_share: self.surfaces.share_of_emitted(&unshot),
            mean_irradiance,
            shooter: self.shooter,
            light: self.surfaces.light(mesh, &irradiance, &direct, &unshot),
            ambient: self.surfaces.ambient(unshot_flux).as_vec3(),
            preparation: built,
            matrix: matrix.map(|matrix| matrix.patches.clone()),
            bounces: self.bounces.clone(),
        }
    }
}
