//! What the thread works with: radiosity, photons, ambient occlusion on the mesh and pictures from a camera, each behind a
//! few calls.

use super::Refused;
use crate::accuracy::{Cache, Found, ProbePoint, Reference};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::methods::{Method, Settings, Step};
use crate::solution::{CameraImage, CameraView, Gathered, Photon, PhotonSolution, PhotonTrail, Solution, VertexShares};
use crate::world::World;
use glam::Vec3A;
use std::sync::Arc;

/// Where runs begin.
pub trait Workshop: Send + 'static {
    type Photons: PhotonMethod;
    type Image: ImageMethod;

    /// Radiosity before its first step.
    ///
    /// # Errors
    /// If it needs more memory than there is.
    fn radiosity(&mut self, world: &Arc<World>, settings: &Settings) -> Result<Box<dyn Method>, Refused>;

    /// Photon mapping before its first step.
    ///
    /// # Errors
    /// If it needs more memory than there is.
    fn photons(&mut self, world: &Arc<World>, settings: &Settings) -> Result<Self::Photons, Refused>;

    /// Ambient occlusion on the mesh before its first step.
    fn occlusion(&mut self, world: &Arc<World>, settings: &Settings) -> Box<dyn OcclusionMethod>;

    /// The truth about a world, and where it is kept for the next time; `None` where nothing is to be held against it.
    fn reference(&mut self, world: &Arc<World>) -> Option<(Reference, Option<Cache>)>;

    /// A picture before its first step. The light that its view needs is there.
    fn image(&mut self, lights: Lights<'_, Self::Photons>, shot: &CameraShot, settings: &Settings) -> Self::Image;

    /// Goes on with other light, so that the picture becomes the mean over both.
    fn go_on(&mut self, image: &mut Self::Image, lights: Lights<'_, Self::Photons>);
}

/// What a picture can be read off.
pub struct Lights<'a, P> {
    pub world: &'a Arc<World>,
    pub radiosity: Option<Arc<Solution>>,
    pub photons: Option<&'a mut P>,
}

/// A picture that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraShot {
    pub view: CameraView,
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

/// How far photons are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PhotonProgress {
    /// Batches of the present pass, as in [`PhotonSolution::batches`].
    pub batches: u64,
    /// Passes that are done.
    pub passes: u64,
    /// Whether all photons of the present pass are there.
    pub is_complete: bool,
}

/// Photons at work.
pub trait PhotonMethod: Send {
    /// Does one bounded piece of work, all of it or nothing.
    fn step(&mut self, cancel: &Cancel) -> Step;

    /// Takes new settings over and goes on; false, and nothing changes, if they need a fresh start.
    fn configure(&mut self, settings: &Settings) -> bool;

    /// Cheap enough to be asked at any time.
    fn progress(&self) -> PhotonProgress;

    /// Copies out what is known so far. Its `elapsed` is zero: whoever steps the method holds the clock.
    fn solution(&mut self) -> PhotonSolution;

    /// What is known of E at points; of progressive photons the mean over the passes that were counted.
    fn irradiance(&mut self, points: &[ProbePoint]) -> Found;

    /// Counts a pass of progressive photons, whose photons are all there, in the mean at these points.
    fn count_pass(&mut self, points: &[ProbePoint]);

    /// The whole way of a photon of the present pass.
    fn trail(&mut self, photon: &Photon) -> Option<PhotonTrail>;

    /// What the estimate at a point is made of, on the side that the unit `normal` faces.
    fn gathered(&mut self, point: Vec3A, normal: Vec3A) -> Option<Gathered>;
}

/// Ambient occlusion on the mesh at work.
pub trait OcclusionMethod: Send {
    /// Does one bounded piece of work, all of it or nothing.
    fn step(&mut self, cancel: &Cancel) -> Step;

    /// Takes new settings over and goes on; false, and nothing changes, if they need a fresh start.
    fn configure(&mut self, settings: &Settings) -> bool;

    /// Copies out what is known so far. Its `elapsed` is zero: whoever steps the method holds the clock.
    fn solution(&self) -> VertexShares;
}

/// A picture in the making.
pub trait ImageMethod: Send + Sized {
    /// The same view of the same light from elsewhere, before its first step: cheaper than one from [`Workshop::image`].
    #[must_use]
    fn moved_to(&self, shot: &CameraShot) -> Self;

    /// Does one bounded piece of work, all of it or nothing.
    fn step(&mut self, cancel: &Cancel) -> Step;

    /// Whole passes over all pixels that are done.
    fn samples(&self) -> u32;

    /// Whether a whole pass was just finished and the next one has not begun.
    fn is_between_passes(&self) -> bool;

    /// The picture so far; `None` before there is anything to see. Its `elapsed` is zero.
    fn image(&self) -> Option<CameraImage>;
}
