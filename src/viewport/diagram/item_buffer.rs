//! What a hemicube sees, unfolded into a cross.

use super::canvas::Canvas;
use crate::math::random::Stream;
use crate::math::rgb::Rgb;
use crate::mesh::Patch;
use crate::solution::ItemBuffer;
use crate::viewport::Picture;
use crate::world::World;

/// Where nothing is seen, linear RGB.
const NOTHING: Rgb = Rgb::new(0.018, 0.022, 0.030);
/// Even black surfaces are as bright as this.
const DARKEST: f32 = 0.12;
/// Patches of one material differ in brightness down to this share.
const DIMMEST: f32 = 0.5;

/// Draws the five faces of a hemicube as its centre sees them, with at most `limit` pixels along each edge: the top in the
/// middle, each side at the edge that it shares with the top, and transparent corners. What is seen has the colour of its
/// material (an emitter that of its light), brighter or darker from patch to patch.
///
/// # Panics
/// If the buffer sees patches that `world` does not have.
pub fn item_buffer(buffer: &ItemBuffer, world: &World, limit: u32) -> Picture {
    let shades: Vec<Rgb> = world.mesh.patches.iter().enumerate().map(|(i, patch)| shade(world, i, patch)).collect();
    let resolution = buffer.resolution as usize;
    let mut canvas = Canvas::new([2 * resolution; 2], limit);
    for (face, items) in buffer.faces.iter().enumerate() {
        for (cell, &item) in items.iter().enumerate() {
            let [x, y] = unfolded(face, cell % resolution, cell / resolution, resolution);
            let colour = if item == ItemBuffer::NOTHING { NOTHING } else { shades[item as usize] };
            canvas.paint(x, y, colour);
        }
    }
    canvas.finish()
}

/// Where a cell of a face lies in the cross. Seen from the centre with the first axis to the right, the second points down.
fn unfolded(face: usize, column: usize, row: usize, resolution: usize) -> [usize; 2] {
    let half = resolution / 2;
    let reversed = resolution - 1 - column;
    // Sides have their foot at the rim of the cross.
    let outwards = |row: usize| half + resolution + (half - 1 - row);
    match face {
        0 => [half + column, half + row],
        1 => [outwards(row), half + column],
        2 => [half + reversed, outwards(row)],
        3 => [row, half + reversed],
        _ => [half + column, row],
    }
}

/// The colour of a patch, linear RGB.
fn shade(world: &World, index: usize, patch: &Patch) -> Rgb {
    let material = &world.scene.materials[patch.material as usize];
    let shines = patch.is_front && material.is_emitter();
    let own = if shines { material.emission / material.emission.max_element() } else { material.diffuse };
    let brightness = DIMMEST + (1.0 - DIMMEST) * Stream::new(0, 0, index as u64).uniform();
    brightness * (DARKEST + (1.0 - DARKEST) * own)
}

#[cfg(test)]
mod tests {
    use super::unfolded;
    use glam::Vec3;

    /// The direction of a cell from the centre: faces are the top and the sides towards x, y, −x and −y, whose columns run to
    /// the right seen from outside.
    fn direction(face: usize, column: usize, row: usize, resolution: usize) -> Vec3 {
        let place = |cell: usize| (cell as f32 + 0.5) * 2.0 / resolution as f32;
        let across = place(column) - 1.0;
        match face {
            0 => Vec3::new(across, place(row) - 1.0, 1.0),
            1 => Vec3::new(1.0, across, place(row)),
            2 => Vec3::new(-across, 1.0, place(row)),
            3 => Vec3::new(-1.0, -across, place(row)),
            _ => Vec3::new(across, -1.0, place(row)),
        }
    }

    #[test]
    fn the_cross_is_whole_and_has_no_seams_at_the_top() {
        let resolution = 8;
        let mut cross = vec![None; 4 * resolution * resolution];
        for face in 0..5 {
            let rows = if face == 0 { resolution } else { resolution / 2 };
            for (column, row) in (0..rows).flat_map(|row| (0..resolution).map(move |column| (column, row))) {
                let [x, y] = unfolded(face, column, row, resolution);
                let place = &mut cross[y * 2 * resolution + x];
                assert_eq!(*place, None, "two cells at {x} {y}");
                *place = Some(direction(face, column, row, resolution));
            }
        }
        let at = |x: usize, y: usize| cross[y * 2 * resolution + x];
        let (first, last) = (resolution / 2, 3 * resolution / 2 - 1);
        for y in 0..2 * resolution {
            for x in 0..2 * resolution {
                let is_covered = (first..=last).contains(&x) || (first..=last).contains(&y);
                assert_eq!(at(x, y).is_some(), is_covered, "{x} {y}");
                for next in [(x + 1, y), (x, y + 1)].into_iter().filter(|(x, y)| *x.max(y) < 2 * resolution) {
                    if let (Some(here), Some(there)) = (at(x, y), at(next.0, next.1)) {
                        // A cell is 2/8 wide; round an edge it is less far.
                        assert!(here.distance(there) < 0.26, "{x} {y}: {here}, then {there}");
                    }
                }
            }
        }
    }
}
