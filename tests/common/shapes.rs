//! Closed triangle meshes to shoot rays at.

use glam::{Quat, Vec3};

/// A list of triangles, counter-clockwise seen from outside.
pub type Triangles = Vec<[Vec3; 3]>;

/// The unit sphere: an octahedron whose faces are split in four `depth` times.
pub fn sphere(depth: u32) -> Triangles {
    let axes = [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::NEG_Y];
    let mut triangles = Triangles::new();
    for i in 0..4 {
        let (from, to) = (axes[i], axes[(i + 1) % 4]);
        triangles.push([from, to, Vec3::Z]);
        triangles.push([to, from, Vec3::NEG_Z]);
    }
    for _ in 0..depth {
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let [ab, bc, ca] = [a + b, b + c, c + a].map(Vec3::normalize);
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    triangles
}

/// The cube [-1, 1]³, each face a grid of `n` × `n` squares cut in two.
pub fn cube(n: u32) -> Triangles {
    let mut triangles = Triangles::new();
    let turns = [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y];
    for normal in turns {
        let right = if normal.y.abs() > 0.5 { Vec3::X } else { Vec3::Y.cross(normal) };
        let up = normal.cross(right);
        let corner = |i: u32, j: u32| {
            let at = |k: u32| 2.0 * k as f32 / n as f32 - 1.0;
            normal + at(i) * right + at(j) * up
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    triangles
}

/// The same mesh turned so that no edge is along an axis, then scaled and moved.
pub fn placed(triangles: &Triangles, scale: f32, shift: Vec3) -> Triangles {
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.1);
    triangles.iter().map(|corners| corners.map(|corner| scale * (turn * corner + shift))).collect()
}
