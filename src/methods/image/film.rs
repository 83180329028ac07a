//! A picture in the making: coarse at first, then every pixel, then more samples of each.

use super::eye_path::{Look, Sight};
use super::shutter::Shutter;
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::methods::cost::Cost;
use crate::methods::photon_map::Scratch;
use crate::methods::transport::Media;
use rayon::prelude::*;

/// Pixels along the edge of a cell, in the passes that come before the first whole one.
const COARSE_CELLS: [u32; 4] = [16, 8, 4, 2];
/// Pixels along the edge of a tile, which one thread works on.
const TILE: u32 = 32;
/// Tiles of a step.
const TILES_PER_STEP: usize = 16;

/// Sums over the samples of each pixel, and how far the pass under way has come.
pub struct Film {
    shutter: Shutter,
    /// The newest whole grid of coarse cells.
    coarse: Option<Grid>,
    /// The grid under way, while passes are coarse.
    next_coarse: Grid,
    /// Of all samples of each pixel.
    sums: Vec<Sum>,
    /// Passes begun before the one under way, coarse ones included.
    pass: usize,
    /// Tiles of the pass that are done.
    tiles_done: usize,
    cost: Cost,
}

/// Values of cells, row by row from the top left.
#[derive(Clone)]
struct Grid {
    /// Pixels along the edge of a cell.
    cell: u32,
    resolution: [u32; 2],
    radiance: Vec<Rgb>,
    coverage: Vec<f32>,
}

#[derive(Clone, Copy, Default)]
struct Sum {
    radiance: Rgb,
    covered: f32,
    samples: u32,
}

/// A film developed: see [`crate::solution::CameraImage`].
pub struct Developed {
    pub resolution: [u32; 2],
    pub radiance: Vec<Rgb>,
    pub coverage: Vec<f32>,
}

impl Film {
    pub fn new(camera: &Camera, media: Media, size: [u32; 2], seed: u64) -> Self {
        Self {
            shutter: Shutter::new(camera, media, size, seed),
            coarse: None,
            next_coarse: Grid::new(size, COARSE_CELLS[0]),
            sums: vec![Sum::default(); size[0] as usize * size[1] as usize],
            pass: 0,
            tiles_done: 0,
            cost: Cost::default(),
        }
    }

    pub fn seed(&self) -> u64 {
        self.shutter.seed
    }

    /// Whole passes over all pixels that are done.
    pub fn samples(&self) -> u32 {
        self.pass.saturating_sub(COARSE_CELLS.len()) as u32
    }

    /// Whether a pass over all pixels was just finished, and the next one has not begun.
    pub fn is_between_passes(&self) -> bool {
        self.tiles_done == 0 && self.samples() > 0
    }

    pub fn cost(&self) -> &Cost {
        &self.cost
    }

    /// Pixels along the edge of a cell in the pass under way.
    fn cell(&self) -> u32 {
        COARSE_CELLS.get(self.pass).copied().unwrap_or(1)
    }

    /// Works on some tiles of the pass under way; false, and nothing changes, if stopped.
    pub fn expose(&mut self, eye: &dyn Look, cancel: &Cancel) -> bool {
        let cell = self.cell();
        let resolution = self.shutter.size.map(|pixels| pixels.div_ceil(cell));
        let across = resolution[0].div_ceil(TILE) as usize;
        let tiles = across * resolution[1].div_ceil(TILE) as usize;
        let range = self.tiles_done..(self.tiles_done + TILES_PER_STEP).min(tiles);
        let tile = |index: usize| Tile::new(index, across, resolution);
        let exposed: Vec<Option<(Vec<Sight>, Cost)>> =
            range.clone().into_par_iter().map(|index| self.expose_tile(&tile(index), cell, eye, cancel)).collect();
        let Some(exposed) = exposed.into_iter().collect::<Option<Vec<_>>>() else { return false };
        for (index, (sights, cost)) in range.clone().zip(exposed) {
            self.cost.add(&cost);
            self.keep(&tile(index), resolution[0], &sights);
        }
        self.tiles_done = range.end;
        if self.tiles_done == tiles {
            self.end_pass();
        }
        true
    }

