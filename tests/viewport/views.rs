//! What each view shows: every pixel against the numbers that it stands for.

use crate::{
    HALF_ROUNDING, SNAP, build, build_in_patches, element_at, frame, gpu, light, motley, on_plane, pixel, pixels,
    plane_scene, solution, square,
};
use glam::Vec3;
use lightwell::choice::Choice;
use lightwell::math::rgb::Rgb;
use lightwell::solution::{ItemBuffer, Picked, Solution, VertexShares};
use lightwell::viewport::{Frame, Legend, Light, Picture, ToneCurve, View, colour_map, render_picture};
use lightwell::world::World;
use std::f32::consts::PI;
use std::sync::Arc;

/// Every pixel that lies inside of an element against the value that this element should have.
fn assert_shows(picture: &Picture, world: &World, expected: impl Fn(usize) -> Rgb) {
    let mut checked = 0;
    for (x, y) in pixels() {
        let Some(element) = element_at(world, x, y) else { continue };
        let (found, expected) = (pixel(picture, x, y), expected(element));
        for channel in 0..3 {
            let error = (found[channel] - expected[channel]).abs();
            assert!(error <= HALF_ROUNDING * expected[channel], "{x} {y}: {found:?}, not {expected}");
        }
        checked += 1;
    }
    assert!(checked > 1500, "{checked} pixels");
}

/// A patch that sends a quarter, a 400th and a 40,000,000th of its light to three others, and none to the rest.
fn picked(world: &World, patch: u32) -> Picked {
    let mut form_factors = vec![0.0; world.mesh.patches.len()];
    let others = (0..form_factors.len()).filter(|&other| other != patch as usize);
    for (other, form_factor) in others.zip([0.25, 0.0025, 2.5e-8]) {
        form_factors[other] = form_factor;
    }
    let item_buffer = Arc::new(ItemBuffer { resolution: 2, faces: Default::default() });
    Picked { patch, form_factors, escaping: 0.0, item_buffer }
}

/// A square whose every element is a patch, so that there are many.
fn tiles() -> Arc<World> {
    build_in_patches(plane_scene(&[0, 1, 2, 3], 1.0, Vec3::ZERO), 0.5, 1)
}

/// A square that reflects another share of each channel, and never half.
fn tinted() -> Arc<World> {
    let mut scene = plane_scene(&[0, 1, 2, 3], 1.0, Vec3::ZERO);
    scene.materials[0].diffuse = Rgb::new(0.2, 0.3, 0.9);
    build(scene, 0.5)
}

#[test]
fn absorbed_light_is_what_is_not_reflected() {
    let Some(gpu) = gpu() else { return };
    let world = tinted();
    let solution = solution(&world, motley);
    let picture =
        render_picture(&gpu, &world, &light(&solution), &frame(&world, View::Absorbed), 4).expect("a picture");
    let reflectance = world.scene.materials[0].diffuse;
    assert_shows(&picture, &world, |element| (1.0 - reflectance) * solution.light.irradiance[element] / PI);
}

#[test]
fn the_ambient_term_is_reflected_and_added_to_patches_and_smooth_light_alone() {
    let Some(gpu) = gpu() else { return };
    let world = tinted();
    let even = |_| Rgb::new(1.0, 2.0, 3.0);
    let solution = Solution { ambient: Rgb::new(4.0, 2.0, 1.0), ..solution(&world, even) };
    let reflectance = world.scene.materials[0].diffuse;
    for &view in View::ALL {
        let render = |ambient| {
            let frame = Frame { ambient, ..frame(&world, view) };
            render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("a picture")
        };
        if matches!(view, View::Patches | View::Smooth) {
            assert_shows(&render(true), &world, |e| {
                (solution.light.radiosity[e] + reflectance * solution.ambient) / PI
            });
        } else {
            assert!(render(true) == render(false), "{view:?}");
        }
    }
}

#[test]
fn bounces_are_shown_one_by_one_and_the_last_one_beyond_it() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let after = |bounce: usize| Rgb::new(1.0, 2.0, 3.0) * (bounce + 1) as f32;
    let bounces = (0..3).map(|bounce| Arc::new(vec![after(bounce); world.mesh.elements.len()])).collect();
    let solution = Solution { bounces, ..solution(&world, motley) };
    for (bounce, shown) in [(0, 0), (1, 1), (2, 2), (7, 2)] {
        let frame = Frame { bounce, ..frame(&world, View::Bounces) };
        let picture = render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("a picture");
        assert_shows(&picture, &world, |_| after(shown) / PI);
    }
}

