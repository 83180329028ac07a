//! Closed rooms in which light is the same everywhere.

use super::{meet, open, run_to_end, settings};
use glam::Vec3A;
use lightwell::math::rgb::total;
use lightwell::methods::PhotonSettings;
use lightwell::methods::photon_map::{Scratch, Which};

#[test]
fn a_furnace_has_the_same_irradiance_in_the_middle_of_its_walls() {
    let transport = open("furnace");
    let mapping = run_to_end(
        &transport,
        &settings(PhotonSettings {
            count: 1_000_000,
            nearest: 40_000,
            max_radius: Some(0.3),
            ..PhotonSettings::default()
        }),
    );
    let solution = mapping.solution();
    assert!(total(solution.energy.defect()).abs() < 1e-12 * total(solution.energy.emitted), "{:?}", solution.energy);
    println!("{:?} {} {}", solution.counters, solution.photons.len(), solution.max_radius);
    let maps = mapping.maps();
    for direction in [Vec3A::X, Vec3A::Y, Vec3A::Z, -Vec3A::X, -Vec3A::Y, -Vec3A::Z] {
        let surface = meet(&transport, Vec3A::splat(0.5), direction);
        let estimate = maps.irradiance(&surface, Which::All, &mut Scratch::default());
        println!("{estimate:?}");
    }
}
