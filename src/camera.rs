//! A camera that turns around what it looks at.

use crate::math::bounds::Bounds;
use crate::scene::Viewpoint;
use crate::tracer::Ray;
use glam::dcamera::rh::proj::directx::perspective_infinite_reverse;
use glam::dcamera::rh::view::look_to_mat4;
use glam::{DMat4, DQuat, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A pinhole camera in spherical coordinates around its target. In double precision, so that small steps far from the
/// origin are not lost, and without lengths of its own: everything follows from the size of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// What it looks at and turns around, m.
    target: DVec3,
    /// From the target to the eye, m.
    distance: f64,
    /// Turn of the eye about `up`, radians.
    azimuth: f64,
    /// Height of the eye over the plane through the target that `up` is normal to, radians.
    elevation: f64,
    /// The pole, of unit length.
    up: DVec3,
    /// Full vertical angle of view, radians.
    vertical_fov: f64,
    /// Radius of a sphere around the scene, m. Scales the near plane and the shortest and longest distance.
    scene_radius: f64,
}

impl Camera {
    /// The eye stays this far from the pole, radians, because left and right are not defined there.
    const POLE_MARGIN: f64 = 0.01;
    /// Nearest and farthest that the eye may be from the target, in radii of the scene.
    const DISTANCES: [f64; 2] = [1e-4, 1e3];
    /// The near plane, as a share of the distance to the target or of the scene's radius, whichever is shorter. Depth is
    /// reversed and in floating point, so its precision is relative and a plane this near costs none.
    const NEAR: f64 = 1e-3;
    /// Room around a scene that fits, as a factor of its radius.
    const FIT_MARGIN: f64 = 1.05;

    /// The camera that stands at `viewpoint`, in a scene that fills `bounds`.
    ///
    /// A viewpoint that looks along its own up vector gets one that it does not look along, and one whose eye is its
    /// target steps back by the radius of the scene.
    pub fn new(viewpoint: &Viewpoint, bounds: &Bounds) -> Self {
        let scene_radius = radius(bounds);
        let target = viewpoint.target.as_dvec3();
        let offset = viewpoint.eye.as_dvec3() - target;
        let direction = offset.try_normalize().unwrap_or(DVec3::Z);
        let distance = if offset.length() > 0.0 { offset.length() } else { scene_radius };
        let up = viewpoint
            .up
            .as_dvec3()
            .try_normalize()
            .filter(|up| up.cross(direction).length() > Self::POLE_MARGIN.sin())
            .unwrap_or_else(|| direction.any_orthonormal_vector());
        let mut camera = Self {
            target,
            distance,
            azimuth: 0.0,
            elevation: 0.0,
            up,
            vertical_fov: f64::from(viewpoint.vertical_fov).to_radians(),
            scene_radius,
        };
        camera.face(direction);
        camera
    }

    /// Where it stands and how it looks, in the form that scene files and screenshots keep.
    pub fn viewpoint(&self) -> Viewpoint {
        Viewpoint {
            eye: self.eye().as_vec3(),
            target: self.target.as_vec3(),
            up: self.up.as_vec3(),
            vertical_fov: self.vertical_fov.to_degrees() as f32,
        }
    }

    /// Where rays start, m.
    pub fn eye(&self) -> DVec3 {
        self.target + self.distance * self.direction()
    }

    /// Turns around the target by a drag of `dx` to the right and `dy` down, in heights of the picture; a drag over the
    /// whole height is half a turn. The eye stops short of the poles.
    pub fn orbit(&mut self, dx: f32, dy: f32) {
        let limit = FRAC_PI_2 - Self::POLE_MARGIN;
        self.azimuth = (self.azimuth - PI * f64::from(dx)).rem_euclid(TAU);
        self.elevation = (self.elevation + PI * f64::from(dy)).clamp(-limit, limit);
    }

    /// Moves eye and target sideways by a drag of `dx` to the right and `dy` down, in heights of the picture, so that
    /// the target stays under the pointer.
    pub fn pan(&mut self, dx: f32, dy: f32) {
        let height = 2.0 * self.distance * (0.5 * self.vertical_fov).tan();
        let (right, up) = self.right_and_up();
        self.target += height * (f64::from(dy) * up - f64::from(dx) * right);
    }

    /// Moves the eye along its line of sight: `factor` times as far from the target, within what the scene allows.
    pub fn zoom(&mut self, factor: f32) {
        let [nearest, farthest] = Self::DISTANCES.map(|share| share * self.scene_radius);
        self.distance = (self.distance * f64::from(factor)).clamp(nearest, farthest);
    }

    /// Looks at the middle of `bounds` from the direction it has, just far enough away to see all of them in a picture
    /// of this aspect ratio (width / height).
    pub fn fit(&mut self, bounds: &Bounds, aspect: f32) {
        let half_height = (0.5 * self.vertical_fov).tan();
        let narrower = half_height.atan().min((half_height * f64::from(aspect)).atan());
        self.target = bounds.center().as_dvec3();
        self.distance = Self::FIT_MARGIN * radius(bounds) / narrower.sin();
    }

