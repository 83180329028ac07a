//! The error of a view against the reference: signed, without the noise, and as the two pictures themselves have it.

use super::{builtin, finished, home, scene, sources, with_photons, with_samples};
use glam::Vec3;
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::effects::{Effect, Effects, Switches};
use lightwell::math::rgb::luminance;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, Settings, Step};
use lightwell::solution::{CameraImage, CameraView, Comparison, Judged, PictureError};
use lightwell::worker::Run;
use lightwell::world::World;
use std::sync::Arc;

fn with_radiosity(sources: Sources, settings: &Settings) -> Sources {
    let world: Arc<World> = sources.transport.world.clone();
    let mut run = Run::start(world, settings).expect("a run");
    while matches!(run.step(&Cancel::default()), Step::Prepared | Step::Advanced) {}
    Sources { radiosity: Some(Arc::new(run.solution())), ..sources }
}

fn error_of(image: &CameraImage) -> PictureError {
    let Some(Comparison::Error(error)) = image.comparison else { panic!("no error") };
    error
}

#[test]
fn the_error_is_the_difference_of_the_two_pictures() {
    let world = builtin("cornell-box");
    let settings = Settings { unshot_limit: 0.01, ..with_samples(256) };
    let sources = with_radiosity(sources(&world), &settings);
    let (camera, size) = (home(&world), [48, 48]);
    let look = |view| finished(&sources, view, camera, size, &settings);
    let errors = look(CameraView::Error(Judged::RadiositySpecular));
    let error = error_of(&errors);
    // Pictures of their own, with other random numbers; of the emitter, which both show alike, there is no error.
    let other = Settings { seed: 9, ..settings };
    let truth = finished(&sources, CameraView::Reference, camera, size, &other);
    let light = look(CameraView::RadiositySpecular);
    let (mut expected, mut offset, mut count) = (0.0, 0.0, 0.0);
    for cell in 0..truth.radiance.len() {
        let [light, truth] = [&light, &truth].map(|image| f64::from(luminance(image.radiance[cell])));
        if truth < 5.0 {
            let difference = (light - truth) / error.mean;
            // Of a pixel beside the box, which shows nothing, there is no error.
            let found = errors.difference(cell).unwrap_or_default();
            expected += difference * found;
            offset += difference;
            count += 1.0;
        }
    }
    let (expected, offset) = ((expected / count).sqrt(), offset / count);
    println!("{error:?}, by two pictures {expected:.4} {offset:+.4}");
    // The product of two estimates with noise of their own has none on average. The other reference has half the paths.
    let noise = 2.0 * error.floor;
    assert!(noise < 0.3, "{error:?}");
    let tolerance = 4.0 * noise / count.sqrt();
    assert!((error.offset - offset).abs() < tolerance, "{error:?}, not {offset}");
    // A square's standard error is twice the number times that of what is squared, and that of the noise.
    let of_square = 4.0 * (2.0 * expected * noise + 1.5 * noise * noise) / count.sqrt();
    assert!((error.rms.powi(2) - expected.powi(2)).abs() < of_square, "{error:?}, not {expected}");
}

