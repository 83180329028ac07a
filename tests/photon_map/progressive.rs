//! Passes whose radii shrink: noise and bias go to zero together.

use super::rooms::furnace;
use super::{at, open, settings, transport};
use glam::Vec3A;
use lightwell::cancel::Cancel;
use lightwell::math::random::Stream;
use lightwell::math::stats::Moments;
use lightwell::methods::photon_map::{PhotonMapping, ProgressivePoints, Which};
use lightwell::methods::transport::{Surface, Transport};
use lightwell::methods::{PhotonSettings, Step};
use std::sync::Arc;

/// Runs the passes; after each that is done `look` sees how many there are and the points.
fn run_passes(
    transport: &Arc<Transport>,
    photons: PhotonSettings,
    surfaces: Vec<Surface>,
    mut look: impl FnMut(u64, &ProgressivePoints),
) {
    let mut points = ProgressivePoints::new(surfaces);
    let mut mapping = PhotonMapping::new(transport.clone(), &settings(photons));
    while mapping.step(&Cancel::default()) == Step::Advanced {
        let maps = mapping.maps();
        if maps.is_complete() {
            points.add(&maps, Which::All);
            look(mapping.solution().passes, &points);
        }
    }
}

/// Slope of the least-squares line through points.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / count;
    let (x, y) = (mean(|point| point.0), mean(|point| point.1));
    let products: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
    products / points.iter().map(|point| (point.0 - x).powi(2)).sum::<f64>()
}

#[test]
fn noise_falls_as_the_radii_say() {
    // A disc of radius r_i holds photons in proportion to r_i², so the variance of a pass grows as 1 / r_i² and that of the
    // mean of n passes is Σ 1 / r_i² / n²: for many passes the RMS error falls as n^(−1/3). In a furnace there is no bias.
    let transport = transport(furnace(0.8));
    let mut stream = Stream::new(2, 0, 0);
    let place = |_| {
        // Away from the edges, where only a part of the disc counts, and less of it while the disc is large.
        let uv = 0.1 + 0.8 * stream.uniform2();
        at(&transport, Vec3A::new(uv.x, 0.0, uv.y), Vec3A::Y)
    };
    let surfaces: Vec<Surface> = (0..1000).map(place).collect();
    let photons =
        PhotonSettings { count: 4_000, nearest: 40, is_progressive: true, passes: 128, ..PhotonSettings::default() };
    let (mut measured, mut predicted) = (Vec::new(), Vec::new());
    let (mut square_radius, mut variances) = (1.0, 0.0);
    run_passes(&transport, photons, surfaces, |passes, points| {
        let i = passes as f64;
        variances += 1.0 / square_radius;
        square_radius *= (i + 2.0 / 3.0) / (i + 1.0);
        let square = |channels: &[Moments; 3]| (channels[0].mean() / 5.0 - 1.0).powi(2);
        let rms = (points.irradiance().iter().map(square).sum::<f64>() / 1000.0).sqrt();
        if passes.is_power_of_two() {
            println!("{passes} passes: RMS error {rms:.4}, {:.4} of one pass", variances.sqrt() / i);
            measured.push((i.ln(), rms.ln()));
            predicted.push((i.ln(), (variances.sqrt() / i).ln()));
        }
    });
    // The first disc holds 40 photons: they are spread over the whole room as evenly as chance has it.
    assert!((measured[0].1.exp() * 40_f64.sqrt() - 1.0).abs() < 0.15);
    // The discs of 1000 places cover a floor of 3000 photons, so some 100 to 300 of them are independent, and the RMS is
    // known to 5 %. Over the ln 128 = 4.9 of the line that is 0.02 of slope.
    let (measured, predicted) = (slope(&measured), slope(&predicted));
    println!("slope {measured:.3}, predicted {predicted:.3}");
    assert!((measured - predicted).abs() < 0.04, "{measured} {predicted}");
}

#[test]
fn radii_shrink_and_photons_are_new_in_every_pass() {
    let transport = open("cornell-box");
    let photons = PhotonSettings { count: 10_000, is_progressive: true, passes: 10, ..PhotonSettings::default() };
    let mut mapping = PhotonMapping::new(transport, &settings(photons));
    let (mut radii, mut firsts) = (Vec::new(), Vec::new());
    while mapping.step(&Cancel::default()) == Step::Advanced {
        let solution = mapping.solution();
        if solution.is_complete {
            radii.push(solution.max_radius);
            firsts.push(solution.photons[0].position);
            assert_eq!(solution.counters.emitted, 10_000);
        }
    }
    assert_eq!((radii.len(), mapping.solution().passes), (10, 10));
    assert!((radii[9] / radii[0] - 0.713_103).abs() < 1e-5, "{radii:?}");
    firsts.dedup();
    assert_eq!(firsts.len(), 10);
    // More passes are no new start, another radius is.
    assert!(!mapping.configure(&settings(PhotonSettings { max_radius: Some(0.1), ..photons })));
    assert!(mapping.configure(&settings(PhotonSettings { passes: 11, ..photons })));
    assert_eq!(mapping.step(&Cancel::default()), Step::Advanced);
    assert_eq!(mapping.solution().passes, 11);
    assert_eq!(mapping.step(&Cancel::default()), Step::Converged);
}
