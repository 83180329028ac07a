//! Progressive radiosity against closed forms: the furnace, the ledger, repeatability.

use lightwell::cancel::Cancel;
use lightwell::math::rgb::total;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::Radiosity;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::world::World;
use std::sync::Arc;

fn world(name: &str, element_size: Option<f32>) -> Arc<World> {
    let scene = Scene::open(name).expect("a built-in scene");
    Arc::new(World::build(scene, &MeshSettings { element_size }, &Cancel::default()).expect("a world"))
}

#[test]
fn try_it() {
    for name in ["furnace", "cornell-box"] {
        let t = std::time::Instant::now();
        let world = world(name, None);
        println!("{name} build {:?} elements {} patches {} closed {}", t.elapsed(), world.mesh.elements.len(), world.mesh.patches.len(), world.is_closed);
        println!("{:?}", world.scene.findings);
        println!("{:?}", world.viewpoint);
        for (i, side) in world.mesh.sides.iter().enumerate() { if let Some(s)=side { print!("{}{} {} ", i/2, if i%2==0 {"f"} else {"b"}, s.elements.len()); } }
        println!();
        let mut method = Radiosity::new(world.clone(), Settings::default());
        let t = std::time::Instant::now();
        let mut next = 1;
        while method.step(&Cancel::default()) == Step::Advanced {
            let s = method.solution();
            if s.steps == next {
                next *= 2;
                println!("{} {:?} unshot {:.5} defect {:.2e} closure {:?} rays {}", s.steps, t.elapsed(), s.energy.unshot_share(), total(s.energy.defect()) / total(s.energy.emitted), s.closure, s.counters.rays);
            }
        }
        let s = method.solution();
        println!("{} {:?} {:?} {:?} {:?}", s.steps, t.elapsed(), s.energy, s.closure, s.counters);
        let b: Vec<f32> = s.light.radiosity.iter().map(|b| b.x).collect();
        println!("B min {} max {} expected 2", b.iter().copied().fold(f32::MAX, f32::min), b.iter().copied().fold(0.0, f32::max));
    }
}
