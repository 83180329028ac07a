//! Single photons, the tree that divides them, and what was picked among them.

use crate::{SIZE, build, frame, gpu, on_plane, pixel, pixels, plane_scene, square};
use glam::{Vec2, Vec3};
use lightwell::math::rgb::Rgb;
use lightwell::mesh::{Patch, side_index};
use lightwell::scene::{Material, Polygon, Scene};
use lightwell::solution::{Gathered, Path, Photon, PhotonSolution, PhotonTrail, Scattering, Split, TrailPlace};
use lightwell::viewport::{Frame, Light, PhotonColour, PhotonLook, Picture, View, render_picture};
use lightwell::world::World;
use std::sync::Arc;

/// Colours are bytes, of which rounding loses half a step.
const BYTE: f32 = 0.6 / 255.0;

/// A photon on the front of the first polygon that came straight from a light before it.
fn photon(at: Vec3) -> Photon {
    let side = side_index(0, true) as u32;
    let flux = Rgb::new(2.0, 1.0, 0.5);
    Photon { position: at, flux, direction: Vec3::NEG_Z, side, path: Path::LIGHT, emission: 0 }
}

fn light(photons: Vec<Photon>) -> Light {
    Light {
        photons: Some(Arc::new(PhotonSolution { photons: Arc::new(photons), ..PhotonSolution::default() })),
        ..Light::default()
    }
}

fn large() -> PhotonLook {
    PhotonLook { size: 6.0, ..PhotonLook::default() }
}

fn draw(world: &Arc<World>, light: &Light, frame: &Frame) -> Option<Picture> {
    Some(render_picture(&gpu()?, world, light, frame, 4).expect("a picture"))
}

/// Pixels that show a colour.
fn of_colour(picture: &Picture, colour: Rgb) -> Vec<(u32, u32)> {
    let is_colour = |&(x, y): &(u32, u32)| {
        let found = Rgb::from_slice(&pixel(picture, x, y)[..3]);
        (found - colour).abs().max_element() < BYTE
    };
    pixels().filter(is_colour).collect()
}

/// A dark square as large as that of [`square`] with a smaller one before it, at z = 0.5, lit from above.
fn with_a_screen() -> Arc<World> {
    let mut scene: Scene = plane_scene(&[0, 1, 2, 3], 1.0, Vec3::ZERO);
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    scene.positions.extend(corners.map(|(x, y)| Vec3::new(x, y, 0.5)));
    let above = [(-1.0, 0.0), (1.0, 0.0), (1.0, 1.5), (-1.0, 1.5)];
    scene.positions.extend(above.map(|(x, z)| Vec3::new(x, 1.0, z)));
    scene.materials.push(Material::grey("dark"));
    let squares: [(&[u32], u32); 3] = [(&[0, 1, 2, 3], 1), (&[4, 5, 6, 7], 1), (&[8, 9, 10, 11], 0)];
    scene.polygons = squares.map(|(corners, material)| Polygon::new(corners, material, 0, 0)).into();
    build(scene, 0.5)
}

#[test]
fn photons_are_thinned_out_until_there_are_gaps() {
    let look = PhotonLook::default();
    // A picture of 120 x 100 has room for a thousand, each on 12 pixels.
    let size = [120, 100];
    assert_eq!([0, 1, 1000, 1001, 10_000].map(|count| look.stride(count, size)), [1, 1, 1, 2, 10]);
    assert_eq!(look.stride(10, [1, 1]), 10);
    assert_eq!(PhotonLook { thinned: false, ..look }.stride(1 << 20, size), 1);
}

#[test]
fn a_photon_is_seen_where_it_landed() {
    let world = square();
    let place = Vec2::new(0.4, -0.3);
    let frame = Frame { photons: large(), ..frame(&world, View::Photons) };
    let Some(picture) = draw(&world, &light(vec![photon(place.extend(0.0))]), &frame) else { return };
    let hue = Rgb::new(1.0, 0.5, 0.25);
    let found = of_colour(&picture, hue);
    // Six pixels wide; those on its edge are mixed with the surface.
    assert!((25..=36).contains(&found.len()), "{} pixels", found.len());
    for (x, y) in found {
        let (point, pixel) = on_plane(x, y);
        assert!((point - place).abs().max_element() < 3.0 * pixel, "{point} is not near {place}");
    }
    let dark = pixel(&picture, SIZE[0] / 2, SIZE[1] / 2);
    assert!(dark[3] == 1.0 && dark[0] < 0.1, "{dark:?} is no dark surface");
}

