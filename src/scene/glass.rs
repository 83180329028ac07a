//! Bodies of glass: which of its two sides is the inside.
//!
//! Rays know that they are in glass by the fronts and backs that they cross, so fronts must look outwards. Connected faces
//! of one glass are a shell. Of a closed one, faces that disagree with their neighbours are turned, and then all of them
//! if the volume inside is negative. A shell inside another of the same glass may bound a bubble, and look into it. A surface
//! that is not closed has no inside: it counts as a sheet that light passes straight through. `Tf` of the material counts once
//! for either: √`Tf` at each of the two boundaries of a body that light crosses, `Tf` at a sheet.

use super::doctor::{Finding, FindingKind};
use super::material::Material;
use super::{Polygon, Scene};
use crate::math::bounds::Bounds;
use glam::DVec3;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// A shell with gaps still has an inside if its area vectors sum to less than this share of its area.
const GAPS: f64 = 0.01;

/// Turns the faces of glass so that they look outwards, and makes sheets of what is no body. Returns what was done.
pub fn mend(scene: &mut Scene) -> Vec<Finding> {
    let is_glass: Vec<bool> = scene.materials.iter().map(Material::is_glass).collect();
    if !is_glass.contains(&true) {
        return Vec::new();
    }
    let shells: Vec<Shell> = (0..scene.materials.len() as u32)
        .filter(|&material| is_glass[material as usize])
        .flat_map(|material| shells_of(scene, material))
        .collect();
    let mut findings = Vec::new();
    let mut sheets = HashMap::new();
    for shell in &shells {
        let first = &scene.polygons[shell.faces[0].polygon];
        let subject = format!("object '{}', line {}", scene.objects[first.object as usize], first.line);
        if !shell.has_inside() {
            make_sheet(scene, shell, &mut sheets);
            findings.push(open_glass(
                subject,
                shell.open_edges,
                "treated as a sheet: light passes straight through, Tf of it",
            ));
            continue;
        }
        if shell.open_edges > 0 {
            findings.push(open_glass(subject.clone(), shell.open_edges, "treated as closed; light leaks at its gaps"));
        }
        let turns_all = (shell.volume < 0.0) != bounds_bubble(shell, &shells);
        let turned: Vec<usize> =
            shell.faces.iter().filter(|face| face.is_contrary != turns_all).map(|face| face.polygon).collect();
        for &polygon in &turned {
            scene.polygons[polygon] = scene.polygons[polygon].turned();
        }
        if !turned.is_empty() {
            let problem =
                format!("{} of the {} faces of this body of glass look inwards", turned.len(), shell.faces.len());
            findings.push(Finding::note(FindingKind::GlassTurned, subject, problem, "turned round"));
        }
    }
    findings
}

/// Whether a shell is the inner surface of a body: it looks inwards, or both surfaces look the wrong way.
fn bounds_bubble(shell: &Shell, shells: &[Shell]) -> bool {
    let round: Vec<&Shell> = shells.iter().filter(|other| other.is_round(shell)).collect();
    round.len() % 2 == 1 && (shell.volume < 0.0 || round.iter().all(|other| other.volume < 0.0))
}

fn open_glass(subject: String, edges: usize, remedy: &str) -> Finding {
    let problem = format!("this glass is no closed surface: {edges} of its edges lack a neighbour");
    Finding::warning(FindingKind::GlassOpen, subject, problem, remedy)
}

/// Gives the faces of a shell a material that lets light straight through; `sheets` are those made before, by the glass.
fn make_sheet(scene: &mut Scene, shell: &Shell, sheets: &mut HashMap<u32, u32>) {
    let sheet = *sheets.entry(shell.material).or_insert_with(|| {
        scene.materials.push(scene.materials[shell.material as usize].as_sheet());
        scene.materials.len() as u32 - 1
    });
    for face in &shell.faces {
        scene.polygons[face.polygon].material = sheet;
    }
}

/// Connected faces of one glass.
struct Shell {
    material: u32,
    faces: Vec<Face>,
    /// Edges with an odd number of faces.
    open_edges: usize,
    /// m²
    area: f64,
    /// Sum of the faces' area vectors, m²: 0 where the shell is closed.
    vector_area: DVec3,
    /// What it encloses, m³; negative where its faces look inwards.
    volume: f64,
    /// Corners, as triangles.
    triangles: Vec<[DVec3; 3]>,
    bounds: Bounds,
}

/// A face of a shell.
struct Face {
    polygon: usize,
    /// Whether it looks to the other side than most of the shell.
    is_contrary: bool,
}

