//! Radiosity by progressive refinement (Cohen, Chen, Wallace, Greenberg 1988): again and again the patch with the most
//! unshot flux shoots it at all elements. As a way to solve linear equations this is Southwell's relaxation (Gortler,
//! Cohen, Slusallek 1993).

use super::form_factor::{FormFactors, Outcome, Shot};
use super::ledger::Ledger;
use super::simulated;
use super::surfaces::Surfaces;
use crate::cancel::Cancel;
use crate::effects::Effect;
use crate::math::rgb::{Rgb64, total};
use crate::mesh::Mesh;
use crate::methods::{Method, Settings, Step};
use crate::solution::{Counters, Energy, Progress, Solution, missing_share};
use crate::world::World;
use std::borrow::Cow;
use std::sync::Arc;
use std::time::Duration;

/// The state of a run. Patches shoot, elements receive.
pub struct Progressive {
    world: Arc<World>,
    settings: Settings,
    surfaces: Surfaces,
    method: FormFactors,
    /// ΔB of each patch, W/m². Below 0 where more was shot than had arrived.
    unshot: Vec<Rgb64>,
    /// E of each element, W/m².
    irradiance: Vec<Rgb64>,
    direct: DirectLight,
    /// Form factor from each element to the present shooter, with visibility.
    form_factors: Vec<f64>,
    ledger: Ledger,
    counters: Counters,
    /// Mean irradiance to be expected in the end, W/m² summed over RGB.
    expected_irradiance: f64,
    shooter: Option<u32>,
}

/// The part of light that comes straight from the emitters.
struct DirectLight {
    /// M_e of each patch that it has not shot yet, W/m².
    exitance: Vec<Rgb64>,
    /// E of each element, W/m².
    irradiance: Vec<Rgb64>,
}

impl Progressive {
    /// A run in which all light is still in the emitters.
    pub fn new(world: Arc<World>, settings: Settings) -> Self {
        let surfaces = Surfaces::new(&world, simulated(&world, &settings));
        let elements = world.mesh.elements.len();
        let dark = vec![Rgb64::ZERO; elements];
        let direct = DirectLight { exitance: surfaces.exitance.clone(), irradiance: dark.clone() };
        Self {
            unshot: surfaces.exitance.clone(),
            irradiance: dark,
            direct,
            form_factors: vec![0.0; elements],
            ledger: Ledger::default(),
            counters: Counters::default(),
            expected_irradiance: total(surfaces.ambient(surfaces.emitted)),
            shooter: None,
            method: FormFactors::new(&world.mesh, &settings),
            surfaces,
            settings,
            world,
        }
    }

    /// The patch with the most unshot flux, whatever its sign; of equals the first. `None` where there is nothing left.
    fn brightest(&self) -> Option<usize> {
        let fluxes = self.unshot.iter().zip(&self.surfaces.area).map(|(unshot, area)| total(unshot.abs()) * area);
        let brightest = fluxes.enumerate().reduce(|best, next| if next.1 > best.1 { next } else { best });
        brightest.filter(|&(_, flux)| flux > 0.0).map(|(patch, _)| patch)
    }

    /// E of each element as it is shown, and the direct part of it, W/m².
    fn shown_irradiance(&self) -> [Cow<'_, [Rgb64]>; 2] {
        let direct = &self.direct.irradiance;
        if self.surfaces.effects.contains(Effect::DirectLight) {
            return [Cow::Borrowed(&self.irradiance), Cow::Borrowed(direct)];
        }
        // Of what is direct alone, rounding must leave nothing below 0.
        let indirect = self.irradiance.iter().zip(direct).map(|(all, direct)| (*all - *direct).max(Rgb64::ZERO));
        [Cow::Owned(indirect.collect()), Cow::Owned(vec![Rgb64::ZERO; direct.len()])]
    }

    fn has_converged(&self) -> bool {
        self.surfaces.share_of_emitted(&self.unshot) <= self.settings.unshot_limit
    }

    /// What the patch shoots, W/m²: its unshot radiosity. Overshooting (Feda, Purgathofer 1992) adds what the patch will
    /// reflect of the light that is still on its way, if that spreads evenly; it need not shoot again for that.
    fn radiosity_to_shoot(&self, patch: usize) -> Rgb64 {
        let unshot = self.unshot[patch];
        if !self.settings.overshoot || total(unshot) <= 0.0 {
            return unshot;
        }
        let ambient = self.surfaces.ambient(self.surfaces.flux(&self.unshot)).max(Rgb64::ZERO);
        unshot + self.surfaces.bouncing[patch] * ambient
    }

