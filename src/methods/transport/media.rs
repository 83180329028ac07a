//! Which glass a ray is in: bodies may stand in each other.

use super::Surface;
use crate::scene::Material;

/// The bodies of glass round a point, the innermost last; in the air there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Media {
    /// Indices of materials.
    bodies: [u32; Self::DEEPEST],
    count: u8,
}

impl Media {
    /// Bodies deeper in each other than this are left out.
    const DEEPEST: usize = 4;

    /// The refraction index behind a surface over that on the side on which it was met. Fronts of glass look outwards.
    pub fn index_across(&self, surface: &Surface, materials: &[Material]) -> f32 {
        let index = |media: &Self| media.innermost().map_or(1.0, |body| materials[body as usize].refraction_index);
        index(&self.across(surface)) / index(self)
    }

    /// The media on the other side of a surface.
    #[must_use]
    pub fn across(&self, surface: &Surface) -> Self {
        let mut media = *self;
        let count = usize::from(self.count);
        if surface.is_front {
            if count < Self::DEEPEST {
                media.bodies[count] = surface.material;
                media.count += 1;
            }
        } else if let Some(place) = self.bodies[..count].iter().rposition(|&body| body == surface.material) {
            media.bodies.copy_within(place + 1.., place);
            media.count -= 1;
            // What is not in use is always the same, so that equal media are equal.
            media.bodies[count - 1] = 0;
        }
        media
    }

    /// The media round a point from which a ray leaves through backs of these materials, the innermost first.
    pub fn inside_of(bodies: &[u32]) -> Self {
        let mut media = Self::default();
        let outer = bodies.len().saturating_sub(Self::DEEPEST);
        for &body in bodies[..bodies.len() - outer].iter().rev() {
            media.bodies[usize::from(media.count)] = body;
            media.count += 1;
        }
        media
    }

    fn innermost(&self) -> Option<u32> {
        self.count.checked_sub(1).map(|last| self.bodies[usize::from(last)])
    }
}
