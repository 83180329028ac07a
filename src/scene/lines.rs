//! The lines of an OBJ file, checked one by one.
//!
//! The parser behind [`super::obj`] gives up a whole file for one bad line and does not say which. So every line is
//! looked at here first: what cannot be used is reported with its number and left out of the text that the parser gets.
//! Also settled here, because the parser does not know them: comments behind numbers, lines continued by a backslash,
//! keywords set off by tabs, and coordinates of more digits than single precision has.

use super::doctor::{Finding, FindingKind};
use super::frame::{FaceBounds, Frame};
use glam::{DVec3, Vec3};
use std::borrow::Cow;

/// Largest coordinate that is accepted, m. The squared length of a cross product of two edges reaches 192 c⁴ for
/// coordinates up to c, which must stay below `f32::MAX` = 3.4e38.
pub const MAX_COORDINATE: f64 = 1e9;

/// The name of faces that stand before any `o` or `g` line.
pub const UNNAMED: &str = "unnamed";

/// The usable part of an OBJ file.
#[derive(Debug)]
pub struct CheckedObj {
    /// OBJ text with `v`, `f` (absolute position indices only), `o` and `usemtl` lines, each of them usable; all `v` lines
    /// come first.
    pub text: String,
    /// Each face of `text`, in order.
    pub faces: Vec<CheckedFace>,
    /// What the coordinates of `text` are measured from, in those of the file, m.
    pub origin: DVec3,
    /// Unit vectors, one for each `vn` line; `None` for one that states no direction.
    pub normals: Vec<Option<Vec3>>,
    /// How many `f` lines the file has, usable or not.
    pub face_count: usize,
    /// Line and argument of each `mtllib`.
    pub libraries: Vec<(u32, String)>,
    /// Line and argument of each `usemtl`.
    pub material_uses: Vec<(u32, String)>,
    /// Line of the first usable face that stands before any `usemtl`.
    pub first_bare_face: Option<u32>,
    pub findings: Vec<Finding>,
}

/// What the text for the parser does not say of a face.
#[derive(Debug)]
pub struct CheckedFace {
    /// Its line in the file.
    pub line: u32,
    /// For each corner an index into [`CheckedObj::normals`], where the file states them.
    pub normals: Option<Vec<u32>>,
}

/// Physical lines joined where one ends in a backslash, with the number of the first one, from 1.
pub fn logical_lines(text: &str) -> impl Iterator<Item = (u32, Cow<'_, str>)> {
    let mut lines = text.strip_prefix('\u{feff}').unwrap_or(text).lines().zip(1..);
    std::iter::from_fn(move || {
        let (first, number) = lines.next()?;
        let mut line = Cow::Borrowed(first.trim());
        // A path in a comment may well end in a backslash.
        while !line.contains('#') && line.ends_with('\\') {
            let joined = line.to_mut();
            joined.pop();
            if let Some((next, _)) = lines.next() {
                joined.push(' ');
                joined.push_str(next.trim());
            }
        }
        Some((number, line))
    })
}

/// The keyword of a line and the rest of it; `None` for blank lines and comments.
pub fn keyword_and_rest(line: &str) -> Option<(&str, &str)> {
    let line = line.trim();
    if line.is_empty() || line.starts_with('#') {
        return None;
    }
    let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    Some((keyword, rest.trim()))
}

/// The words of a line of numbers, up to a comment.
pub fn words(rest: &str) -> impl Iterator<Item = &str> {
    rest.split('#').next().unwrap_or("").split_whitespace()
}

/// A name, up to a comment. Names may hold spaces and even `#` (`Material #25`), so only a `#` that stands alone
/// begins a comment.
pub fn name(rest: &str) -> &str {
    let comment = rest.match_indices('#').find(|&(at, _)| {
        let before = rest[..at].chars().next_back();
        let after = rest[at + 1..].chars().next();
        before.is_none_or(char::is_whitespace) && after.is_none_or(char::is_whitespace)
    });
    comment.map_or(rest, |(at, _)| &rest[..at]).trim()
}

/// Checks every line of an OBJ file.
pub fn check_obj(text: &str) -> CheckedObj {
    let mut checker = Checker::new();
    for (number, line) in logical_lines(text) {
        let Some((keyword, rest)) = keyword_and_rest(&line) else { continue };
        match keyword {
            "v" => checker.vertex(number, rest),
            "vn" => checker.normal(number, rest),
            "f" | "fo" => checker.face(number, rest),
            "o" | "g" => checker.object(name(rest)),
            "usemtl" => checker.use_material(number, name(rest)),
            "mtllib" => checker.output.libraries.push((number, name(rest).to_owned())),
            // Texture coordinates, points, lines, smoothing groups, curves: light does not need them.
            _ => {}
        }
    }
    checker.finish()
}

struct Checker {
    output: CheckedObj,
    vertices: Vec<Vertex>,
    normals: Vec<Normal>,
    /// Of each usable face.
    bounds: Vec<FaceBounds>,
    object: String,
}

