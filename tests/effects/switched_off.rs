//! What is missing where an effect is switched off that a scene calls for: that effect, and nothing else.

use super::quads::Quads;
use super::{builtin, coarse, picture, settings, solved, traced, without};
use lightwell::effects::{Bill, Effect, Effects, Switches, needed};
use lightwell::math::rgb::{Rgb, total};
use lightwell::methods::{ImageSettings, Settings, Solver};
use lightwell::solution::{CameraImage, CameraView};
use lightwell::worker::Subject;
use lightwell::world::World;
use std::sync::Arc;

#[test]
fn direct_light_and_interreflection_add_up_to_all_light() {
    let world = coarse(Quads::room("lamp", "grey", "red").block("grey").scene());
    for solver in [Solver::Jacobi, Solver::GaussSeidel, Solver::Southwell, Solver::Progressive] {
        let light = |effects| {
            let settings = Settings { solver, unshot_limit: 1e-6, ..settings(effects) };
            solved(&world, &settings, 100_000).light.irradiance
        };
        let all = light(Switches::default());
        let (direct, indirect) = (light(without(Effect::Interreflection)), light(without(Effect::DirectLight)));
        let largest = all.iter().map(|e| e.max_element()).fold(0.0, f32::max);
        let mut sums = [Rgb::ZERO; 3];
        for ((all, direct), indirect) in all.iter().zip(&direct).zip(&indirect) {
            // Where the same visibility rays fall elsewhere, a share of 1 in 64 of them at most is another.
            let is_exact = solver != Solver::Progressive;
            let tolerance = if is_exact { 1e-5 } else { 0.1 };
            assert!((*direct + *indirect - *all).abs().max_element() <= tolerance * largest, "{solver:?}");
            for (sum, light) in sums.iter_mut().zip([all, direct, indirect]) {
                *sum += *light;
            }
        }
        let [all, direct, indirect] = sums;
        assert!((direct + indirect - all).abs().max_element() < 5e-3 * all.max_element(), "{solver:?}: {sums:?}");
        assert!(direct.min_element() > 0.0 && indirect.min_element() > 0.0);
    }
}

#[test]
fn without_shadows_a_block_is_not_in_the_way_of_the_lamp() {
    let floor = |quads: Quads, off: &[Effect]| {
        let world = coarse(quads.scene());
        let effects = Switches { off: Effects::of(off), ..Switches::default() };
        let solution = solved(&world, &settings(effects), 100);
        let is_floor = |i: &usize| world.mesh.elements[*i].center.y == 0.0;
        let light = (0..solution.light.irradiance.len()).filter(is_floor).map(|i| solution.light.irradiance[i].x);
        (light.collect::<Vec<_>>(), solution.closure.worst)
    };
    let room = || Quads::room("grey", "lamp", "grey");
    let least = |floor: &[f32], of: &[f32]| floor.iter().zip(of).map(|(e, of)| e / of).fold(1.0, f32::min);
    let (empty, _) = floor(room(), &[Effect::Interreflection]);
    let (shadowed, _) = floor(room().block("grey"), &[Effect::Interreflection]);
    let (lit, closure) = floor(room().block("grey"), &[Effect::Interreflection, Effect::Shadows]);
    assert!(least(&shadowed, &empty) < 0.6, "the block hides much of the ceiling");
    // What falls on the block falls on the floor behind it, too: so much more light is shared out than there is.
    let lit = least(&lit, &empty);
    assert!(lit > 0.75 && f64::from(lit) >= 1.0 / (1.0 + closure) - 1e-6, "{lit} with a closure of {closure}");
}

#[test]
fn without_colour_all_is_grey() {
    let is_grey = |rgb: &Rgb| *rgb == Rgb::splat(rgb.x);
    let world = coarse(builtin("cornell-box"));
    let light = |effects| solved(&world, &settings(effects), 30).light.irradiance;
    let (coloured, grey) = (light(Switches::default()), light(without(Effect::Colour)));
    assert!(!coloured.iter().all(is_grey) && grey.iter().all(is_grey));
    for view in [
        CameraView::RayTraced,
        CameraView::PhotonRadiance,
        CameraView::FinalGather,
        CameraView::DiffuseAmbient,
        CameraView::RadiosityDirect,
        CameraView::Reference,
    ] {
        let (coloured, grey) = (
            picture(&world, view, &settings(Switches::default())),
            picture(&world, view, &settings(without(Effect::Colour))),
        );
        assert!(!coloured.radiance.iter().all(is_grey) && grey.radiance.iter().all(is_grey), "{view:?}");
        assert!(grey.radiance.iter().any(|rgb| rgb.x > 0.0), "{view:?}");
    }
}

