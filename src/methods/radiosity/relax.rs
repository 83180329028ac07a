//! Three ways to relax B = M + ρ F B to its solution. All keep one state, in which light is conserved at every moment:
//! what each patch has sent so far, and the irradiance that this has brought.
//!
//! With S for what was sent, E = F S and B = M + ρ E, the unshot radiosity is B − S: the residual of the equations. The
//! flux emitted is what is absorbed, (1 − ρ) E, what escaped of S, and what is unshot, whatever S is.

use crate::math::rgb::{Rgb64, total};
use crate::math::sparse::Sparse;
use rayon::prelude::*;

/// The linear equations of a scene.
pub struct System<'a> {
    /// F_ij, row by row, with A_i F_ij = A_j F_ji.
    pub form_factors: &'a Sparse,
    /// Factor on what each patch sends, by which its row closes to the last bit: 1 but for rounding where a symmetric matrix
    /// with all the wanted sums exists.
    pub closing: &'a [f64],
    /// m²
    pub area: &'a [f64],
    /// ρ
    pub reflectance: &'a [Rgb64],
    /// M_e, W/m²
    pub exitance: &'a [Rgb64],
}

impl System<'_> {
    /// Irradiance at patch `i` from what all patches send, W/m².
    fn gather(&self, i: usize, sent: &[Rgb64]) -> Rgb64 {
        let (columns, values) = self.form_factors.row(i);
        let entries = columns.iter().zip(values);
        entries.map(|(&j, &form_factor)| sent[j as usize] * (self.closing[j as usize] * form_factor)).sum()
    }
}

/// How far the light has come, on the level of patches.
#[derive(Clone, Debug)]
pub struct Relaxation {
    /// S, W/m²: what each patch has sent so far.
    sent: Vec<Rgb64>,
    /// E = F S, W/m².
    irradiance: Vec<Rgb64>,
    /// B − S, W/m².
    unshot: Vec<Rgb64>,
}

impl Relaxation {
    /// All light is in the emitters.
    pub fn new(system: &System) -> Self {
        let dark = vec![Rgb64::ZERO; system.area.len()];
        Self { sent: dark.clone(), irradiance: dark, unshot: system.exitance.to_vec() }
    }

    /// One sweep in which all patches send all they have at once (Jacobi): one more bounce of light.
    pub fn jacobi(&mut self, system: &System) {
        for (sent, unshot) in self.sent.iter_mut().zip(&self.unshot) {
            *sent += *unshot;
        }
        let arriving: Vec<Rgb64> =
            (0..system.area.len()).into_par_iter().map(|i| system.gather(i, &self.unshot)).collect();
        for (i, arriving) in arriving.into_iter().enumerate() {
            self.irradiance[i] += arriving;
            self.unshot[i] = system.reflectance[i] * arriving;
        }
    }

    /// One sweep in which patch after patch gathers what has been sent so far and sends what it then has (Gauss, Seidel).
    pub fn gauss_seidel(&mut self, system: &System) {
        for i in 0..system.area.len() {
            self.sent[i] = system.exitance[i] + system.reflectance[i] * system.gather(i, &self.sent);
        }
        // Patches that sent later have changed what the earlier ones see.
        let sent = &self.sent;
        let arrived = (0..system.area.len()).into_par_iter().map(|i| system.gather(i, sent));
        arrived.collect_into_vec(&mut self.irradiance);
        for (i, unshot) in self.unshot.iter_mut().enumerate() {
            *unshot = system.exitance[i] + system.reflectance[i] * self.irradiance[i] - self.sent[i];
        }
    }

    /// The patch with the most unshot flux sends it (Southwell); of equals the first. Returns which one it was; `None`
    /// where there is nothing left.
    pub fn southwell(&mut self, system: &System) -> Option<usize> {
        let fluxes = self.unshot.iter().zip(system.area).map(|(unshot, area)| total(unshot.abs()) * area);
        let brightest = fluxes.enumerate().reduce(|best, next| if next.1 > best.1 { next } else { best });
        let (shooter, _) = brightest.filter(|&(_, flux)| flux > 0.0)?;
        let shot = std::mem::replace(&mut self.unshot[shooter], Rgb64::ZERO);
        self.sent[shooter] += shot;
        let (columns, values) = system.form_factors.row(shooter);
        let flux = shot * (system.area[shooter] * system.closing[shooter]);
        for (&j, &form_factor) in columns.iter().zip(values) {
            let j = j as usize;
            let arriving = flux * (form_factor / system.area[j]);
            self.irradiance[j] += arriving;
            self.unshot[j] += system.reflectance[j] * arriving;
        }
        Some(shooter)
    }

    /// S, W/m²: what each patch has sent so far. After a sweep of Gauss and Seidel this is its iterate.
    pub fn sent(&self) -> &[Rgb64] {
        &self.sent
    }

    /// E = F S, W/m².
    pub fn irradiance(&self) -> &[Rgb64] {
        &self.irradiance
    }

    /// B − S, W/m².
    pub fn unshot(&self) -> &[Rgb64] {
        &self.unshot
    }

    /// B = M + ρ E, W/m². Of Jacobi and Southwell this is the iterate.
    pub fn radiosity(&self, system: &System) -> Vec<Rgb64> {
        let patches = self.irradiance.iter().zip(system.reflectance).zip(system.exitance);
        patches.map(|((irradiance, reflectance), exitance)| *exitance + *reflectance * *irradiance).collect()
    }
}