impl Shell {
    fn new(scene: &Scene, material: u32, mut faces: Vec<Face>, open_edges: usize) -> Self {
        let triangles = |face: &Face| triangles(scene, &scene.polygons[face.polygon]);
        let area_of = |face: &Face| triangles(face).iter().map(|t| double_area(t).length()).sum::<f64>();
        let (all, contrary) = faces.iter().fold((0.0, 0.0), |(all, contrary), face| {
            let area = area_of(face);
            (all + area, if face.is_contrary { contrary + area } else { contrary })
        });
        if contrary > 0.5 * all {
            faces.iter_mut().for_each(|face| face.is_contrary = !face.is_contrary);
        }
        let wound = |face: &Face| {
            let is_contrary = face.is_contrary;
            triangles(face).into_iter().map(move |[a, b, c]| if is_contrary { [a, c, b] } else { [a, b, c] })
        };
        let triangles: Vec<[DVec3; 3]> = faces.iter().flat_map(wound).collect();
        // From a corner of its own, so that a small body far away keeps its digits.
        let origin = triangles[0][0];
        Self {
            material,
            open_edges,
            area: 0.5 * all,
            vector_area: 0.5 * triangles.iter().map(double_area).sum::<DVec3>(),
            volume: triangles.iter().map(|t| double_area(t).dot(t[0] - origin)).sum::<f64>() / 6.0,
            bounds: Bounds::of(triangles.iter().flatten().map(|corner| corner.as_vec3())),
            triangles,
            faces,
        }
    }

    fn has_inside(&self) -> bool {
        self.open_edges == 0 || self.vector_area.length() < GAPS * self.area
    }

    /// Whether it is another closed shell of the same glass, and the given one is inside.
    fn is_round(&self, shell: &Self) -> bool {
        let point = shell.triangles[0][0];
        let may_be = self.material == shell.material && self.has_inside() && !std::ptr::eq(self, shell);
        let is_boxed = self.bounds.min.cmple(shell.bounds.min).all() && self.bounds.max.cmpge(shell.bounds.max).all();
        may_be && is_boxed && self.solid_angle(point).abs() > TAU
    }

    /// What the shell fills of the view from a point: ±4π from inside and 0 from outside, sr (van Oosterom, Strackee 1983).
    fn solid_angle(&self, point: DVec3) -> f64 {
        let angle = |triangle: &[DVec3; 3]| {
            let [a, b, c] = triangle.map(|corner| (corner - point).normalize_or_zero());
            2.0 * a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
        };
        self.triangles.iter().map(angle).sum()
    }
}

/// The shells of one material.
fn shells_of(scene: &Scene, material: u32) -> Vec<Shell> {
    let polygons: Vec<usize> = (0..scene.polygons.len()).filter(|&i| scene.polygons[i].material == material).collect();
    let edges = Edges::of(scene, &polygons);
    // Of each polygon that was reached, whether it looks to the other side than the first of its shell.
    let mut contrary: HashMap<usize, bool> = HashMap::new();
    let mut shells = Vec::new();
    for first in polygons {
        if contrary.contains_key(&first) {
            continue;
        }
        contrary.insert(first, false);
        let (mut faces, mut open_edges) = (Vec::new(), 0);
        let mut waiting = vec![first];
        while let Some(polygon) = waiting.pop() {
            let is_contrary = contrary[&polygon];
            faces.push(Face { polygon, is_contrary });
            for edge in directed_edges(&scene.polygons[polygon]) {
                match edges.neighbour(polygon, edge) {
                    Neighbour::None => open_edges += 1,
                    Neighbour::Many => {}
                    Neighbour::One { polygon, agrees } => {
                        contrary.entry(polygon).or_insert_with(|| {
                            waiting.push(polygon);
                            is_contrary == agrees
                        });
                    }
                }
            }
        }
        shells.push(Shell::new(scene, material, faces, open_edges));
    }
    shells
}

/// Which polygons meet at each edge, and whether they run along it from its lower to its higher corner.
struct Edges(HashMap<(u32, u32), Vec<(usize, bool)>>);

/// What is on the other side of an edge.
enum Neighbour {
    None,
    /// `agrees` if both look to the same side of the surface: they run along the edge in opposite directions.
    One {
        polygon: usize,
        agrees: bool,
    },
    /// Several surfaces meet at the edge.
    Many,
}

impl Edges {
    fn of(scene: &Scene, polygons: &[usize]) -> Self {
        let mut edges: HashMap<_, Vec<_>> = HashMap::new();
        for &polygon in polygons {
            for (from, to) in directed_edges(&scene.polygons[polygon]) {
                edges.entry((from.min(to), from.max(to))).or_default().push((polygon, from < to));
            }
        }
        Self(edges)
    }

    fn neighbour(&self, polygon: usize, (from, to): (u32, u32)) -> Neighbour {
        match self.0[&(from.min(to), from.max(to))][..] {
            [(a, a_runs_up), (b, b_runs_up)] => {
                Neighbour::One { polygon: if a == polygon { b } else { a }, agrees: a_runs_up != b_runs_up }
            }
            ref faces if faces.len() % 2 == 1 => Neighbour::None,
            _ => Neighbour::Many,
        }
    }
}

fn directed_edges(polygon: &Polygon) -> impl Iterator<Item = (u32, u32)> + '_ {
    let corners = polygon.corners();
    corners.iter().copied().zip(corners.iter().copied().cycle().skip(1))
}

fn triangles(scene: &Scene, polygon: &Polygon) -> Vec<[DVec3; 3]> {
    let corners = polygon.corners();
    let place = |corner: u32| scene.positions[corner as usize].as_dvec3();
    corners[1..].windows(2).map(|pair| [place(corners[0]), place(pair[0]), place(pair[1])]).collect()
}

/// Twice the area, along the normal.
fn double_area([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*b - *a).cross(*c - *a)
}
