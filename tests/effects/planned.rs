//! Which effects of light scenes call for, and why.

use super::quads::Quads;
use super::{builtin, house, moonless_night, seen_from, world};
use Effect::{
    AmbientLight, Caustics, Colour, DirectLight, Escape, Gloss, Interreflection, Shadows, SpecularReflection,
    Transmission,
};
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::effects::{Approach, Effect, Effects, Plan, plan};
use lightwell::mesh::MeshSettings;
use lightwell::scene::{BUILTINS, Scene};
use lightwell::world::with_ceiling_light;
use std::sync::Arc;

fn plan_of(scene: Scene) -> Plan {
    plan(&world(scene))
}

/// Asserts that exactly these effects are needed, and that each of all ten is judged once and in one sentence.
fn assert_needed(what: &str, plan: &Plan, expected: &[Effect]) {
    let judged: Vec<Effect> = plan.verdicts.iter().map(|verdict| verdict.effect).collect();
    assert_eq!(judged, Effect::ALL, "{what}");
    for verdict in &plan.verdicts {
        let is_expected = expected.contains(&verdict.effect);
        assert_eq!(verdict.is_needed, is_expected, "{what}: {}: {}", verdict.effect.name(), verdict.reason);
        for text in [&*verdict.reason, verdict.saves, verdict.if_missed] {
            assert!(text.ends_with('.') && !text.contains(". "), "{what}: {text}");
        }
    }
    assert_eq!(plan.needed(), expected.iter().copied().collect::<Effects>(), "{what}");
}

#[test]
fn built_in_scenes_call_for_what_is_in_them() {
    let room = [DirectLight, Shadows, Interreflection, Colour];
    let cornell = [DirectLight, Shadows, Interreflection, Colour, Escape];
    let with = |more: &[Effect]| [&room[..], more].concat();
    for (name, expected) in [
        ("furnace", vec![DirectLight, Interreflection]),
        ("empty-box", cornell.to_vec()),
        ("cornell-box", cornell.to_vec()),
        ("two-rooms", room.to_vec()),
        ("gallery", room.to_vec()),
        ("cornell-spheres", with(&[SpecularReflection, Transmission, Caustics, Escape])),
        ("caustic-ring", with(&[SpecularReflection, Caustics, Escape])),
        ("glass-block", with(&[SpecularReflection, Transmission, Caustics, Escape])),
        ("glossy-floor", with(&[Gloss, Caustics])),
        ("ao-study", vec![Colour, Escape, AmbientLight]),
        ("machine-hall", vec![Colour, AmbientLight]),
    ] {
        assert_needed(name, &plan_of(builtin(name)), &expected);
    }
}

#[test]
fn an_empty_room_needs_no_shadows_and_a_grey_one_no_colour() {
    let bare = [DirectLight, Interreflection];
    for (what, quads, more) in [
        ("grey", Quads::room("glow", "grey", "grey"), &[][..]),
        ("a red wall", Quads::room("glow", "grey", "red"), &[Colour]),
        ("a yellow wall", Quads::room("glow", "grey", "yellow"), &[Colour]),
        ("a warm lamp", Quads::room("warm", "grey", "grey"), &[Colour]),
        ("a block", Quads::room("glow", "grey", "grey").block("grey"), &[Shadows]),
        ("red behind a wall", Quads::room("glow", "grey", "grey").down("red", 0.5, -0.5), &[Colour]),
        ("a hole", Quads::new().up("glow", 1.0, 0.0).around("grey", 1.0, [0.0, 1.0], true), &[Escape]),
    ] {
        assert_needed(what, &plan_of(quads.scene()), &[&bare, more].concat());
    }
}

#[test]
fn light_that_nothing_reflects_ends_where_it_arrives() {
    let black = Quads::room("lamp", "black", "black");
    assert_needed("a black room", &plan_of(black.scene()), &[DirectLight]);
    let floor = Quads::new().up("black", 1.0, 0.0).down("lamp", 0.2, 1.0);
    assert_needed("a lamp over a black floor", &plan_of(floor.scene()), &[DirectLight, Escape]);
    let lit = Quads::new().up("grey", 1.0, 0.0).down("lamp", 0.2, 1.0);
    assert_needed(
        "the lamp receives what the floor reflects",
        &plan_of(lit.scene()),
        &[DirectLight, Interreflection, Escape],
    );
}

