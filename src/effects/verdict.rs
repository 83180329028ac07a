//! Whether one effect is needed, and why.

use super::effect::Effect;
use crate::math::rgb::Rgb;
use crate::world::{Census, World};

/// What a plan says of one effect.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    pub effect: Effect,
    pub is_needed: bool,
    /// One sentence, with the figures behind it.
    pub reason: String,
    /// What skipping it saves.
    pub saves: &'static str,
    /// What one would see if it were skipped where it is needed.
    pub if_missed: &'static str,
}

impl Verdict {
    pub(super) fn new(effect: Effect, world: &World) -> Self {
        let census = &world.census;
        let (is_needed, reason) = match effect {
            Effect::DirectLight => direct_light(census),
            Effect::Colour => colour(census),
            Effect::Escape => escape(world),
            Effect::AmbientLight => ambient_light(census),
            // Without light, nothing else can be seen.
            _ if !census.light_may_arrive => (false, format!("There is no light: {}.", why_dark(census))),
            Effect::Shadows => shadows(world),
            Effect::Interreflection => interreflection(census),
            Effect::SpecularReflection => specular_reflection(census),
            Effect::Gloss => gloss(census),
            Effect::Transmission => transmission(census),
            Effect::Caustics => caustics(census),
        };
        Self { effect, is_needed, reason, saves: saves(effect), if_missed: if_missed(effect) }
    }
}

fn saves(effect: Effect) -> &'static str {
    match effect {
        Effect::DirectLight => "All rays from and to emitters.",
        Effect::Shadows => "All visibility rays: what faces each other sees each other.",
        Effect::Interreflection => {
            "All light after the first: reflected shots, photons that bounce, and gathering rays."
        }
        Effect::Colour => "Next to nothing, since all three channels go with the same rays and form factors.",
        Effect::SpecularReflection => "All reflected rays, and the photons that are reflected as by a mirror.",
        Effect::Gloss => "All rays and photons that are spread over a lobe.",
        Effect::Transmission => "All rays and photons through surfaces.",
        Effect::Caustics => "The photons that meet specular surfaces first, and the search for them.",
        Effect::Escape => "The rays of every shot that look for a way out.",
        Effect::AmbientLight => "All rays that look for open sky.",
    }
}

fn if_missed(effect: Effect) -> &'static str {
    match effect {
        Effect::DirectLight => "What emitters shine on would be lit by other surfaces alone.",
        Effect::Shadows => "Light would shine through whatever stands in its way.",
        Effect::Interreflection => "What no emitter shines on would be black, and nothing would tint its neighbour.",
        Effect::Colour => "All would be grey.",
        Effect::SpecularReflection => "Mirrors would be black, and glass would show no reflections.",
        Effect::Gloss => "Glossy surfaces would be dull and too dark.",
        Effect::Transmission => "Glass would be black and cast whole shadows.",
        Effect::Caustics => "The bright figures beside mirrors and behind glass would be missing.",
        Effect::Escape => "Light that leaves would come back from nowhere, and the energy would not add up.",
        Effect::AmbientLight => "All would be black, since nothing emits.",
    }
}

/// A number of things, which may be one.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

fn why_dark(census: &Census) -> String {
    match census.emitters {
        0 => "no surface emits".to_owned(),
        1 => "nothing sees the one emitter".to_owned(),
        count => format!("nothing sees any of the {count} emitters"),
    }
}

fn direct_light(census: &Census) -> (bool, String) {
    if !census.light_may_arrive {
        return (false, format!("There is none: {}.", why_dark(census)));
    }
    let reason = match census.emitters - census.unseen_emitters {
        0 => "Random rays from emitters meet nothing, but something faces one of them.".to_owned(),
        seen => format!("Emitters with something in sight: {seen} of {}.", census.emitters),
    };
    (true, reason)
}

