//! Mirrors, glass and gloss against the laws of optics.

mod materials;
mod normals;
#[path = "../common/shapes.rs"]
mod shapes;

use lightwell::scene::Scene;

/// A scene from OBJ and MTL text.
fn scene(obj: &str, mtl: &str) -> Scene {
    Scene::from_text("scene", &format!("mtllib all\n{obj}"), mtl).expect("the scene opens")
}