#[test]
fn each_specular_surface_calls_for_its_own_effects() {
    let bare = [DirectLight, Interreflection];
    for (what, quads, more) in [
        ("mirror", Quads::room("glow", "grey", "mirror"), &[SpecularReflection, Caustics][..]),
        ("gloss", Quads::room("glow", "grey", "gloss"), &[Gloss, Caustics]),
        (
            "glass",
            Quads::room("glow", "grey", "grey").block("glass"),
            &[Shadows, SpecularReflection, Transmission, Caustics],
        ),
        (
            "stained glass",
            Quads::room("glow", "grey", "grey").block("stained"),
            &[Shadows, Colour, SpecularReflection, Transmission, Caustics],
        ),
        ("a pane", Quads::room("glow", "grey", "grey").up("pane", 0.3, 0.5), &[Shadows, Transmission, Caustics]),
    ] {
        assert_needed(what, &plan_of(quads.scene()), &[&bare, more].concat());
    }
}

#[test]
fn caustics_take_an_emitter_before_them() {
    // What glass gathers on black walls no picture shows, but it is part of their irradiance.
    let glass = [DirectLight, Shadows, SpecularReflection, Transmission, Caustics];
    let black = Quads::room("lamp", "black", "black").block("glass");
    assert_needed("glass in a black room", &plan_of(black.scene()), &glass);
    // The lamp shines down and the mirror hangs above it, so that it reflects the floor's light alone.
    let behind = |mirror: f32| {
        let quads = Quads::new().up("grey", 1.0, 0.0).down("lamp", 0.2, 0.5).down("mirror", 1.0, mirror);
        plan_of(quads.scene())
    };
    let above = [DirectLight, Shadows, Interreflection, SpecularReflection, Escape];
    assert_needed("a mirror behind the lamp", &behind(1.0), &above);
    // Below a block the mirror is before the lamp, but shows it its back, which is inside.
    let below = Quads::new().up("grey", 1.0, 0.0).down("lamp", 0.2, 1.0);
    let below = below.up("black", 0.4, 0.6).around("black", 0.4, [0.5, 0.6], false).down("mirror", 0.4, 0.5);
    assert_needed("a mirror that faces away from the lamp", &plan_of(below.scene()), &above);
}

#[test]
fn a_dark_scene_needs_ambient_light_and_of_the_others_none_that_carries_light() {
    let floor = Quads::new().up("grey", 1.0, 0.0).around("mirror", 0.2, [0.1, 0.4], false);
    let dark = plan_of(floor.scene());
    assert_needed("a floor without an emitter", &dark, &[Escape, AmbientLight]);
    assert_eq!(dark.advice.approach, Approach::AmbientOcclusion);
    let room = seen_from([0.0, 0.5, 0.9], [0.0, 0.5, 0.0], Quads::room("grey", "red", "grey").scene());
    assert_needed("a room without an emitter", &plan_of(room.clone()), &[Colour, AmbientLight]);
    let lit = plan_of(with_ceiling_light(&room));
    assert_needed("a room with a ceiling light", &lit, &[DirectLight, Shadows, Interreflection, Colour]);
    let hidden = plan_of(Quads::room("black", "black", "black").up("lamp", 0.2, 1.01).scene());
    assert_needed("a lamp on the roof", &hidden, &[Escape, AmbientLight]);
    assert_eq!(hidden.parts, ["1 of 1 emitters light nothing that random rays find."]);
    assert_needed("a lamp that shines on nothing", &plan_of(moonless_night()), &[Colour, Escape, AmbientLight]);
}

#[test]
fn a_lamp_that_shines_on_nothing_is_no_reason_not_to_look_at_the_rest() {
    let world = world(moonless_night());
    assert!(!world.census.light_may_arrive && world.census.unreached() == 0, "{:?}", world.census);
}