/// What faces need to know of a vertex. Even one that cannot be used has its place in the numbering.
struct Vertex {
    line: u32,
    /// In the coordinates of the file, m; `None` for one that cannot be used.
    position: Option<DVec3>,
    is_used: bool,
}

/// A `vn` line.
struct Normal {
    line: u32,
    /// A unit vector, or why there is none.
    direction: Result<Vec3, String>,
    is_reported: bool,
}

impl Checker {
    fn new() -> Self {
        let output = CheckedObj {
            text: format!("o {UNNAMED}\n"),
            faces: Vec::new(),
            origin: DVec3::ZERO,
            normals: Vec::new(),
            face_count: 0,
            libraries: Vec::new(),
            material_uses: Vec::new(),
            first_bare_face: None,
            findings: Vec::new(),
        };
        Self { output, vertices: Vec::new(), normals: Vec::new(), bounds: Vec::new(), object: UNNAMED.to_owned() }
    }

    fn vertex(&mut self, number: u32, rest: &str) {
        let position = match usable_position(rest) {
            Ok(position) => Some(position),
            Err((kind, problem)) => {
                let subject = format!("vertex {}, line {number}", self.vertices.len() + 1);
                let remedy = "faces that use it are left out";
                self.output.findings.push(Finding::warning(kind, subject, problem, remedy));
                None
            }
        };
        self.vertices.push(Vertex { line: number, position, is_used: false });
    }

    fn normal(&mut self, number: u32, rest: &str) {
        let direction = parse_numbers(rest).and_then(|[x, y, z]| {
            let direction = DVec3::new(x, y, z).try_normalize().ok_or("it has no direction")?;
            Ok(direction.as_vec3())
        });
        self.normals.push(Normal { line: number, direction, is_reported: false });
    }

    fn face(&mut self, number: u32, rest: &str) {
        self.output.face_count += 1;
        match self.corners(rest) {
            Ok(corners) => {
                let positions = corners.iter().filter_map(|&corner| self.vertices[corner].position);
                self.bounds.push(FaceBounds::of(positions));
                let corners: String = corners.iter().map(|c| format!(" {}", c + 1)).collect();
                self.output.text += &format!("f{corners}\n");
                let normals = self.normals(number, rest);
                self.output.faces.push(CheckedFace { line: number, normals });
                if self.output.material_uses.is_empty() {
                    self.output.first_bare_face.get_or_insert(number);
                }
            }
            Err((kind, problem)) => {
                let subject = format!("object '{}', line {number}", self.object);
                self.output.findings.push(Finding::warning(kind, subject, problem, "the face is left out"));
            }
        }
    }

    /// Corners of a face as indices from 0, each of a usable vertex.
    fn corners(&mut self, rest: &str) -> Result<Vec<usize>, (FindingKind, String)> {
        let corners = words(rest).map(|word| self.corner(word)).collect::<Result<Vec<_>, _>>()?;
        for &corner in &corners {
            self.vertices[corner].is_used = true;
        }
        if corners.len() < 3 {
            return Err((FindingKind::DegenerateFace, format!("the face has {} corners", corners.len())));
        }
        match corners.iter().find(|&&corner| self.vertices[corner].position.is_none()) {
            None => Ok(corners),
            Some(&corner) => {
                let problem = format!("vertex {} (line {}) cannot be used", corner + 1, self.vertices[corner].line);
                Err((FindingKind::NonFiniteVertex, problem))
            }
        }
    }

    /// The vertex of one `v/vt/vn` word, as an index from 0.
    fn corner(&self, word: &str) -> Result<usize, (FindingKind, String)> {
        let index = word.split('/').next().unwrap_or("");
        let Ok(index) = index.parse::<i64>() else {
            return Err((FindingKind::MalformedLine, format!("`{word}` is no vertex index")));
        };
        let count = self.vertices.len();
        from_zero(index, count).ok_or_else(|| {
            let problem = format!("vertex {index} does not exist ({count} vertices stand above this line)");
            (FindingKind::IndexOutOfRange, problem)
        })
    }

    /// The normals of a face's corners; `None` where it states none that can be used.
    fn normals(&mut self, number: u32, rest: &str) -> Option<Vec<u32>> {
        let stated: Vec<&str> = words(rest).map(|word| word.split('/').nth(2).unwrap_or("")).collect();
        if stated.iter().all(|index| index.is_empty()) {
            return None;
        }
        let count = self.normals.len();
        let normal = |index: &&str| match index.parse().map(|index| from_zero(index, count)) {
            Ok(Some(normal)) => Ok(normal),
            Ok(None) => Err(format!("normal {index} does not exist ({count} normals stand above this line)")),
            Err(_) if index.is_empty() => Err("only some of its corners have a normal".to_owned()),
            Err(_) => Err(format!("`{index}` is no index of a normal")),
        };
        match stated.iter().map(normal).collect::<Result<Vec<usize>, _>>() {
            Ok(normals) => self.are_usable(&normals).then(|| normals.into_iter().map(|n| n as u32).collect()),
            Err(problem) => {
                let subject = format!("object '{}', line {number}", self.object);
                let remedy = "the face counts as flat";
                self.output.findings.push(Finding::warning(FindingKind::NormalIgnored, subject, problem, remedy));
                None
            }
        }
    }

