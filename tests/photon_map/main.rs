//! Photons against closed forms, against brute force, and against their own books.

mod agreement;
mod black;
mod boundary;
mod furnace;
mod glass;
mod ledger;
#[path = "../common/oracle.rs"]
mod oracle;
mod progressive;
mod repeat;
mod rooms;

use glam::Vec3A;
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::mesh::MeshSettings;
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::{Surface, Transport};
use lightwell::methods::{PhotonSettings, Settings, Step};
use lightwell::scene::Scene;
use lightwell::tracer::Ray;
use lightwell::world::World;
use std::sync::Arc;

fn transport(scene: Scene) -> Arc<Transport> {
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
    Arc::new(Transport::new(Arc::new(world), Switches::default()))
}

fn open(name: &str) -> Arc<Transport> {
    transport(Scene::open(name).expect("a built-in scene"))
}

fn settings(photons: PhotonSettings) -> Settings {
    Settings { photons, ..Settings::default() }
}

fn run_to_end(transport: &Arc<Transport>, photons: PhotonSettings) -> PhotonMapping {
    let mut mapping = PhotonMapping::new(transport.clone(), &settings(photons));
    while mapping.step(&Cancel::default()) == Step::Advanced {}
    mapping
}

/// The surface that a ray meets.
fn meet(transport: &Transport, origin: impl Into<Vec3A>, direction: impl Into<Vec3A>) -> Surface {
    let ray = Ray::new(origin.into(), direction.into().normalize());
    transport.meet(&ray).expect("a surface")
}

/// The surface at a place, on the side to which `normal` points.
fn at(transport: &Transport, place: impl Into<Vec3A>, normal: Vec3A) -> Surface {
    meet(transport, place.into() + 1e-3 * normal, -normal)
}