#[test]
fn what_a_lamp_faces_and_does_not_reach_needs_shadows() {
    let needed = [DirectLight, Shadows, Interreflection, Colour];
    assert_needed("a house in the dark", &plan_of(house()), &needed);
}

#[test]
fn a_lamp_too_small_for_random_rays_still_lights_the_floor() {
    let plan = plan_of(Quads::new().up("black", 1.0, 0.0).down("lamp", 0.01, 1000.0).scene());
    assert_needed("a lamp far above a floor", &plan, &[DirectLight, Escape]);
    assert_eq!(plan.parts, ["1 of 1 emitters light nothing that random rays find."]);
}

#[test]
fn reasons_give_the_figures() {
    let plan = plan_of(Quads::room("lamp", "red", "red").block("glass").scene());
    let reason = |effect: Effect| {
        let verdict = plan.verdicts.iter().find(|verdict| verdict.effect == effect).expect("all effects are judged");
        verdict.reason.as_str()
    };
    for (effect, expected) in [
        (DirectLight, "Emitters with something in sight: 1 of 1."),
        (Shadows, "Something may stand between two of the 12 polygons that light reaches, or shut off others."),
        (
            Interreflection,
            "5 of 12 polygons reflect diffusely, with a reflectance from 0 to (0.5, 0.25, 0.25), at least back to where their light comes from.",
        ),
        (Colour, "Red, green and blue differ in the materials of 5 of 12 polygons."),
        (SpecularReflection, "Of 12 polygons, 0 are mirrors and 6 glass, which reflects too."),
        (Gloss, "None of 12 polygons that light reaches is glossy."),
        (
            Transmission,
            "Of 12 polygons, 6 are glass (√Tf at each boundary, so that a body counts Tf once), and 0 let light straight \
             through (Tf at each).",
        ),
        (
            Caustics,
            "Emitters may shine on specular polygons (0 mirrors, 0 glossy, 6 of glass and 0 otherwise clear), and 5 are \
             diffuse.",
        ),
        (Escape, "0 % of the bounces of light that explored the scene left it."),
        (AmbientLight, "There is light by 1 emitter."),
    ] {
        assert_eq!(reason(effect), expected);
    }
}

#[test]
fn the_method_follows_from_the_effects() {
    for (name, approach) in [
        ("furnace", Approach::Radiosity),
        ("cornell-box", Approach::Radiosity),
        ("glossy-floor", Approach::CausticMap),
        ("caustic-ring", Approach::CausticMap),
        ("ao-study", Approach::AmbientOcclusion),
        ("machine-hall", Approach::AmbientOcclusion),
    ] {
        assert_eq!(plan_of(builtin(name)).advice.approach, approach, "{name}");
    }
    let mirror = Quads::new().up("grey", 1.0, 0.0).down("lamp", 0.2, 0.5).down("mirror", 1.0, 1.0);
    assert_eq!(plan_of(mirror.scene()).advice.approach, Approach::RadiosityAndRays);
}

#[test]
fn a_world_cut_differently_has_the_same_plan() {
    let world = world(builtin("cornell-spheres"));
    let settings = MeshSettings { elements_per_patch_edge: 1, ..MeshSettings::default() };
    let remeshed = world.remeshed(&settings, &Cancel::default()).expect("a world");
    assert_eq!(plan(&remeshed), plan(&world));
}

/// It costs next to nothing, since it looks at no polygon.
#[test]
fn a_plan_is_made_by_what_was_counted_before() {
    for builtin in BUILTINS {
        let mut world = world(Scene::open(builtin.name).expect("a built-in scene"));
        let expected = plan(&world);
        let scene = Scene::clone(&world.scene);
        world.scene = Arc::new(Scene { positions: vec![], polygons: vec![], materials: vec![], ..scene });
        world.mesh.patches.clear();
        world.mesh.elements.clear();
        assert_eq!(plan(&world), expected, "{}", builtin.name);
    }
}
