//! Scenes for the cases, as text that goes through the loader, and their light.

use crate::cancel::{Cancel, Cancelled};
use crate::mesh::{Element, MeshSettings};
use crate::methods::{Settings, Step, radiosity};
use crate::scene::{Scene, SceneError};
use crate::solution::Solution;
use crate::world::{World, WorldError};
use glam::DVec3;
use std::fmt::Write;
use std::sync::Arc;

/// An OBJ file with its materials, line by line.
pub struct Stage {
    obj: String,
    mtl: String,
    scale: f64,
    shift: DVec3,
}

impl Stage {
    pub fn new() -> Self {
        Self { obj: "mtllib stage.mtl\n".to_owned(), mtl: String::new(), scale: 1.0, shift: DVec3::ZERO }
    }

    /// Scales what follows and then moves it.
    pub fn placed(mut self, scale: f64, shift: DVec3) -> Self {
        (self.scale, self.shift) = (scale, shift);
        self
    }

    /// Begins an object of a new material: grey with this reflectance and emitted radiance, W/(m²·sr).
    pub fn object(self, name: &str, reflectance: f64, radiance: f64) -> Self {
        let material = format!("newmtl {name}\nKd {reflectance}\nKe {radiance}\n");
        self.line(&format!("o {name}\nusemtl {name}")).material(&material)
    }

    /// A face with its front where the corners run counter-clockwise.
    pub fn face(mut self, corners: &[DVec3]) -> Self {
        for &corner in corners {
            let DVec3 { x, y, z } = corner * self.scale + self.shift;
            writeln!(self.obj, "v {x} {y} {z}").expect("text grows");
        }
        let indices: String = (1..=corners.len()).rev().map(|back| format!(" -{back}")).collect();
        self.line(&format!("f{indices}"))
    }

    /// A face with its front up.
    pub fn level_up(self, x: [f64; 2], y: f64, z: [f64; 2]) -> Self {
        self.face(&level(x, y, z))
    }

    /// A face with its front down.
    pub fn level_down(self, x: [f64; 2], y: f64, z: [f64; 2]) -> Self {
        let [a, b, c, d] = level(x, y, z);
        self.face(&[d, c, b, a])
    }

    /// The six faces of a box that is looked at from within.
    pub fn room(self, low: DVec3, high: DVec3) -> Self {
        room_faces(low, high).iter().fold(self, |stage, face| stage.face(face))
    }

    /// The six faces of a box that is looked at from outside.
    pub fn block(self, low: DVec3, high: DVec3) -> Self {
        box_faces(low, high).iter().fold(self, |stage, face| stage.face(face))
    }

    /// A line of the OBJ file, as it is.
    pub fn line(mut self, line: &str) -> Self {
        writeln!(self.obj, "{line}").expect("text grows");
        self
    }

    /// Lines of the MTL file, as they are.
    pub fn material(mut self, lines: &str) -> Self {
        self.mtl.push_str(lines);
        self
    }

    /// OBJ and MTL text.
    pub fn text(&self) -> (&str, &str) {
        (&self.obj, &self.mtl)
    }

    /// # Errors
    /// As [`Scene::open`].
    pub fn try_open(&self, name: &'static str) -> Result<Scene, SceneError> {
        Scene::from_text(name, &self.obj, &self.mtl)
    }

    /// # Panics
    /// If there is no face that can be used.
    pub fn open(&self, name: &'static str) -> Scene {
        self.try_open(name).expect("a scene of the gallery has a face")
    }

    /// The scene to look at.
    pub fn show(&self, name: &'static str) -> Option<Arc<Scene>> {
        Some(Arc::new(self.open(name)))
    }
}

/// Radiance of what has M_e = 1 W/m².
pub const GLOW: f64 = std::f64::consts::FRAC_1_PI;

/// A closed room of a cubic metre, its floor first, with this reflectance and emitted radiance, W/(m²·sr).
pub fn cube(reflectance: f64, radiance: f64) -> Stage {
    Stage::new().object("room", reflectance, radiance).room(DVec3::ZERO, DVec3::ONE)
}