/// How many pixels show a photon on the first polygon, on its side towards the camera or on the other.
fn pixels_of_photon(world: &Arc<World>, at: Vec3, is_towards_camera: bool) -> Option<usize> {
    // Emitters may have been turned.
    let is_side = |patch: &&Patch| patch.polygon == 0 && patch.normal.z > 0.0;
    let front = world.mesh.patches.iter().find(is_side).expect("the side towards the camera").is_front;
    let side = side_index(0, front == is_towards_camera) as u32;
    let frame = Frame { photons: large(), ..frame(world, View::Photons) };
    let picture = draw(world, &light(vec![Photon { side, ..photon(at) }]), &frame)?;
    Some(of_colour(&picture, Rgb::new(1.0, 0.5, 0.25)).len())
}

#[test]
fn what_hides_a_surface_hides_its_photons() {
    let (open, closed) = (square(), with_a_screen());
    let (behind, beside) = (Vec3::new(0.1, 0.1, 0.0), Vec3::new(0.8, 0.8, 0.0));
    let Some(seen) = pixels_of_photon(&open, behind, true) else { return };
    assert!(seen > 20);
    assert!(pixels_of_photon(&closed, beside, true) > Some(20), "the screen is not before it");
    assert_eq!(pixels_of_photon(&closed, behind, true), Some(0), "the screen stands before it");
    // A surface without thickness: a photon on its back is drawn nearer than it by more than they are apart.
    assert_eq!(pixels_of_photon(&open, behind, false), Some(0), "it landed on the back");
}

#[test]
fn colours_tell_bounces_and_paths() {
    use Scattering::{Diffuse, Specular};
    let world = square();
    let paths =
        [Path::LIGHT, Path::LIGHT.then(Diffuse), Path::LIGHT.then(Specular), Path::LIGHT.then(Specular).then(Diffuse)];
    let places = [-0.6, -0.2, 0.2, 0.6].map(|x| Vec3::new(x, 0.0, 0.0));
    let photons = places.into_iter().zip(paths).map(|(at, path)| Photon { path, ..photon(at) }).collect();
    let light = light(photons);
    let classes = |colour: PhotonColour| colour.classes().into_iter().map(|(_, colour)| colour).collect::<Vec<_>>();
    for (colour, of_photons) in [(PhotonColour::Bounce, [0, 1, 1, 2]), (PhotonColour::Path, [0, 1, 2, 1])] {
        let frame = Frame { photons: PhotonLook { colour, ..large() }, ..frame(&world, View::Photons) };
        let Some(picture) = draw(&world, &light, &frame) else { return };
        for (at, class) in places.iter().zip(of_photons) {
            let shown = of_colour(&picture, classes(colour)[class]);
            let is_there = |&(x, y): &(u32, u32)| (on_plane(x, y).0 - at.truncate()).abs().max_element() < 0.1;
            assert!(shown.iter().any(is_there), "{colour:?} at {at}");
        }
    }
}

#[test]
fn a_filter_leaves_the_others_out() {
    let world = square();
    let caustic = Photon { path: Path::LIGHT.then(Scattering::Specular), ..photon(Vec3::new(0.5, 0.5, 0.0)) };
    let light = light(vec![photon(Vec3::ZERO), caustic]);
    let look = PhotonLook { colour: PhotonColour::Path, ..large() };
    let count = |filter: &str, class: usize| {
        let filter = filter.parse().expect("a pattern");
        let frame = Frame { photons: look, filter, ..frame(&world, View::Photons) };
        Some(of_colour(&draw(&world, &light, &frame)?, PhotonColour::Path.classes()[class].1).len())
    };
    let (direct, caustic) = (0, 2);
    let Some(all) = count("", direct) else { return };
    assert!(all > 20 && count("", caustic) > Some(20));
    assert!(count("LDE", direct) == Some(all) && count("LDE", caustic) == Some(0));
    assert!(count("LS+DE", direct) == Some(0) && count("LS+DE", caustic) > Some(20));
}

