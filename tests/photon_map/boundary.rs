//! Where surfaces end.

use super::rooms::{add, add_material, furnace};
use super::{at, run_to_end, transport};
use glam::{Vec3, Vec3A};
use lightwell::math::rgb::Rgb;
use lightwell::methods::PhotonSettings;
use lightwell::methods::photon_map::{PhotonMapping, Scratch, Which};
use lightwell::methods::transport::Transport;
use lightwell::scene::Material;
use std::sync::Arc;

fn photons() -> PhotonSettings {
    PhotonSettings { count: 200_000, nearest: 500, max_radius: Some(0.1), ..PhotonSettings::default() }
}

#[test]
fn the_share_of_the_disc_that_is_surface_has_its_closed_form() {
    let transport = transport(furnace(0.5));
    let maps = run_to_end(&transport, photons()).maps();
    let inside = |x: f32, z: f32| {
        let surface = at(&transport, Vec3A::new(x, 0.0, z), Vec3A::Y);
        let estimate = maps.irradiance(&surface, Which::All, &mut Scratch::default());
        (estimate.inside, estimate.radius)
    };
    assert_eq!(inside(0.5, 0.5).0, 1.0);
    // At an edge 1/2 and in a corner 1/4, to the radius over which the place is off the edge.
    assert!((inside(1e-5, 0.5).0 - 0.5).abs() < 1e-3, "{:?}", inside(1e-5, 0.5));
    assert!((inside(1e-5, 1.0 - 1e-5).0 - 0.25).abs() < 1e-3, "{:?}", inside(1e-5, 1.0 - 1e-5));
    // A chord at a distance d cuts off (acos δ − δ √(1 − δ²)) / π, δ = d / r. 64 directions are good to (2π / 64)² / 6.
    for distance in [0.005, 0.01, 0.02] {
        let (inside, radius) = inside(0.5, distance);
        let share = distance / radius;
        let expected = 1.0 - (share.acos() - share * (1.0 - share * share).sqrt()) / std::f32::consts::PI;
        assert!((inside - expected).abs() < 2e-3, "{distance}: {inside} {expected}");
    }
}

/// The furnace with a wall across the middle, x = 0.5. The floor and other walls go on below and behind it. In the far part,
/// x > 0.5, nothing glows: its walls are given a second, dark skin.
fn divided(thickness: f32) -> Arc<Transport> {
    let mut scene = furnace(0.5);
    let dark = add_material(&mut scene, Material { diffuse: Rgb::splat(0.5), ..Material::grey("dark") });
    // A lamp in the near part instead of glowing walls.
    for polygon in &mut scene.polygons {
        polygon.material = dark;
    }
    let lamp = [(0.1, 0.3), (0.3, 0.3), (0.3, 0.6), (0.1, 0.6)];
    add(&mut scene, 0, &[lamp.map(|(x, z)| Vec3::new(x, 0.9, z)).to_vec()]);
    for x in [0.5, 0.5 + thickness] {
        let wall = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        add(&mut scene, dark, &[wall.map(|(y, z)| Vec3::new(x, y, z)).to_vec()]);
        if thickness == 0.0 {
            break;
        }
    }
    transport(scene)
}

fn irradiance(mapping: &PhotonMapping, place: Vec3A, normal: Vec3A) -> f32 {
    let maps = mapping.maps();
    let surface = at(maps.transport(), place, normal);
    maps.irradiance(&surface, Which::All, &mut Scratch::default()).irradiance.x
}

