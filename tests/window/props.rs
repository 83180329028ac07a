//! What is put on a stage: made-up light, runs and findings, with round numbers.

use egui::TextureHandle;
use glam::Vec3;
use lightwell::accuracy::Error;
use lightwell::app::diagrams::MatrixTexture;
use lightwell::app::patch::{PatchFacts, PatchLight};
use lightwell::camera::Camera;
use lightwell::effects::Bill;
use lightwell::hard_cases::{Row, Verdict, cases};
use lightwell::math::bounds::Bounds;
use lightwell::math::rgb::{Rgb, Rgb64};
use lightwell::methods::{Settings, Solver};
use lightwell::scene::{Finding, FindingKind, Severity, Viewpoint};
use lightwell::solution::{
    CameraImage, CameraView, Closure, Counters, Energy, Gathered, PhotonCounters, PhotonEnergy, PhotonSolution,
    PhotonTrail, Progress, Scattering, Solution, TrailPlace,
};
use lightwell::viewport::Legend;
use lightwell::viewport::colour_map::ColourMap;
use lightwell::viewport::diagram::Swatch;
use lightwell::worker::{CheckReport, Curve, CurvePoint, LightKind, Track, TrackPoint};
use std::sync::Arc;
use std::time::Duration;

/// 10 W emitted, of which 6 W are absorbed, 3 W unshot and 1 W escaped.
pub fn solution() -> Solution {
    let watts = |red: f64| Rgb64::new(red, 0.0, 0.0);
    Solution {
        steps: 1_234,
        elapsed: Duration::from_millis(2_500),
        converged: false,
        unshot_share: 0.3,
        energy: Energy { emitted: watts(10.0), absorbed: watts(6.0), unshot: watts(3.0), escaped: watts(1.0) },
        closure: Closure { mean: 0.0123, worst: 0.07, reciprocity: 2e-6 },
        counters: Counters { rays: 31_000_000, ..Counters::default() },
        shooter: None,
        ..Solution::default()
    }
}

pub fn finding(kind: FindingKind, severity: Severity) -> Finding {
    Finding {
        severity,
        kind,
        subject: "object 'lamp', line 12".to_owned(),
        problem: "the face has no area".to_owned(),
        remedy: "left out".to_owned(),
    }
}

/// A 500 × 500 matrix and an item buffer, both grey.
pub fn pictures(ctx: &egui::Context) -> (MatrixTexture, TextureHandle) {
    let texture = |name: &str| {
        let image = egui::ColorImage::filled([8, 8], egui::Color32::GRAY);
        ctx.load_texture(name, image, egui::TextureOptions::NEAREST)
    };
    let swatch = |(label, share)| Swatch { label, colour: Rgb::splat(0.5), share };
    let legend = Legend {
        title: "Form factor",
        unit: "",
        low: 1e-6,
        high: 1e-2,
        is_logarithmic: true,
        map: ColourMap::Sequential,
        ticks: vec![1e-4, 1e-2],
    };
    let matrix = MatrixTexture {
        texture: texture("matrix"),
        size: 500,
        legend: Some(legend),
        zeros: [("Same plane", 0.2), ("Faces away", 0.4), ("Occluded", 0.1)].map(swatch),
        filled: 0.3,
    };
    (matrix, texture("item buffer"))
}

pub fn patch() -> PatchFacts<'static> {
    let light = PatchLight {
        radiosity: Rgb::new(12.0, 6.0, 3.0),
        irradiance: Rgb::new(16.0, 8.0, 4.0),
        unshot: Rgb::new(1.0, 0.5, 0.25),
    };
    PatchFacts {
        index: 42,
        material: "white",
        area: 0.0123,
        reflectance: Rgb::new(0.725, 0.71, 0.68),
        exitance: Rgb::ZERO,
        light: Some(light),
        row_sum: 0.98,
        escaping: 0.02,
    }
}

/// Three runs, each ten times as fast as the one before.
pub fn curves() -> Vec<Arc<Curve>> {
    let solvers = [Solver::Progressive, Solver::Jacobi, Solver::GaussSeidel];
    let curve = |(i, solver): (u32, Solver)| {
        let point = |k: u64| CurvePoint {
            progress: Progress {
                steps: k * 10_u64.pow(2 - i),
                updates: 500 * k,
                rays: 1_000_000 * k,
                unshot_share: 0.5_f64.powi(k as i32),
                missing_share: 0.4_f64.powi(k as i32),
            },
            seconds: 0.1 * k as f64,
        };
        let settings = Settings { solver, ..Settings::default() };
        Arc::new(Curve { number: i + 1, settings, points: (0..10).map(point).collect() })
    };
    (0_u32..).zip(solvers).map(curve).collect()
}

