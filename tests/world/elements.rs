//! Polygons cut into patches and elements.

use crate::obj::Obj;
use crate::{build, build_with, builtin};
use glam::{DVec3, Vec3};
use lightwell::cancel::Cancel;
use lightwell::math::polygon::vector_area;
use lightwell::mesh::MeshSettings;
use lightwell::world::{World, WorldError};
use proptest::prelude::*;
use std::sync::LazyLock;

/// Quads, triangles and a skew quad, in a room.
fn motley() -> lightwell::scene::Scene {
    let obj = Obj::new().object("room", "white").room(Vec3::ZERO, Vec3::ONE);
    let obj = obj.object("lamp", "lamp").level_down([0.4, 0.6], 0.9, [0.4, 0.6]).object("leaves", "white");
    let triangle = [Vec3::new(0.1, 0.1, 0.1), Vec3::new(0.5, 0.2, 0.2), Vec3::new(0.2, 0.4, 0.5)];
    let skew = [(0.6, 0.1), (0.9, 0.2), (0.8, 0.7), (0.65, 0.5)].map(|(x, z)| Vec3::new(x, 0.25, z));
    obj.face(triangle).face(skew).open()
}

#[test]
fn no_element_is_larger_than_asked_for() {
    for size in [0.3, 0.11, 0.02] {
        let world = build_with(motley(), size);
        assert_eq!(world.element_size, size);
        for element in &world.mesh.elements {
            let region = world.mesh.region(element);
            let corners = region.corners();
            let count = corners.len();
            let mut edges: Vec<f32> = (0..count).map(|i| corners[i].distance(corners[(i + 1) % count])).collect();
            edges.sort_by(f32::total_cmp);
            // Of a triangle the second longest counts.
            let longest = if count == 3 { edges[1] } else { edges[3] };
            assert!(longest <= size * (1.0 + 1e-5), "{longest} for {size}");
        }
    }
}

#[test]
fn elements_and_patches_tile_every_side() {
    let world = build_with(motley(), 0.05);
    let scene = &world.scene;
    for (index, polygon) in scene.polygons.iter().enumerate() {
        let corners: Vec<DVec3> =
            polygon.corners().iter().map(|&corner| scene.positions[corner as usize].as_dvec3()).collect();
        let expected = vector_area(&corners);
        for is_front in [true, false] {
            let Some(side) = world.mesh.side(index as u32, is_front) else { continue };
            let sign = if is_front { 1.0 } else { -1.0 };
            let patches = &world.mesh.patches[side.patches.start as usize..side.patches.end as usize];
            let elements = &world.mesh.elements[side.elements.start as usize..side.elements.end as usize];
            // Nothing stands on anything here, so that all of it is exposed.
            let of_patches: f64 = patches.iter().map(|patch| patch.area).sum();
            let of_elements: f64 = elements.iter().map(|element| element.area).sum();
            assert!((of_patches / expected.length() - 1.0).abs() < 1e-9);
            assert!((of_elements / expected.length() - 1.0).abs() < 1e-9);
            for patch in patches {
                assert_eq!((patch.polygon, patch.is_front, patch.material), (index as u32, is_front, polygon.material));
                assert!((patch.normal.as_dvec3() - sign * expected.normalize()).length() < 1e-6);
            }
        }
    }
}

#[test]
fn without_a_size_the_mesh_has_about_as_many_elements_as_stated() {
    for name in ["cornell-box", "furnace", "gallery"] {
        let elements = build(builtin(name)).mesh.elements.len() as f64;
        // Grids are rounded up to whole cells, long thin faces most.
        let range = 0.9 * MeshSettings::DEFAULT_ELEMENTS..3.0 * MeshSettings::DEFAULT_ELEMENTS;
        assert!(range.contains(&elements), "{name}: {elements}");
    }
}