fn shadows(world: &World) -> (bool, String) {
    let reached = polygons(world.census.reached);
    if world.has_occluders {
        return (
            true,
            format!("Something may stand between two of the {reached} that light reaches, or shut off others."),
        );
    }
    (false, format!("Nothing stands before the planes of the {reached} that light reaches."))
}

fn interreflection(census: &Census) -> (bool, String) {
    if census.diffuse == 0 {
        return (false, format!("The reflectance of all {} that light reaches is 0.", polygons(census.reached)));
    }
    let [low, high] = census.reflectance.map(channels);
    // Whatever lights a surface faces it, so that there is always a surface that it sends light to.
    let reason = format!(
        "{} of {} reflect diffusely, with a reflectance from {low} to {high}, at least back to where their light comes from.",
        census.diffuse,
        polygons(census.reached)
    );
    (true, reason)
}

fn colour(census: &Census) -> (bool, String) {
    let all = polygons(census.polygons);
    match census.coloured {
        0 => (false, format!("Red, green and blue are equal in the materials of all {all}.")),
        count => (true, format!("Red, green and blue differ in the materials of {count} of {all}.")),
    }
}

fn specular_reflection(census: &Census) -> (bool, String) {
    let reached = polygons(census.reached);
    if census.mirrors + census.glass == 0 {
        return (false, format!("None of {reached} that light reaches is a mirror or glass."));
    }
    (true, format!("Of {reached}, {} are mirrors and {} glass, which reflects too.", census.mirrors, census.glass))
}

fn gloss(census: &Census) -> (bool, String) {
    let reached = polygons(census.reached);
    match census.glossy {
        0 => (false, format!("None of {reached} that light reaches is glossy.")),
        count => (true, format!("{count} of {reached} are glossy.")),
    }
}

fn transmission(census: &Census) -> (bool, String) {
    let reached = polygons(census.reached);
    if census.glass + census.sheets == 0 {
        return (false, format!("All {reached} that light reaches are opaque."));
    }
    let of_glass = format!("{} are glass (√Tf at each boundary, so that a body counts Tf once)", census.glass);
    (true, format!("Of {reached}, {of_glass}, and {} let light straight through (Tf at each).", census.sheets))
}

fn caustics(census: &Census) -> (bool, String) {
    let Census { mirrors, glossy, glass, sheets, .. } = *census;
    let reached = polygons(census.reached);
    if mirrors + glossy + glass + sheets == 0 {
        return (false, format!("None of {reached} that light reaches is a mirror, glossy or clear."));
    }
    let specular = format!("{mirrors} mirrors, {glossy} glossy, {glass} of glass and {sheets} otherwise clear");
    if !census.light_may_meet_specular {
        (false, format!("No emitter faces a specular polygon ({specular})."))
    } else if census.diffuse == 0 {
        // The irradiance of a black surface is asked for all the same.
        let reason = "and none is diffuse: no picture shows what they gather, but it is part of the irradiance";
        (true, format!("Emitters may shine on specular polygons ({specular}), {reason}."))
    } else {
        (true, format!("Emitters may shine on specular polygons ({specular}), and {} are diffuse.", census.diffuse))
    }
}

fn escape(world: &World) -> (bool, String) {
    if world.is_closed() {
        return (false, "0 % of the bounces of light that explored the scene left it.".to_owned());
    }
    (true, format!("{:.3} % of the bounces of light that explored the scene left it.", 100.0 * world.escape_share))
}

fn ambient_light(census: &Census) -> (bool, String) {
    if census.light_may_arrive {
        return (false, format!("There is light by {}.", counted(census.emitters, "emitter", "emitters")));
    }
    (true, format!("Nothing else would light the scene: {}.", why_dark(census)))
}

fn polygons(count: usize) -> String {
    counted(count, "polygon", "polygons")
}

/// One number if it is the same in all channels.
fn channels(rgb: Rgb) -> String {
    if rgb == Rgb::splat(rgb.x) { format!("{}", rgb.x) } else { format!("({}, {}, {})", rgb.x, rgb.y, rgb.z) }
}
