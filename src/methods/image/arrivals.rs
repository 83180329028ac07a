//! What photons bring to each element of the mesh: the map that gathering rays end in.
//!
//! Photons near a gathering ray's end are taken together by elements, not by distance: thousands of such rays meet an element,
//! so that a lookup that costs no search pays (the idea of Christensen 1999, who keeps irradiance at photons). An element
//! knows how much of it is exposed, and photons never cross its edges: its mean irradiance has no bias, not even in corners.

use super::photon_batches::{BATCHES, ByBatch, PhotonBatches};
use crate::math::rgb::{Rgb, Rgb64};
use crate::methods::photon_map::PhotonMaps;
use crate::methods::transport::Surface;
use crate::solution::{Path, PathMatcher, Photon, Scattering};
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// Numbers of specular events from which on paths are no longer told apart by a filter, and left out.
const TOLD_APART: usize = 8;
/// The element of a photon on a surface that is not meshed.
const NOWHERE: u32 = u32::MAX;

/// Photons summed over elements: all of them, those that make caustics, and for a filter those whose way goes on over so
/// many specular surfaces to the place that gathers, and so many to the eye.
pub struct ArrivalMaps {
    maps: Arc<PhotonMaps>,
    /// For each photon the element on which it landed.
    elements: Vec<u32>,
    all: Sums,
    caustic: Sums,
    filtered: [[Sums; TOLD_APART]; TOLD_APART],
}

/// E of each element by photons that pass a filter, W/m², made when it is first asked for.
#[derive(Default)]
struct Sums {
    whole: OnceLock<Vec<Rgb>>,
    /// The parts of it that batches of photons make up.
    batches: OnceLock<Vec<ByBatch>>,
}

/// Whose arrivals are asked for: of photons that go on over `events` specular surfaces to a diffuse one, which sends them to
/// the eye along `to_eye`.
#[derive(Clone, Copy)]
pub struct Onward<'a> {
    pub matcher: &'a PathMatcher,
    pub events: usize,
    pub to_eye: Path,
}

impl Onward<'_> {
    fn passes(&self, photon: &Photon) -> bool {
        let landed = photon.path.then(Scattering::Diffuse);
        let from_light = (0..self.events).fold(landed, |path, _| path.then(Scattering::Specular));
        self.matcher.passes(from_light, Some(Scattering::Diffuse), self.to_eye)
    }
}

impl ArrivalMaps {
    pub fn new(maps: Arc<PhotonMaps>) -> Self {
        let mesh = &maps.transport().world.mesh;
        let element = |photon: &Photon| {
            let element = mesh.element_at(photon.side / 2, photon.side.is_multiple_of(2), photon.position.into());
            element.unwrap_or(NOWHERE)
        };
        let elements = maps.photons().par_iter().map(element).collect();
        Self { maps, elements, all: Sums::default(), caustic: Sums::default(), filtered: Default::default() }
    }

    /// E, W/m², at a place, by the photons that are asked for. Surfaces that are not meshed are not known to be lit. What
    /// batches of photons say goes to `batches`, if there are any, `weight` times.
    pub fn irradiance(
        &self,
        onward: Onward<'_>,
        surface: &Surface,
        weight: Rgb,
        batches: Option<&mut PhotonBatches>,
    ) -> Rgb {
        if onward.matcher.passes_all() {
            return self.at(&self.all, |_| true, surface, weight, batches);
        }
        let kept = self.filtered.get(onward.events).and_then(|row| row.get(onward.to_eye.len()));
        kept.map_or(Rgb::ZERO, |sums| self.at(sums, |photon| onward.passes(photon), surface, weight, batches))
    }

    /// The same of the photons of caustics alone, whatever comes of them.
    pub fn caustic_irradiance(&self, surface: &Surface, weight: Rgb, batches: Option<&mut PhotonBatches>) -> Rgb {
        self.at(&self.caustic, |photon| photon.path.is_caustic(), surface, weight, batches)
    }

    fn at(
        &self,
        sums: &Sums,
        passes: impl Fn(&Photon) -> bool,
        surface: &Surface,
        weight: Rgb,
        batches: Option<&mut PhotonBatches>,
    ) -> Rgb {
        let element = self.maps.transport().world.mesh.element_at(surface.polygon, surface.is_front, surface.point);
        let Some(element) = element else { return Rgb::ZERO };
        if let Some(batches) = batches {
            let by_batch = sums.batches.get_or_init(|| self.sum_batches(&passes));
            batches.add(weight, &by_batch[element as usize]);
        }
        sums.whole.get_or_init(|| self.sum(&passes))[element as usize]
    }

