//! From the text of an OBJ file and its material libraries to a scene.

use super::doctor::{Finding, FindingKind};
use super::glass;
use super::lines::{self, CheckedFace, CheckedObj};
use super::material::Material;
use super::mtl::Library;
use super::polygonize::{Shape, has_area, polygonize, without_repeated_corners};
use super::repeats::Faces;
use super::smooth::{Smoothness, drop_unused_normals, keep_used, smoothness};
use super::{Polygon, Scene, SceneError, Source};
use glam::{DVec3, Vec3};
use std::collections::{HashMap, HashSet};
use std::io;

/// Reads a scene. `path` is what messages call the file, `load_library` returns the text of a material library by the
/// name that stands behind `mtllib`.
///
/// # Errors
/// [`SceneError::Empty`] where no face can be used. Everything else that is wrong is mended and becomes a finding.
pub fn read(
    text: &str,
    name: &str,
    source: Source,
    path: &str,
    load_library: &mut dyn FnMut(&str) -> io::Result<String>,
) -> Result<Scene, SceneError> {
    let mut checked = lines::check_obj(text);
    let mut findings = std::mem::take(&mut checked.findings);
    let library = load_libraries(&checked.libraries, load_library, &mut findings);
    report_missing_materials(&checked, &library, &mut findings);
    let empty = |reason: String| SceneError::Empty { path: path.to_owned(), reason };
    if checked.faces.is_empty() {
        return Err(empty(why_no_face(text, &checked, &findings)));
    }
    let models = parse(&checked.text, &library).map_err(|error| empty(error.to_string()))?;
    let mut assembler = Assembler::new(library, findings, std::mem::take(&mut checked.normals), checked.origin);
    let mut faces = checked.faces.iter();
    for model in &models {
        assembler.model(model, &mut faces);
    }
    if assembler.polygons.is_empty() {
        return Err(empty(why_no_face(text, &checked, &assembler.findings)));
    }
    Ok(assembler.finish(name, source))
}

fn load_libraries(
    names: &[(u32, String)],
    load: &mut dyn FnMut(&str) -> io::Result<String>,
    findings: &mut Vec<Finding>,
) -> Library {
    let mut library = Library::default();
    for (line, argument) in names {
        // The argument is one name, which may hold spaces, or else several names.
        let loaded = load(argument).map(|text| vec![(argument.as_str(), text)]).or_else(|error| {
            let several: io::Result<Vec<_>> = argument.split_whitespace().map(|name| Ok((name, load(name)?))).collect();
            several.map_err(|_| error)
        });
        match loaded {
            Ok(texts) => texts.iter().for_each(|(name, text)| library.read(text, name)),
            Err(error) => findings.push(Finding::warning(
                FindingKind::MissingMaterialFile,
                format!("material file '{argument}', line {line}"),
                format!("it cannot be read: {error}"),
                "its materials are missing",
            )),
        }
    }
    findings.append(&mut library.findings);
    library
}

fn report_missing_materials(checked: &CheckedObj, library: &Library, findings: &mut Vec<Finding>) {
    let mut reported = HashSet::new();
    for (line, name) in &checked.material_uses {
        if !library.index.contains_key(name) && reported.insert(name) {
            findings.push(Finding::warning(
                FindingKind::MissingMaterial,
                format!("material '{name}', line {line}"),
                "no material file states it",
                "its faces are grey",
            ));
        }
    }
    if let Some(line) = checked.first_bare_face {
        findings.push(Finding::warning(
            FindingKind::MissingMaterial,
            format!("line {line}"),
            "faces from here on name no material",
            "they are grey",
        ));
    }
}

fn why_no_face(text: &str, checked: &CheckedObj, findings: &[Finding]) -> String {
    if text.trim().is_empty() {
        return "the file is empty".to_owned();
    }
    match checked.face_count {
        0 => "it has no line that begins with `f`".to_owned(),
        count => {
            let first = findings.first().map_or(String::new(), |finding| format!(" ({finding})"));
            format!("none of its {count} faces can be used{first}")
        }
    }
}

/// Hands the checked text to the parser, for which all material libraries are one, loaded beforehand.
fn parse(text: &str, library: &Library) -> Result<Vec<tobj::Model>, tobj::LoadError> {
    let text = format!("mtllib all\n{text}");
    let index = || library.index.iter().map(|(name, &place)| (name.clone(), place)).collect();
    let options = tobj::LoadOptions::default();
    tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok((Vec::new(), index()))).map(|(models, _)| models)
}

