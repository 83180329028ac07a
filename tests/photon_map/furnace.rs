//! Closed rooms in which light is the same everywhere.

use super::rooms::{add, add_material, block, furnace, furnace_irradiance, glass, globe, mirror, square};
use super::{at, meet, run_to_end, transport};
use glam::{Quat, Vec3, Vec3A};
use lightwell::choice::Choice;
use lightwell::math::random::Stream;
use lightwell::math::rgb::total;
use lightwell::math::warp::{cosine_hemisphere, frame};
use lightwell::methods::photon_map::{PhotonMapping, PhotonMaps, Scratch, Which};
use lightwell::methods::transport::{Surface, Transport};
use lightwell::methods::{Kernel, PhotonSettings};
use lightwell::scene::{Material, Scene};
use std::sync::Arc;

/// Random places on the walls of the unit cube, the middles of edges and the corners among them.
fn places(transport: &Transport, count: u64) -> Vec<Surface> {
    let mut stream = Stream::new(3, 0, 0);
    let mut place = |index: u64| {
        let at_edges = if index.is_multiple_of(4) { 1e-4 } else { 1.0 };
        let uv = stream.uniform2() * at_edges;
        let wall = index % 6;
        let axis = (wall / 2) as usize;
        let mut place = [uv.x, uv.y, uv.x];
        place[(axis + 1) % 3] = uv.y;
        place[axis] = (wall % 2) as f32;
        let mut normal = [0.0; 3];
        normal[axis] = if wall.is_multiple_of(2) { 1.0 } else { -1.0 };
        // Just off the walls: on an edge there is no saying which wall a ray meets.
        let place = Vec3A::from_array(place).clamp(Vec3A::splat(1e-5), Vec3A::splat(1.0 - 1e-5));
        at(transport, place, Vec3A::from_array(normal))
    };
    (0..count).map(&mut place).collect()
}

/// Mean of the irradiance at places of one room over what it must be, and the largest deviation in standard errors.
fn check(maps: &PhotonMaps, places: &[Surface], expected: f64) -> (f64, f64) {
    let mut scratch = Scratch::default();
    let (mut sum, mut worst) = (0.0, 0.0_f64);
    for surface in places {
        let estimate = maps.irradiance(surface, Which::All, &mut scratch);
        let relative = f64::from(estimate.irradiance.x) / expected;
        sum += relative;
        worst = worst.max((relative - 1.0).abs() / f64::from(estimate.relative_error));
    }
    (sum / places.len() as f64, worst)
}

#[test]
fn photons_of_a_closed_room_land_as_often_as_reflectance_says() {
    for reflectance in [0.5_f32, 0.9] {
        let transport = transport(furnace(reflectance));
        let mapping = run_to_end(&transport, PhotonSettings { count: 200_000, ..PhotonSettings::default() });
        let solution = mapping.solution();
        let (chance, count) = (f64::from(reflectance), solution.counters.emitted as f64);
        let mean = solution.counters.stored as f64 / count;
        // The number of landings of a photon has a geometric distribution.
        let standard_error = chance.sqrt() / (1.0 - chance) / count.sqrt();
        println!("ρ = {reflectance}: {mean} landings a photon, one standard error is {standard_error}");
        assert!((mean - 1.0 / (1.0 - chance)).abs() < 3.0 * standard_error);
        assert_eq!(solution.photons.len() as u64, solution.counters.stored);
        let stored: f64 = solution.photons.iter().map(|photon| f64::from(photon.flux.x)).sum();
        assert!((stored / solution.energy.emitted.x - mean).abs() < 1e-4 * mean, "stored flux {stored}");
    }
}

fn check_room(name: &str, scene: Scene, reflectance: f32) -> PhotonMapping {
    let transport: Arc<Transport> = transport(scene);
    let photons = PhotonSettings {
        count: 400_000,
        caustic_count: 200_000,
        nearest: 1000,
        max_radius: Some(0.2),
        ..PhotonSettings::default()
    };
    let mut mapping = run_to_end(&transport, photons);
    let places = places(&transport, 240);
    for &kernel in Kernel::ALL {
        let settings = super::settings(PhotonSettings { kernel, ..photons });
        assert!(mapping.configure(&settings));
        let (mean, worst) = check(&mapping.maps(), &places, furnace_irradiance(reflectance));
        println!("{name}, {kernel:?}: mean {mean}, worst {worst} standard errors");
        // 240 estimates of 1000 photons, many of them shared: at most 1 % / √(240 / 10).
        assert!((mean - 1.0).abs() < 0.01, "{name}, {kernel:?}: {mean}");
        // A normal distribution goes past 5 once in two million times.
        assert!(worst < 5.0, "{name}, {kernel:?}: {worst}");
    }
    mapping
}

