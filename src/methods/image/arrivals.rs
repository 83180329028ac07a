//! What photons bring to each element of the mesh: the map that gathering rays end in.
//!
//! Photons near a gathering ray's end are taken together by elements, not by distance: thousands of such rays meet an element,
//! so that a lookup that costs no search pays (the idea of Christensen 1999, who keeps irradiance at photons). An element
//! knows how much of it is exposed, and photons never cross its edges: its mean irradiance has no bias, not even in corners.

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
    all: OnceLock<Vec<Rgb>>,
    caustic: OnceLock<Vec<Rgb>>,
    filtered: [[OnceLock<Vec<Rgb>>; TOLD_APART]; TOLD_APART],
}

impl ArrivalMaps {
    pub fn new(maps: Arc<PhotonMaps>) -> Self {
        let mesh = &maps.transport().world.mesh;
        let element = |photon: &Photon| {
            let element = mesh.element_at(photon.side / 2, photon.side.is_multiple_of(2), photon.position.into());
            element.unwrap_or(NOWHERE)
        };
        let elements = maps.photons().par_iter().map(element).collect();
        let (all, caustic) = (OnceLock::new(), OnceLock::new());
        Self { maps, elements, all, caustic, filtered: Default::default() }
    }

    /// E, W/m², at a place, by photons that go on from there over `events` specular surfaces to a diffuse one, which sends
    /// them to the eye along `to_eye`. Surfaces that are not meshed are not known to be lit.
    pub fn irradiance(&self, matcher: &PathMatcher, surface: &Surface, events: usize, to_eye: Path) -> Rgb {
        if matcher.passes_all() {
            return self.at(self.all.get_or_init(|| self.sum(|_| true)), surface);
        }
        let kept = self.filtered.get(events).and_then(|row| row.get(to_eye.len()));
        kept.map_or(Rgb::ZERO, |kept| {
            let passes = |photon: &Photon| {
                let landed = photon.path.then(Scattering::Diffuse);
                let from_light = (0..events).fold(landed, |path, _| path.then(Scattering::Specular));
                matcher.passes(from_light, Some(Scattering::Diffuse), to_eye)
            };
            self.at(kept.get_or_init(|| self.sum(passes)), surface)
        })
    }

    /// E, W/m², at a place by the photons of caustics alone.
    pub fn caustic_irradiance(&self, surface: &Surface) -> Rgb {
        self.at(self.caustic.get_or_init(|| self.sum(|photon| photon.path.is_caustic())), surface)
    }

    fn at(&self, irradiance: &[Rgb], surface: &Surface) -> Rgb {
        let element = self.maps.transport().world.mesh.element_at(surface.polygon, surface.is_front, surface.point);
        element.map_or(Rgb::ZERO, |element| irradiance[element as usize])
    }

    /// E of each element by photons that pass, W/m². On one thread: those that wait for it must not be given other work.
    fn sum(&self, passes: impl Fn(&Photon) -> bool) -> Vec<Rgb> {
        let mesh = &self.maps.transport().world.mesh;
        let mut flux = vec![Rgb64::ZERO; mesh.elements.len()];
        for (photon, &element) in self.maps.photons().iter().zip(&self.elements) {
            if element != NOWHERE && passes(photon) {
                flux[element as usize] += (self.maps.scale(photon) * photon.flux).as_dvec3();
            }
        }
        let density = flux.iter().zip(&mesh.elements);
        let density =
            density.map(|(flux, element)| if element.area > 0.0 { *flux / element.area } else { Rgb64::ZERO });
        density.map(|density| density.as_vec3()).collect()
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