/// Collects the scene, model by model.
struct Assembler {
    library: Library,
    /// Of faces whose file names no material.
    grey: Material,
    findings: Vec<Finding>,
    /// See [`Scene::origin`].
    origin: DVec3,
    positions: Vec<Vec3>,
    /// As the file has them; no face that names one that is missing is left.
    normals: Vec<Vec3>,
    polygons: Vec<Polygon>,
    /// For each material of the scene its place in the library; `None` is the grey one.
    materials: Vec<Option<usize>>,
    objects: Vec<String>,
    welded: HashMap<[u32; 3], u32>,
    material_index: HashMap<Option<usize>, u32>,
    object_index: HashMap<String, u32>,
    faces: Faces,
}

impl Assembler {
    fn new(library: Library, findings: Vec<Finding>, normals: Vec<Option<Vec3>>, origin: DVec3) -> Self {
        Self {
            library,
            grey: Material::grey("grey"),
            findings,
            origin,
            positions: Vec::new(),
            normals: normals.into_iter().map(Option::unwrap_or_default).collect(),
            polygons: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
            welded: HashMap::new(),
            material_index: HashMap::new(),
            object_index: HashMap::new(),
            faces: Faces::default(),
        }
    }

    /// Adds the faces of one model: one object's with one material. The parser keeps the faces' order, so what it was not
    /// told of them comes one after the other from `faces`.
    fn model<'a>(&mut self, model: &tobj::Model, faces: &mut impl Iterator<Item = &'a CheckedFace>) {
        let mesh = &model.mesh;
        if mesh.indices.is_empty() {
            return;
        }
        let stated: Vec<DVec3> = mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect();
        let welded: Vec<u32> = stated.iter().map(|position| self.weld(position.as_vec3())).collect();
        let material = self.material(mesh.material_id);
        let object = self.object(&model.name);
        // The parser leaves the arities out where all faces are triangles.
        let all_triangles = vec![3; if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { 0 }];
        let mut rest = mesh.indices.as_slice();
        for (&arity, checked) in mesh.face_arities.iter().chain(&all_triangles).zip(faces) {
            let (face, after) = rest.split_at(arity as usize);
            rest = after;
            let corner = |&corner: &u32| (welded[corner as usize], stated[corner as usize]);
            self.face(&face.iter().map(corner).collect::<Vec<_>>(), checked, material, object);
        }
    }

    /// `corners` are indices of positions, each with the coordinates that the file states, in the scene's frame.
    fn face(&mut self, corners: &[(u32, DVec3)], checked: &CheckedFace, material: u32, object: u32) {
        let line = checked.line;
        let (corners, stated): (Vec<u32>, Vec<DVec3>) = corners.iter().copied().unzip();
        let ring = without_repeated_corners(&corners);
        let subject = format!("object '{}', line {line}", self.objects[object as usize]);
        let corners: Vec<u32> = ring.iter().map(|&place| corners[place]).collect();
        if let Some(finding) = self.repeated(&corners, line, material, &subject) {
            self.findings.push(finding);
            return;
        }
        let first = self.polygons.len();
        let rounding = f64::EPSILON * stated.iter().map(|&p| (p + self.origin).abs().max_element()).fold(0.0, f64::max);
        let outline: Vec<DVec3> = ring.iter().map(|&place| stated[place]).collect();
        let polygons = &mut self.polygons;
        let shape = polygonize(&outline, rounding, &mut |piece| {
            let pick = |from: &dyn Fn(usize) -> u32| piece.iter().map(|&place| from(place)).collect::<Vec<u32>>();
            let polygon = Polygon::new(&pick(&|place| corners[place]), material, object, line);
            polygons.push(match &checked.normals {
                Some(normals) => polygon.with_normals(&pick(&|place| normals[ring[place]])),
                None => polygon,
            });
        });
        self.keep_smooth_normals(first, &subject);
        // Corners that fell together may be all that was wrong.
        let shape = if shape == Shape::Degenerate && has_area(&stated, rounding) { Shape::Collapsed } else { shape };
        self.findings.extend(shape_finding(shape, corners.len(), subject));
    }

    /// Why a face need not be there, if it was stated before.
    fn repeated(&mut self, corners: &[u32], line: u32, material: u32, subject: &str) -> Option<Finding> {
        if corners.len() < 3 {
            return None;
        }
        let Self { faces, library, materials, grey, .. } = self;
        let look = |material: u32| {
            let place = materials[material as usize];
            place.map_or(&*grey, |place| &library.entries[place].material)
        };
        faces.add(corners, line, material, subject, look)
    }

    /// Leaves the pieces of a face, from polygon `first` on, the normals that say more than their planes.
    fn keep_smooth_normals(&mut self, first: usize, subject: &str) {
        let mut has_contrary_normals = false;
        for polygon in &mut self.polygons[first..] {
            match smoothness(&self.positions, &self.normals, polygon) {
                Smoothness::Smooth => continue,
                Smoothness::Flat => {}
                Smoothness::Contrary => has_contrary_normals = true,
            }
            *polygon = polygon.without_normals();
        }
        if has_contrary_normals {
            let problem = "its normals are not all on one side of it";
            let finding = Finding::warning(FindingKind::NormalIgnored, subject, problem, "the face counts as flat");
            self.findings.push(finding);
        }
    }

    /// The index of a position; corners at exactly the same place share one.
    fn weld(&mut self, position: Vec3) -> u32 {
        // Adding zero turns −0 into +0, which is the same place.
        let key = (position + Vec3::ZERO).to_array().map(f32::to_bits);
        *self.welded.entry(key).or_insert_with(|| {
            self.positions.push(position);
            self.positions.len() as u32 - 1
        })
    }

    fn material(&mut self, place: Option<usize>) -> u32 {
        *self.material_index.entry(place).or_insert_with(|| {
            self.materials.push(place);
            self.materials.len() as u32 - 1
        })
    }

    fn object(&mut self, name: &str) -> u32 {
        *self.object_index.entry(name.to_owned()).or_insert_with(|| {
            self.objects.push(name.to_owned());
            self.objects.len() as u32 - 1
        })
    }

    fn finish(self, name: &str, source: Source) -> Scene {
        let Self {
            library,
            grey,
            mut findings,
            origin,
            mut positions,
            mut normals,
            mut polygons,
            materials,
            objects,
            ..
        } = self;
        drop_unused_positions(&mut positions, &mut polygons);
        drop_unused_normals(&mut normals, &mut polygons);
        let mut entries: Vec<_> = library.entries.into_iter().map(Some).collect();
        let mut take = |place: usize| entries[place].take().map(|entry| entry.into_material_and_findings());
        let materials = materials
            .into_iter()
            .map(|place| match place.and_then(&mut take) {
                Some((material, mut mended)) => {
                    findings.append(&mut mended);
                    material
                }
                None => grey.clone(),
            })
            .collect();
        let name = name.to_owned();
        let mut scene =
            Scene { name, source, origin, positions, normals, polygons, materials, objects, viewpoint: None, findings };
        let mended = glass::mend(&mut scene);
        scene.findings.extend(mended);
        if !scene.has_emitter() {
            scene.findings.push(Finding::warning(
                FindingKind::NoEmitter,
                "the scene",
                "no surface emits light",
                "it stays dark unless a ceiling light is added; ambient occlusion needs none",
            ));
        }
        scene
    }
}

