//! How single photons are drawn.

use crate::choice::Choice;
use crate::math::rgb::Rgb;
use crate::solution::Photon;
use crate::viewport::colour_map::colour;

/// What a person can change of the views of photons.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PhotonLook {
    pub colour: PhotonColour,
    /// Width of a photon, pixels.
    pub size: f32,
    /// Whether only so many are drawn that there are gaps between them: of a million there is nothing to see but their crowd.
    pub thinned: bool,
    /// Whether a tick at each photon points to where it came from.
    pub ticks: bool,
    /// How deep into the tree [`crate::viewport::View::KdTree`] shows its planes; the root is at 0.
    pub depth: u8,
}

impl PhotonLook {
    /// The widest, pixels.
    pub const MAX_SIZE: f32 = 12.0;
    pub const MAX_DEPTH: u8 = 16;
    /// Pixels of the picture for each photon that is drawn, where they are thinned out.
    const PIXELS_EACH: u32 = 12;

    /// One photon of so many is drawn in a picture of this size, of a `count` in all.
    pub fn stride(&self, count: u32, size: [u32; 2]) -> u32 {
        let room = (size[0].saturating_mul(size[1]) / Self::PIXELS_EACH).max(1);
        if self.thinned { count.div_ceil(room).max(1) } else { 1 }
    }
}

impl Default for PhotonLook {
    fn default() -> Self {
        Self { colour: PhotonColour::default(), size: 2.0, thinned: true, ticks: false, depth: 5 }
    }
}

/// What the colour of a photon tells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PhotonColour {
    /// The hue of its flux, and how much of it there is.
    #[default]
    Flux,
    /// How many surfaces it met before.
    Bounce,
    /// Whether it came straight from the light, over specular surfaces alone, or in another way.
    Path,
}

/// A colour with a meaning of its own: label, linear RGB.
pub type ColourClass = (&'static str, Rgb);

/// The last one is for all later bounces as well.
const BOUNCES: [&str; 7] = ["0", "1", "2", "3", "4", "5", "6 and more"];
/// Told apart by their lightness too (after Okabe, Ito 2008).
const PATHS: [ColourClass; 3] = [
    ("Direct, LD", Rgb::new(0.79, 0.35, 0.0)),
    ("Indirect", Rgb::new(0.093, 0.456, 0.815)),
    ("Caustic, LS+D", Rgb::new(0.871, 0.776, 0.055)),
];

impl PhotonColour {
    /// The colours that it is made of, in the order of a legend; none where they are no classes.
    pub fn classes(self) -> Vec<ColourClass> {
        match self {
            Self::Flux => Vec::new(),
            Self::Bounce => (0..BOUNCES.len()).map(|bounce| (BOUNCES[bounce], of_bounce(bounce))).collect(),
            Self::Path => PATHS.to_vec(),
        }
    }

    /// The colour of a photon among others whose flux has `brightest` as its largest channel, W. Linear RGB.
    pub(super) fn of(self, photon: &Photon, brightest: f32) -> Rgb {
        match self {
            Self::Flux => of_flux(photon.flux, brightest),
            Self::Bounce => of_bounce(photon.path.len()),
            Self::Path if photon.path.is_empty() => PATHS[0].1,
            Self::Path if photon.path.is_caustic() => PATHS[2].1,
            Self::Path => PATHS[1].1,
        }
    }
}

/// The darkest photon has this share of the brightness of the brightest one, so that it can be seen.
const DARKEST: f32 = 0.2;

/// The colour of flux among others whose largest channel is `brightest`, W.
pub(super) fn of_flux(flux: Rgb, brightest: f32) -> Rgb {
    let largest = flux.max_element();
    if largest <= 0.0 {
        return Rgb::ZERO;
    }
    flux / largest * (DARKEST + (1.0 - DARKEST) * (largest / brightest).min(1.0))
}

/// From bright to dark: photons get fewer and darker with every bounce.
fn of_bounce(bounce: usize) -> Rgb {
    let last = BOUNCES.len() - 1;
    colour(1.0 - bounce.min(last) as f32 / last as f32)
}

impl Choice for PhotonColour {
    const ALL: &'static [Self] = &[Self::Flux, Self::Bounce, Self::Path];
    const KIND: &'static str = "colour of photons";

    fn name(self) -> &'static str {
        match self {
            Self::Flux => "flux",
            Self::Bounce => "bounce",
            Self::Path => "path",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Flux => "Flux",
            Self::Bounce => "Bounce",
            Self::Path => "Path",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Flux => "The hue of a photon's flux, brighter where it carries more",
            Self::Bounce => "How many surfaces a photon met before it landed here",
            Self::Path => "Straight from the light, gathered by mirrors and glass, or in another way",
        }
    }
}