    fn expose_tile(&self, tile: &Tile, cell: u32, eye: &dyn Look, cancel: &Cancel) -> Option<(Vec<Sight>, Cost)> {
        let mut sights = Vec::with_capacity((TILE * TILE) as usize);
        let (mut scratch, mut cost) = (Scratch::default(), Cost::default());
        for y in tile.rows.clone() {
            if cancel.is_requested() {
                return None;
            }
            for x in tile.columns.clone() {
                sights.push(self.shutter.sample([x, y], cell, self.samples(), eye, &mut scratch, &mut cost));
            }
        }
        Some((sights, cost))
    }

    fn keep(&mut self, tile: &Tile, width: u32, sights: &[Sight]) {
        let cells = tile.rows.clone().flat_map(|y| tile.columns.clone().map(move |x| (y * width + x) as usize));
        let is_coarse = self.pass < COARSE_CELLS.len();
        for (cell, sight) in cells.zip(sights) {
            let covered = if sight.is_surface { 1.0 } else { 0.0 };
            if is_coarse {
                self.next_coarse.radiance[cell] = sight.radiance;
                self.next_coarse.coverage[cell] = covered;
            } else {
                let sum = &mut self.sums[cell];
                sum.radiance += sight.radiance;
                sum.covered += covered;
                sum.samples += 1;
            }
        }
    }

    fn end_pass(&mut self) {
        if let Some(cell) = COARSE_CELLS.get(self.pass) {
            let next = COARSE_CELLS.get(self.pass + 1).unwrap_or(cell);
            self.coarse = Some(std::mem::replace(&mut self.next_coarse, Grid::new(self.shutter.size, *next)));
        } else {
            // Every pixel has a value of its own now.
            self.coarse = None;
        }
        self.pass += 1;
        self.tiles_done = 0;
    }

    /// The means so far; `None` before the first coarse pass is whole.
    pub fn develop(&self) -> Option<Developed> {
        let is_coarse = self.pass < COARSE_CELLS.len() || (self.samples() == 0 && self.tiles_done == 0);
        match &self.coarse {
            Some(Grid { resolution, radiance, coverage, .. }) if is_coarse => {
                Some(Developed { resolution: *resolution, radiance: radiance.clone(), coverage: coverage.clone() })
            }
            None if is_coarse => None,
            coarse => Some(self.develop_pixels(coarse.as_ref())),
        }
    }

    /// Pixels without a sample of their own take over their cell's.
    fn develop_pixels(&self, coarse: Option<&Grid>) -> Developed {
        let value = |(index, sum): (usize, &Sum)| match coarse {
            Some(grid) if sum.samples == 0 => grid.value(index, self.shutter.size[0]),
            _ => {
                let scale = 1.0 / sum.samples.max(1) as f32;
                (sum.radiance * scale, sum.covered * scale)
            }
        };
        let (radiance, coverage) = self.sums.iter().enumerate().map(value).unzip();
        Developed { resolution: self.shutter.size, radiance, coverage }
    }
}

impl Grid {
    fn new(size: [u32; 2], cell: u32) -> Self {
        let resolution = size.map(|pixels| pixels.div_ceil(cell));
        let cells = resolution[0] as usize * resolution[1] as usize;
        Self { cell, resolution, radiance: vec![Rgb::ZERO; cells], coverage: vec![0.0; cells] }
    }

    /// Of the cell round a pixel of a picture of this width.
    fn value(&self, pixel: usize, width: u32) -> (Rgb, f32) {
        let (x, y) = (pixel as u32 % width / self.cell, pixel as u32 / width / self.cell);
        let cell = (y * self.resolution[0] + x) as usize;
        (self.radiance[cell], self.coverage[cell])
    }
}

/// A rectangle of cells.
struct Tile {
    columns: std::ops::Range<u32>,
    rows: std::ops::Range<u32>,
}

impl Tile {
    fn new(index: usize, across: usize, resolution: [u32; 2]) -> Self {
        let [x, y] = [index % across, index / across].map(|i| i as u32 * TILE);
        Self { columns: x..(x + TILE).min(resolution[0]), rows: y..(y + TILE).min(resolution[1]) }
    }
}
