use super::*;
use crate::math::polygon::form_factor;
use crate::math::random::Stream;
use glam::DVec3;

const NOTHING: u32 = ItemBuffer::NOTHING;
const EYE: Vec3A = Vec3A::ZERO;

/// A square of this half side at this height that faces down, with these two corners opposite.
fn ceiling(low: [f32; 2], high: [f32; 2], height: f32, id: u32) -> Item {
    let corner = |x, y| Vec3::new(x, y, height);
    Item::new(&[corner(low[0], low[1]), corner(low[0], high[1]), corner(high[0], high[1]), corner(high[0], low[1])], id)
}

fn draw(resolution: u32, items: &[Item]) -> Hemicube {
    let mut hemicube = Hemicube::new(resolution);
    hemicube.draw(EYE, Vec3A::Z, items);
    hemicube
}

/// Form factors to so many ids, then the share of nothing.
fn form_factors<const N: usize>(hemicube: &Hemicube) -> ([f64; N], f64) {
    let mut sums = [0.0; N];
    let empty = hemicube.add_form_factors(&mut sums);
    (sums, empty)
}

/// The closed form from the eye to an item.
fn exact(item: &Item) -> f64 {
    form_factor(DVec3::ZERO, DVec3::Z, &item.corners.map(|corner| corner.as_dvec3()))
}

#[test]
fn midpoint_deltas_sum_to_the_published_values() {
    for (resolution, expected) in [(8, 1.0085688), (32, 1.00052964), (128, 1.00003308), (512, 1.000002067)] {
        let sum = sum_over_faces(&midpoint_deltas(resolution));
        let printed = 0.5
            * 10f64.powi(if resolution == 8 {
                -7
            } else if resolution == 512 {
                -9
            } else {
                -8
            });
        assert!((sum - expected).abs() <= 1.01 * printed, "{resolution}: {sum}");
        assert!(((sum - 1.0) * (resolution * resolution) as f64 / 0.542 - 1.0).abs() < 0.02, "{resolution}: {sum}");
    }
}

#[test]
fn deltas_sum_to_one_and_approach_the_exact_shares() {
    for resolution in [2, 8, 30, 256] {
        let hemicube = Hemicube::new(resolution);
        let sum = sum_over_faces(&hemicube.deltas);
        assert!((sum - 1.0).abs() < 1e-15 * f64::from(resolution), "{resolution}: {sum}");
    }
    let hemicube = Hemicube::new(512);
    let share = |face: usize| hemicube.face_deltas(face).iter().sum::<f64>();
    // Before they are scaled, the midpoint sums of both shares together are off by 2.1e-6.
    assert!((share(0) - 0.554_126_423_979_572).abs() < 2.1e-6);
    assert!((4.0 * share(1) - 0.445_873_576_020_428).abs() < 2.1e-6);
}

#[test]
fn a_square_at_gap_1_has_the_form_factor_of_the_point_and_not_of_the_area() {
    // The picture of the square ends between two cells, so only the sum of the midpoint rule is wrong.
    let hemicube = draw(256, &[ceiling([-0.5, -0.5], [0.5, 0.5], 1.0, 0)]);
    let ([seen], empty) = form_factors(&hemicube);
    assert!((seen - 0.239_456_470_460_774).abs() < 1e-5, "{seen}");
    assert!((seen + empty - 1.0).abs() < 1e-13);
    // At gap 0.99 its edge runs through the middle of cells: wrong by at most half of the cells along the edge, each of
    // which has less than the highest delta form factor.
    let square = ceiling([-0.5, -0.5], [0.5, 0.5], 0.99, 0);
    let ([seen], _) = form_factors(&draw(64, &[square]));
    assert!((seen - exact(&square)).abs() < 0.5 * 4.0 * 33.0 * (2.0f64 / 64.0).powi(2) / PI, "{seen}");
}

#[test]
fn a_fan_of_triangles_covers_every_cell_once() {
    let mut stream = Stream::new(5, 0, 0);
    for round in 0..50 {
        let apex = Vec3::new(stream.uniform() - 0.5, stream.uniform() - 0.5, 0.7);
        // A closed room round the eye, seen from inside: a floor-less pyramid whose rim is below the horizon.
        let count = 3 + round % 9;
        let rim: Vec<Vec3> = (0..count)
            .map(|i| (i as f32 + 0.6 * stream.uniform()) * std::f32::consts::TAU / count as f32)
            .map(|angle| Vec3::new(3.0 * angle.cos(), 3.0 * angle.sin(), -0.2))
            .collect();
        let items: Vec<Item> = (0..count).map(|i| Item::new(&[apex, rim[(i + 1) % count], rim[i]], i as u32)).collect();
        let hemicube = draw(64, &items);
        let (sums, empty) = form_factors::<12>(&hemicube);
        assert_eq!(empty, 0.0, "round {round}");
        assert!((sums.iter().sum::<f64>() - 1.0).abs() < 1e-13);
    }
}

#[test]
fn edges_through_the_middles_of_cells_leave_no_hole() {
    // Four squares meet at the direction of the middle of a cell, and their edges run through more.
    let middle = 1.0 / 16.0;
    let items = [
        ceiling([-20.0, -20.0], [middle, middle], 1.0, 0),
        ceiling([middle, -20.0], [20.0, middle], 1.0, 1),
        ceiling([-20.0, middle], [middle, 20.0], 1.0, 2),
        ceiling([middle, middle], [20.0, 20.0], 1.0, 3),
    ];
    let (sums, empty) = form_factors::<4>(&draw(16, &items));
    // Squares of half side 20 leave a rim above the horizon: less than one row of cells on each side.
    assert!(empty == 0.0 && (sums.iter().sum::<f64>() - 1.0).abs() < 1e-13, "{sums:?} {empty}");
}