/// What there is to say of a face's shape.
fn shape_finding(shape: Shape, corners: usize, subject: String) -> Option<Finding> {
    Some(match shape {
        Shape::Planar => return None,
        Shape::Warped(share) => {
            let problem = format!("its {corners} corners are not in one plane (off by {share:.1e} of its size)");
            Finding::note(FindingKind::NonPlanarFace, subject, problem, "cut into triangles")
        }
        Shape::Crossed => {
            let problem = "its outline crosses itself";
            Finding::warning(FindingKind::CrossedFace, subject, problem, "cut as far as possible")
        }
        Shape::Collapsed => {
            let problem = "it is narrower than single precision can hold";
            let remedy = "left out; its edges fall together, so that no gap is left";
            Finding::note(FindingKind::FaceTooNarrow, subject, problem, remedy)
        }
        Shape::Degenerate => Finding::note(FindingKind::DegenerateFace, subject, "the face has no area", "left out"),
    })
}

/// Faces that were left out may leave positions behind, far from everything that is seen.
fn drop_unused_positions(positions: &mut Vec<Vec3>, polygons: &mut [Polygon]) {
    let used = polygons.iter().flat_map(|polygon| polygon.corners().iter().copied());
    let new_index = keep_used(positions, used);
    for polygon in polygons {
        polygon.corners = polygon.corners.map(|corner| new_index[corner as usize]);
    }
}
