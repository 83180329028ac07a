//! Small scenes as OBJ files.

use glam::Vec3;
use lightwell::scene::Scene;

/// Materials that every scene here may use. The lamp emits 1 W/(m²·sr) and reflects nothing.
const MATERIALS: &str = "\
newmtl white
Kd 0.5 0.5 0.5
newmtl black
Kd 0 0 0
newmtl lamp
Kd 0 0 0
Ke 1 1 1
newmtl glass
Kd 0 0 0
Ni 1.5
illum 7
newmtl glow
Kd 0.5 0.5 0.5
Ke 1 1 1
";

/// The corners of a box, and its faces seen from outside.
const FACES: [[usize; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Faces with their objects and materials.
pub struct Obj {
    text: String,
    scale: f32,
}

impl Obj {
    pub fn new() -> Self {
        Self::scaled(1.0)
    }

    /// Objects, materials, vertices and faces as they stand in a file.
    pub fn from_text(text: String) -> Self {
        Self { text, scale: 1.0 }
    }

    /// A scene of which every length is multiplied.
    pub fn scaled(scale: f32) -> Self {
        Self { text: "mtllib scene.mtl\n".to_owned(), scale }
    }

    /// What follows is a part of this object and made of this material.
    pub fn object(mut self, name: &str, material: &str) -> Self {
        self.text += &format!("o {name}\nusemtl {material}\n");
        self
    }

    /// A face with its front where these corners run counter-clockwise.
    pub fn face(mut self, corners: impl IntoIterator<Item = Vec3>) -> Self {
        let mut count = 0;
        for corner in corners {
            let corner = corner * self.scale;
            self.text += &format!("v {:e} {:e} {:e}\n", corner.x, corner.y, corner.z);
            count += 1;
        }
        let indices: Vec<String> = (1..=count).rev().map(|index| format!("-{index}")).collect();
        self.text += &format!("f {}\n", indices.join(" "));
        self
    }

    /// A level rectangle with its front up.
    pub fn level(self, x: [f32; 2], y: f32, z: [f32; 2]) -> Self {
        self.face([(0, 0), (0, 1), (1, 1), (1, 0)].map(|(i, j)| Vec3::new(x[i], y, z[j])))
    }

    /// A level rectangle with its front down.
    pub fn level_down(self, x: [f32; 2], y: f32, z: [f32; 2]) -> Self {
        self.face([(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| Vec3::new(x[i], y, z[j])))
    }

    /// The faces of a box with their fronts outside.
    pub fn block(self, low: Vec3, high: Vec3) -> Self {
        self.sides_of_box(low, high, true, |_| true)
    }

    /// The same without the face below.
    pub fn block_without_underside(self, low: Vec3, high: Vec3) -> Self {
        self.sides_of_box(low, high, true, |normal| normal.y > -0.5)
    }

    /// The faces of a box with their fronts inside.
    pub fn room(self, low: Vec3, high: Vec3) -> Self {
        self.sides_of_box(low, high, false, |_| true)
    }

    /// The same without the face that has this outward normal.
    pub fn room_open_to(self, open: Vec3, low: Vec3, high: Vec3) -> Self {
        self.sides_of_box(low, high, false, |normal| normal.dot(open) < 0.5)
    }

    fn sides_of_box(mut self, low: Vec3, high: Vec3, outward: bool, is_wanted: impl Fn(Vec3) -> bool) -> Self {
        let pick = |i: usize| Vec3::new([low.x, high.x][i & 1], [low.y, high.y][i >> 1 & 1], [low.z, high.z][i >> 2]);
        for face in FACES {
            let mut corners = face.map(pick);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
            if !outward {
                corners.reverse();
            }
            if is_wanted(normal) {
                self = self.face(corners);
            }
        }
        self
    }

    pub fn triangles(self, triangles: &[[Vec3; 3]]) -> Self {
        triangles.iter().fold(self, |obj, &corners| obj.face(corners))
    }

    /// Rooms on a floor plan of square metres, 1 m high, with fronts inside: `#` is solid, `L` has a lamp under the
    /// ceiling, everything else is empty.
    pub fn floor_plan(mut self, rows: &[&str]) -> Self {
        let cell = |i: i32, j: i32| {
            let row = usize::try_from(j).ok().and_then(|j| rows.get(j));
            let cell = row.and_then(|row| row.as_bytes().get(usize::try_from(i).ok()?));
            cell.copied().unwrap_or(b'#')
        };
        let size = |count: usize| i32::try_from(count).expect("a small plan");
        let (width, depth) = (size(rows.iter().map(|row| row.len()).max().unwrap_or(0)), size(rows.len()));
        for (i, j) in (0..depth).flat_map(|j| (0..width).map(move |i| (i, j))).filter(|&(i, j)| cell(i, j) != b'#') {
            let low = Vec3::new(i as f32, 0.0, j as f32);
            let steps = [(Vec3::X, 1, 0), (Vec3::NEG_X, -1, 0), (Vec3::Z, 0, 1), (Vec3::NEG_Z, 0, -1)];
            let has_wall =
                |normal: Vec3| steps.iter().all(|&(way, x, z)| normal.dot(way) < 0.5 || cell(i + x, j + z) == b'#');
            self = self.object("rooms", "white").sides_of_box(low, low + Vec3::ONE, false, has_wall);
            if cell(i, j) == b'L' {
                let (x, z) = ([low.x + 0.3, low.x + 0.7], [low.z + 0.3, low.z + 0.7]);
                self = self.object("lamp", "lamp").level_down(x, 0.9, z);
            }
        }
        self
    }

    pub fn open(&self) -> Scene {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("scene.obj");
        std::fs::write(&path, &self.text).expect("a file");
        std::fs::write(folder.path().join("scene.mtl"), MATERIALS).expect("a file");
        Scene::open(&path.display().to_string()).expect("a scene")
    }
}