/// The same with a lamp under its ceiling.
pub fn lit_cube(reflectance: f64) -> Stage {
    cube(reflectance, 0.0).object("lamp", 0.5, 1.0).level_down([0.3, 0.7], 0.9, [0.3, 0.7])
}

/// A glowing unit square, "floor", that looks up at a black one, "plate".
pub fn plates(gap: f64) -> Stage {
    let unit = [0.0, 1.0];
    let stage = Stage::new().object("floor", 0.0, 1.0).level_up(unit, 0.0, unit);
    stage.object("plate", 0.0, 0.0).level_down(unit, gap, unit)
}

/// Corners of a level rectangle, counter-clockwise seen from above.
pub fn level(x: [f64; 2], y: f64, z: [f64; 2]) -> [DVec3; 4] {
    [(x[0], z[0]), (x[0], z[1]), (x[1], z[1]), (x[1], z[0])].map(|(x, z)| DVec3::new(x, y, z))
}

/// Faces of a box with their fronts inside: floor, ceiling, x low, x high, z low, z high.
pub fn room_faces(low: DVec3, high: DVec3) -> [[DVec3; 4]; 6] {
    box_faces(low, high).map(|[a, b, c, d]| [d, c, b, a])
}

/// Faces of a box with their fronts outside: floor, ceiling, x low, x high, z low, z high.
fn box_faces(low: DVec3, high: DVec3) -> [[DVec3; 4]; 6] {
    let corner = |i: usize| {
        DVec3::new(
            if i & 1 == 0 { low.x } else { high.x },
            if i & 2 == 0 { low.y } else { high.y },
            if i & 4 == 0 { low.z } else { high.z },
        )
    };
    [[0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5], [0, 2, 3, 1], [4, 5, 7, 6]].map(|face| face.map(corner))
}

/// Elements of at most this size, each a patch of its own.
pub fn single(element_size: f64) -> MeshSettings {
    MeshSettings { element_size: Some(element_size as f32), elements_per_patch_edge: 1 }
}

/// The scene made ready for light.
///
/// # Errors
/// If cancelled.
pub fn world(scene: Scene, mesh: MeshSettings, cancel: &Cancel) -> Result<Arc<World>, Cancelled> {
    match World::build(scene, &mesh, cancel) {
        Ok(world) => Ok(Arc::new(world)),
        Err(WorldError::Cancelled) => Err(Cancelled),
        Err(error) => panic!("a scene of the gallery cannot be meshed: {error}"),
    }
}

/// Light until the stop rule of the settings holds.
///
/// # Errors
/// If cancelled.
pub fn solve(world: &Arc<World>, settings: &Settings, cancel: &Cancel) -> Result<Solution, Cancelled> {
    steps(world, settings, u64::MAX, cancel)
}

/// Light after so many steps, or fewer if the stop rule holds before.
///
/// # Errors
/// If cancelled.
pub fn steps(world: &Arc<World>, settings: &Settings, steps: u64, cancel: &Cancel) -> Result<Solution, Cancelled> {
    let mut method = radiosity::start(world.clone(), settings);
    let mut done = 0;
    while done < steps {
        match method.step(cancel) {
            Step::Prepared => {}
            Step::Advanced => done += 1,
            Step::Converged => break,
            Step::Cancelled => return Err(Cancelled),
        }
    }
    Ok(method.solution())
}

/// Indices of the elements of one object, on the fronts of its faces.
pub fn elements_of<'a>(world: &'a World, object: &'a str) -> impl Iterator<Item = usize> + 'a {
    let is_of = move |element: &Element| {
        let patch = &world.mesh.patches[element.patch as usize];
        let polygon = &world.scene.polygons[patch.polygon as usize];
        patch.is_front && world.scene.objects[polygon.object as usize] == object
    };
    (0..world.mesh.elements.len()).filter(move |&i| is_of(&world.mesh.elements[i]))
}

/// The first patch of one object's fronts.
pub fn patch_of(world: &World, object: &str) -> u32 {
    let first = elements_of(world, object).next().expect("the object is meshed");
    world.mesh.elements[first].patch
}