    /// Whether all of these normals have a direction. One that has none is reported once.
    fn are_usable(&mut self, normals: &[usize]) -> bool {
        let mut are_usable = true;
        for &index in normals {
            let normal = &mut self.normals[index];
            let Err(problem) = &normal.direction else { continue };
            are_usable = false;
            if !std::mem::replace(&mut normal.is_reported, true) {
                let subject = format!("normal {}, line {}", index + 1, normal.line);
                let remedy = "faces that use it count as flat";
                self.output.findings.push(Finding::warning(FindingKind::NormalIgnored, subject, problem, remedy));
            }
        }
        are_usable
    }

    fn object(&mut self, name: &str) {
        self.object = if name.is_empty() { UNNAMED.to_owned() } else { name.to_owned() };
        self.output.text += &format!("o {}\n", self.object);
    }

    fn use_material(&mut self, number: u32, name: &str) {
        if name.is_empty() {
            let subject = format!("line {number}");
            let finding = Finding::warning(
                FindingKind::MalformedLine,
                subject,
                "`usemtl` names no material",
                "the material before it stays in use",
            );
            self.output.findings.push(finding);
        } else {
            self.output.material_uses.push((number, name.to_owned()));
            self.output.text += &format!("usemtl {name}\n");
        }
    }

    fn finish(mut self) -> CheckedObj {
        let unused = self.vertices.iter().filter(|v| !v.is_used).count();
        if unused > 0 {
            let problem = format!("{unused} of {} vertices belong to no face", self.vertices.len());
            self.output.findings.push(Finding::note(FindingKind::UnusedVertices, "the file", problem, "left out"));
        }
        self.output.normals = self.normals.iter().map(|normal| normal.direction.clone().ok()).collect();
        let frame = Frame::of(&self.bounds, |face| self.face_name(face));
        self.output.origin = frame.origin;
        self.output.findings.extend(frame.findings);
        self.leave_out(&frame.is_stray);
        let mut text = String::new();
        for vertex in &self.vertices {
            let DVec3 { x, y, z } = vertex.position.map_or(DVec3::ZERO, |position| position - frame.origin);
            text += &format!("v {x} {y} {z}\n");
        }
        self.output.text.insert_str(0, &text);
        self.output
    }

    /// What findings call a usable face by.
    fn face_name(&self, face: usize) -> String {
        let mut faces = 0;
        let mut object = UNNAMED;
        for line in self.output.text.lines() {
            object = line.strip_prefix("o ").unwrap_or(object);
            faces += usize::from(line.starts_with("f "));
            if faces > face {
                break;
            }
        }
        format!("object '{object}', line {}", self.output.faces[face].line)
    }

    fn leave_out(&mut self, is_stray: &[bool]) {
        if !is_stray.contains(&true) {
            return;
        }
        let mut strays = is_stray.iter();
        let is_kept = |line: &&str| !line.starts_with("f ") || strays.next() == Some(&false);
        self.output.text = self.output.text.lines().filter(is_kept).flat_map(|line| [line, "\n"]).collect();
        let mut strays = is_stray.iter();
        self.output.faces.retain(|_| strays.next() == Some(&false));
    }
}

/// An index of the file as one from 0. Negative ones count back from the last of the `count` that stand above. `None` where
/// there is no such thing.
fn from_zero(index: i64, count: usize) -> Option<usize> {
    let from_zero = if index > 0 { index - 1 } else { index.saturating_add(count as i64) };
    // Index 0, which the format does not know, falls behind the last one.
    usize::try_from(from_zero).ok().filter(|&place| place < count)
}

/// A fourth number (the weight of rational curves) and vertex colours mean nothing to polygons here.
fn usable_position(rest: &str) -> Result<DVec3, (FindingKind, String)> {
    let position = parse_numbers(rest).map_err(|problem| (FindingKind::MalformedLine, problem))?;
    // What single precision has no number for counts as infinite.
    if position.iter().any(|coordinate| !(*coordinate as f32).is_finite()) {
        return Err((FindingKind::NonFiniteVertex, "a coordinate is not a finite number".to_owned()));
    }
    if position.iter().any(|coordinate| coordinate.abs() > MAX_COORDINATE) {
        return Err((FindingKind::ValueOutOfRange, format!("a coordinate is larger than {MAX_COORDINATE:e}")));
    }
    Ok(DVec3::from_array(position))
}

fn parse_numbers(rest: &str) -> Result<[f64; 3], String> {
    let mut words = words(rest);
    let mut numbers = [0.0_f64; 3];
    for number in &mut numbers {
        let word = words.next().ok_or("it needs three coordinates")?;
        *number = word.parse().map_err(|_| format!("`{word}` is no number"))?;
    }
    Ok(numbers)
}
