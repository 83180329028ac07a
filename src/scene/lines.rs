//! The lines of an OBJ file, checked one by one.
//!
//! The parser behind [`super::obj`] gives up a whole file for one bad line and does not say which. So every line is
//! looked at here first: what cannot be used is reported with its number and left out of the text that the parser gets.
//! Also settled here, because the parser does not know them: comments behind numbers, lines continued by a backslash,
//! keywords set off by tabs.

use super::doctor::{Finding, FindingKind};
use std::borrow::Cow;

/// Largest coordinate that is accepted, m. The squared length of a cross product of two edges reaches 192 c⁴ for
/// coordinates up to c, which must stay below `f32::MAX` = 3.4e38.
pub const MAX_COORDINATE: f32 = 1e9;

/// The name of faces that stand before any `o` or `g` line.
pub const UNNAMED: &str = "unnamed";

/// The usable part of an OBJ file.
#[derive(Debug)]
pub struct CheckedObj {
    /// OBJ text with `v`, `f` (absolute position indices only), `o` and `usemtl` lines, each of them usable.
    pub text: String,
    /// Line of each face of `text`, in order.
    pub face_lines: Vec<u32>,
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
            "f" | "fo" => checker.face(number, rest),
            "o" | "g" => checker.object(name(rest)),
            "usemtl" => checker.use_material(number, name(rest)),
            "mtllib" => checker.output.libraries.push((number, name(rest).to_owned())),
            // Normals and texture coordinates, points, lines, smoothing groups, curves: light does not need them.
            _ => {}
        }
    }
    checker.finish()
}

struct Checker {
    output: CheckedObj,
    vertices: Vec<Vertex>,
    object: String,
}

/// What faces need to know of a vertex. Even one that cannot be used has its place in the numbering.
struct Vertex {
    line: u32,
    is_usable: bool,
    is_used: bool,
}

impl Checker {
    fn new() -> Self {
        let output = CheckedObj {
            text: format!("o {UNNAMED}\n"),
            face_lines: Vec::new(),
            face_count: 0,
            libraries: Vec::new(),
            material_uses: Vec::new(),
            first_bare_face: None,
            findings: Vec::new(),
        };
        Self { output, vertices: Vec::new(), object: UNNAMED.to_owned() }
    }

    fn vertex(&mut self, number: u32, rest: &str) {
        let problem = match parse_position(rest) {
            Err(problem) => Some((FindingKind::MalformedLine, problem)),
            Ok(position) if position.iter().any(|c| !c.is_finite()) => {
                Some((FindingKind::NonFiniteVertex, "a coordinate is not a finite number".to_owned()))
            }
            Ok(position) if position.iter().any(|c| c.abs() > MAX_COORDINATE) => {
                Some((FindingKind::ValueOutOfRange, format!("a coordinate is larger than {MAX_COORDINATE:e}")))
            }
            // A fourth number (the weight of rational curves) and vertex colours mean nothing to polygons here.
            Ok([x, y, z]) => {
                self.output.text += &format!("v {x} {y} {z}\n");
                None
            }
        };
        self.vertices.push(Vertex { line: number, is_usable: problem.is_none(), is_used: false });
        if let Some((kind, problem)) = problem {
            self.output.text += "v 0 0 0\n";
            let subject = format!("vertex {}, line {number}", self.vertices.len());
            self.output.findings.push(Finding::warning(kind, subject, problem, "faces that use it are left out"));
        }
    }

    fn face(&mut self, number: u32, rest: &str) {
        self.output.face_count += 1;
        match self.corners(rest) {
            Ok(corners) => {
                let corners: String = corners.iter().map(|c| format!(" {}", c + 1)).collect();
                self.output.text += &format!("f{corners}\n");
                self.output.face_lines.push(number);
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
        match corners.iter().find(|&&corner| !self.vertices[corner].is_usable) {
            None => Ok(corners),
            Some(&corner) => {
                let problem = format!("vertex {} (line {}) cannot be used", corner + 1, self.vertices[corner].line);
                Err((FindingKind::NonFiniteVertex, problem))
            }
        }
    }

    /// The vertex of one `v/vt/vn` word, as an index from 0. Negative indices count back from the last vertex above.
    fn corner(&self, word: &str) -> Result<usize, (FindingKind, String)> {
        let index = word.split('/').next().unwrap_or("");
        let Ok(index) = index.parse::<i64>() else {
            return Err((FindingKind::MalformedLine, format!("`{word}` is no vertex index")));
        };
        let count = self.vertices.len();
        let from_zero = if index > 0 { index - 1 } else { index + count as i64 };
        match usize::try_from(from_zero) {
            // Index 0, which the format does not know, falls behind the last vertex.
            Ok(corner) if corner < count => Ok(corner),
            _ => {
                let problem = format!("vertex {index} does not exist ({count} vertices stand above this line)");
                Err((FindingKind::IndexOutOfRange, problem))
            }
        }
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
        self.output
    }
}

fn parse_position(rest: &str) -> Result<[f32; 3], String> {
    let mut words = words(rest);
    let mut position = [0.0; 3];
    for coordinate in &mut position {
        let word = words.next().ok_or("a vertex needs three coordinates")?;
        *coordinate = word.parse().map_err(|_| format!("`{word}` is no number"))?;
    }
    Ok(position)
}