#[test]
fn form_factors_have_the_colours_of_their_legend_whatever_the_exposure() {
    let Some(gpu) = gpu() else { return };
    let world = tiles();
    let picked = picked(&world, 3);
    let light = Light { picked: Some(Arc::new(picked.clone())), ..solution(&world, motley).into() };
    let legend = Legend::of(View::FormFactors, &light).expect("there are form factors");
    assert_eq!((legend.low, legend.high), (0.25 * 1e-4, 0.25));
    let frame = frame(&world, View::FormFactors);
    let picture = render_picture(&gpu, &world, &light, &frame, 4).expect("a picture");
    // All patches lie in one plane, so what is plain is of one grey.
    let plain = pixels().find_map(|(x, y)| {
        let patch = world.mesh.elements[element_at(&world, x, y)?].patch as usize;
        (picked.form_factors[patch] == 0.0).then(|| Rgb::from_slice(&pixel(&picture, x, y)[..3]))
    });
    let plain = plain.expect("a patch that gets nothing");
    assert!(plain.x == plain.y && plain.y == plain.z);
    assert_shows(&picture, &world, |element| match picked.form_factors[world.mesh.elements[element].patch as usize] {
        0.0 => plain,
        form_factor => legend.colour(form_factor),
    });
    // Two decades below the largest is half-way down the scale, and what is below the scale has its lowest colour.
    assert!((legend.share(0.0025) - 0.5).abs() < 1e-6);
    assert_eq!(legend.colour(2.5e-8), colour_map::colour(0.0));

    let other = Frame { exposure_ev: 5.0, tone: ToneCurve::Linear, ..frame };
    assert!(render_picture(&gpu, &world, &light, &other, 4).expect("a picture") == picture);
}

#[test]
fn shares_of_vertices_are_greys_between_them_whatever_the_exposure() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    // Linear over the whole square, so that it is known between vertices, too.
    let share = |x: f32, y: f32| 0.5 + 0.2 * x + 0.1 * y;
    let shares = world.mesh.vertices.iter().map(|vertex| share(vertex.x, vertex.y)).collect();
    let occlusion = Some(Arc::new(VertexShares { shares: Arc::new(shares), rounds: 1, ..VertexShares::default() }));
    let light = Light { occlusion, ..light(&solution(&world, motley)) };
    let view = View::OcclusionVertices;
    assert!(view.missing(&light).is_none() && view.missing(&Light::default()).is_some() && view.is_false_colour());
    let render = |exposure_ev| {
        let frame = Frame { exposure_ev, show_shooter: true, ..frame(&world, view) };
        render_picture(&gpu, &world, &light, &frame, 4).expect("a picture")
    };
    let picture = render(0.0);
    assert!(picture == render(5.0));
    let shown: Vec<_> = pixels().filter(|&(x, y)| element_at(&world, x, y).is_some()).collect();
    assert!(shown.len() > 1500);
    for (x, y) in shown {
        let [r, g, b, _] = pixel(&picture, x, y);
        // The middle of a pixel is where its four samples are on average, and edges may be rounded by some of a pixel.
        let (at, size) = on_plane(x, y);
        let tolerance = HALF_ROUNDING + 0.3 * SNAP * size;
        assert!(r == g && g == b && (r - share(at.x, at.y)).abs() < tolerance, "{at}: {r}");
    }
}

#[test]
fn the_picked_patch_is_outlined_and_the_shooter_is_not() {
    let Some(gpu) = gpu() else { return };
    let world = tiles();
    let is_front = |index: &u32| world.mesh.patches[*index as usize].normal.z > 0.0;
    let [first, second] = [0, 1].map(|n| (0..).filter(is_front).nth(n).expect("a patch in front"));
    let render = |patch: u32, shooter: u32| {
        let solution = Solution { shooter: Some(shooter), ..solution(&world, motley) };
        let mut picked = picked(&world, patch);
        picked.form_factors.fill(0.0);
        let light = Light { picked: Some(Arc::new(picked)), ..solution.into() };
        let frame = Frame { show_shooter: true, ..frame(&world, View::FormFactors) };
        render_picture(&gpu, &world, &light, &frame, 4).expect("a picture")
    };
    let (one, other) = (render(first, second), render(second, second));
    assert!(one == render(first, first), "it does not depend on the shooter");
    assert!(one.linear == other.linear && one.srgb != other.srgb, "outlines are no colours of surfaces");
    let reddish = |picture: &Picture| picture.srgb.iter().filter(|pixel| pixel[0] > 2 * pixel[1]).count();
    assert!(reddish(&one) > 50, "the outline stands out");
}

#[test]
fn a_view_without_its_data_says_so_and_is_plain() {
    let world = square();
    let without = light(&solution(&world, motley));
    let with = Light {
        picked: Some(Arc::new(picked(&world, 0))),
        ..Solution { bounces: vec![Arc::default()], ..Solution::default() }.into()
    };
    for &view in View::ALL {
        let is_shown = |light: &Light| view.missing(light).is_none();
        let is_radiosity = !view.shows_photons() && !matches!(view, View::Camera(_) | View::OcclusionVertices);
        assert!(!is_shown(&Light::default()), "{view:?}");
        assert_eq!(is_shown(&without), is_radiosity && !matches!(view, View::Bounces | View::FormFactors), "{view:?}");
        assert_eq!(is_shown(&with), is_radiosity, "{view:?}");
    }
    let Some(gpu) = gpu() else { return };
    let render = |view, exposure_ev| {
        let frame = Frame { exposure_ev, show_shooter: false, ..frame(&world, view) };
        render_picture(&gpu, &world, &without, &frame, 4).expect("a picture")
    };
    let plain = render(View::Bounces, 0.0);
    assert!(plain == render(View::FormFactors, 3.0));
    for (value, shown) in plain.linear.iter().zip(&plain.srgb).filter(|(value, _)| value[3] == 1.0) {
        assert!(value[0] == value[1] && value[1] == value[2] && value[0] > 0.0, "{value:?} is a grey");
        assert!((60..200).contains(&shown[0]), "{shown:?} is neither black nor white");
    }
}