#[test]
fn without_escape_light_that_leaves_the_box_is_shared_out_in_it() {
    let world = coarse(builtin("cornell-box"));
    let energy = |effects| solved(&world, &settings(effects), 200).energy;
    let (open, shut) = (energy(Switches::default()), energy(without(Effect::Escape)));
    assert!(total(open.escaped) > 0.0 && total(shut.escaped) == 0.0);
    assert!(total(shut.absorbed) > total(open.absorbed));
    for energy in [open, shut] {
        // Some 200 sums, each rounded by 1e-16.
        assert!(total(energy.defect()).abs() < 1e-12 * total(energy.emitted));
    }
}

#[test]
fn without_interreflection_photons_end_where_they_land_first() {
    let world = coarse(builtin("cornell-box"));
    let mapping = traced(&world, &settings(without(Effect::Interreflection)));
    let solution = mapping.solution();
    assert!(solution.counters.by_bounce.len() == 1 && !solution.photons.is_empty());
    assert!(solution.counters.bill.saved(Effect::Interreflection) > 0);
    assert!(total(solution.energy.defect()).abs() < 1e-6 * total(solution.energy.emitted));
    let picture = picture(&world, CameraView::FinalGather, &settings(without(Effect::Interreflection)));
    assert_eq!(picture.bill.spent(Effect::Interreflection), 0);
    assert!(picture.bill.saved(Effect::Interreflection) > 0);
}

/// Mean of red in a picture, and what that took.
fn mean(world: &Arc<World>, view: CameraView, effects: Switches) -> (f32, Bill) {
    let picture = picture(world, view, &settings(effects));
    (picture.radiance.iter().map(|rgb| rgb.x).sum::<f32>() / picture.radiance.len() as f32, picture.bill)
}

#[test]
fn without_a_specular_effect_its_surfaces_are_darker_and_its_rays_are_not_traced() {
    for (effect, material) in [
        (Effect::SpecularReflection, "mirror"),
        (Effect::SpecularReflection, "glass"),
        (Effect::Transmission, "glass"),
        (Effect::Transmission, "pane"),
        (Effect::Gloss, "gloss"),
    ] {
        let world = coarse(Quads::room("grey", "glow", "grey").block(material).scene());
        assert!(needed(&world).contains(effect), "{material}");
        for view in
            [CameraView::RayTraced, CameraView::FinalGather, CameraView::RadiositySpecular, CameraView::Reference]
        {
            let ((lit, with), (dark, out)) =
                (mean(&world, view, Switches::default()), mean(&world, view, without(effect)));
            assert!(dark < lit, "{material}, {view:?}: {dark} after {lit}");
            assert!(with.spent(effect) > 0 && with.saved(effect) == 0, "{material}, {view:?}");
            assert!(out.spent(effect) == 0 && out.saved(effect) > 0, "{material}, {view:?}");
        }
        let photons = traced(&world, &settings(without(effect))).solution();
        assert_eq!(photons.counters.bill.spent(effect), 0, "{material}");
        assert!(photons.counters.bill.saved(effect) > 0, "{material}");
    }
}

#[test]
fn without_caustics_no_photon_of_them_is_kept() {
    let world = coarse(builtin("caustic-ring"));
    let caustic = |effects| {
        let solution = traced(&world, &settings(effects)).solution();
        let kept = solution.photons.iter().filter(|photon| photon.path.is_caustic()).count();
        (kept, solution.counters.caustic_emitted, solution.counters.bill.saved(Effect::Caustics))
    };
    let (with, out) = (caustic(Switches::default()), caustic(without(Effect::Caustics)));
    assert!(with.0 > 0 && with.1 == 4_000 && with.2 == 0, "{with:?}");
    assert_eq!(out, (0, 0, 4_000));
}

#[test]
fn without_direct_light_photons_show_what_came_by_way_of_surfaces() {
    let world = coarse(builtin("cornell-box"));
    for view in
        [CameraView::PhotonRadiance, CameraView::RayTraced, CameraView::FinalGather, CameraView::RadiosityDirect]
    {
        let ((all, _), (indirect, _)) =
            (mean(&world, view, Switches::default()), mean(&world, view, without(Effect::DirectLight)));
        assert!(indirect < all, "{view:?}: {indirect} of {all}");
    }
    // Nothing but the lamp itself is left of it, since rays to lamps find direct light alone.
    let lamp = picture(&world, CameraView::RayTraced, &settings(without(Effect::DirectLight)));
    let (lit, emission) = (lamp.radiance.iter().filter(|rgb| **rgb != Rgb::ZERO), world.scene.materials.iter());
    let emission: Vec<Rgb> = emission.map(|material| material.emission).filter(|rgb| *rgb != Rgb::ZERO).collect();
    for radiance in lit {
        let share = *radiance / emission[0];
        assert!(
            share.x <= 1.0 && (share - share.x).abs().max_element() < 1e-5,
            "{radiance} is no part of {emission:?}"
        );
    }
}