#[test]
fn direct_light_in_a_furnace_is_too_dark_by_what_its_walls_reflect() {
    let world = builtin("furnace");
    let material = &world.scene.materials[0];
    // All faces send out M/(1 − ρ), of which ρM/(1 − ρ) is reflected; direct light makes ρM of it.
    let all = luminance(material.diffuse * material.emission / (1.0 - material.diffuse));
    let expected = f64::from(luminance(material.diffuse * material.emission) / all - 1.0);
    let sources = sources(&world);
    let error = |judged, sources: &Sources, samples| {
        // Where walls meet, rays to emitters are noisy: many of them.
        let image = ImageSettings { samples, light_rays: 64, ..ImageSettings::default() };
        let settings = Settings { image, ..Settings::default() };
        error_of(&finished(sources, CameraView::Error(judged), home(&world), [32, 24], &settings))
    };
    let traced = error(Judged::RayTraced, &sources, 64);
    // How much the pixels differ, of which there are 768, tells how much their mean may be off.
    let noise = |error: &PictureError| {
        let variance = error.rms.powi(2) - error.offset.powi(2) + error.floor.powi(2);
        4.0 * (variance / 768.0).sqrt()
    };
    println!("{traced:?}, not {expected} ± {}", noise(&traced));
    assert!(noise(&traced) < 0.03 && (traced.offset - expected).abs() < noise(&traced), "{traced:?}, not {expected}");
    // Everywhere alike: the offset is all of the error, but for the noise of the light. That of the reference is taken out of the
    // squares, which may leave less than there is.
    let apart = traced.rms - traced.offset.abs();
    assert!((-3.0 * traced.uncertainty..0.01).contains(&apart), "{traced:?}");
    // All light is in what is gathered, to the noise of 200,000 photons and of the rays that read them.
    let gathered = error(Judged::FinalGather, &with_photons(sources, &with_samples(1)), 16);
    let noise = noise(&gathered) + 4.0 / 200_000_f64.sqrt();
    println!("{gathered:?}, noise {noise}");
    assert!(noise < 0.05 && gathered.offset.abs() < noise, "{gathered:?}, noise {noise}");
}

#[test]
fn an_effect_that_is_left_out_is_a_part_of_the_error() {
    let world = builtin("cornell-box");
    let error = |off: &[Effect]| {
        let effects = Switches { off: Effects::of(off), ..Switches::default() };
        let transport = Arc::new(Transport::new(world.clone(), effects));
        let sources = Sources { transport, radiosity: None, photons: None };
        let settings = Settings { effects, ..with_samples(64) };
        error_of(&finished(&sources, CameraView::Error(Judged::RayTraced), home(&world), [32, 32], &settings))
    };
    let (whole, shadowless) = (error(&[]), error(&[Effect::Shadows]));
    // The truth is the same: its mean over a thousand pixels, by different random numbers where paths go other ways.
    assert!((shadowless.mean / whole.mean - 1.0).abs() < 6.0 * whole.floor / 32.0, "{whole:?} {shadowless:?}");
    // Light that the blocks would keep away.
    assert!(shadowless.offset > whole.offset + 0.02, "{whole:?} {shadowless:?}");
}

#[test]
fn what_emits_is_no_error_and_without_light_there_is_none() {
    let lamp = "mtllib m.mtl\no lamp\nusemtl lamp\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf -4 -3 -2 -1\n";
    let world = scene(lamp, "newmtl lamp\nKd 0.5 0.5 0.5\nKe 7 7 7\n");
    let camera = super::camera(&world, Vec3::Y * 3.0, Vec3::ZERO, Vec3::Z, 30.0);
    let settings = with_samples(4);
    let sources = sources(&world);
    for &judged in
        Judged::ALL.iter().filter(|judged| !judged.view().needs_radiosity() && !judged.view().needs_photons())
    {
        let image = finished(&sources, CameraView::Error(judged), camera, [16, 12], &settings);
        // The lamp fills the middle and nothing reflects its light.
        assert!(image.coverage.contains(&1.0), "{judged:?}");
        let is_truth_dark = image.radiance.iter().all(|value| value.y == 0.0);
        assert!(is_truth_dark && image.comparison.is_none(), "{judged:?}");
    }
}

#[test]
fn errors_need_the_light_that_they_are_of() {
    let world = builtin("empty-box");
    let sources = sources(&world);
    let settings = Settings { image: ImageSettings { samples: 1, ..ImageSettings::default() }, ..Settings::default() };
    for &judged in Judged::ALL {
        let run = ImageRun::new(&sources, CameraView::Error(judged), home(&world), [8, 6], &settings);
        assert_eq!(run.is_none(), judged.view().needs_radiosity() || judged.view().needs_photons(), "{judged:?}");
    }
}
