//! Irradiance from the photons near by (Jensen 1996). Arrivals are as dense as irradiance is strong, so there is no cosine
//! in it any more.

use super::kernel;
use crate::math::rgb::Rgb;
use crate::methods::Kernel;
use std::f32::consts::PI;

/// What photons say of the irradiance at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// E, W/m².
    pub irradiance: Rgb,
    /// Photons that count.
    pub photons: u32,
    /// Radius of the disc, m.
    pub radius: f32,
    /// Share of the disc, weighted by the kernel, that is surface on which photons can land, in (0, 1].
    pub inside: f32,
    /// Relative standard error of the sum over the channels: the spread of a sum of independent photons. Infinite where
    /// there is none.
    pub relative_error: f32,
    /// Of each channel, (W/m²)²: the square of its standard error. Where no photon landed, that of one photon in the disc:
    /// what is seen of none may well be one.
    pub variance: Rgb,
}

/// Photons of one map weighted and summed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum {
    irradiance: Rgb,
    /// Σ of squares of the sum over the channels.
    squares: f32,
    /// Σ of squares, by channel.
    variance: Rgb,
    photons: u32,
    radius: f32,
    inside: f32,
}

impl Sum {
    /// A sum over no photon, on a disc of which this share is surface.
    pub fn new(radius: f32, inside: f32) -> Self {
        Self { radius, inside, ..Self::default() }
    }

    /// Takes a photon in: its flux, W, and square distance, m².
    pub fn add(&mut self, flux: Rgb, square_distance: f32, kernel: Kernel) {
        let light = flux * (kernel::value(kernel, square_distance, self.radius) / self.inside);
        let total = light.element_sum();
        self.irradiance += light;
        self.squares += total * total;
        self.variance += light * light;
        self.photons += 1;
    }

    /// Where no photon landed, takes in the noise of one with this flux, W.
    pub fn doubt(&mut self, flux: Rgb) {
        if self.photons == 0 && self.radius > 0.0 {
            let light = flux / (PI * self.radius * self.radius * self.inside);
            self.variance = light * light;
        }
    }

    /// Multiplies all light.
    pub fn scale(&mut self, factor: f32) {
        self.irradiance *= factor;
        self.squares *= factor * factor;
        self.variance *= factor * factor;
    }

    /// The light of both; the disc is that of the one with the larger part of the light.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let disc = if other.irradiance.element_sum() > self.irradiance.element_sum() { other } else { self };
        Self {
            irradiance: self.irradiance + other.irradiance,
            squares: self.squares + other.squares,
            variance: self.variance + other.variance,
            photons: self.photons + other.photons,
            ..*disc
        }
    }

    /// Of the disc, m.
    pub fn radius(&self) -> f32 {
        self.radius
    }

    pub fn estimate(&self) -> Estimate {
        let total = self.irradiance.element_sum();
        Estimate {
            irradiance: self.irradiance,
            photons: self.photons,
            radius: self.radius,
            inside: self.inside,
            relative_error: if total > 0.0 { self.squares.sqrt() / total } else { f32::INFINITY },
            variance: self.variance,
        }
    }
}
