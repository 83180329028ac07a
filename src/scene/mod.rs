//! What a scene file says: polygons, materials, a viewpoint, and what had to be mended to read it.

mod builtin;
mod doctor;
mod frame;
mod glass;
mod light;
mod lines;
mod material;
mod mtl;
mod obj;
mod polygonize;
mod repeats;
mod smooth;

pub use builtin::{BUILTINS, Builtin};
pub use doctor::{Finding, FindingKind, Severity};
pub use material::{Lobes, Material};

use glam::{DVec3, Vec3};
use std::io;
use std::path::{Path, PathBuf};

/// A scene as its file describes it, mended where that was possible. Lengths are in metres, y is up.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The built-in name, or the file's name without its folder and extension.
    pub name: String,
    /// Where it was read from.
    pub source: Source,
    /// What positions are measured from, in the coordinates of the file, m; not 0 where the file is far from its own origin.
    pub origin: DVec3,
    /// Corner positions, m from `origin`; every polygon's corners index into them.
    pub positions: Vec<Vec3>,
    /// Unit vectors: normals at corners of polygons that stand for a smooth surface.
    pub normals: Vec<Vec3>,
    /// Triangles and planar convex quads, in the order of the file.
    pub polygons: Vec<Polygon>,
    /// Never empty where there is a polygon: polygons without a material share a grey one.
    pub materials: Vec<Material>,
    /// Names of the file's objects and groups.
    pub objects: Vec<String>,
    /// The view that the scene's author measured, where one is known.
    pub viewpoint: Option<Viewpoint>,
    /// What was wrong with the file and what was done about it.
    pub findings: Vec<Finding>,
}

impl Scene {
    /// Opens a scene by the name of a built-in one or else by its path.
    ///
    /// # Errors
    /// Where there is no such file, it is no text, or it holds no face that can be used. Lesser troubles are mended and
    /// become [`Scene::findings`].
    pub fn open(name_or_path: &str) -> Result<Self, SceneError> {
        match Builtin::find(name_or_path) {
            Some(builtin) => builtin.open(),
            None => Self::open_file(Path::new(name_or_path)),
        }
    }

    /// Reads a scene that is part of the program from OBJ text. Whatever library it asks for has the MTL text.
    ///
    /// # Errors
    /// [`SceneError::Empty`] where no face can be used.
    pub fn from_text(name: &'static str, obj: &str, mtl: &str) -> Result<Self, SceneError> {
        obj::read(obj, name, Source::Builtin(name), name, &mut |_| Ok(mtl.to_owned()))
    }

    fn open_file(path: &Path) -> Result<Self, SceneError> {
        let text = read_text(path).map_err(|source| match source.kind() {
            io::ErrorKind::NotFound => {
                let known = BUILTINS.iter().map(|builtin| builtin.name).collect::<Vec<_>>().join(", ");
                SceneError::Unknown { name: path.display().to_string(), known }
            }
            _ => SceneError::Read { path: path.to_owned(), source },
        })?;
        let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy();
        let folder = path.parent().unwrap_or(Path::new(""));
        // Files written on Windows may have its separators.
        let mut load_library = |file: &str| read_text(&folder.join(file.replace('\\', "/")));
        let source = Source::File(path.to_owned());
        obj::read(&text, &name, source, &path.display().to_string(), &mut load_library)
    }
}

/// Reads a text file of any encoding that extends ASCII.
fn read_text(path: &Path) -> io::Result<String> {
    let bytes = std::fs::read(path)?;
    if bytes.contains(&0) {
        return Err(io::Error::new(io::ErrorKind::InvalidData, "it is not a text file"));
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Where a scene comes from: a path, or the name of a scene that is built into the program.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    Builtin(&'static str),
    File(PathBuf),
}

/// A planar convex face with three or four corners. Its front is the side from which they run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Polygon {
    corners: [u32; 4],
    corner_count: u8,
    /// Indices into [`Scene::normals`], corner by corner.
    normals: Option<[u32; 4]>,
    /// Index into [`Scene::materials`].
    pub material: u32,
    /// Index into [`Scene::objects`].
    pub object: u32,
    /// Line of the file, from 1, that states the face; 0 for a polygon that is in no file.
    pub line: u32,
}

impl Polygon {
    /// `corners` are indices of positions: three or four of them.
    ///
    /// # Panics
    /// If there are fewer than three or more than four corners.
    pub fn new(corners: &[u32], material: u32, object: u32, line: u32) -> Self {
        assert!((3..=4).contains(&corners.len()), "a polygon has three or four corners");
        Self { corners: padded(corners), corner_count: corners.len() as u8, normals: None, material, object, line }
    }

    /// The same polygon standing for a smooth surface that has these normals at its corners: indices of
    /// [`Scene::normals`].
    ///
    /// # Panics
    /// If there are not as many as corners.
    #[must_use]
    pub fn with_normals(self, normals: &[u32]) -> Self {
        assert_eq!(normals.len(), self.corners().len(), "every corner has its normal");
        Self { normals: Some(padded(normals)), ..self }
    }

    /// The same polygon standing for nothing but itself.
    #[must_use]
    pub fn without_normals(self) -> Self {
        Self { normals: None, ..self }
    }

    /// The same polygon at other corners.
    ///
    /// # Panics
    /// If there are not as many as before.
    #[must_use]
    pub fn at_corners(self, corners: &[u32]) -> Self {
        assert_eq!(corners.len(), self.corners().len(), "a polygon keeps its corners' number");
        Self { corners: padded(corners), ..self }
    }

    /// The same face with its front and back exchanged.
    #[must_use]
    pub fn turned(&self) -> Self {
        let reversed = |ring: &[u32]| padded(&ring.iter().rev().copied().collect::<Vec<u32>>());
        Self { corners: reversed(self.corners()), normals: self.normals().map(reversed), ..*self }
    }

    /// Indices of the corner positions, counter-clockwise seen from the front.
    pub fn corners(&self) -> &[u32] {
        &self.corners[..self.corner_count as usize]
    }

    /// Indices of the normals at its corners, where it stands for a smooth surface.
    pub fn normals(&self) -> Option<&[u32]> {
        self.normals.as_ref().map(|normals| &normals[..self.corner_count as usize])
    }
}

/// Three or four indices in the room of four.
fn padded(indices: &[u32]) -> [u32; 4] {
    let mut padded = [indices[2]; 4];
    padded[..indices.len()].copy_from_slice(indices);
    padded
}

/// A pinhole camera's place and lens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    pub eye: Vec3,
    pub target: Vec3,
    pub up: Vec3,
    /// Full vertical angle of view, degrees.
    pub vertical_fov: f32,
}

/// Why a scene could not be opened.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    #[error("cannot read {path}")]
    Read { path: PathBuf, source: io::Error },
    #[error("no scene is called `{name}`, and there is no such file (built-in scenes: {known})")]
    Unknown { name: String, known: String },
    #[error("{path} has no face that can be used: {reason}")]
    Empty { path: String, reason: String },
}
