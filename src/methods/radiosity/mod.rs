//! Radiosity by progressive refinement (Cohen, Chen, Wallace, Greenberg 1988): again and again the patch with the most
//! unshot flux shoots it at all elements. As a way to solve linear equations this is Southwell's relaxation (Gortler,
//! Cohen, Slusallek 1993).

mod escape;
pub mod form_factor;
mod gather;
mod ledger;
mod sensor;
mod visibility;

pub use sensor::irradiance_in_space;

use crate::cancel::Cancel;
use crate::math::rgb::{Rgb64, total};
use crate::mesh::{Element, Mesh, Patch};
use crate::methods::{Method, Settings, Step};
use crate::solution::{Counters, ElementLight, Energy, ItemBuffer, Picked, Solution};
use crate::world::World;
use escape::{ESCAPE_RAYS, escaping_share};
use form_factor::Shooter;
use gather::{Receivers, Shot, row_sum};
use ledger::Ledger;
use std::sync::Arc;
use std::time::Duration;
use visibility::{Rays, Sightline};

/// The state of a run. Patches shoot, elements receive.
pub struct Radiosity {
    world: Arc<World>,
    settings: Settings,
    receivers: Receivers,
    /// ρ of each patch.
    reflectance: Vec<Rgb64>,
    /// M_e of each patch, W/m².
    exitance: Vec<Rgb64>,
    /// ΔB of each patch, W/m².
    unshot: Vec<Rgb64>,
    /// E of each element, W/m².
    irradiance: Vec<Rgb64>,
    /// Form factor from each element to the present shooter, with visibility.
    form_factors: Vec<f64>,
    ledger: Ledger,
    counters: Counters,
    steps: u64,
    /// Mean irradiance to be expected in the end, W/m² summed over RGB.
    expected_irradiance: f64,
    shooter: Option<u32>,
}

impl Radiosity {
    /// A run in which all light is still in the emitters.
    pub fn new(world: Arc<World>, settings: Settings) -> Self {
        let patches = &world.mesh.patches;
        let material = |patch: &Patch| &world.scene.materials[patch.material as usize];
        let reflectance: Vec<Rgb64> = patches.iter().map(|patch| material(patch).diffuse.as_dvec3()).collect();
        // Emitters shine from their front; their back only reflects.
        let exitance: Vec<Rgb64> = patches
            .iter()
            .map(|patch| if patch.is_front { material(patch).exitance().as_dvec3() } else { Rgb64::ZERO })
            .collect();
        let emitted = patches.iter().zip(&exitance).map(|(patch, exitance)| *exitance * patch.area).sum();
        Self {
            receivers: Receivers::new(&world.mesh),
            unshot: exitance.clone(),
            exitance,
            irradiance: vec![Rgb64::ZERO; world.mesh.elements.len()],
            form_factors: vec![0.0; world.mesh.elements.len()],
            ledger: Ledger::new(emitted),
            counters: Counters::default(),
            steps: 0,
            expected_irradiance: expected_irradiance(&world, &reflectance, emitted),
            reflectance,
            shooter: None,
            settings,
            world,
        }
    }

    /// Unshot flux of a patch, W summed over RGB.
    fn unshot_flux(&self, patch: usize) -> f64 {
        total(self.unshot[patch]) * self.world.mesh.patches[patch].area
    }

    /// The patch with the most unshot flux; of equals the first. `None` where there is nothing left at all.
    fn brightest(&self) -> Option<usize> {
        let fluxes = (0..self.unshot.len()).map(|patch| (patch, self.unshot_flux(patch)));
        let brightest = fluxes.reduce(|best, next| if next.1 > best.1 { next } else { best });
        brightest.filter(|&(_, flux)| flux > 0.0).map(|(patch, _)| patch)
    }

    fn unshot_in_all(&self) -> Rgb64 {
        self.unshot.iter().zip(&self.world.mesh.patches).map(|(unshot, patch)| *unshot * patch.area).sum()
    }

    fn has_converged(&self) -> bool {
        total(self.unshot_in_all()) <= self.settings.unshot_limit * total(self.ledger.emitted)
    }

    /// Visibility rays in proportion to the irradiance that the shot may bring, [`Settings::shadow_rays`] for all that is
    /// expected in the end. Each shot then adds noise in proportion to what it adds, and for a given number of rays the
    /// sum has the least.
    fn rays_per_form_factor(&self, patch: usize) -> f64 {
        f64::from(self.settings.shadow_rays) * total(self.unshot[patch]) / self.expected_irradiance
    }

    /// Hands the shooter's unshot flux to the elements and to the void.
    fn receive(&mut self, patch: usize, escaping: f64) {
        let shot = std::mem::replace(&mut self.unshot[patch], Rgb64::ZERO);
        let Mesh { patches, elements, .. } = &self.world.mesh;
        let area = patches[patch].area;
        let row = row_sum(&self.world.mesh, &self.form_factors) / area;
        let shot_scaled = shot * self.ledger.close_row(shot * area, row, escaping);
        for ((receiver, unshot), reflectance) in patches.iter().zip(&mut self.unshot).zip(&self.reflectance) {
            let range = receiver.elements.start as usize..receiver.elements.end as usize;
            let mut received = Rgb64::ZERO;
            for index in range {
                let form_factor = self.form_factors[index];
                if form_factor > 0.0 {
                    let irradiance = shot_scaled * form_factor;
                    self.irradiance[index] += irradiance;
                    received += irradiance * elements[index].area;
                }
            }
            if receiver.area > 0.0 {
                *unshot += *reflectance * received / receiver.area;
            }
        }
    }

