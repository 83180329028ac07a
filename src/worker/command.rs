//! What the window may ask of the solver thread.

use crate::camera::Camera;
use crate::methods::Settings;
use crate::scene::Scene;
use crate::solution::{CameraView, Photon};
use crate::world::World;
use glam::Vec3;
use std::fmt;
use std::sync::Arc;

/// Commands take effect in the order they are sent; of several of one kind the newest wins.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens a scene: a path or the name of a built-in one.
    Load(String),
    /// Opens a scene that is in memory.
    Show(Shown),
    /// Adds a ceiling light to a scene that has no emitter.
    AddCeilingLight,
    /// Applies settings; a new mesh or a new method starts from the emitters again.
    Configure(Settings),
    Run,
    Pause,
    /// Does this many steps, publishing each, then pauses.
    Step(u64),
    /// Starts over from the emitters, paused.
    Reset,
    /// Computes what the patch at this place sees and where its light comes from, or forgets about it and the second place.
    /// Without effect if another world is on show by then.
    Pick(Option<Place>),
    /// Says what this second place sends to the first one. Without effect if another world is on show by then.
    PickSource(Place),
    /// Traces the way of a photon again, or forgets about it. Other photons may be on show by then: one that is not among
    /// them has no way.
    PickPhoton(Option<Photon>),
    /// Says what the estimate of irradiance at a spot is made of, or forgets about it.
    Gather(Option<Spot>),
    /// Says what is on show: it is worked on first, and a picture from a camera is made anew where anything of it changed.
    Look(Sight),
    /// Lets the measuring of errors wait, or go on: something else wants the processors.
    Hush(bool),
}

/// What is on show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    pub subject: Subject,
    pub camera: Camera,
    /// Width and height of the picture, pixels.
    pub size: [u32; 2],
}

/// Whose work is on show. `Run`, `Step`, `Pause` and `Reset` are about its light: the radiosity solution, or the photons
/// that a picture is read off, or ambient light on the mesh. Pictures from a camera are made without being told to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    #[default]
    Radiosity,
    Photons,
    /// Ambient occlusion at the vertices of the mesh.
    Occlusion,
    Camera(CameraView),
}

/// A way to compute light that goes on by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightKind {
    Radiosity,
    Photons,
    /// Ambient light, as far as it is not occluded, at the vertices of the mesh.
    Occlusion,
}

impl LightKind {
    pub const ALL: [Self; 3] = [Self::Radiosity, Self::Photons, Self::Occlusion];
}

impl Subject {
    /// The light that it shows or is read off; `None` where rays from the camera find it themselves.
    pub fn light(self) -> Option<LightKind> {
        match self {
            Self::Radiosity => Some(LightKind::Radiosity),
            Self::Photons => Some(LightKind::Photons),
            Self::Occlusion => Some(LightKind::Occlusion),
            Self::Camera(view) if view.needs_photons() => Some(LightKind::Photons),
            Self::Camera(view) if view.needs_radiosity() => Some(LightKind::Radiosity),
            Self::Camera(_) => None,
        }
    }

    /// The picture from a camera that it is, if it is one.
    pub fn view(self) -> Option<CameraView> {
        match self {
            Self::Camera(view) => Some(view),
            Self::Radiosity | Self::Photons | Self::Occlusion => None,
        }
    }
}

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// On the surface, m.
    pub point: Vec3,
    /// Unit normal on the side that is looked at.
    pub normal: Vec3,
}

/// A point of a patch of a world.
#[derive(Clone)]
pub struct Place {
    pub world: Arc<World>,
    /// Index among the patches of its mesh.
    pub patch: u32,
    /// On that patch, m.
    pub point: Vec3,
}

impl PartialEq for Place {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.world, &other.world) && (self.patch, self.point) == (other.patch, other.point)
    }
}

impl fmt::Debug for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} on patch {} of {}", self.point, self.patch, self.world.scene.name)
    }
}

/// A scene that is in memory. Two are equal if they are the same copy.
#[derive(Clone, Debug)]
pub struct Shown(pub Arc<Scene>);

impl PartialEq for Shown {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
