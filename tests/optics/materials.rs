//! What MTL files state of mirrors, gloss and glass, and what is made of it.

use crate::scene;
use glam::Vec3;
use lightwell::scene::{Finding, FindingKind, Material, Severity};

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl it\nf 1 2 3\n";

/// A material that is in use, and what there is to say about it.
fn material(statements: &str) -> (Material, Vec<Finding>) {
    let scene = scene(TRIANGLE, &format!("newmtl it\n{statements}\n"));
    let told = |finding: &Finding| finding.subject.contains("material");
    (scene.materials[0].clone(), scene.findings.into_iter().filter(told).collect())
}

fn severities(findings: &[Finding]) -> Vec<(FindingKind, Severity)> {
    findings.iter().map(|finding| (finding.kind, finding.severity)).collect()
}

#[test]
fn specular_materials_are_noted_and_nothing_more() {
    let note = [(FindingKind::SpecularIgnored, Severity::Note)];
    for statements in
        ["Kd 0.1 0.1 0.1\nKs 0.5 0.5 0.5", "Kd 0 0 0\nKs 1 1 1\nillum 3", "Kd 0 0 0\nillum 7", "Kd 0 0 0\nd 0.5"]
    {
        let (_, findings) = material(statements);
        assert_eq!(severities(&findings), note, "{statements}: {findings:#?}");
    }
    for statements in ["Kd 0.9 0.9 0.9\nKs 1 1 1\nillum 1", "Kd 0.9 0.9 0.9\nillum 3", "Kd 0.9 0.9 0.9\nTf 0 0 0"] {
        let (_, findings) = material(statements);
        assert!(findings.is_empty(), "{statements}: {findings:#?}");
    }
}

#[test]
fn what_reflects_too_much_is_scaled_by_one_factor() {
    // The ball of CornellBox-Glossy: its blue leaves 0.337 to a Ks of 0.9.
    let (ball, findings) = material("Kd 0.486 0.631 0.663\nKs 0.9 0.9 0.9\nNs 40\nillum 2");
    assert_eq!(severities(&findings)[0], (FindingKind::SpecularScaled, Severity::Warning));
    assert_eq!(findings[0].subject, "material 'it'");
    assert!(ball.specular.distance(Vec3::splat(0.337)) < 1e-6, "{}", ball.specular);
    assert_eq!(ball.diffuse, Vec3::new(0.486, 0.631, 0.663));
    // Whatever is stated, and in whatever order, no more leaves than arrives.
    for model in 0..=10 {
        for kd in [0.0, 0.3, 0.71, 1.0, 7.0] {
            for ks in [0.0, 0.2, 0.3, 1.0, 5.0] {
                for d in [0.0, 0.3, 1.0] {
                    let statements =
                        format!("Ks {ks} 0.5 {ks}\nillum {model}\nNi 1.5\nd {d}\nTf 1 1 0.9\nKd {kd} {kd} 0.4");
                    let lobes = material(&statements).0.lobes();
                    let sum = lobes.diffuse + lobes.glossy + lobes.mirror + Vec3::splat(lobes.glass) + lobes.straight;
                    // Four roundings.
                    assert!(sum.max_element() <= 1.0 + 2.0 * f32::EPSILON, "{statements}: {sum}");
                    assert!(lobes.filter.max_element() <= 1.0);
                }
            }
        }
    }
}

#[test]
fn a_dark_grey_filter_is_read_as_what_is_kept_back() {
    // The glass ball of CornellBox-Sphere.
    let glass = "Kd 0.01 0.01 0.01\nKs 0.3 0.3 0.3\nTf 0.1 0.1 0.1\nNs 200\nNi 2.5\nillum 7";
    let (ball, findings) = material(glass);
    // Its light passes two boundaries.
    assert!(ball.lobes().filter.distance(Vec3::splat(0.9_f32.sqrt())) < 1e-6);
    assert_eq!(severities(&findings)[0], (FindingKind::FilterInverted, Severity::Warning));
    for (filter, passes) in [
        ("", Vec3::ONE),
        ("Tf 1 1 1", Vec3::ONE),
        ("Tf 0.9 0.9 0.9", Vec3::splat(0.9)),
        ("Tf 0.1 0.4 0.1", Vec3::new(0.1, 0.4, 0.1)),
    ] {
        for model in ["illum 7", "d 0"] {
            let (filtering, findings) = material(&format!("Kd 0 0 0\n{model}\n{filter}"));
            let lobes = filtering.lobes();
            // A body of glass has two boundaries.
            let passes = if model == "illum 7" { passes.map(f32::sqrt) } else { passes };
            assert_eq!(lobes.filter + lobes.straight, passes, "{filter}");
            assert_eq!(findings.len(), 1, "{filter}: {findings:?}");
        }
    }
}