#[test]
fn no_light_leaks_under_or_through_a_thin_wall() {
    for thickness in [0.0, 1e-3] {
        let transport = divided(thickness);
        let mapping = run_to_end(&transport, photons());
        let beyond = 0.5 + thickness + 1e-3;
        let dark = [
            irradiance(&mapping, Vec3A::new(beyond, 0.0, 0.5), Vec3A::Y),
            irradiance(&mapping, Vec3A::new(beyond, 0.5, 0.0), Vec3A::Z),
            irradiance(&mapping, Vec3A::new(0.5 + thickness, 0.5, 0.5), Vec3A::X),
        ];
        assert_eq!(dark, [0.0; 3], "thickness {thickness}");
        // On the lit side the estimate does not fall off towards the wall.
        let near = irradiance(&mapping, Vec3A::new(0.499, 0.0, 0.45), Vec3A::Y);
        let off = irradiance(&mapping, Vec3A::new(0.44, 0.0, 0.45), Vec3A::Y);
        println!("thickness {thickness}: {near} W/m² at the foot of the wall, {off} W/m² 6 cm off");
        // Two estimates of 500 photons: 6 % together, and light changes by less than 15 % over 6 cm of a lit room of 1 m.
        assert!((near / off - 1.0).abs() < 0.33, "{near} {off}");
    }
}

#[test]
fn a_floor_of_many_tiles_is_one_floor() {
    let mut scene = furnace(0.5);
    scene.polygons.remove(0);
    // Tiles of two sizes, so that corners of some lie on the edges of others.
    let tile = |x: f32, z: f32, dx: f32, dz: f32| {
        vec![Vec3::new(x, 0.0, z), Vec3::new(x, 0.0, z + dz), Vec3::new(x + dx, 0.0, z + dz), Vec3::new(x + dx, 0.0, z)]
    };
    for i in 0..8 {
        let x = i as f32 / 8.0;
        let rows = if i % 2 == 0 { 8 } else { 5 };
        for j in 0..rows {
            let dz = 1.0 / rows as f32;
            add(&mut scene, 0, &[tile(x, j as f32 * dz, 1.0 / 8.0, dz)]);
        }
    }
    let transport = transport(scene);
    let maps = run_to_end(&transport, photons()).maps();
    for (x, z) in [(0.3, 0.52), (0.25, 0.4), (0.3751, 0.37), (0.5, 0.5)] {
        let surface = at(&transport, Vec3A::new(x, 0.0, z), Vec3A::Y);
        let estimate = maps.irradiance(&surface, Which::All, &mut Scratch::default());
        assert_eq!(estimate.inside, 1.0, "at {x}, {z}");
        assert!((f64::from(estimate.irradiance.x) / 2.0 - 1.0).abs() < 4.0 * f64::from(estimate.relative_error));
    }
    let corner = at(&transport, Vec3A::new(1e-4, 0.0, 1e-4), Vec3A::Y);
    let estimate = maps.irradiance(&corner, Which::All, &mut Scratch::default());
    assert!((estimate.inside - 0.25).abs() < 0.01, "{estimate:?}");
}

#[test]
fn what_an_estimate_is_made_of_is_told() {
    let transport = divided(0.0);
    let mapping = run_to_end(&transport, photons());
    let maps = mapping.maps();
    let surface = at(&transport, Vec3A::new(0.495, 0.0, 0.5), Vec3A::Y);
    let estimate = maps.irradiance(&surface, Which::All, &mut Scratch::default());
    let gathered = maps.gathered(&surface);
    assert_eq!(
        (gathered.irradiance, gathered.radius, gathered.inside),
        (estimate.irradiance, estimate.radius, estimate.inside)
    );
    assert_eq!(gathered.used.len(), estimate.photons as usize);
    assert!(estimate.photons == 499 && (estimate.relative_error - 499_f32.sqrt().recip()).abs() < 0.01);
    let photons = maps.photons();
    let position = |index: &u32| photons[*index as usize].position;
    assert!(gathered.used.iter().all(|index| position(index).x < 0.5 && position(index).y == 0.0));
    // Photons on the wall, which is next to the place, do not belong.
    assert!(!gathered.rejected.is_empty() && gathered.rejected.iter().all(|index| position(index).y > 0.0));
    let far = |index: &u32| Vec3A::from(position(index)).distance(surface.point) > gathered.radius * 1.0001;
    assert!(!gathered.used.iter().chain(&gathered.rejected).any(far));
}
