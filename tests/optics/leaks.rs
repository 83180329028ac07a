//! Shading normals bend light, and let none through a surface.

use crate::{smooth_ball, transport};
use glam::{Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::math::warp::{cosine_hemisphere, frame};
use lightwell::methods::transport::Media;
use lightwell::tracer::Ray;

const MTL: &str = "newmtl mixed\nKd 0.3 0.3 0.3\nKs 0.5 0.5 0.5\nNs 3\nnewmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\n\
                   newmtl glass\nKd 0 0 0\nNi 1.5\nillum 7\n";

/// A ray from outside at a point in the ball of radius 1: many of them graze it.
fn ray_from_outside(stream: &mut Stream) -> Ray {
    let mut unit = || (Vec3A::from((stream.uniform2() - 0.5).extend(stream.uniform() - 0.5))).normalize();
    let (eye, target) = (3.0 * unit(), 0.98 * unit());
    Ray::new(eye, (target - eye).normalize())
}

/// An octahedron and a ball of 32 faces, whose normals are up to 55° and 30° off.
#[test]
fn nothing_gets_into_a_coarse_ball_that_is_opaque() {
    for (material, depth) in [("mixed", 0), ("mirror", 0), ("mixed", 1), ("mirror", 1)] {
        let transport = transport(&smooth_ball("ball", material, depth, 1.0), MTL);
        let mut stream = Stream::new(13, 0, 0);
        let (mut met, mut bent) = (0, 0);
        for _ in 0..20_000 {
            let ray = ray_from_outside(&mut stream);
            let Some(surface) = transport.meet(&ray) else { continue };
            met += 1;
            bent += u32::from(surface.normal.dot(-ray.direction) < 0.0);
            assert!(surface.is_front && surface.normal.dot(surface.facing) > 0.0);
            let bsdf = transport.bsdf(&surface, -ray.direction, &Media::default());
            let into = -(frame(surface.facing) * cosine_hemisphere(stream.uniform2()));
            assert_eq!(bsdf.value(into), [Vec3::ZERO; 2], "no light through the polygon");
            let Some(sample) = bsdf.sample(Vec3::ONE, &mut stream) else { continue };
            assert!(!sample.crosses && sample.direction.dot(surface.facing) > 0.0);
            assert!((sample.direction.length() - 1.0).abs() < 1e-5);
            // The ball is convex: what is reflected meets nothing.
            let next = transport.meet(&transport.leave(&surface, sample.direction));
            assert!(next.is_none(), "{material}, depth {depth}: it met {next:?}");
        }
        assert!(met > 5000 && bent > 100, "{met} rays met it, {bent} of them the back of its normal");
    }
}

#[test]
fn what_enters_a_coarse_ball_of_glass_is_inside_and_what_leaves_it_outside() {
    for depth in [0, 1, 3] {
        let transport = transport(&smooth_ball("ball", "glass", depth, 1.0), MTL);
        let mut stream = Stream::new(14, 0, 0);
        let mut left = 0;
        for _ in 0..5000 {
            let (mut ray, mut media) = (ray_from_outside(&mut stream), Media::default());
            for _ in 0..100 {
                let Some(surface) = transport.meet(&ray) else {
                    assert_eq!(media, Media::default(), "what has left is in the air");
                    left += 1;
                    break;
                };
                assert_eq!(surface.is_front, media == Media::default(), "fronts are met from the air");
                let bsdf = transport.bsdf(&surface, -ray.direction, &media);
                let sample = bsdf.sample(Vec3::ONE, &mut stream).expect("clear glass");
                assert_eq!(sample.crosses, sample.direction.dot(surface.facing) < 0.0);
                media = if sample.crosses { media.across(&surface) } else { media };
                ray = transport.leave(&surface, sample.direction);
            }
        }
        // Light that is reflected totally in an octahedron may stay for long.
        assert!(left > 4000, "{left} left a ball of depth {depth}");
    }
}
