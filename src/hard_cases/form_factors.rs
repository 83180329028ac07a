//! Where the 1/r² of the form factor is singular, or its sum over edges loses digits.

use super::row::{about, exactly};
use super::stage::{Stage, level, patch_of, plates, solve, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::math::polygon::{area_form_factor, form_factor, parallel_rectangles};
use crate::mesh::{MeshSettings, Region};
use crate::methods::Settings;
use crate::methods::radiosity::pick;
use glam::{DVec2, DVec3, Vec2};
use std::f64::consts::PI;

pub const CASES: &[Case] = &[
    Case {
        name: "shared-edge",
        about: "a floor and a wall that meet, where 1/r² has no bound",
        measure: shared_edge,
        scene: || corner().show("shared-edge"),
    },
    Case {
        name: "gap",
        about: "two plates face to face, from one edge length apart to a billionth of it",
        measure: gap,
        scene: || plates(1e-2).show("gap"),
    },
    Case {
        name: "point-on-edge",
        about: "a point exactly on the edge of the polygon that it looks at",
        measure: point_on_edge,
        scene: || corner().show("point-on-edge"),
    },
    Case {
        name: "horizon",
        about: "polygons that reach below the horizon of the point that looks at them",
        measure: horizon,
        scene: || sunk_wall().show("horizon"),
    },
    Case {
        name: "tiny-polygon",
        about: "a polygon so small that its edges point the same way for all digits of a cosine",
        measure: tiny_polygon,
        scene: || None,
    },
];

const ARC_TANGENT: &str = "angles of edges from the arc tangent of sine and cosine, not from the arc cosine";
const CONTOUR: &str = "pairs of edges are integrated in closed form, however near they are";
const LAMBERT: &str = "a closed form in angles, which needs no distance";
const CLIPPING: &str = "the polygon is clipped at the horizon first";
const FACING: &str = "double precision tells which of two near planes is in front";
const CLOSED_FORM: &str = "the closed form to the whole polygon, over all of what is near";

/// Elements along each edge of a unit square.
const CUTS: u32 = 16;

/// One patch for each square, cut into elements.
fn one_patch() -> MeshSettings {
    MeshSettings { element_size: Some(1.001 / CUTS as f32), elements_per_patch_edge: CUTS }
}

/// A glowing floor and a black wall, unit squares with a common edge.
fn corner() -> Stage {
    Stage::new()
        .object("floor", 0.0, 1.0)
        .level_up([0.0, 1.0], 0.0, [0.0, 1.0])
        .object("wall", 0.0, 0.0)
        .face(&wall(0.0))
}

/// A unit square above the x axis that looks along z; more of it where its foot is lower.
fn wall(foot: f64) -> [DVec3; 4] {
    [(0.0, foot), (1.0, foot), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0))
}

/// A glowing floor, and a wall that goes through it.
fn sunk_wall() -> Stage {
    corner().object("sunk", 0.5, 0.0).face(&wall(-1.0).map(|corner| corner + 0.5 * DVec3::Z))
}

/// F from one object to another, as the program computes it before rows are scaled.
fn between(stage: &Stage, from: &str, to: &str, rows: &Rows) -> Result<f64, Cancelled> {
    let world = world(stage.open("pair"), one_patch(), rows.cancel)?;
    let seen = pick(&world, &Settings::default(), patch_of(&world, from), rows.cancel).ok_or(Cancelled)?;
    Ok(seen.form_factors[patch_of(&world, to) as usize])
}

/// From a point at this distance before the foot of a unit wall.
fn before_the_wall(distance: f64) -> f64 {
    form_factor(DVec3::new(0.5, 0.0, distance), DVec3::Y, &wall(0.0))
}

fn shared_edge(rows: &mut Rows) -> Result<(), Cancelled> {
    for (distance, expected, guard) in
        [(1e-3, 0.499_215_797_596_26, LAMBERT), (1e-9, 0.499_999_999_215_797, ARC_TANGENT)]
    {
        // Some ten roundings of numbers below 1.
        let quantity = format!("F, {distance:.0e} before the foot of a wall");
        rows.check(quantity, before_the_wall(distance), about(expected, 1e-14), guard);
    }
    // Howell C-14 for W = H = 1, first exactly, then on 16 × 16 elements, of which the single points at the far ends of the
    // floor miss some 1e-5.
    let (floor, wall) = (level([0.0, 1.0], 0.0, [0.0, 1.0]), wall(0.0));
    let exactly_so = area_form_factor(&floor, &wall);
    rows.check(
        "F of unit squares with a common edge, exactly",
        exactly_so,
        about(0.200_043_776_075_403, 1e-9),
        CONTOUR,
    );
    let got = between(&corner(), "floor", "wall", rows)?;
    rows.check("F of unit squares with a common edge", got, about(0.200_043_776_075_403, 1e-4), CLOSED_FORM);
    Ok(())
}