/// 64 samples a pixel: single pixels are off by some 4 %, so that the mean of all 432 is off by 0.2 %, and the difference of
/// two such means by more than 1 % next to never.
fn fine(effects: Switches) -> Settings {
    let settings = settings(effects);
    Settings { image: ImageSettings { samples: 64, ..settings.image }, ..settings }
}

fn mean_radiance(image: &CameraImage) -> Rgb {
    image.radiance.iter().sum::<Rgb>() / image.radiance.len() as f32
}

fn assert_near(one: Rgb, other: Rgb) {
    assert!((one / other - 1.0).abs().max_element() < 0.01, "{one} {other}");
}

#[test]
fn a_reference_is_the_sum_of_its_effects() {
    let world = coarse(builtin("cornell-box"));
    let look = |view, switches| picture(&world, view, &fine(switches));
    let all = look(CameraView::Reference, Switches::default());
    let direct = look(CameraView::Reference, without(Effect::Interreflection));
    let indirect = look(CameraView::Reference, without(Effect::DirectLight));
    // Both show the lamp itself.
    let lamp = look(CameraView::RayTraced, without(Effect::DirectLight));
    assert_near(mean_radiance(&all), mean_radiance(&direct) + mean_radiance(&indirect) - mean_radiance(&lamp));
    assert_near(mean_radiance(&direct), mean_radiance(&look(CameraView::RayTraced, Switches::default())));
    assert!(direct.bill.spent(Effect::Interreflection) == 0 && direct.bill.saved(Effect::Interreflection) > 0);
}

#[test]
fn without_shadows_paths_show_what_ray_tracing_shows() {
    let world = coarse(builtin("cornell-box"));
    let off = Switches { off: Effects::of(&[Effect::Shadows, Effect::Interreflection]), ..Switches::default() };
    let [paths, traced] = [CameraView::Reference, CameraView::RayTraced].map(|view| picture(&world, view, &fine(off)));
    assert_near(mean_radiance(&paths), mean_radiance(&traced));
    assert!(paths.bill.spent(Effect::Shadows) == 0 && paths.bill.saved(Effect::Shadows) > 0);
    let shadowed = picture(&world, CameraView::RayTraced, &fine(Switches::default()));
    // Most of what is seen is the lamp itself, and yet shadows are three times what means may differ by.
    let (lit, dark) = (mean_radiance(&traced).x, mean_radiance(&shadowed).x);
    assert!(lit > 1.03 * dark, "{lit} {dark}");
}

#[test]
fn without_caustics_paths_bring_none() {
    let world = coarse(builtin("caustic-ring"));
    let filter = "LS+DE".parse().expect("a pattern");
    let caustics = |switches| {
        let settings = fine(switches);
        let image = ImageSettings { filter, ..settings.image };
        mean_radiance(&picture(&world, CameraView::Reference, &Settings { image, ..settings })).x
    };
    assert!(caustics(Switches::default()) > 0.0 && caustics(without(Effect::Caustics)) == 0.0);
}

#[test]
fn without_ambient_light_a_dark_scene_is_black() {
    let world = coarse(Quads::new().up("grey", 1.0, 0.0).around("grey", 0.2, [0.1, 0.4], false).scene());
    for view in [CameraView::Diffuse, CameraView::DiffuseAmbient] {
        let ((lit, _), (dark, bill)) =
            (mean(&world, view, Switches::default()), mean(&world, view, without(Effect::AmbientLight)));
        assert!(lit > 0.0 && dark == 0.0, "{view:?}: {lit}, {dark}");
        assert_eq!(bill.spent(Effect::AmbientLight), 0, "{view:?}");
    }
}

#[test]
fn a_view_calls_for_what_it_is_there_to_show() {
    let world = coarse(builtin("cornell-box"));
    let view = CameraView::DiffuseAmbient;
    let subject = Subject::Camera(view);
    let shown = picture(&world, view, &settings(Switches::default()));
    for (effects, is_simulated) in [(Switches::default(), true), (without(Effect::AmbientLight), false)] {
        let settings = settings(effects);
        let bill = picture(&world, view, &settings).bill;
        let entries = subject.account(&world, &settings, &bill);
        let entry = entries.iter().find(|entry| entry.effect == Effect::AmbientLight).expect("it can be left out");
        let became = (entry.is_simulated, entry.spent > 0, entry.saved > 0);
        assert_eq!(became, (is_simulated, is_simulated, !is_simulated));
    }
    let needed = subject.needed(&world);
    let off = Switches::default().with(Effect::AmbientLight, false, needed);
    assert_eq!(off, without(Effect::AmbientLight));
    assert_eq!(off.with(Effect::AmbientLight, true, needed), Switches::default());
    // How bright ambient light is does not depend on what radiosity leaves out.
    assert_eq!(picture(&world, view, &settings(without(Effect::Escape))).radiance, shown.radiance);
}