#[test]
fn a_furnace_is_even_up_to_its_corners_with_every_kernel() {
    check_room("furnace", furnace(0.5), 0.5);
}

#[test]
fn a_mirror_in_a_furnace_vanishes() {
    let mut scene = furnace(0.5);
    let material = add_material(&mut scene, mirror());
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.4, 0.3, 0.0);
    add(&mut scene, material, &[square(0.5, turn, Vec3::splat(0.5))]);
    let mapping = check_room("mirror", scene, 0.5);
    let counters = mapping.solution().counters;
    assert!(counters.caustic_stored > 10_000, "{counters:?}");
}

#[test]
fn a_sphere_of_glass_in_a_furnace_vanishes_and_keeps_no_flux() {
    let mut scene = furnace(0.5);
    let material = add_material(&mut scene, glass());
    add(&mut scene, material, &globe(0.3, Vec3::splat(0.5), 8));
    let energy = check_room("glass", scene, 0.5).solution().energy;
    let emitted = total(energy.emitted);
    assert!(total(energy.defect()).abs() < 1e-12 * emitted && total(energy.escaped) == 0.0, "{energy:?}");
    assert!(total(energy.truncated) < 1e-3 * emitted, "{energy:?}");
}

#[test]
fn a_block_that_glows_like_its_room_vanishes_even_at_its_foot() {
    let mut scene = furnace(0.5);
    let (half, center) = (Vec3::new(0.15, 0.2, 0.1), Vec3::new(0.5, 0.2, 0.5));
    add(&mut scene, 0, &block(center, half, 0.4));
    let transport = transport(scene);
    let mapping = run_to_end(
        &transport,
        PhotonSettings { count: 400_000, nearest: 1000, max_radius: Some(0.2), ..PhotonSettings::default() },
    );
    let turn = Quat::from_rotation_y(0.4);
    // On the floor before a wall of the block, beside its corner, and on the wall itself.
    let floor = |x: f32, z: f32| {
        let place = center + turn * Vec3::new(x, 0.0, z);
        at(&transport, Vec3::new(place.x, 0.0, place.z), Vec3A::Y)
    };
    let out = turn * Vec3::X;
    let on_wall = center + 0.15 * out - Vec3::new(0.0, 0.199, 0.0);
    let places = [floor(0.151, 0.0), floor(0.0, 0.101), floor(0.155, 0.105), floor(-0.18, 0.05)];
    let (mean, worst) = check(&mapping.maps(), &places, 2.0);
    println!("floor: mean {mean}, worst {worst} standard errors");
    assert!(worst < 4.0 && (mean - 1.0).abs() < 0.05);
    let (mean, worst) = check(&mapping.maps(), &[at(&transport, on_wall, out.into())], 2.0);
    assert!(worst < 4.0, "wall: {mean}, {worst}");
}

#[test]
fn estimates_from_few_photons_are_right_on_average() {
    // With k photons up to the k-th, k / (π r²) is too bright by k / (k − 1). The relative variance of (k − 1) / (π r²) is
    // 1 / (k − 2), and 4000 places share few of their photons.
    let transport = transport(furnace(0.5));
    for nearest in [4_u32, 8] {
        let mapping = run_to_end(
            &transport,
            PhotonSettings { count: 400_000, nearest, max_radius: Some(0.2), ..PhotonSettings::default() },
        );
        let mut stream = Stream::new(9, 0, 0);
        let places: Vec<Surface> = (0..4000)
            .map(|_| {
                let uv = stream.uniform2() * 0.8 + 0.1;
                at(&transport, Vec3A::new(uv.x, 0.0, uv.y), Vec3A::Y)
            })
            .collect();
        let (mean, _) = check(&mapping.maps(), &places, 2.0);
        let standard_error = (f64::from(nearest - 2) * 4000.0).sqrt().recip();
        println!("k = {nearest}: mean {mean}, one standard error is {standard_error}");
        assert!((mean - 1.0).abs() < 4.0 * standard_error, "{mean}");
    }
}