fn gap(rows: &mut Rows) -> Result<(), Cancelled> {
    for gap in [1.0, 1e-3, 1e-9] {
        let plate = level([0.0, 1.0], gap, [0.0, 1.0]);
        let down = [plate[3], plate[2], plate[1], plate[0]];
        let got = form_factor(DVec3::new(0.5, 0.0, 0.5), DVec3::Y, &down);
        // Four rectangles with a corner above the point (Howell C-3), their edges 1/(2 gap) of the height.
        let slope = 1.0 / (1.0 + 4.0 * gap * gap).sqrt();
        rows.check(
            format!("F from the middle, gap {gap:.0e}"),
            got,
            about(4.0 / PI * slope * slope.atan(), 1e-14),
            LAMBERT,
        );
    }
    // 1 − 2 gap for the rims of a small gap; the next term is a square of it.
    let [lower, [a, b, c, d]] = [0.0, 1e-9].map(|height| level([0.0, 1.0], height, [0.0, 1.0]));
    let got = area_form_factor(&lower, &[d, c, b, a]);
    rows.check("1 − F of unit squares, exactly, gap 1e-9", 1.0 - got, about(2e-9, 1e-12), CONTOUR);
    // At a gap of 1 a point stands for each of 16 × 16 elements, which errs by 0.118 % for the midpoint rule. Nearer, elements
    // are integrated in closed form; their corners are in single precision, and dF / dgap is 2 at most.
    for (gap, tolerance) in [(1.0, 2.4e-4), (0.1, 1e-6), (1e-2, 1e-6), (1e-3, 1e-6)] {
        let got = between(&plates(gap), "floor", "plate", rows)?;
        rows.check(format!("F of unit squares, gap {gap:.0e}"), got, about(exact(gap), tolerance), CLOSED_FORM);
    }
    let emitted = |gap: f64| {
        let world = world(plates(gap).open("gap"), one_patch(), rows.cancel)?;
        Ok(solve(&world, &Settings::default(), rows.cancel)?.energy)
    };
    for gap in [1e-4, 1e-9] {
        let energy = emitted(gap)?;
        let share = energy.absorbed.x / energy.emitted.x;
        // What escapes between the rims, 2 gap, is found by rays at random, and is off by that much at most.
        rows.check(format!("share that arrives, gap {gap:.0e}"), share, about(exact(gap), 2.0 * gap + 1e-9), FACING);
    }
    Ok(())
}

/// F of unit squares face to face.
fn exact(gap: f64) -> f64 {
    parallel_rectangles(1.0, 1.0, gap)
}

fn point_on_edge(rows: &mut Rows) -> Result<(), Cancelled> {
    let reason = "the edge that the point lies on has no direction from it, and drops out of the sum";
    rows.limit("F from the edge itself, 1/2 from any side", before_the_wall(0.0), exactly(0.0), reason);
    let square = level([0.0, 1.0], 0.0, [0.0, 1.0]).map(|corner| corner.as_vec3a());
    let samples = Region::new(square, 4).sampler();
    let nearest = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE].map(|at| {
        let at = DVec2::new(f64::from(samples.point(at).x), f64::from(samples.point(at).z));
        at.min(1.0 - at).min_element()
    });
    // Half of 1/8192 of the way across.
    let expected = about(0.5 / 8192.0, 2.0 * f64::from(f32::EPSILON));
    rows.check(
        "distance of samples from the edge",
        nearest.into_iter().fold(1.0, f64::min),
        expected,
        "samples keep off the edges",
    );
    Ok(())
}

fn horizon(rows: &mut Rows) -> Result<(), Cancelled> {
    // What is above the horizon is the triangle between the ends of the axes, an octant: exactly 1/4.
    let triangle = [DVec3::new(2.0, 0.0, -1.0), DVec3::Z, DVec3::new(0.0, 2.0, -1.0)];
    rows.check(
        "F of an octant that goes on below",
        form_factor(DVec3::ZERO, DVec3::Z, &triangle),
        about(0.25, 1e-15),
        CLIPPING,
    );
    let got = form_factor(DVec3::new(0.5, 0.0, 0.1), DVec3::Y, &wall(-1.0));
    rows.check("F of a wall that goes through the floor", got, about(0.422_544_860_239_058, 1e-14), CLIPPING);
    Ok(())
}

fn tiny_polygon(rows: &mut Rows) -> Result<(), Cancelled> {
    let half = 5e-7;
    let above = level([-half, half], 1.0, [-half, half]);
    let got = form_factor(DVec3::ZERO, DVec3::Y, &[above[3], above[2], above[1], above[0]]);
    // Four terms of some 1e-6 with a rounding of 1e-16 each leave 1e-22 of a sum of 3e-13.
    rows.check(
        "F times π of a square of 1e-6, over its area",
        got * PI / (4.0 * half * half),
        about(1.0, 1e-8),
        ARC_TANGENT,
    );
    Ok(())
}
