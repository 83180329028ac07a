//! The truth by brute force: irradiance by plain path tracing over all triangles, in double precision. It shares
//! nothing with the program but the scene.

use glam::DVec3;
use lightwell::math::random::Stream;
use lightwell::math::stats::Moments;
use lightwell::scene::Scene;
use std::f64::consts::TAU;

struct Triangle {
    corners: [DVec3; 3],
    normal: DVec3,
    area: f64,
    reflectance: DVec3,
    emission: DVec3,
}

pub struct Oracle {
    triangles: Vec<Triangle>,
    lamps: Vec<usize>,
    lamp_area: f64,
}

impl Oracle {
    pub fn new(scene: &Scene) -> Self {
        let mut triangles = Vec::new();
        for polygon in &scene.polygons {
            let material = &scene.materials[polygon.material as usize];
            let corners: Vec<DVec3> =
                polygon.corners().iter().map(|&corner| scene.positions[corner as usize].as_dvec3()).collect();
            for pair in corners[1..].windows(2) {
                let cross = (pair[0] - corners[0]).cross(pair[1] - corners[0]);
                triangles.push(Triangle {
                    corners: [corners[0], pair[0], pair[1]],
                    normal: cross.normalize(),
                    area: cross.length() / 2.0,
                    reflectance: material.diffuse.as_dvec3(),
                    emission: material.emission.as_dvec3(),
                });
            }
        }
        let lamps: Vec<usize> = (0..triangles.len()).filter(|&i| triangles[i].emission != DVec3::ZERO).collect();
        let lamp_area = lamps.iter().map(|&i| triangles[i].area).sum();
        Self { triangles, lamps, lamp_area }
    }

    /// Mean and standard error of the irradiance, W/m², per channel, from so many paths.
    pub fn irradiance(&self, point: DVec3, normal: DVec3, paths: u64, seed: u64) -> [Moments; 3] {
        let mut moments = [Moments::default(); 3];
        for path in 0..paths {
            let value = self.path(point, normal, &mut Stream::new(seed, 99, path));
            for (moments, value) in moments.iter_mut().zip(value.to_array()) {
                moments.add(value);
            }
        }
        moments
    }

    /// One path: light from the lamps at each vertex, then a cosine-distributed bounce. The first vertex does not
    /// reflect, since irradiance is wanted there.
    fn path(&self, mut point: DVec3, mut normal: DVec3, stream: &mut Stream) -> DVec3 {
        let (mut irradiance, mut throughput) = (DVec3::ZERO, DVec3::ONE);
        for bounce in 0.. {
            irradiance += throughput * self.direct(point, normal, stream);
            let direction = cosine_direction(normal, stream);
            let Some((distance, hit)) = self.nearest(point, direction) else { break };
            let survival = if bounce < 3 { 1.0 } else { 0.7 };
            if f64::from(stream.uniform()) >= survival {
                break;
            }
            let triangle = &self.triangles[hit];
            throughput *= triangle.reflectance / survival;
            point += distance * direction;
            normal = if direction.dot(triangle.normal) < 0.0 { triangle.normal } else { -triangle.normal };
        }
        irradiance
    }

    /// Irradiance straight from one random point of the lamps.
    fn direct(&self, point: DVec3, normal: DVec3, stream: &mut Stream) -> DVec3 {
        let mut along = f64::from(stream.uniform()) * self.lamp_area;
        let mut lamp = 0;
        while lamp + 1 < self.lamps.len() && along > self.triangles[self.lamps[lamp]].area {
            along -= self.triangles[self.lamps[lamp]].area;
            lamp += 1;
        }
        let Some(lamp) = self.lamps.get(lamp).map(|&i| &self.triangles[i]) else { return DVec3::ZERO };
        let (u, v) = (f64::from(stream.uniform()).sqrt(), f64::from(stream.uniform()));
        let [a, b, c] = lamp.corners;
        let way = a + u * (b - a) + u * v * (c - b) - point;
        let square = way.length_squared();
        let geometry = way.dot(normal).max(0.0) * (-way.dot(lamp.normal)).max(0.0) / (square * square);
        let distance = square.sqrt();
        let is_visible = geometry > 0.0
            && self.nearest(point, way / distance).is_none_or(|(nearest, _)| nearest > distance * (1.0 - 1e-9));
        if is_visible { lamp.emission * geometry * self.lamp_area } else { DVec3::ZERO }
    }

    /// Möller and Trumbore over every triangle.
    fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<(f64, usize)> {
        let mut nearest = None;
        for (i, triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = triangle.corners;
            let (e1, e2, to) = (b - a, c - a, origin - a);
            let p = direction.cross(e2);
            let determinant = e1.dot(p);
            let (u, q) = (to.dot(p) / determinant, to.cross(e1));
            let (v, distance) = (direction.dot(q) / determinant, e2.dot(q) / determinant);
            let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-9;
            if inside && nearest.is_none_or(|(other, _)| distance < other) {
                nearest = Some((distance, i));
            }
        }
        nearest
    }

    /// Random points on the triangles, by area, with the side of the triangle that `is_wanted`.
    pub fn points(&self, count: usize, seed: u64, is_wanted: impl Fn(DVec3, DVec3) -> bool) -> Vec<(DVec3, DVec3)> {
        let all: f64 = self.triangles.iter().map(|triangle| triangle.area).sum();
        let mut stream = Stream::new(seed, 98, 0);
        let mut points = Vec::new();
        while points.len() < count {
            let mut along = f64::from(stream.uniform()) * all;
            let index = self.triangles.iter().position(|triangle| {
                along -= triangle.area;
                along < 0.0
            });
            let triangle = &self.triangles[index.unwrap_or(0)];
            let (u, v) = (f64::from(stream.uniform()).sqrt(), f64::from(stream.uniform()));
            let [a, b, c] = triangle.corners;
            let point = a + u * (b - a) + u * v * (c - b);
            let normal = if stream.uniform() < 0.5 { triangle.normal } else { -triangle.normal };
            if is_wanted(point, normal) {
                points.push((point, normal));
            }
        }
        points
    }
}

fn cosine_direction(normal: DVec3, stream: &mut Stream) -> DVec3 {
    let (radius, angle) = (f64::from(stream.uniform()).sqrt(), TAU * f64::from(stream.uniform()));
    let (across, up) = normal.any_orthonormal_pair();
    let height = (1.0 - radius * radius).sqrt();
    (radius * angle.cos() * across + radius * angle.sin() * up + height * normal).normalize()
}