proptest! {
    #[test]
    fn every_division_into_patches_covers_the_same_area(size in 0.02_f32..0.6, per_patch in prop::sample::select(vec![1, 2, 4, 8])) {
        static MOTLEY: LazyLock<World> = LazyLock::new(|| build(motley()));
        let settings = MeshSettings { element_size: Some(size), elements_per_patch_edge: per_patch };
        let mesh = MOTLEY.remeshed(&settings, &Cancel::default()).expect("a world").mesh;

        let of_patches: f64 = mesh.patches.iter().map(|patch| patch.area).sum();
        let of_elements: f64 = mesh.elements.iter().map(|element| element.area).sum();
        let of_scene = MOTLEY.mesh.area();
        prop_assert!((of_patches / of_scene - 1.0).abs() < 1e-9 && (of_elements / of_scene - 1.0).abs() < 1e-9);

        // Sides are ranges of patches, and patches are ranges of elements, one after the other.
        let (mut next_patch, mut next_element) = (0, 0);
        for side in mesh.sides.iter().flatten() {
            prop_assert_eq!((side.patches.start, side.elements.start), (next_patch, next_element));
            let cells = side.shape.cells(side.grid.elements);
            prop_assert!(side.grid.elements.iter().all(|&count| count <= per_patch));
            prop_assert_eq!(side.patches.len() as u32, side.shape.cells(side.grid.patches));
            for index in side.patches.clone() {
                let patch = &mesh.patches[index as usize];
                prop_assert_eq!(patch.elements.clone(), next_element..next_element + cells);
                let elements = &mesh.elements[patch.elements.start as usize..patch.elements.end as usize];
                prop_assert!(elements.iter().all(|element| element.patch == index));
                if per_patch == 1 {
                    prop_assert_eq!((elements.len(), elements[0].center), (1, patch.center));
                    prop_assert!((elements[0].area / patch.area - 1.0).abs() < 1e-12);
                }
                next_element += cells;
            }
            next_patch += side.patches.len() as u32;
            prop_assert_eq!((side.patches.end, side.elements.end), (next_patch, next_element));
        }
        prop_assert_eq!((next_patch as usize, next_element as usize), (mesh.patches.len(), mesh.elements.len()));
    }
}

#[test]
fn sizes_that_cannot_be_used_are_refused() {
    let refusal = |size: f32| {
        let settings = MeshSettings { element_size: Some(size), ..MeshSettings::default() };
        World::build(builtin("furnace"), &settings, &Cancel::default()).err().expect("a refusal")
    };
    for size in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(matches!(refusal(size), WorldError::ElementSize(_)), "{size}");
    }
    // One element more in each direction than fits on six squares.
    let most = (MeshSettings::MAX_ELEMENTS / 6.0).sqrt();
    for size in [1.0 / (most + 2.0), 1e-5, 1e-30] {
        let error = refusal(size as f32);
        assert!(matches!(error, WorldError::TooFine { .. }), "{size}");
        assert!(error.to_string().contains("at most 8e6"), "{error}");
    }
}

#[test]
fn a_remeshed_world_is_the_one_that_would_have_been_built() {
    let fine = MeshSettings { element_size: Some(0.06), ..MeshSettings::default() };
    for scene in [builtin("cornell-box"), motley()] {
        let built = World::build(scene.clone(), &fine, &Cancel::default()).expect("a world");
        let remeshed = build(scene).remeshed(&fine, &Cancel::default()).expect("a world");
        assert_eq!(remeshed.mesh.sides, built.mesh.sides);
        assert_eq!(remeshed.mesh.patches, built.mesh.patches);
        assert_eq!(remeshed.mesh.elements, built.mesh.elements);
        assert_eq!(remeshed.mesh.vertices, built.mesh.vertices);
        assert_eq!(remeshed.scene.polygons, built.scene.polygons);
        assert_eq!(remeshed.scene.findings, built.scene.findings);
        assert_eq!((remeshed.viewpoint, remeshed.is_closed()), (built.viewpoint, built.is_closed()));
        let refused = remeshed
            .remeshed(&MeshSettings { element_size: Some(1e-9), ..MeshSettings::default() }, &Cancel::default())
            .err()
            .expect("a refusal");
        assert!(matches!(refused, WorldError::TooFine { .. }));
    }
}

#[test]
fn a_world_that_is_not_wanted_any_more_is_not_built() {
    let cancel = Cancel::default();
    cancel.request();
    let refused = World::build(builtin("cornell-box"), &MeshSettings::default(), &cancel).err();
    assert_eq!(refused, Some(WorldError::Cancelled));
}
