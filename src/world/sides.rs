//! Which sides of which polygons light can reach.
//!
//! The outside of a closed room and the inside of a block never see light; meshing them would cost memory and time
//! for nothing. Sides are first joined into *shells*: sides that meet at an edge and bound the same space. A shell is
//! reached if a walk of light from an emitter touches it, or if a walk that starts on it can be connected with a walk
//! from an emitter by a free line of sight: no chain of guesses, every step is a ray, so nothing that is shut off is
//! ever taken for reached. Both kinds of walk together find what is small or hard to get into.
//!
//! Where no emitter lights anything, walks start from what the eye sees, and the even light of the sky may come from
//! anywhere: a shell from which a walk leaves the scene is reached, too.

use super::TOUCHING;
use super::shells::shells;
use super::surface::{Place, Surfaces};
use crate::cancel::{Cancel, Cancelled};
use crate::math::bounds::Bounds;
use crate::math::random::Stream;
use crate::mesh::side_index;
use crate::scene::Scene;
use crate::tracer::{Hit, Ray, Tracer};
use glam::{Vec3, Vec3A};
use rayon::prelude::*;

/// Walks of light from emitters, and the bounces of each. Every emitter gets a walk; where that makes more of them, each
/// is shorter.
const LIGHT_WALKS: usize = 4096;
const LIGHT_BOUNCES: usize = 16;
/// Walks from a shell that no light walk touched, and the bounces of each. Scenes with very many shells share out
/// [`SHELL_WALKS_IN_ALL`].
const SHELL_WALKS: usize = 256;
const SHELL_WALKS_IN_ALL: usize = 1 << 17;
const SHELL_BOUNCES: usize = 6;
/// Rays with which a side looks for anything at all.
const LOOKS: usize = 64;
/// Streams of random numbers, one for each use.
const LIGHT_PASS: u64 = 1;
const SHELL_PASS: u64 = 2;
const LOOK_PASS: u64 = 3;
const SKY_PASS: u64 = 5;

/// What the exploration found out.
pub struct Reach {
    /// For each side, as in [`crate::mesh::Mesh::sides`].
    pub is_reached: Vec<bool>,
    /// Those of them which walks reached: worth looking at. Others are only open to the sky, as the outside of a room.
    pub is_walked: Vec<bool>,
    /// Share of the steps of light walks that left the scene, in [0, 1].
    pub escape_share: f64,
    /// Places on surfaces that light reaches, to look for a viewpoint between them.
    pub rooms: Vec<Place>,
}

impl Reach {
    /// Adds what light of emitters reaches, and takes over how much of that leaves the scene.
    pub fn add_lit(&mut self, lit: &Self) {
        self.is_reached.iter_mut().zip(&lit.is_reached).for_each(|(this, lit)| *this |= lit);
        self.escape_share = lit.escape_share;
    }
}

/// Explores the scene from these emitting sides, or from the eye where there are none.
pub fn explore(
    scene: &Scene,
    emitters: &[usize],
    surfaces: &Surfaces,
    tracer: &Tracer,
    eye: Vec3,
    cancel: &Cancel,
) -> Result<Reach, Cancelled> {
    let shells = shells(scene, surfaces);
    let walks = LIGHT_WALKS.max(emitters.len());
    let walks: Vec<Walk> =
        (0..walks).into_par_iter().map(|i| light_walk(i, walks, emitters, surfaces, tracer, eye)).collect();
    let light: Vec<Place> = walks.iter().flat_map(|walk| walk.places.iter().copied()).collect();
    let mut is_shell_reached = vec![false; shells.count];
    let mut is_touched = vec![false; 2 * surfaces.len()];
    for place in &light {
        is_shell_reached[shells.of_side[place.side]] = true;
        is_touched[place.side] = true;
    }
    let mut members = vec![Vec::new(); shells.count];
    for (side, &shell) in shells.of_side.iter().enumerate() {
        members[shell].push(side);
    }
    let dark: Vec<usize> = (0..shells.count).filter(|&shell| !is_shell_reached[shell]).collect();
    let walks_each = (SHELL_WALKS_IN_ALL / dark.len().max(1)).clamp(8, SHELL_WALKS);
    let found: Vec<bool> = dark
        .par_iter()
        .map(|&shell| {
            !cancel.is_requested() && finds_light(&members[shell], shell, walks_each, &light, surfaces, tracer)
        })
        .collect();
    for (&shell, found) in dark.iter().zip(found) {
        is_shell_reached[shell] = found;
    }
    let is_shell_open: Vec<bool> = members
        .par_iter()
        .enumerate()
        .map(|(shell, sides)| {
            emitters.is_empty() && !cancel.is_requested() && finds_sky(sides, shell, walks_each, surfaces, tracer)
        })
        .collect();
    let near = TOUCHING * Bounds::of(surfaces.corners()).radius();
    let (mut is_walked, mut is_reached): (Vec<bool>, Vec<bool>) = (0..2 * surfaces.len())
        .into_par_iter()
        .map(|side| {
            let shell = shells.of_side[side];
            let may_be_reached = is_shell_reached[shell] || is_shell_open[shell];
            if !may_be_reached || cancel.is_requested() || !has_room(side, near, emitters, surfaces, tracer) {
                return (false, false);
            }
            let is_walked =
                is_shell_reached[shell] && (is_touched[side] || looks_at_something(side, &light, surfaces, tracer));
            (is_walked, is_walked || is_shell_open[shell])
        })
        .unzip();
    for &side in emitters {
        is_walked[side] = true;
        is_reached[side] = true;
    }
    if cancel.is_requested() {
        return Err(Cancelled);
    }
    Ok(Reach { is_reached, is_walked, escape_share: escape_share(&walks), rooms: light })
}