#[test]
fn what_is_behind_is_hidden_in_any_order() {
    let (near, far) = (ceiling([-0.2, -0.2], [0.2, 0.2], 0.5, 0), ceiling([-2.0, -2.0], [2.0, 2.0], 1.0, 1));
    let (first, _) = form_factors::<2>(&draw(64, &[near, far]));
    let (second, _) = form_factors::<2>(&draw(64, &[far, near]));
    assert_eq!(first, second);
    let ([alone], _) = form_factors::<1>(&draw(64, &[near]));
    assert_eq!(first[0], alone);
    let [_, far_alone] = form_factors::<2>(&draw(64, &[far])).0;
    assert!((first[1] + first[0] - far_alone).abs() < 1e-13);
}

#[test]
fn a_polygon_seen_from_behind_hides_without_being_seen() {
    let far = ceiling([-2.0, -2.0], [2.0, 2.0], 1.0, 0);
    let mut turned = ceiling([-0.2, -0.2], [0.2, 0.2], 0.5, 1);
    turned.corners.reverse();
    let (sums, empty) = form_factors::<2>(&draw(64, &[far, turned]));
    let ([alone], empty_alone) = form_factors::<1>(&draw(64, &[far]));
    let hidden = form_factors::<1>(&draw(64, &[ceiling([-0.2, -0.2], [0.2, 0.2], 0.5, 0)])).0[0];
    assert_eq!(sums[1], 0.0);
    assert!((alone - sums[0] - hidden).abs() < 1e-13 && (empty - empty_alone - hidden).abs() < 1e-13);
}

#[test]
fn of_a_polygon_with_two_sides_the_one_that_faces_the_eye_is_seen() {
    let mut stream = Stream::new(6, 0, 0);
    let mut point = |scale: f32| Vec3::new(stream.uniform() - 0.5, stream.uniform() - 0.5, stream.uniform()) * scale;
    for _ in 0..100 {
        let [a, b, c] = [point(2.0), point(2.0), point(2.0)];
        let sides = [Item::new(&[a, b, c], 0), Item::new(&[c, b, a], 1)];
        let (both, _) = form_factors::<2>(&draw(32, &sides));
        assert!(both[0] == 0.0 || both[1] == 0.0);
        for side in sides {
            let (alone, _) = form_factors::<2>(&draw(32, &[side]));
            assert!(alone == both || alone == [0.0, 0.0]);
        }
    }
}

#[test]
fn a_polygon_through_the_horizon_counts_above_it() {
    // A wall at distance 1 that stands half below: the part above alone looks the same.
    let wall =
        |foot| Item::new(&[[-8.0, foot], [-8.0, 8.0], [8.0, 8.0], [8.0, foot]].map(|[y, z]| Vec3::new(1.0, y, z)), 0);
    let [([through], _), ([above], _)] = [wall(-8.0), wall(0.0)].map(|wall| form_factors::<1>(&draw(128, &[wall])));
    assert_eq!(through, above);
    // The outline of a wall so near is some 6 · 128 cells long; half of them at the mean delta form factor are 0.008.
    assert!(through > 0.4 && (through - exact(&wall(-8.0))).abs() < 0.008, "{through}");
}

#[test]
fn what_is_in_the_plane_of_the_hemicube_or_below_is_not_seen() {
    let floor = |height| ceiling([-1.0, -1.0], [1.0, 1.0], height, 0);
    for height in [0.0, -1e-7, -1.0] {
        assert_eq!(form_factors::<1>(&draw(32, &[floor(height)])), ([0.0], form_factors::<1>(&draw(32, &[])).1));
    }
}

#[test]
fn degenerate_items_are_not_seen() {
    let point = Vec3::new(0.3, 0.2, 1.0);
    for corners in [[point; 3], [point, 2.0 * point, 3.0 * point], [point, Vec3::NAN, -point]] {
        assert_eq!(form_factors::<1>(&draw(32, &[Item::new(&corners, 0)])).0, [0.0]);
    }
}

#[test]
fn the_picture_does_not_depend_on_the_scale_or_the_threads() {
    let mut stream = Stream::new(7, 0, 0);
    let mut point = || Vec3::new(stream.uniform(), stream.uniform(), stream.uniform()) - 0.5;
    let item = |id| {
        let corner = point();
        Item::new(&[corner, corner + point() * 0.3, corner + point() * 0.3], id)
    };
    let items: Vec<Item> = (0..300).map(item).collect();
    let normal = Vec3A::new(0.36, 0.48, 0.8);
    let on_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut hemicube = Hemicube::new(64);
        pool.install(|| hemicube.draw(EYE, normal, &items));
        hemicube.item_buffer()
    };
    let one = on_threads(1);
    assert_eq!(one, on_threads(2));
    assert!(one.faces.iter().all(|face| face.iter().any(|&id| id != NOTHING)));
    for scale in [2f32.powi(-40), 2f32.powi(40)] {
        let scaled: Vec<Item> =
            items.iter().map(|item| Item { corners: item.corners.map(|corner| corner * scale), ..*item }).collect();
        let mut hemicube = Hemicube::new(64);
        hemicube.draw(EYE, normal, &scaled);
        assert_eq!(one, hemicube.item_buffer());
    }
}
