//! Effects that a scene does not call for change nothing but the time: to the last bit, since none of them moves the random
//! numbers of the others.

use super::quads::Quads;
use super::{builtin, coarse, house, moonless_night, picture, settings, solved, traced};
use lightwell::choice::Choice;
use lightwell::effects::{Effect, Effects, Switches, needed};
use lightwell::methods::{FormFactorMethod, Settings, Solver};
use lightwell::scene::Scene;
use lightwell::solution::CameraView;
use lightwell::world::World;
use std::sync::Arc;

/// Scenes that differ in what they call for.
fn scenes() -> Vec<(&'static str, Scene)> {
    let quads = |quads: Quads| quads.scene();
    let mut scenes = vec![
        ("an empty grey room", quads(Quads::room("glow", "grey", "grey"))),
        ("an empty room with a red wall", quads(Quads::room("glow", "grey", "red"))),
        ("a room with a block", quads(Quads::room("glow", "grey", "grey").block("grey"))),
        ("a black room", quads(Quads::room("lamp", "black", "black"))),
        ("a lamp over a floor", quads(Quads::new().up("grey", 1.0, 0.0).down("lamp", 0.2, 1.0))),
        ("a room without a ceiling", quads(Quads::new().up("glow", 1.0, 0.0).around("grey", 1.0, [0.0, 1.0], true))),
        ("a room with a mirror", quads(Quads::room("glow", "grey", "mirror"))),
        ("a glossy room", quads(Quads::room("glow", "grey", "gloss"))),
        ("a block of glass", quads(Quads::room("glow", "grey", "grey").block("glass"))),
        ("a block of stained glass", quads(Quads::room("glow", "grey", "grey").block("stained"))),
        ("glass in a black room", quads(Quads::room("lamp", "black", "black").block("glass"))),
        ("a pane", quads(Quads::room("glow", "grey", "grey").up("pane", 0.3, 0.5))),
        ("a dark floor", quads(Quads::new().up("grey", 1.0, 0.0).around("mirror", 0.2, [0.1, 0.4], false))),
        ("a house in the dark", house()),
        ("a lamp that shines on nothing", moonless_night()),
    ];
    let names = ["furnace", "cornell-box", "two-rooms", "gallery", "cornell-spheres", "caustic-ring", "glossy-floor"];
    scenes.extend(names.map(|name| (name, builtin(name))));
    scenes
}

/// Runs a comparison in each scene, with the settings of the plan and those of all effects.
fn in_each_scene(compare: impl Fn(&str, &Arc<World>, &Settings, &Settings)) {
    let mut plans = Vec::new();
    for (name, scene) in scenes() {
        let world = coarse(scene);
        compare(name, &world, &settings(Switches::default()), &settings(Switches::ALL));
        plans.push(needed(&world));
    }
    plans.sort_by_key(|plan| plan.iter().map(|effect| 1 << effect as u32).sum::<u32>());
    plans.dedup();
    assert!(plans.len() >= 12, "only {} different plans", plans.len());
}

fn skipped(world: &World) -> Effects {
    Effects::ALL.but(needed(world))
}

#[test]
fn radiosity_is_the_same_and_skips_work() {
    in_each_scene(|name, world, planned, all| {
        let (planned, all) = (solved(world, planned, 40), solved(world, all, 40));
        assert_eq!(planned.light.irradiance, all.light.irradiance, "{name}");
        assert_eq!(planned.light.radiosity, all.light.radiosity, "{name}");
        assert_eq!((planned.energy, planned.steps), (all.energy, all.steps), "{name}");
        for effect in skipped(world).iter() {
            assert_eq!(planned.counters.bill.spent(effect), 0, "{name}: {}", effect.name());
        }
        // Whatever somebody was told of as saved is what all of them cost.
        for effect in [Effect::Shadows, Effect::Escape] {
            let (saved, spent) = (planned.counters.bill.saved(effect), all.counters.bill.spent(effect));
            let expected = if needed(world).contains(effect) { 0 } else { spent };
            assert_eq!(saved, expected, "{name}: {}", effect.name());
        }
        let (planned, all) = (planned.counters, all.counters);
        let more = |effect: Effect| all.bill.spent(effect) - planned.bill.spent(effect);
        let more = more(Effect::Shadows) + more(Effect::Escape);
        assert_eq!(planned.rays + more, all.rays, "{name}");
    });
}

#[test]
fn every_way_to_form_factors_and_every_solver_gives_the_same() {
    let rooms = [
        Quads::room("glow", "grey", "red"),
        Quads::room("glow", "grey", "grey"),
        Quads::room("lamp", "grey", "red").block("grey"),
    ];
    for room in rooms {
        let world = coarse(room.scene());
        for &form_factor in FormFactorMethod::ALL {
            for &solver in Solver::ALL {
                let with = |effects| {
                    let settings = Settings {
                        form_factor,
                        solver,
                        light_rays: 20_000,
                        hemicube_resolution: 32,
                        ..settings(effects)
                    };
                    solved(&world, &settings, 5)
                };
                let (planned, all) = (with(Switches::default()), with(Switches::ALL));
                assert_eq!(planned.light.irradiance, all.light.irradiance, "{} {}", form_factor.name(), solver.name());
            }
        }
    }
}

#[test]
fn photons_are_the_same_and_skip_work() {
    in_each_scene(|name, world, planned, all| {
        let (planned, all) = (traced(world, planned), traced(world, all));
        let (planned, all) = (planned.solution(), all.solution());
        assert_eq!(planned.photons, all.photons, "{name}");
        let has_caustics = needed(world).contains(Effect::Caustics);
        let emitted = |are_emitted: bool| if are_emitted { 4_000 } else { 0 };
        assert_eq!(planned.counters.caustic_emitted, emitted(has_caustics), "{name}");
        assert_eq!(all.counters.caustic_emitted, emitted(world.scene.has_emitter()), "{name}");
        assert_eq!(all.counters.caustic_stored, planned.counters.caustic_stored, "{name}");
        for effect in skipped(world).iter() {
            assert_eq!(planned.counters.bill.spent(effect), 0, "{name}: {}", effect.name());
        }
        let more = all.counters.bill.spent(Effect::Caustics) - planned.counters.bill.spent(Effect::Caustics);
        assert_eq!(planned.counters.rays + more, all.counters.rays, "{name}");
    });
}

#[test]
fn pictures_are_the_same_and_skip_work() {
    in_each_scene(|name, world, planned, all| {
        for view in CameraView::ALL.iter().copied() {
            let (planned, all) = (picture(world, view, planned), picture(world, view, all));
            assert_eq!(planned.radiance, all.radiance, "{name}: {}", view.name());
            // What ambient light there is, a view of it was asked for.
            for effect in skipped(world).but(Effects::of(&[Effect::AmbientLight])).iter() {
                assert_eq!(planned.bill.spent(effect), 0, "{name}: {}: {}", view.name(), effect.name());
            }
            let more = |effect: &Effect| all.bill.spent(*effect) - planned.bill.spent(*effect);
            let more: u64 = Effect::ALL.iter().map(more).sum();
            assert_eq!(planned.rays + more, all.rays, "{name}: {}", view.name());
        }
    });
}