/// Fronts of emitters.
pub fn emitting_sides(scene: &Scene) -> Vec<usize> {
    let emits = |polygon: usize| scene.materials[scene.polygons[polygon].material as usize].is_emitter();
    (0..scene.polygons.len())
        .filter(|&polygon| emits(polygon))
        .map(|polygon| side_index(polygon as u32, true))
        .collect()
}

/// One path of light.
struct Walk {
    places: Vec<Place>,
    escaped: bool,
}

/// Escapes by all steps: every place but the first was reached by one.
fn escape_share(walks: &[Walk]) -> f64 {
    let escapes = walks.iter().filter(|walk| walk.escaped).count();
    let bounces: usize = walks.iter().map(|walk| walk.places.len().saturating_sub(1)).sum();
    escapes as f64 / (escapes + bounces).max(1) as f64
}

/// Number `index` of so many walks, from an emitter or else from what the eye sees.
fn light_walk(index: usize, walks: usize, emitters: &[usize], surfaces: &Surfaces, tracer: &Tracer, eye: Vec3) -> Walk {
    let bounces = (LIGHT_WALKS * LIGHT_BOUNCES / walks).max(1);
    let mut stream = Stream::new(0, LIGHT_PASS, index as u64);
    let start = if emitters.is_empty() {
        first_seen(surfaces, tracer, eye, &mut stream)
    } else {
        Some(surfaces.place(emitters[index % emitters.len()], &mut stream))
    };
    let mut walk = Walk { places: start.into_iter().collect(), escaped: false };
    while let Some(last) = walk.places.last().filter(|_| walk.places.len() <= bounces) {
        match surfaces.bounce(last, tracer, &mut stream) {
            Some(place) => walk.places.push(place),
            None => {
                walk.escaped = true;
                break;
            }
        }
    }
    walk
}

/// What the eye sees in a random direction.
fn first_seen(surfaces: &Surfaces, tracer: &Tracer, eye: Vec3, stream: &mut Stream) -> Option<Place> {
    if surfaces.len() == 0 {
        return None;
    }
    let aim = surfaces.place(2 * (stream.bits() % surfaces.len() as u64) as usize, stream);
    let origin = Vec3A::from(eye);
    let direction = (aim.point - origin).try_normalize()?;
    let hit = tracer.closest(&Ray::new(origin, direction))?;
    let side = side_index(hit.polygon, hit.is_front);
    Some(Place { side, point: hit.point, normal: surfaces.normal(side) })
}

/// Whether a walk from one of these sides comes in sight of a place where light has been.
fn finds_light(
    sides: &[usize],
    shell: usize,
    walks: usize,
    light: &[Place],
    surfaces: &Surfaces,
    tracer: &Tracer,
) -> bool {
    (0..walks).any(|walk| {
        let mut stream = Stream::new(walk as u64, SHELL_PASS, shell as u64);
        let mut place = surfaces.place(sides[walk % sides.len()], &mut stream);
        for _ in 0..SHELL_BOUNCES {
            if sees_light(&place, light, tracer, &mut stream) {
                return true;
            }
            match surfaces.bounce(&place, tracer, &mut stream) {
                Some(next) => place = next,
                None => return false,
            }
        }
        false
    })
}

/// Whether a walk from one of these sides leaves the scene: then the light of the sky finds the same way in.
fn finds_sky(sides: &[usize], shell: usize, walks: usize, surfaces: &Surfaces, tracer: &Tracer) -> bool {
    (0..walks).any(|walk| {
        let mut stream = Stream::new(walk as u64, SKY_PASS, shell as u64);
        let mut place = surfaces.place(sides[walk * sides.len() / walks], &mut stream);
        for _ in 0..SHELL_BOUNCES {
            match surfaces.bounce(&place, tracer, &mut stream) {
                Some(next) => place = next,
                None => return true,
            }
        }
        false
    })
}

/// Whether a place has a free line of sight to a random one of those where light has been.
fn sees_light(place: &Place, light: &[Place], tracer: &Tracer, stream: &mut Stream) -> bool {
    let count = light.len() as u64;
    count > 0 && place.sees(&light[(stream.bits() % count) as usize], tracer)
}

/// Whether anything can be seen from the side: from the part of a floor that a block hides, nothing can. Of what is small
/// and far away, such as a lamp high above a bare floor, no random ray may tell, but a ray to where light has been does.
fn looks_at_something(side: usize, light: &[Place], surfaces: &Surfaces, tracer: &Tracer) -> bool {
    let mut stream = Stream::new(0, LOOK_PASS, side as u64);
    (0..LOOKS).any(|_| {
        let place = surfaces.place(side, &mut stream);
        surfaces.bounce(&place, tracer, &mut stream).is_some() || sees_light(&place, light, tracer, &mut stream)
    })
}

/// Whether some of the side is farther than `near`, m, from whatever is before it, or faces an emitter: the back of a lamp
/// that is let into a ceiling does not. `emitters` are sides in ascending order.
fn has_room(side: usize, near: f32, emitters: &[usize], surfaces: &Surfaces, tracer: &Tracer) -> bool {
    let emits = |hit: &Hit| emitters.binary_search(&side_index(hit.polygon, hit.is_front)).is_ok();
    let mut stream = Stream::new(1, LOOK_PASS, side as u64);
    (0..LOOKS).any(|_| {
        let place = surfaces.place(side, &mut stream);
        let ahead = tracer.closest(&Ray::leaving(place.surface_point(), place.normal));
        ahead.is_none_or(|hit| hit.distance > near || emits(&hit))
    })
}