#[test]
fn ticks_point_to_where_photons_came_from() {
    let world = square();
    let from_the_left = Photon { direction: Vec3::new(1.0, 0.0, 0.0), ..photon(Vec3::ZERO) };
    let drawn = |ticks| {
        let look = PhotonLook { ticks, size: 1.0, ..PhotonLook::default() };
        let frame = Frame { photons: look, ..frame(&world, View::Photons) };
        draw(&world, &light(vec![from_the_left]), &frame)
    };
    let (Some(without), Some(with)) = (drawn(false), drawn(true)) else { return };
    let changed: Vec<f32> = pixels()
        .filter(|&(x, y)| pixel(&without, x, y) != pixel(&with, x, y))
        .map(|(x, y)| on_plane(x, y).0.x)
        .collect();
    let (_, pixel) = on_plane(0, 0);
    assert!(!changed.is_empty() && changed.iter().all(|&x| x < 0.5 * pixel), "{changed:?}");
}

#[test]
fn the_tree_shows_its_planes_down_to_a_depth() {
    let world = square();
    // A vertical plane through the middle, and a horizontal one in its left half.
    let [min, max] = [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0)];
    let splits = vec![
        Split { depth: 0, axis: 0, at: 0.0, min, max },
        Split { depth: 1, axis: 1, at: 0.5, min, max: Vec3::new(0.0, 1.0, 0.0) },
    ];
    let solution = PhotonSolution {
        photons: Arc::new(vec![photon(Vec3::new(-0.9, -0.9, 0.0))]),
        splits: Arc::new(splits),
        ..PhotonSolution::default()
    };
    let light = Light { photons: Some(Arc::new(solution)), ..Light::default() };
    let drawn = |view, depth| {
        let frame = Frame { photons: PhotonLook { depth, ..PhotonLook::default() }, ..frame(&world, view) };
        draw(&world, &light, &frame)
    };
    let (Some(none), Some(root), Some(both)) =
        (drawn(View::Photons, 5), drawn(View::KdTree, 0), drawn(View::KdTree, 1))
    else {
        return;
    };
    let changed = |picture: &Picture| -> Vec<Vec2> {
        let differs = |&(x, y): &(u32, u32)| pixel(&none, x, y) != pixel(picture, x, y);
        pixels().filter(differs).map(|(x, y)| on_plane(x, y).0).collect()
    };
    let near = |points: &[Vec2], at: Vec2| points.iter().any(|point| (point - at).abs().max_element() < 0.06);
    let (root, both) = (changed(&root), changed(&both));
    assert!(near(&root, Vec2::new(0.0, 0.2)) && near(&both, Vec2::new(0.0, 0.2)));
    assert!(!near(&root, Vec2::new(-0.5, 0.5)) && near(&both, Vec2::new(-0.5, 0.5)));
    assert!(!near(&both, Vec2::new(0.5, 0.5)), "the right half has no plane of its own");
}

#[test]
fn what_is_picked_is_drawn_before_everything() {
    let world = with_a_screen();
    let place =
        |x: f32, scattering| TrailPlace { point: Vec3::new(x, -0.3, 0.0), flux: Rgb::ONE, survival: 1.0, scattering };
    let trail = PhotonTrail { places: vec![place(-0.3, Some(Scattering::Diffuse)), place(0.3, None)], escape: None };
    let gathered = Gathered {
        normal: Vec3::Z,
        radius: 0.3,
        inside: 1.0,
        used: vec![0],
        rejected: vec![1, 99],
        ..Gathered::default()
    };
    let plain = light(vec![photon(Vec3::new(0.1, 0.1, 0.0)), photon(Vec3::new(-0.1, 0.1, 0.0))]);
    let picked = Light { trail: Some(Arc::new(trail)), gathered: Some(Arc::new(gathered)), ..plain.clone() };
    let frame = frame(&world, View::Photons);
    let (Some(plain), Some(picked)) = (draw(&world, &plain, &frame), draw(&world, &picked, &frame)) else { return };
    let is_changed = |at: Vec2| {
        // The plane z = 0 behind the screen: what is marked there is seen through it.
        pixels().any(|(x, y)| (on_plane(x, y).0 - at).length() < 0.05 && pixel(&plain, x, y) != pixel(&picked, x, y))
    };
    for (what, at) in [
        ("the way", Vec2::new(0.0, -0.3)),
        ("its start", Vec2::new(-0.3, -0.3)),
        ("the disc", Vec2::new(0.3, 0.0)),
        ("a used photon", Vec2::new(0.1, 0.1)),
        ("a rejected one", Vec2::new(-0.1, 0.1)),
    ] {
        assert!(is_changed(at), "{what}");
    }
    assert!(!is_changed(Vec2::new(0.15, -0.1)), "nothing else is");
}
