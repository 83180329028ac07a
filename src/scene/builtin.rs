//! Scenes that are part of the program.

use super::{Scene, SceneError, Source, Viewpoint, obj};
use glam::Vec3;
use std::io;

/// A scene whose files are embedded in the program.
#[derive(Debug)]
pub struct Builtin {
    pub name: &'static str,
    /// One line.
    pub description: &'static str,
    pub viewpoint: Option<Viewpoint>,
    obj: &'static str,
    mtl: &'static str,
}

/// Every built-in scene, in the order in which they are listed.
pub const BUILTINS: &[Builtin] = &[
    Builtin {
        name: "cornell-box",
        description: "the Cornell box as it was measured: two blocks under a square lamp, between a red and a green wall",
        viewpoint: Some(CORNELL_CAMERA),
        obj: include_str!("../../assets/scenes/cornell-box.obj"),
        mtl: include_str!("../../assets/scenes/cornell-box.mtl"),
    },
    Builtin {
        name: "empty-box",
        description: "the Cornell box without its blocks",
        viewpoint: Some(CORNELL_CAMERA),
        obj: include_str!("../../assets/scenes/empty-box.obj"),
        mtl: include_str!("../../assets/scenes/empty-box.mtl"),
    },
    Builtin {
        name: "furnace",
        description: "a closed cube that glows and reflects alike on all sides, so that B = M_e / (1 - rho) = 2 W/m2",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(0.5, 0.5, 0.95),
            target: Vec3::new(0.5, 0.5, 0.0),
            up: Vec3::Y,
            vertical_fov: 60.0,
        }),
        obj: include_str!("../../assets/scenes/furnace.obj"),
        mtl: include_str!("../../assets/scenes/furnace.mtl"),
    },
    Builtin {
        name: "two-rooms",
        description: "two rooms with one lamp: the far room is lit only through a doorway",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(7.3, 1.6, 3.8),
            target: Vec3::new(6.0, 0.9, 0.5),
            up: Vec3::Y,
            vertical_fov: 62.0,
        }),
        obj: include_str!("../../assets/scenes/two-rooms.obj"),
        mtl: include_str!("../../assets/scenes/two-rooms.mtl"),
    },
    Builtin {
        name: "gallery",
        description: "a vaulted gallery with columns, lanterns and a red carpet, and daylight from one side",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(0.8, 1.6, -1.0),
            target: Vec3::new(-0.4, 2.7, -14.0),
            up: Vec3::Y,
            vertical_fov: 58.0,
        }),
        obj: include_str!("../../assets/scenes/gallery.obj"),
        mtl: include_str!("../../assets/scenes/gallery.mtl"),
    },
    Builtin {
        name: "cornell-spheres",
        description: "the measured Cornell room with a mirror ball and a glass ball, which gathers light on the floor",
        viewpoint: Some(CORNELL_CAMERA),
        obj: include_str!("../../assets/scenes/cornell-spheres.obj"),
        mtl: include_str!("../../assets/scenes/cornell-spheres.mtl"),
    },
    Builtin {
        name: "caustic-ring",
        description: "a ring of brass on a table that reflects the light of a small lamp into a cardioid",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(0.02, 0.5, 0.22),
            target: Vec3::new(0.0, 0.02, 0.0),
            up: Vec3::Y,
            vertical_fov: 34.0,
        }),
        obj: include_str!("../../assets/scenes/caustic-ring.obj"),
        mtl: include_str!("../../assets/scenes/caustic-ring.mtl"),
    },
    Builtin {
        name: "glass-block",
        description: "a rod and a prism of glass that draw the light of a small lamp into their shadows and beside them",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(0.35, 0.62, 0.72),
            target: Vec3::new(0.1, 0.0, 0.0),
            up: Vec3::Y,
            vertical_fov: 40.0,
        }),
        obj: include_str!("../../assets/scenes/glass-block.obj"),
        mtl: include_str!("../../assets/scenes/glass-block.mtl"),
    },
    Builtin {
        name: "glossy-floor",
        description: "a room with a glossy floor, in which a red block, a blue column and a yellow ball are reflected",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(0.0, 1.25, -0.15),
            target: Vec3::new(0.0, 0.75, -2.6),
            up: Vec3::Y,
            vertical_fov: 62.0,
        }),
        obj: include_str!("../../assets/scenes/glossy-floor.obj"),
        mtl: include_str!("../../assets/scenes/glossy-floor.mtl"),
    },
    Builtin {
        name: "ao-study",
        description: "the corner of a room without a lamp: a stair, a niche, balls, blocks and gaps of 5 to 40 mm, for ambient occlusion",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(3.5, 2.3, 5.4),
            target: Vec3::new(1.65, 0.58, 1.2),
            up: Vec3::Y,
            vertical_fov: 45.0,
        }),
        obj: include_str!("../../assets/scenes/ao-study.obj"),
        mtl: include_str!("../../assets/scenes/ao-study.mtl"),
    },
    Builtin {
        name: "machine-hall",
        description: "a hall without a lamp, full of pumps, vessels, pipes, bolts and gratings under a crane, for ambient occlusion",
        viewpoint: Some(Viewpoint {
            eye: Vec3::new(-1.2, 3.4, -0.5),
            target: Vec3::new(1.0, 2.2, -12.0),
            up: Vec3::Y,
            vertical_fov: 60.0,
        }),
        obj: include_str!("../../assets/scenes/machine-hall.obj"),
        mtl: include_str!("../../assets/scenes/machine-hall.mtl"),
    },
];

/// The measured camera: 35 mm focal length and a film of 25 mm, so a vertical angle of 2 atan(12.5 / 35).
const CORNELL_CAMERA: Viewpoint = Viewpoint {
    eye: Vec3::new(0.278, 0.273, -0.8),
    target: Vec3::new(0.278, 0.273, 0.2796),
    up: Vec3::Y,
    vertical_fov: 39.307_65,
};

impl Builtin {
    /// The built-in scene of this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        BUILTINS.iter().find(|builtin| builtin.name == name)
    }

    pub(super) fn open(&'static self) -> Result<Scene, SceneError> {
        let mut load_library = |file: &str| {
            let is_own = file.strip_suffix(".mtl") == Some(self.name);
            if is_own { Ok(self.mtl.to_owned()) } else { Err(io::ErrorKind::NotFound.into()) }
        };
        let scene = obj::read(self.obj, self.name, Source::Builtin(self.name), self.name, &mut load_library)?;
        Ok(Scene { viewpoint: self.viewpoint, ..scene })
    }
}
