//! Scenes of quads, for tests of what scenes call for.

use glam::Vec3;
use lightwell::scene::Scene;

/// `glow` and `lamp` emit; `black` and `lamp` reflect nothing.
const MATERIALS: &str = "\
newmtl grey
Kd 0.5 0.5 0.5
newmtl red
Kd 0.5 0.25 0.25
newmtl black
Kd 0 0 0
newmtl lamp
Kd 0 0 0
Ke 1 1 1
newmtl glow
Kd 0.5 0.5 0.5
Ke 1 1 1
newmtl warm
Kd 0 0 0
Ke 2 1 1
newmtl yellow
Kd 0.5 0.5 0.25
newmtl mirror
Kd 0 0 0
Ks 0.9 0.9 0.9
illum 3
newmtl gloss
Kd 0.25 0.25 0.25
Ks 0.5 0.5 0.5
Ns 50
newmtl glass
Kd 0 0 0
Ni 1.5
illum 7
newmtl pane
Kd 0 0 0
d 0.5
illum 1
newmtl stained
Kd 0 0 0
Tf 1 0.5 0.5
Ni 1.5
illum 7
";

/// Quads of one material each.
pub struct Quads(String);

impl Quads {
    pub fn new() -> Self {
        Self("mtllib scene.mtl\n".to_owned())
    }

    pub fn quad(mut self, material: &str, corners: [Vec3; 4]) -> Self {
        self.0 += &format!("usemtl {material}\n");
        for corner in corners {
            self.0 += &format!("v {} {} {}\n", corner.x, corner.y, corner.z);
        }
        self.0 += "f -4 -3 -2 -1\n";
        self
    }

    /// A level square about the y axis with its front up.
    pub fn up(self, material: &str, half: f32, y: f32) -> Self {
        self.quad(material, [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| at(half, x, y, z)))
    }

    /// The same with its front down.
    pub fn down(self, material: &str, half: f32, y: f32) -> Self {
        self.quad(material, [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, z)| at(half, x, y, z)))
    }

    /// The upright sides of a box about the y axis, with their fronts inside or outside.
    pub fn around(self, material: &str, half: f32, y: [f32; 2], is_inside: bool) -> Self {
        let ring = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        (0..4).fold(self, |quads, i| {
            let [from, to] = [ring[i], ring[(i + 1) % 4]];
            let mut corners = [(from, y[0]), (to, y[0]), (to, y[1]), (from, y[1])].map(|((x, z), y)| at(half, x, y, z));
            if !is_inside {
                corners.reverse();
            }
            quads.quad(material, corners)
        })
    }

    /// A closed room of 2 m × 1 m × 2 m.
    pub fn room(floor: &str, ceiling: &str, walls: &str) -> Self {
        Self::new().up(floor, 1.0, 0.0).down(ceiling, 1.0, 1.0).around(walls, 1.0, [0.0, 1.0], true)
    }

    /// A closed block in the middle of such a room.
    pub fn block(self, material: &str) -> Self {
        self.down(material, 0.2, 0.3).up(material, 0.2, 0.6).around(material, 0.2, [0.3, 0.6], false)
    }

    pub fn scene(&self) -> Scene {
        Scene::from_text("quads", &self.0, MATERIALS).expect("a scene")
    }
}

fn at(half: f32, x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(half * x, y, half * z)
}
