//! The image of a lamp in a mirror.

use crate::transport;
use glam::{Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::methods::transport::Media;
use lightwell::tracer::Ray;

const MTL: &str = "newmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3\nnewmtl lamp\nKd 0.5 0.5 0.5\nKe 3 2 1\n";

/// A mirror of 8 m × 8 m in the plane y = 0, and a lamp of 1 m × 0.6 m over it that shines down.
const OBJ: &str = "v -4 0 -4\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nv 1 2 0\nv 2 2 0\nv 2 2 0.6\nv 1 2 0.6\n\
                   o mirror\nusemtl mirror\nf 1 2 3 4\no lamp\nusemtl lamp\nf 5 6 7 8\n";

#[test]
fn rays_to_the_image_of_a_lamp_meet_the_lamp() {
    let transport = transport(OBJ, MTL);
    let mut stream = Stream::new(6, 0, 0);
    for _ in 0..2000 {
        let eye = Vec3A::new(4.0 * stream.uniform() - 2.0, 0.2 + stream.uniform(), 4.0 * stream.uniform() - 2.0);
        let at = 1.4 * stream.uniform2() - 0.2;
        let lamp = Vec3A::new(1.0 + at.x, 2.0, 0.6 * at.y);
        let image = lamp * Vec3A::new(1.0, -1.0, 1.0);
        let ray = Ray::new(eye, (image - eye).normalize());
        let mirror = transport.meet(&ray).expect("the mirror");
        assert_eq!(mirror.polygon, 0);
        let bsdf = transport.bsdf(&mirror, -ray.direction, &Media::default());
        let sample = bsdf.sample(Vec3::ONE, &mut stream).expect("it reflects all");
        assert!(sample.is_sharp && !sample.crosses && sample.weight.distance(Vec3::ONE) < 1e-6);
        let end = transport.meet(&transport.leave(&mirror, sample.direction));
        // The ray leaves from 32 ε · 4 m = 1.5e-5 m over the mirror, and meets it at up to 80°.
        let inside = at.min(1.0 - at).min_element();
        if inside > 1e-4 {
            let end = end.expect("the lamp");
            assert!(end.point.distance(lamp) < 1e-4, "{} instead of {lamp}", end.point);
            assert_eq!(transport.emission(&end), Vec3::new(3.0, 2.0, 1.0));
            // Seen in the mirror it is as far as its image.
            let way = mirror.distance + end.distance;
            assert!((way - eye.distance(image)).abs() < 1e-4);
        } else if inside < -1e-4 {
            assert!(end.is_none(), "beside the lamp there is nothing");
        }
    }
}