    /// E of each element by photons that pass, W/m². On one thread: those that wait for it must not be given other work.
    fn sum(&self, passes: impl Fn(&Photon) -> bool) -> Vec<Rgb> {
        let mut flux = vec![Rgb64::ZERO; self.maps.transport().world.mesh.elements.len()];
        self.for_each(passes, |photon, element| {
            flux[element] += (self.maps.scale(photon) * photon.flux).as_dvec3();
        });
        let mesh = &self.maps.transport().world.mesh;
        let density = flux.iter().zip(&mesh.elements);
        let density =
            density.map(|(flux, element)| if element.area > 0.0 { *flux / element.area } else { Rgb64::ZERO });
        density.map(|density| density.as_vec3()).collect()
    }

    /// The same for each batch of photons by itself. Single precision is enough for a spread.
    fn sum_batches(&self, passes: impl Fn(&Photon) -> bool) -> Vec<ByBatch> {
        let mesh = &self.maps.transport().world.mesh;
        let mut density = vec![ByBatch::default(); mesh.elements.len()];
        self.for_each(passes, |photon, element| {
            let area = mesh.elements[element].area;
            if area > 0.0 {
                let light = self.maps.scale(photon) * photon.flux / area as f32;
                let batch = self.maps.batch(photon, BATCHES);
                for (channel, light) in density[element].iter_mut().zip(light.to_array()) {
                    channel[batch] += light;
                }
            }
        });
        density
    }

    fn for_each(&self, passes: impl Fn(&Photon) -> bool, mut visit: impl FnMut(&Photon, usize)) {
        for (photon, &element) in self.maps.photons().iter().zip(&self.elements) {
            if element != NOWHERE && passes(photon) {
                visit(photon, element as usize);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::math::stats::Moments;
    use crate::mesh::MeshSettings;
    use crate::methods::photon_map::PhotonMapping;
    use crate::methods::transport::Transport;
    use crate::methods::{PhotonSettings, Settings, Step};
    use crate::scene::Scene;
    use crate::world::World;
    use glam::Vec3A;

    /// A floor of 1 m under a glowing ceiling, and in its middle a slab so low that it casts no shadow to speak of.
    const SLAB: &str = "\
mtllib m.mtl
usemtl grey
v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0
f 1 2 3 4
v 0.3 0 0.3\nv 0.7 0 0.3\nv 0.7 0.002 0.3\nv 0.3 0.002 0.3
v 0.3 0 0.7\nv 0.7 0 0.7\nv 0.7 0.002 0.7\nv 0.3 0.002 0.7
f 9 10 11 12\nf 6 5 8 7\nf 10 6 7 11\nf 5 9 12 8\nf 12 11 7 8
usemtl glow
v 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1
f 13 14 15 16
";

    #[test]
    fn elements_that_are_covered_in_part_are_as_bright_as_their_neighbours() {
        let mtl = "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl glow\nKd 0 0 0\nKe 1 1 1\n";
        let scene = Scene::from_text("slab", SLAB, mtl).expect("a scene");
        let mesh = MeshSettings { element_size: Some(0.1), ..MeshSettings::default() };
        let world = Arc::new(World::build(scene, &mesh, &Cancel::default()).expect("a world"));
        let photons = PhotonSettings { count: 500_000, ..PhotonSettings::default() };
        let settings = Settings { photons, ..Settings::default() };
        let mut mapping = PhotonMapping::new(Arc::new(Transport::new(world.clone(), settings.effects)), &settings);
        while mapping.step(&Cancel::default()) == Step::Advanced {}
        let irradiance = ArrivalMaps::new(mapping.maps()).sum(|_| true);
        let (mut in_part, mut beside) = (Moments::default(), Moments::default());
        for (element, irradiance) in world.mesh.elements.iter().zip(irradiance) {
            let from_middle = (element.center - Vec3A::new(0.5, 0.0, 0.5)).abs();
            if element.center.y == 0.0 && from_middle.max_element() < 0.3 && element.exposed > 0.1 {
                let moments = if element.exposed < 1.0 { &mut in_part } else { &mut beside };
                moments.add(f64::from(irradiance.x));
            }
        }
        assert!(in_part.count() >= 8 && beside.count() >= 8, "{in_part:?} {beside:?}");
        // Elements are a twelfth wide: 0.6 of one is exposed, counted as 5 of 8 columns of points, so 4 % too dark. Light that
        // falls off from the middle makes those farther out darker by as much.
        assert!((in_part.mean() / beside.mean() - 1.0).abs() < 0.1, "{in_part:?} {beside:?}");
    }
}
