//! Some pixels of a picture, for those who want to know how it will be before it is made.

use super::eye_path::Look;
use super::shutter::Shutter;
use super::{Sources, media_round};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::math::random::sobol2;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::Settings;
use crate::methods::cost::Cost;
use crate::methods::photon_map::Scratch;
use crate::methods::transport::Transport;
use crate::solution::CameraView;
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::Arc;

/// Of each pixel, along the width and along the height.
const RAYS_ACROSS: u32 = 4;
/// Where a large emitter that reaches into a pixel is met at least once, however little of it that covers.
const CORNERS: [[f32; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
/// Pixels that are looked at for some that show surfaces: all at once, and in all.
const TRIES_AT_ONCE: usize = 1 << 12;
const MOST_TRIES: u32 = 1 << 20;

/// Single pixels of a picture, exposed sample by sample: plain state and a step. Each has the value that it has in the whole
/// picture with as many samples, to the rounding of sums.
pub struct Pixels {
    eye: Arc<dyn Look>,
    shutter: Shutter,
    /// Column and row, from the top left.
    places: Arc<[[u32; 2]]>,
    /// L of the samples of each pixel, W/(m²·sr), background as 0.
    channels: Vec<[Moments; 3]>,
    samples: u32,
}

impl Pixels {
    /// Pixels of a picture of `size` before their first sample; `None` where the view needs light that `sources` do not have.
    pub fn new(
        sources: &Sources,
        view: CameraView,
        camera: Camera,
        size: [u32; 2],
        places: Arc<[[u32; 2]]>,
        settings: &Settings,
    ) -> Option<Self> {
        let eye = sources.look(view, settings)?;
        let shutter = Shutter::new(&camera, media_round(&*eye, &camera), size, settings.seed);
        let channels = vec![[Moments::default(); 3]; places.len()];
        Some(Self { eye, shutter, places, channels, samples: 0 })
    }

    /// The same pixels of the same light before their first sample, by other random numbers.
    #[must_use]
    pub fn reseeded(&self, seed: u64) -> Self {
        Self {
            eye: self.eye.clone(),
            shutter: self.shutter.reseeded(seed),
            places: self.places.clone(),
            channels: vec![[Moments::default(); 3]; self.places.len()],
            samples: 0,
        }
    }

    /// One sample more of each, or of none if stopped.
    pub fn step(&mut self, cancel: &Cancel) -> bool {
        let expose = |scratch: &mut Scratch, place: &[u32; 2]| {
            let mut take = || self.shutter.sample(*place, 1, self.samples, &*self.eye, scratch, &mut Cost::default());
            (!cancel.is_requested()).then(|| take().radiance)
        };
        let found: Option<Vec<Rgb>> = self.places.par_iter().map_init(Scratch::default, expose).collect();
        let Some(found) = found else { return false };
        for (channels, radiance) in self.channels.iter_mut().zip(found) {
            for (moments, value) in channels.iter_mut().zip(radiance.to_array()) {
                moments.add(value.into());
            }
        }
        self.samples += 1;
        true
    }

    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// L so far, W/(m²·sr).
    pub fn radiance(&self) -> Vec<Rgb> {
        let mean = |channels: &[Moments; 3]| Rgb::from_array(channels.each_ref().map(|channel| channel.mean() as f32));
        self.channels.iter().map(mean).collect()
    }
}

/// At most `count` pixels, spread over a picture, that show surfaces and nothing else, none of which emits: there is no light to
/// be found where one is seen. Where no others are seen, those that emit. Always the same of a picture and a `set`; those of
/// another set are others, as far as there are enough.
pub fn spread_pixels(transport: &Transport, camera: &Camera, size: [u32; 2], count: usize, set: u32) -> Vec<[u32; 2]> {
    let eye_rays = camera.rays(size);
    let shown = |[x, y]: [u32; 2]| {
        let met = |inside: [f32; 2]| transport.meet(&eye_rays.through([x as f32 + inside[0], y as f32 + inside[1]]));
        let emits = |inside| met(inside).is_some_and(|surface| transport.emission(&surface) != Rgb::ZERO);
        let mut shown = if CORNERS.into_iter().any(emits) { Shown::Emitter } else { Shown::Dull };
        for i in 0..RAYS_ACROSS * RAYS_ACROSS {
            let inside = [i % RAYS_ACROSS, i / RAYS_ACROSS].map(|i| (i as f32 + 0.5) / RAYS_ACROSS as f32);
            if transport.emission(&met(inside)?) != Rgb::ZERO {
                shown = Shown::Emitter;
            }
        }
        Some(shown)
    };
    let place = |i| {
        let at = sobol2(i, 0, set);
        [at.x * size[0] as f32, at.y * size[1] as f32].map(|pixel| pixel as u32)
    };
    // Of small pictures each pixel comes up again and again; of large ones that show little, many are looked at.
    let pixels = size[0].saturating_mul(size[1]);
    let tries = pixels.saturating_mul(4).min(MOST_TRIES);
    let (mut seen, mut dull, mut emitters) = (HashSet::new(), Vec::new(), Vec::new());
    for start in (0..tries).step_by(TRIES_AT_ONCE) {
        let range = start..tries.min(start + TRIES_AT_ONCE as u32);
        let fresh: Vec<[u32; 2]> = range.map(place).filter(|&place| seen.insert(place)).collect();
        let shown: Vec<Option<Shown>> = fresh.par_iter().map(|&place| shown(place)).collect();
        for (place, shown) in fresh.into_iter().zip(shown) {
            match shown {
                Some(Shown::Dull) => dull.push(place),
                Some(Shown::Emitter) => emitters.push(place),
                None => {}
            }
        }
        if dull.len() >= count || seen.len() == pixels as usize {
            break;
        }
    }
    let mut chosen = if dull.is_empty() { emitters } else { dull };
    chosen.truncate(count);
    chosen
}

/// What a pixel shows that shows surfaces all over.
#[derive(Clone, Copy)]
enum Shown {
    Dull,
    Emitter,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Switches;
    use crate::mesh::MeshSettings;
    use crate::methods::image::ImageRun;
    use crate::methods::{ImageSettings, Step};
    use crate::scene::Scene;
    use crate::world::World;

    const SIZE: [u32; 2] = [37, 29];

    fn seen(scene: &str) -> (Sources, Camera) {
        let scene = Scene::open(scene).expect("a built-in scene");
        let world = Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"));
        let camera = Camera::new(&world.viewpoint, &world.bounds);
        let transport = Arc::new(Transport::new(world, Switches::default()));
        (Sources { transport, radiosity: None, photons: None }, camera)
    }

    #[test]
    fn single_pixels_are_those_of_the_whole_picture() {
        let (sources, camera) = seen("cornell-box");
        let settings =
            Settings { image: ImageSettings { samples: 3, ..ImageSettings::default() }, ..Settings::default() };
        let mut whole = ImageRun::new(&sources, CameraView::Reference, camera, SIZE, &settings).expect("a run");
        while whole.step(&Cancel::default()) == Step::Advanced {}
        let whole = whole.image().expect("a picture").radiance;
        let places: Arc<[[u32; 2]]> = spread_pixels(&sources.transport, &camera, SIZE, 200, 0).into();
        let mut some =
            Pixels::new(&sources, CameraView::Reference, camera, SIZE, places.clone(), &settings).expect("pixels");
        (0..3).for_each(|_| assert!(some.step(&Cancel::default())));
        for ([x, y], radiance) in places.iter().zip(some.radiance()) {
            let of_whole = whole[(y * SIZE[0] + x) as usize];
            assert!((of_whole - radiance).abs().max_element() <= 1e-6 * of_whole.max_element(), "{x},{y}");
        }
    }

    #[test]
    fn pixels_that_show_surfaces_are_found_however_few_there_are() {
        let (sources, mut camera) = seen("cornell-box");
        let whole = spread_pixels(&sources.transport, &camera, SIZE, usize::MAX, 0);
        // The box does not fill the picture.
        assert!(whole.len() > 600 && whole.len() < 37 * 29, "{}", whole.len());
        let few = spread_pixels(&sources.transport, &camera, [1000, 1000], 100, 0);
        let others = spread_pixels(&sources.transport, &camera, [1000, 1000], 100, 1);
        assert_eq!((few.len(), others.len()), (100, 100));
        assert!(few.iter().filter(|place| others.contains(place)).count() < 5);
        // From so far away that the box is a few pixels across.
        camera.zoom(40.0);
        let far = spread_pixels(&sources.transport, &camera, [400, 400], 1000, 0);
        let all = spread_pixels(&sources.transport, &camera, [400, 400], usize::MAX, 1);
        // Points that are spread evenly miss next to none, but may miss one.
        assert!(!far.is_empty() && far.len().abs_diff(all.len()) <= 1 + all.len() / 50, "{} {}", far.len(), all.len());
        assert_eq!(spread_pixels(&sources.transport, &camera, [0, 5], 10, 0), Vec::<[u32; 2]>::new());
    }
}
