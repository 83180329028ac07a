//! What is drawn when, and what cannot be drawn.

use crate::{frame, gpu, light, motley, solution, square};
use lightwell::viewport::{Frame, GpuError, ToneCurve, View, Viewport, render_picture};

#[test]
fn nothing_is_drawn_again_that_has_not_changed() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    let mut viewport = Viewport::new(&gpu, wgpu::TextureFormat::Bgra8Unorm);
    let frame = frame(&world, View::Smooth);
    let mut draw = |change: &dyn Fn(&mut Viewport), frame: &Frame| {
        change(&mut viewport);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        viewport.draw(&mut encoder, frame);
        gpu.queue.submit([encoder.finish()]);
        viewport.draws()
    };
    let nothing = |_: &mut Viewport| ();
    assert_eq!(draw(&nothing, &frame), 0, "there is no world yet");
    assert_eq!(draw(&|viewport| viewport.set_world(&world), &frame), 1);
    assert_eq!(draw(&|viewport| viewport.set_light(&light(&solution)), &frame), 2);
    assert_eq!(draw(&nothing, &frame), 2);
    assert_eq!(draw(&nothing, &Frame { size: [0, 9], ..frame }), 2, "there is nothing to draw on");
    assert_eq!(draw(&nothing, &Frame { exposure_ev: 1.0, tone: ToneCurve::Linear, ..frame }), 2, "that is presenting");
    let mut turned = frame;
    turned.camera.orbit(0.1, 0.0);
    let different = [
        turned,
        frame,
        Frame { view: View::Unshot, ..frame },
        Frame { ambient: true, ..frame },
        Frame { bounce: 1, ..frame },
        Frame { wireframe: true, ..frame },
        Frame { show_shooter: true, ..frame },
        Frame { size: [64, 64], ..frame },
    ];
    for (count, frame) in (3..).zip(different) {
        assert_eq!(draw(&nothing, &frame), count);
        assert_eq!(draw(&nothing, &frame), count);
    }
    gpu.check().expect("a device that works");
}

#[test]
fn a_picture_that_is_empty_or_too_large_is_refused() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    let limit = gpu.device.limits().max_texture_dimension_2d;
    for size in [[0, 4], [4, 0], [limit + 1, 4], [4, u32::MAX]] {
        let frame = Frame { size, ..frame(&world, View::Patches) };
        let error = render_picture(&gpu, &world, &light(&solution), &frame, 4).expect_err("too large");
        assert!(matches!(error, GpuError::PictureSize { limit: stated, .. } if stated == limit), "{error}");
    }
}

#[test]
fn a_lost_device_is_an_error() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    gpu.device.destroy();
    let error =
        render_picture(&gpu, &world, &light(&solution), &frame(&world, View::Patches), 4).expect_err("no device");
    assert!(matches!(error, GpuError::Failed(_)), "{error}");
}
