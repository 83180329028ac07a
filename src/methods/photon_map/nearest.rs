//! The nearest photons of a search.

use super::tree::Found;

/// Up to so many found points, the nearest so far. Points are gathered up to half as many again, and then the farther third is
/// dropped at once: that is less work a point than a heap.
#[derive(Clone, Debug, Default)]
pub struct Nearest {
    /// Bits of the square distance, which as a positive float sorts like a whole number, above the slot.
    keys: Vec<u64>,
    limit: usize,
}

impl Nearest {
    /// Begins a search for `limit` points, at least 1.
    pub fn begin(&mut self, limit: usize) {
        self.keys.clear();
        self.limit = limit;
    }

    /// Takes a point in; returns the square distance, m², up to which points are of use.
    pub fn add(&mut self, found: &Found, bound: f32) -> f32 {
        self.keys.push(u64::from(found.square_distance.to_bits()) << 32 | u64::from(found.slot));
        if self.keys.len() > self.limit.saturating_add(self.limit / 2) { self.drop_farther() } else { bound }
    }

    /// Ends the search; returns the square distance of the last of the points, m², if there are `limit` of them. That one
    /// is then the last of [`Nearest::points`].
    pub fn end(&mut self) -> Option<f32> {
        (self.keys.len() >= self.limit).then(|| self.drop_farther())
    }

    /// Square distances, m², and slots, in no order.
    pub fn points(&self) -> impl ExactSizeIterator<Item = (f32, u32)> + Clone + '_ {
        self.keys.iter().map(|&key| (square_distance(key), key as u32))
    }

    fn drop_farther(&mut self) -> f32 {
        let (_, &mut last, _) = self.keys.select_nth_unstable(self.limit - 1);
        self.keys.truncate(self.limit);
        square_distance(last)
    }
}

fn square_distance(key: u64) -> f32 {
    f32::from_bits((key >> 32) as u32)
}
