//! Faces that are stated more than once.
//!
//! Corners decide, at whichever of them a face begins:
//! - The same corners in the same order are the same face, which is kept once.
//! - The same corners in reverse order are the back of that face. Surfaces reflect and absorb on both sides alike, so that a
//!   back of the same material adds nothing and is left out, unless it emits: emitters shine from their fronts alone. A
//!   back of another material is kept, so that each side has its own.
//! - Glass has its other side where its body ends. A back of any glass on a face of glass bounds nothing and is left out.

use super::doctor::{Finding, FindingKind};
use super::material::Material;
use std::collections::HashMap;

/// The faces so far.
#[derive(Debug, Default)]
pub struct Faces(HashMap<Vec<u32>, Stated>);

/// Where a face was stated first.
#[derive(Clone, Copy, Debug)]
struct Stated {
    line: u32,
    /// Index into the scene's materials.
    material: u32,
}

impl Faces {
    /// Why a face is to be left out, if it is; `look` tells what a material is like. `corners` are at different places.
    pub fn add<'a>(
        &mut self,
        corners: &[u32],
        line: u32,
        material: u32,
        subject: &str,
        look: impl Fn(u32) -> &'a Material,
    ) -> Option<Finding> {
        let own = from_lowest(corners);
        if let Some(first) = self.0.get(&own) {
            return Some(repeated(*first, material, subject));
        }
        let reversed: Vec<u32> = corners.iter().rev().copied().collect();
        let front = self.0.get(&from_lowest(&reversed)).copied();
        if let Some(finding) = front.and_then(|front| needless_back(front, material, subject, look)) {
            return Some(finding);
        }
        self.0.insert(own, Stated { line, material });
        None
    }
}

fn repeated(first: Stated, material: u32, subject: &str) -> Finding {
    let problem = format!("it has the same corners as the face of line {}", first.line);
    if first.material == material {
        Finding::note(FindingKind::DuplicateFace, subject, problem, "left out")
    } else {
        Finding::warning(FindingKind::DuplicateFace, subject, format!("{problem}, but another material"), "left out")
    }
}

fn needless_back<'a>(
    front: Stated,
    material: u32,
    subject: &str,
    look: impl Fn(u32) -> &'a Material,
) -> Option<Finding> {
    let problem = format!("it is the back of the face of line {}", front.line);
    let [one, other] = [front.material, material].map(look);
    if one.is_glass() && other.is_glass() {
        let problem = format!("{problem}, and both are glass: light would leave the glass where it enters");
        let remedy = "left out; glass is stated once, its fronts outwards";
        Some(Finding::warning(FindingKind::DuplicateFace, subject, problem, remedy))
    } else if front.material == material && !other.is_emitter() {
        let remedy = "left out: a surface of one material is the same on both sides";
        Some(Finding::note(FindingKind::DuplicateFace, subject, problem, remedy))
    } else {
        None
    }
}

/// The same ring from its lowest corner on: of those where it has several, the lowest ring.
fn from_lowest(ring: &[u32]) -> Vec<u32> {
    let lowest = ring.iter().min();
    let begins = (0..ring.len()).filter(|&place| Some(&ring[place]) == lowest);
    begins.map(|place| [&ring[place..], &ring[..place]].concat()).min().unwrap_or_default()
}