/// A run of radiosity that levels off, and one of photons whose noise falls with the root of time.
pub fn tracks() -> Vec<Arc<Track>> {
    let track = |number, kind, error: fn(f64) -> f64| {
        let point = |k: i32| {
            let seconds = 0.01 * 2_f64.powi(k);
            TrackPoint {
                seconds,
                error: Error { rms: error(seconds), uncertainty: 0.001, floor: 0.004, ..Error::default() },
            }
        };
        Arc::new(Track { number, kind, settings: Settings::default(), points: (0..9).map(point).collect() })
    };
    vec![
        track(1, LightKind::Radiosity, |seconds| 0.03 + 0.01 / seconds),
        track(2, LightKind::Photons, |seconds| 0.1 / seconds.sqrt()),
    ]
}

/// Three rows of the first case: one of each verdict.
pub fn checks(is_finished: bool) -> CheckReport {
    let case = cases().next().expect("there are hard cases").name;
    let row = |quantity: &str, expected, got, tolerance, verdict| Row {
        case,
        quantity: quantity.to_owned(),
        expected,
        got,
        tolerance,
        guard: "a guard".to_owned(),
        verdict,
    };
    let rows = vec![
        row("holds", 0.199_824_895_698, 0.199_824_895_699, 1e-9, Verdict::Pass),
        row("fails", 0.003_162_056_838_757_6, -1.25e-7, 0.0, Verdict::Fail),
        row("is a limit", 123_456.789, 123_456.789, 1e-3, Verdict::Limit),
    ];
    CheckReport { rows, running: (!is_finished).then_some(case), is_finished }
}

/// 10 W emitted as 50,000 photons of 200,000, of which 7 W are absorbed, 2.5 W escaped and 0.5 W truncated.
pub fn photons() -> PhotonSolution {
    let watts = |red: f64| Rgb64::new(red, 0.0, 0.0);
    PhotonSolution {
        batches: 4,
        elapsed: Duration::from_millis(250),
        max_radius: 0.04,
        energy: PhotonEnergy { emitted: watts(10.0), absorbed: watts(7.0), escaped: watts(2.5), truncated: watts(0.5) },
        counters: PhotonCounters {
            emitted: 50_000,
            caustic_emitted: 0,
            stored: 90_000,
            rays: 1_000_000,
            by_bounce: vec![60_000, 20_000, 0, 10_000],
            by_path: vec![("LD".to_owned(), 60_000), ("LDD".to_owned(), 30_000)],
            ..PhotonCounters::default()
        },
        ..PhotonSolution::default()
    }
}

/// A picture after 4 samples a pixel and 1.5 s.
pub fn image(view: CameraView) -> CameraImage {
    let viewpoint = Viewpoint { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 45.0 };
    CameraImage {
        view,
        camera: Camera::new(&viewpoint, &Bounds { min: Vec3::ZERO, max: Vec3::ONE }),
        size: [1; 2],
        resolution: [1; 2],
        radiance: vec![Rgb::ONE],
        coverage: vec![1.0],
        comparison: None,
        samples: 4,
        rays: 3_000_000,
        bill: Bill::default(),
        elapsed: Duration::from_millis(1_500),
        is_complete: false,
    }
}

/// A photon that met a mirror, then a diffuse surface, and was absorbed.
pub fn trail() -> PhotonTrail {
    let place =
        |survival: f32, scattering| TrailPlace { point: Vec3::ZERO, flux: Rgb::splat(1e-3), survival, scattering };
    PhotonTrail {
        places: vec![
            place(1.0, Some(Scattering::Diffuse)),
            place(0.9, Some(Scattering::Specular)),
            place(0.7, Some(Scattering::Diffuse)),
            place(0.6, None),
        ],
        escape: None,
    }
}

pub fn gathered() -> Gathered {
    Gathered {
        normal: Vec3::Y,
        irradiance: Rgb::new(12.0, 6.0, 3.0),
        radius: 0.02,
        inside: 0.75,
        relative_error: 0.1,
        used: (0..100).collect(),
        photons: 100,
        rejected: vec![7, 8],
        ..Gathered::default()
    }
}
