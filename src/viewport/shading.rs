//! What a view shows of the light: a value for every element, or for every vertex.

use super::colour_map::GREY;
use super::{Frame, Legend, Light, View};
use crate::math::rgb::Rgb;
use crate::mesh::{Mesh, Patch};
use crate::solution::Solution;
use crate::world::World;
use glam::Vec3A;
use std::borrow::Cow;

/// Of plain surfaces behind photons, so that these stand out.
const DIMMED: f32 = 0.12;

/// What the values of elements are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Flux density, W/m², drawn as the radiance of a diffuse surface that sends so much.
    FluxDensity,
    /// Linear colours in [0, 1], drawn as they are.
    Colour,
}

/// The surfaces as a view shows them.
#[derive(Debug)]
pub struct Shading<'a> {
    /// In the order of the mesh's elements, or of its vertices.
    pub values: Cow<'a, [Rgb]>,
    pub quantity: Quantity,
    pub spread: Spread,
}

/// How values vary over an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// One value an element.
    Constant,
    /// Values of elements, averaged to vertices and interpolated between these.
    Averaged,
    /// Values of vertices, interpolated between these.
    OfVertices,
}

impl<'a> Shading<'a> {
    /// What `frame` shows of the light of `world`: plain grey where the view cannot be drawn (see [`View::missing`]).
    pub fn of(world: &World, light: &'a Light, frame: &Frame) -> Self {
        Self::of_view(world, light, frame).unwrap_or_else(|| Self::colours(world, |_, patch| plain(patch)))
    }

    fn of_view(world: &World, light: &'a Light, frame: &Frame) -> Option<Self> {
        let solution = light.solution.as_deref();
        let constant = |values| Self { values, quantity: Quantity::FluxDensity, spread: Spread::Constant };
        let smooth = |values| Self { spread: Spread::Averaged, ..constant(values) };
        Some(match frame.view {
            View::Patches => constant(radiosity(world, solution?, frame.ambient)),
            View::Smooth => smooth(radiosity(world, solution?, frame.ambient)),
            View::Unshot => constant(Cow::Borrowed(&solution?.light.unshot)),
            View::Absorbed => constant(Cow::Owned(absorbed(world, solution?))),
            View::Bounces => {
                let bounces = &solution?.bounces;
                let bounce = bounces.get(frame.bounce).or(bounces.last())?;
                smooth(Cow::Borrowed(bounce))
            }
            View::FormFactors => {
                let picked = light.picked.as_ref()?;
                let legend = Legend::of(frame.view, light);
                Self::colours(world, |index, patch| match (picked.form_factors[index], &legend) {
                    (form_factor, Some(legend)) if form_factor > 0.0 => legend.colour(form_factor),
                    _ => plain(patch),
                })
            }
            View::Photons | View::KdTree => {
                light.photons.as_ref()?;
                Self::colours(world, |_, patch| DIMMED * plain(patch))
            }
            View::OcclusionVertices => Self {
                values: light.shares()?.iter().map(|&share| Rgb::splat(share)).collect(),
                quantity: Quantity::Colour,
                spread: Spread::OfVertices,
            },
            View::Camera(_) => return None,
        })
    }

    /// A colour for each patch, from its index and itself.
    fn colours(world: &World, colour: impl Fn(usize, &Patch) -> Rgb) -> Self {
        let Mesh { patches, elements, .. } = &world.mesh;
        let of_patch: Vec<Rgb> = patches.iter().enumerate().map(|(index, patch)| colour(index, patch)).collect();
        let values = elements.iter().map(|element| of_patch[element.patch as usize]).collect();
        Self { values: Cow::Owned(values), quantity: Quantity::Colour, spread: Spread::Constant }
    }
}

/// B, and if asked for what the ambient term adds to it, W/m².
fn radiosity<'a>(world: &World, solution: &'a Solution, with_ambient: bool) -> Cow<'a, [Rgb]> {
    let radiosity = &solution.light.radiosity;
    if !with_ambient {
        return Cow::Borrowed(radiosity);
    }
    let reflectance = reflectance(world);
    radiosity.iter().zip(reflectance).map(|(&radiosity, rho)| radiosity + rho * solution.ambient).collect()
}

/// (1 − ρ) E of each element, W/m².
fn absorbed(world: &World, solution: &Solution) -> Vec<Rgb> {
    let irradiance = &solution.light.irradiance;
    irradiance.iter().zip(reflectance(world)).map(|(&irradiance, rho)| (Rgb::ONE - rho) * irradiance).collect()
}

/// ρ of each element.
fn reflectance(world: &World) -> impl Iterator<Item = Rgb> {
    let World { mesh, scene, .. } = world;
    let material = |patch: u32| &scene.materials[mesh.patches[patch as usize].material as usize];
    mesh.elements.iter().map(move |element| material(element.patch).lobes().diffuse)
}

/// A grey that tells the sides of things apart, as if a wide light stood above and to one side.
fn plain(patch: &Patch) -> Rgb {
    let towards_light = Vec3A::new(0.36, 0.8, 0.48);
    GREY * (1.0 + 0.5 * patch.normal.dot(towards_light))
}