    /// Σ (1 − ρ) A E: what stays in the surfaces, W.
    fn absorbed(&self) -> Rgb64 {
        let elements = self.world.mesh.elements.iter().zip(&self.irradiance);
        elements
            .map(|(element, irradiance)| {
                (Rgb64::ONE - self.reflectance[element.patch as usize]) * *irradiance * element.area
            })
            .sum()
    }

    fn light(&self) -> ElementLight {
        let elements = self.world.mesh.elements.iter().zip(&self.irradiance);
        let radiosity = |(element, irradiance): (&Element, &Rgb64)| {
            let patch = element.patch as usize;
            (self.exitance[patch] + self.reflectance[patch] * *irradiance).as_vec3()
        };
        ElementLight {
            radiosity: elements.map(radiosity).collect(),
            irradiance: self.irradiance.iter().map(|irradiance| irradiance.as_vec3()).collect(),
            unshot: self.world.mesh.elements.iter().map(|e| self.unshot[e.patch as usize].as_vec3()).collect(),
        }
    }
}

/// The irradiance of a room with this much light, the mean reflectance ρ̄ of the scene and its share ε of light that
/// escapes on the way to a surface: Φ (1 − ε) / (S (1 − ρ̄ (1 − ε))), W/m² summed over RGB. It is the ambient term of Cohen,
/// Chen, Wallace, Greenberg (1988) before the first shot, for rooms that may be open.
fn expected_irradiance(world: &World, reflectance: &[Rgb64], emitted: Rgb64) -> f64 {
    let area = world.mesh.area();
    let reflecting: Rgb64 = world.mesh.patches.iter().zip(reflectance).map(|(patch, rho)| *rho * patch.area).sum();
    let mean = reflecting / area;
    let arriving = 1.0 - world.escape_share;
    total(emitted * arriving / (area * (Rgb64::ONE - mean * arriving)))
}

/// What a patch sees, by the method of the settings.
pub fn pick(world: &Arc<World>, settings: &Settings, patch: u32) -> Picked {
    let mut method = Radiosity::new(world.clone(), *settings);
    let shooter = &world.mesh.patches[patch as usize];
    let shot = Shot {
        world,
        shooter: Shooter::new(shooter),
        sightline: Sightline::new(world, shooter, Rays { most: settings.shadow_rays, per_form_factor: 1.0 }),
        seed: settings.seed,
        step: 0,
        cancel: &Cancel::default(),
    };
    method.receivers.gather(&shot, &mut method.form_factors);
    let of = |receiver: &Patch| {
        let elements = receiver.elements.start as usize..receiver.elements.end as usize;
        elements.map(|i| world.mesh.elements[i].area * method.form_factors[i]).sum::<f64>() / shooter.area
    };
    Picked {
        patch,
        form_factors: world.mesh.patches.iter().map(of).collect(),
        escaping: escaping_share(world, shooter, settings.seed, 0),
        item_buffer: Arc::new(ItemBuffer { resolution: 0, faces: Default::default() }),
    }
}

impl Method for Radiosity {
    /// One shot. It takes (number of elements) · (visibility rays) shadow rays, fewer where patches face away.
    fn step(&mut self, cancel: &Cancel) -> Step {
        if self.has_converged() {
            return Step::Converged;
        }
        let Some(patch) = self.brightest() else { return Step::Converged };
        let rays = Rays { most: self.settings.shadow_rays, per_form_factor: self.rays_per_form_factor(patch) };
        let world = self.world.clone();
        let shooter = &world.mesh.patches[patch];
        let shot = Shot {
            world: &world,
            shooter: Shooter::new(shooter),
            sightline: Sightline::new(&world, shooter, rays),
            seed: self.settings.seed,
            step: self.steps,
            cancel,
        };
        let work = self.receivers.gather(&shot, &mut self.form_factors);
        if cancel.is_requested() {
            return Step::Cancelled;
        }
        let escaping = escaping_share(&world, shooter, self.settings.seed, self.steps);
        self.receive(patch, escaping);
        self.shooter = Some(patch as u32);
        self.steps += 1;
        self.counters.form_factors += work.form_factors;
        self.counters.shadow_rays += work.rays;
        self.counters.escape_rays += u64::from(ESCAPE_RAYS);
        self.counters.rays += work.rays + u64::from(ESCAPE_RAYS);
        Step::Advanced
    }

    /// The stop rule may change on the way; everything else would have led elsewhere from the first shot.
    fn configure(&mut self, settings: &Settings) -> bool {
        let same = Settings { unshot_limit: settings.unshot_limit, ..self.settings } == *settings;
        if same {
            self.settings = *settings;
        }
        same
    }

    fn solution(&self) -> Solution {
        Solution {
            steps: self.steps,
            elapsed: Duration::ZERO,
            converged: self.has_converged(),
            energy: Energy {
                emitted: self.ledger.emitted,
                absorbed: self.absorbed(),
                unshot: self.unshot_in_all(),
                escaped: self.ledger.escaped,
            },
            closure: self.ledger.closure(),
            counters: self.counters,
            shooter: self.shooter,
            light: self.light(),
            ..Solution::default()
        }
    }
}