#[test]
fn a_globe_that_glows_like_its_room_vanishes_although_it_is_made_of_triangles() {
    // Discs lie over many triangles of the globe, which are 11° off each other: a disc as large as a triangle is off its
    // sphere's area by less than 1 %.
    let mut scene = furnace(0.5);
    let (radius, center) = (0.25, Vec3::splat(0.5));
    add(&mut scene, 0, &globe(radius, center, 16));
    let transport = transport(scene);
    let mapping = run_to_end(
        &transport,
        PhotonSettings { count: 400_000, nearest: 1000, max_radius: Some(0.1), ..PhotonSettings::default() },
    );
    let maps = mapping.maps();
    let mut stream = Stream::new(4, 0, 0);
    let place = |_| {
        let out = frame(Vec3A::Y) * cosine_hemisphere(stream.uniform2());
        meet(&transport, Vec3A::from(center) + 0.4 * out, -out)
    };
    let places: Vec<Surface> = (0..50).map(place).collect();
    let (mean, worst) = check(&maps, &places, 2.0);
    let open = places.iter().filter(|place| maps.irradiance(place, Which::All, &mut Scratch::default()).inside == 1.0);
    println!("globe: mean {mean}, worst {worst} standard errors");
    assert_eq!(open.count(), places.len());
    assert!(worst < 4.0 && (mean - 1.0).abs() < 0.03, "{mean} {worst}");
}

#[test]
fn a_white_plate_in_glass_gets_the_light_that_refraction_gathers() {
    // Radiance over the square of the index goes on unchanged through a boundary, so in equilibrium a plate that keeps next to
    // nothing has n² as much irradiance in glass as in the air: that photons carry flux, and not radiance, shows here. From
    // most directions it comes by total reflection in the slab.
    let mut scene = furnace(0.5);
    let material = add_material(&mut scene, glass());
    let half = Vec3::new(0.3, 0.06, 0.3);
    add(&mut scene, material, &block(Vec3::splat(0.5), half, 0.0));
    let down = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    add(&mut scene, material, &[square(0.6, down, Vec3::new(0.5, 0.44, 0.5))]);
    let white = add_material(&mut scene, Material { diffuse: Vec3::splat(0.999), ..Material::grey("white") });
    add(&mut scene, white, &[square(0.2, down, Vec3::splat(0.5))]);
    let transport = transport(scene);
    let photons = PhotonSettings {
        count: 200_000,
        caustic_count: 200_000,
        nearest: 2000,
        max_radius: Some(0.1),
        ..PhotonSettings::default()
    };
    let maps = run_to_end(&transport, photons).maps();
    let places = [Vec3A::Y, Vec3A::NEG_Y].map(|normal| at(&transport, Vec3A::splat(0.5), normal));
    let (mean, _) = check(&maps, &places, 2.0 * 2.25);
    println!("plate in glass: {mean} of what it should be");
    // Some 2000 landings count on each side, but one photon may land there many times: as if there were 10 times fewer.
    assert!((mean - 1.0).abs() < 4.0 / 400_f64.sqrt(), "{mean}");
}

#[test]
fn the_far_side_of_a_small_globe_lends_no_light() {
    // A lamp above lights the upper half of the globe. Below, all photons within the disc, which is larger than the globe, are
    // on the other side of it.
    let mut scene = furnace(0.5);
    scene.polygons.clear();
    add(&mut scene, 0, &[square(0.05, Quat::from_rotation_x(std::f32::consts::FRAC_PI_2), Vec3::new(0.5, 0.7, 0.5))]);
    let grey = add_material(&mut scene, Material::grey("grey"));
    add(&mut scene, grey, &globe(0.03, Vec3::splat(0.5), 16));
    let transport = transport(scene);
    let photons = PhotonSettings { nearest: 100_000, max_radius: Some(0.1), ..PhotonSettings::default() };
    let maps = run_to_end(&transport, photons).maps();
    let irradiance = |normal: Vec3A| {
        let surface = meet(&transport, Vec3A::splat(0.5) + 0.05 * normal, -normal);
        maps.irradiance(&surface, Which::All, &mut Scratch::default())
    };
    let (above, below) = (irradiance(Vec3A::new(0.1, 1.0, 0.1)), irradiance(Vec3A::new(0.1, -1.0, 0.1)));
    assert!(above.photons > 100 && below.photons == 0, "{above:?} {below:?}");
}
