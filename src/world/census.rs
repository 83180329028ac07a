//! What light meets in a scene, counted once: what a plan of the effects worth simulating is made from.
//!
//! Nothing is traced. Where counting alone cannot tell whether light gets from here to there, it is taken to.

use super::planes::{may_see, may_see_across_gaps};
use super::sides::emitting_sides;
use super::surface::Surfaces;
use crate::math::rgb::Rgb;
use crate::scene::{Material, Scene};

/// Counts of polygons, and what they tell of light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Census {
    pub polygons: usize,
    /// Those of which some number is not the same in red, green and blue. A picture may show what light does not reach.
    pub coloured: usize,
    /// Those that light reaches on one side or both. All other counts are of these.
    pub reached: usize,
    pub emitters: usize,
    /// Emitters of which random rays meet nothing.
    pub unseen_emitters: usize,
    /// Those that reflect in all directions: ρ > 0.
    pub diffuse: usize,
    pub mirrors: usize,
    pub glossy: usize,
    /// Boundaries of glass.
    pub glass: usize,
    /// Those that let light straight through.
    pub sheets: usize,
    /// Smallest and largest ρ, by channel; 0 where light reaches nothing.
    pub reflectance: [Rgb; 2],
    /// Whether light of an emitter may reach a surface.
    pub light_may_arrive: bool,
    /// Whether light of an emitter may reach a surface that is not only diffuse.
    pub light_may_meet_specular: bool,
}

impl Census {
    /// Counts what light reaches: `is_reached` is by side, as in [`crate::mesh::Mesh::sides`]. Sides see each other if they
    /// face each other by more than `tolerance`, m. Whether emitters light any of them is known already.
    pub(super) fn take(
        scene: &Scene,
        surfaces: &Surfaces,
        is_reached: &[bool],
        unseen_emitters: usize,
        light_may_arrive: bool,
        tolerance: f64,
    ) -> Self {
        let traits: Vec<Traits> = scene.materials.iter().map(Traits::new).collect();
        let of = |polygon: usize| &traits[scene.polygons[polygon].material as usize];
        let (mut counts, mut all) = (vec![0; traits.len()], vec![0; traits.len()]);
        for (polygon, sides) in scene.polygons.iter().zip(is_reached.chunks_exact(2)) {
            counts[polygon.material as usize] += usize::from(sides[0] || sides[1]);
            all[polygon.material as usize] += 1;
        }
        let count_in = |counts: &[usize], has: fn(&Traits) -> bool| {
            traits.iter().zip(counts).filter(|(traits, _)| has(traits)).map(|(_, count)| count).sum()
        };
        let count = |has| count_in(&counts, has);
        let reached: Vec<usize> = (0..is_reached.len()).filter(|&side| is_reached[side]).collect();
        let those = |has: fn(&Traits) -> bool| -> Vec<usize> {
            reached.iter().copied().filter(|side| has(of(side / 2))).collect()
        };
        let emitters = emitting_sides(scene);
        Self {
            polygons: scene.polygons.len(),
            coloured: count_in(&all, |traits| traits.is_coloured),
            reached: counts.iter().sum(),
            emitters: emitters.len(),
            unseen_emitters,
            diffuse: count(Traits::is_diffuse),
            mirrors: count(|traits| traits.is_mirror),
            glossy: count(|traits| traits.is_glossy),
            glass: count(|traits| traits.is_glass),
            sheets: count(|traits| traits.is_sheet),
            reflectance: reflectance(&traits, &counts),
            light_may_arrive,
            light_may_meet_specular: light_may_arrive
                && may_see(surfaces, &emitters, &those(Traits::is_specular), tolerance),
        }
    }

    /// Those that light reaches from no side: nothing is computed for them.
    pub fn unreached(&self) -> usize {
        self.polygons - self.reached
    }
}

/// Whether light of these emitting sides may arrive at any side that is reached. No gap is too small for it.
pub(super) fn light_arrives(surfaces: &Surfaces, emitters: &[usize], is_reached: &[bool], tolerance: f64) -> bool {
    let reached: Vec<usize> = (0..is_reached.len()).filter(|&side| is_reached[side]).collect();
    may_see_across_gaps(surfaces, emitters, &reached, tolerance)
}

/// Smallest and largest ρ, by channel, of the materials that are reached.
fn reflectance(traits: &[Traits], counts: &[usize]) -> [Rgb; 2] {
    let reached = traits.iter().zip(counts).filter(|(_, count)| **count > 0).map(|(traits, _)| traits.diffuse);
    let range = reached.map(|diffuse| [diffuse; 2]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    range.unwrap_or_default()
}

/// What a material does with light, once for all its polygons.
struct Traits {
    diffuse: Rgb,
    is_mirror: bool,
    is_glossy: bool,
    is_glass: bool,
    is_sheet: bool,
    is_coloured: bool,
}

impl Traits {
    fn new(material: &Material) -> Self {
        let lobes = material.lobes();
        let is_coloured = |rgb: &Rgb| *rgb != Rgb::splat(rgb.x);
        let all = [lobes.diffuse, lobes.glossy, lobes.mirror, lobes.filter, lobes.straight, material.emission];
        Self {
            diffuse: lobes.diffuse,
            is_mirror: lobes.mirror != Rgb::ZERO,
            is_glossy: lobes.glossy != Rgb::ZERO,
            is_glass: lobes.glass > 0.0,
            is_sheet: lobes.straight != Rgb::ZERO,
            is_coloured: all.iter().any(is_coloured),
        }
    }

    fn is_diffuse(&self) -> bool {
        self.diffuse != Rgb::ZERO
    }

    fn is_specular(&self) -> bool {
        self.is_mirror || self.is_glossy || self.is_glass || self.is_sheet
    }
}