    /// The camera that is `t` in [0, 1] of the way to `other`: the target goes straight, the eye turns the shorter way
    /// around it, and the distance changes by equal factors in equal times.
    pub fn toward(&self, other: &Self, t: f32) -> Self {
        let t = f64::from(t.clamp(0.0, 1.0));
        let mut start = Self { up: other.up, ..*self };
        start.face(self.direction());
        let turn = (other.azimuth - start.azimuth + PI).rem_euclid(TAU) - PI;
        Self {
            target: self.target.lerp(other.target, t),
            distance: self.distance * (other.distance / self.distance).powf(t),
            azimuth: start.azimuth + t * turn,
            elevation: start.elevation + t * (other.elevation - start.elevation),
            vertical_fov: self.vertical_fov + t * (other.vertical_fov - self.vertical_fov),
            ..*other
        }
    }

    /// World coordinates to clip coordinates, for a picture of this aspect ratio (width / height). Depth is 1 at the near
    /// plane and falls to 0 at infinity.
    pub fn clip_from_world(&self, aspect: f32) -> DMat4 {
        let near = Self::NEAR * self.distance.min(self.scene_radius);
        let clip_from_view = perspective_infinite_reverse(self.vertical_fov, f64::from(aspect), near);
        clip_from_view * look_to_mat4(self.eye(), -self.direction(), self.up)
    }

    /// The ray from the eye through a point of a picture of this size, both in pixels; the point counts from the top left
    /// corner.
    pub fn ray(&self, at: [f32; 2], size: [u32; 2]) -> Ray {
        self.rays(size).through(at)
    }

    /// All rays from the eye through a picture of this size, in pixels.
    pub fn rays(&self, size: [u32; 2]) -> EyeRays {
        let [width, height] = size.map(f64::from);
        let half_height = (0.5 * self.vertical_fov).tan();
        let (right, up) = self.right_and_up();
        let pixel = 2.0 * half_height / height;
        EyeRays {
            eye: self.eye(),
            top_left: half_height * (up - width / height * right) - self.direction(),
            right: pixel * right,
            down: -pixel * up,
        }
    }

    /// From the target to the eye, of unit length.
    fn direction(&self) -> DVec3 {
        let [x, z] = equator(self.up);
        let (sin, cos) = self.elevation.sin_cos();
        let around = DVec2::from_angle(self.azimuth);
        cos * (around.x * x + around.y * z) + sin * self.up
    }

    /// Puts the eye in `direction` from the target, which has unit length, or as near to the pole as it may be.
    fn face(&mut self, direction: DVec3) {
        let [x, z] = equator(self.up);
        let limit = FRAC_PI_2 - Self::POLE_MARGIN;
        self.azimuth = direction.dot(z).atan2(direction.dot(x)).rem_euclid(TAU);
        self.elevation = direction.dot(self.up).clamp(-1.0, 1.0).asin().clamp(-limit, limit);
    }

    /// The picture's axes in the world, of unit length.
    fn right_and_up(&self) -> (DVec3, DVec3) {
        let right = self.up.cross(self.direction()).normalize();
        (right, self.direction().cross(right))
    }
}

/// The rays from an eye through the plane of a picture.
#[derive(Clone, Copy, Debug)]
pub struct EyeRays {
    eye: DVec3,
    /// From the eye to the picture's corner, and from there along one pixel.
    top_left: DVec3,
    right: DVec3,
    down: DVec3,
}

impl EyeRays {
    /// The ray through a point in pixels, counted from the top left corner.
    pub fn through(&self, at: [f32; 2]) -> Ray {
        let direction = self.top_left + f64::from(at[0]) * self.right + f64::from(at[1]) * self.down;
        Ray::new(self.eye.as_vec3a(), direction.normalize().as_vec3a())
    }
}

/// The way from one camera to another, for an animation.
#[derive(Clone, Copy, Debug)]
pub struct Flight {
    pub from: Camera,
    pub to: Camera,
}

impl Flight {
    /// How long it takes, s.
    pub const DURATION: f32 = 0.4;

    /// The camera `seconds` after the start, slow at both ends; `None` once the flight is over.
    pub fn at(&self, seconds: f32) -> Option<Camera> {
        let t = seconds / Self::DURATION;
        (t < 1.0).then(|| self.from.toward(&self.to, t * t * (3.0 - 2.0 * t)))
    }
}

/// Two axes of unit length that span the plane normal to `up`, turned so that azimuth grows counter-clockwise seen from
/// the tip of `up`.
fn equator(up: DVec3) -> [DVec3; 2] {
    let rotation = DQuat::from_rotation_arc(DVec3::Y, up);
    [rotation * DVec3::X, rotation * DVec3::NEG_Z]
}

/// Of the sphere around `bounds`, m; 1 where they hold less than two points.
fn radius(bounds: &Bounds) -> f64 {
    let radius = f64::from(bounds.radius());
    if radius > 0.0 { radius } else { 1.0 }
}