    /// Hands the shooter's flux to the elements and to the void.
    fn receive(&mut self, patch: usize, radiosity: Rgb64, escaping: f64) {
        self.unshot[patch] -= radiosity;
        let Mesh { patches, elements, .. } = &self.world.mesh;
        let area = self.surfaces.area[patch];
        let row = row_sum(&self.world.mesh, &self.form_factors) / area;
        let closing = self.ledger.close_row(radiosity * area, row, escaping);
        let scaled = radiosity * closing;
        let emitted = std::mem::take(&mut self.direct.exitance[patch]) * closing;
        if emitted != Rgb64::ZERO {
            for (irradiance, form_factor) in self.direct.irradiance.iter_mut().zip(&self.form_factors) {
                *irradiance += emitted * *form_factor;
            }
        }
        let reflecting = self.surfaces.bouncing.iter().zip(&self.surfaces.area);
        for ((receiver, unshot), (reflectance, area)) in patches.iter().zip(&mut self.unshot).zip(reflecting) {
            let range = receiver.elements.start as usize..receiver.elements.end as usize;
            let mut received = Rgb64::ZERO;
            for index in range {
                let form_factor = self.form_factors[index];
                if form_factor > 0.0 {
                    let irradiance = scaled * form_factor;
                    self.irradiance[index] += irradiance;
                    received += irradiance * elements[index].area;
                }
            }
            if *area > 0.0 {
                *unshot += *reflectance * received / *area;
            }
        }
    }
}

/// Σ A_e F_e, m², in one fixed order.
fn row_sum(mesh: &Mesh, form_factors: &[f64]) -> f64 {
    mesh.elements.iter().zip(form_factors).map(|(element, form_factor)| element.area * form_factor).sum()
}

impl Method for Progressive {
    /// One shot. It takes at most (number of elements) · (visibility rays) shadow rays.
    fn step(&mut self, cancel: &Cancel) -> Step {
        if self.has_converged() {
            return Step::Converged;
        }
        let Some(patch) = self.brightest() else { return Step::Converged };
        let radiosity = self.radiosity_to_shoot(patch);
        let amount = total(radiosity.abs());
        let world = self.world.clone();
        let shot = Shot {
            world: &world,
            patch: patch as u32,
            relative_radiosity: amount / self.expected_irradiance,
            flux_share: amount * self.surfaces.area[patch] / total(self.surfaces.emitted),
            effects: self.surfaces.effects,
            seed: self.settings.seed,
            pass: self.counters.updates,
            cancel,
        };
        let Outcome { escaping, counters } = self.method.toward(&shot, &mut self.form_factors);
        if cancel.is_requested() {
            return Step::Cancelled;
        }
        self.receive(patch, radiosity, escaping);
        self.shooter = Some(patch as u32);
        self.counters += counters;
        self.counters.updates += 1;
        Step::Advanced
    }

    /// The stop rule may change on the way; everything else would have led elsewhere from the first shot.
    fn configure(&mut self, settings: &Settings) -> bool {
        let same =
            self.settings.is_same_radiosity(settings) && self.surfaces.effects == simulated(&self.world, settings);
        if same {
            self.settings = *settings;
        }
        same
    }

    fn progress(&self) -> Progress {
        let ambient = self.surfaces.ambient(self.surfaces.flux(&self.unshot));
        let arrived = self.surfaces.mean_irradiance(&self.world.mesh.patch_means(&self.irradiance));
        Progress {
            steps: self.counters.updates,
            updates: self.counters.updates,
            rays: self.counters.rays,
            unshot_share: self.surfaces.share_of_emitted(&self.unshot),
            missing_share: missing_share(ambient, arrived),
        }
    }

    fn solution(&self) -> Solution {
        let mesh = &self.world.mesh;
        let unshot = self.surfaces.flux(&self.unshot);
        let patch_irradiance = mesh.patch_means(&self.irradiance);
        let [irradiance, direct] = self.shown_irradiance();
        Solution {
            steps: self.counters.updates,
            elapsed: Duration::ZERO,
            converged: self.has_converged(),
            energy: Energy {
                emitted: self.surfaces.emitted,
                absorbed: self.surfaces.absorbed(&patch_irradiance),
                unshot,
                escaped: self.ledger.escaped,
            },
            closure: self.ledger.closure(),
            counters: self.counters,
            unshot_share: self.surfaces.share_of_emitted(&self.unshot),
            mean_irradiance: self.surfaces.mean_irradiance(&patch_irradiance),
            shooter: self.shooter,
            light: self.surfaces.light(mesh, &irradiance, &direct, &self.unshot),
            ambient: self.surfaces.ambient(unshot).as_vec3(),
            ..Solution::default()
        }
    }
}
