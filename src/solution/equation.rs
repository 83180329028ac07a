//! The rendering equation at a point that was picked, term by term, and what the radiosity of its patch is made of.
//!
//! L(x, x′) = δ(x, x′) [E(x, x′) + ∫ ρ(x, x″) L(x′, x″) G(x′, x″) dx″], over all surfaces (Kajiya 1986, in the letters of
//! O'Brien 2009): the eye is at x and looks at x′, and x″ is a point that sends light there.

use crate::math::rgb::Rgb64;
use glam::{DVec3, Vec3};

/// δ: whether light gets from one point to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Visibility {
    Free,
    /// A polygon stands between them, met first at this point, m.
    Blocked {
        polygon: u32,
        at: Vec3,
    },
    /// One of them lies in the plane of the other, or behind it.
    FacesAway,
}

impl Visibility {
    /// δ as a factor: 1 where light gets through, and 0 where it does not.
    pub fn factor(self) -> f64 {
        f64::from(u8::from(self == Self::Free))
    }
}

/// The rendering equation at a point x′ of the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// x, m.
    pub eye: DVec3,
    /// x′, m.
    pub point: Vec3,
    /// δ(x, x′). Sides that no light reaches hide nothing, as in the picture.
    pub sight: Visibility,
    /// E(x, x′): the radiance that the surface makes at x′, W/(m²·sr).
    pub emitted: Rgb64,
    /// The integral: the radiance that it reflects there by the radiosity solution, ρ E/π, W/(m²·sr).
    pub reflected: Rgb64,
    /// x″ and what it sends to x′, where a second point is picked.
    pub source: Option<LightSource>,
    /// Of the patch of x′.
    pub balance: Balance,
}

impl Equation {
    /// L(x, x′): the radiance that arrives at the eye, W/(m²·sr).
    pub fn radiance(&self) -> Rgb64 {
        self.sight.factor() * (self.emitted + self.reflected)
    }
}

/// What a point x″ sends to x′, and the patch that it lies on to the patch of x′.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSource {
    /// x″, m.
    pub point: Vec3,
    /// Index into the patches of the mesh.
    pub patch: u32,
    /// δ(x′, x″)
    pub visibility: Visibility,
    /// The diffuse part of ρ(x, x″): reflectance over π, 1/sr.
    pub diffuse: Rgb64,
    /// The glossy part of ρ(x, x″), for light from x″ to the eye, 1/sr. Radiosity does not simulate it.
    pub gloss: Rgb64,
    /// B/π at x″: L(x′, x″) if nothing stands between, W/(m²·sr).
    pub sent: Rgb64,
    /// cos θ′ at x′ and cos θ″ at x″, between the normals and the way from one to the other; 0 behind the horizon.
    pub cosines: [f64; 2],
    /// r, m.
    pub distance: f64,
    /// F from the patch of x′ to the patch of x″, as the solver's method computes it.
    pub form_factor: f64,
    /// ρ F B: how much of the radiosity of the patch of x′ comes from the patch of x″, W/m².
    pub contribution: Rgb64,
}

impl LightSource {
    /// ρ(x, x″), 1/sr.
    pub fn brdf(&self) -> Rgb64 {
        self.diffuse + self.gloss
    }

    /// L(x′, x″): the radiance that arrives from x″, W/(m²·sr).
    pub fn radiance(&self) -> Rgb64 {
        self.visibility.factor() * self.sent
    }

    /// G = cos θ′ cos θ″ / r², 1/m²; 0 for a point and itself.
    pub fn geometry(&self) -> f64 {
        let [here, there] = self.cosines;
        if self.distance > 0.0 { here * there / (self.distance * self.distance) } else { 0.0 }
    }

    /// The integrand ρ L G: the radiance that x′ reflects to the eye for each m² round x″, W/(m²·sr) per m².
    pub fn integrand(&self) -> Rgb64 {
        self.brdf() * self.radiance() * self.geometry()
    }
}

/// What the radiosity of a patch is made of, W/m²: emission + light of the largest contributors + of the others − what is
/// not shot yet + difference = radiosity.
#[derive(Clone, Debug, PartialEq)]
pub struct Balance {
    /// Index into the patches of the mesh.
    pub patch: u32,
    /// B, the mean over the patch in the solution.
    pub radiosity: Rgb64,
    /// M_e
    pub emission: Rgb64,
    /// The patches that contribute most, the first one most of all; at most [`Balance::MOST`].
    pub largest: Vec<Contribution>,
    /// The light of all other patches, and how many send any.
    pub others: Rgb64,
    pub other_count: usize,
    /// Part of the light above that is on its way: the radiosity that the contributors have not shot yet.
    pub unshot: Rgb64,
    /// What the solution has beside all this. Where form factors are computed anew for each shot, as much as they differ
    /// from those used here; with the matrix rounding alone.
    pub difference: Rgb64,
    /// Whether the form factors are those of the solver's matrix.
    pub is_by_matrix: bool,
}

impl Balance {
    /// More contributors are not told apart.
    pub const MOST: usize = 10;

    /// ρ Σ F B over all patches, W/m².
    pub fn gathered(&self) -> Rgb64 {
        self.largest.iter().map(|contribution| contribution.light).sum::<Rgb64>() + self.others
    }
}

/// How much of the radiosity of a patch comes from another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contribution {
    /// Index into the patches of the mesh.
    pub patch: u32,
    /// F to that patch.
    pub form_factor: f64,
    /// ρ F B, W/m².
    pub light: Rgb64,
}
