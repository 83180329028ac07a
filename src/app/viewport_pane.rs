//! The scene in the window: its camera, and its way onto the graphics device.

use super::action::CameraMove;
use super::marks::Marks;
use super::model::Look;
use crate::camera::{Camera, Flight};
use crate::cli::picture::subject;
use crate::solution::{Equation, PathFilter};
use crate::viewport::{Frame, Gpu, Light, Viewport, automatic_exposure, pick_patch, pick_photon, pick_point};
use crate::worker::{Place, Sight, Snapshot, Spot};
use crate::world::World;
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use eframe::{egui_wgpu, wgpu};
use egui::{PaintCallbackInfo, Rect, Ui, Vec2};
use std::sync::Arc;
use std::time::Instant;

/// What is on show, and from where.
pub struct ViewportPane {
    render_state: RenderState,
    gpu: Gpu,
    world: Option<Arc<World>>,
    light: Option<Light>,
    camera: Option<Camera>,
    /// A way that the camera is on, and when it set off.
    flight: Option<(Flight, Instant)>,
    /// Where automatic exposure stands, in EV.
    automatic_ev: f32,
    /// Width and height in pixels when it was drawn last.
    size: [u32; 2],
}

impl ViewportPane {
    pub fn new(render_state: RenderState) -> Self {
        let gpu = Gpu::from_parts(render_state.device.clone(), render_state.queue.clone());
        let viewport = Viewport::new(&gpu, render_state.target_format);
        render_state.renderer.write().callback_resources.insert(viewport);
        Self {
            render_state,
            gpu,
            world: None,
            light: None,
            camera: None,
            flight: None,
            automatic_ev: 0.0,
            size: [1280, 960],
        }
    }

    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Uploads what is new in the snapshot. Another scene gets its own first view; the same one with another mesh, or
    /// read again, keeps the camera. Returns whether another scene came on show.
    pub fn follow(&mut self, snapshot: &Snapshot) -> bool {
        let Some(world) = &snapshot.world else { return false };
        let mut renderer = self.render_state.renderer.write();
        let Some(viewport) = renderer.callback_resources.get_mut::<Viewport>() else { return false };
        let mut is_other_scene = false;
        if !is_same(&self.world, world) {
            viewport.set_world(world);
            is_other_scene = self.world.as_ref().is_none_or(|shown| shown.scene.source != world.scene.source);
            self.world = Some(Arc::clone(world));
            self.light = None;
        }
        let light = light_of(snapshot);
        if self.light.as_ref().is_none_or(|shown| !is_same_light(shown, &light)) {
            viewport.set_light(&light);
            self.automatic_ev = automatic_exposure(world, light.solution.as_deref());
            self.light = Some(light);
        }
        if is_other_scene {
            self.camera = Some(Camera::new(&world.viewpoint, &world.bounds));
            self.flight = None;
        }
        is_other_scene
    }

    /// The exposure that `look` asks for, in EV.
    pub fn exposure_ev(&self, look: &Look) -> f32 {
        match look.exposure {
            crate::viewport::Exposure::Automatic => self.automatic_ev,
            crate::viewport::Exposure::Manual(ev) => ev,
        }
    }

    pub fn move_camera(&mut self, movement: CameraMove) {
        let (Some(camera), Some(world)) = (&mut self.camera, &self.world) else { return };
        let mut target = *camera;
        match movement {
            CameraMove::Orbit(drag) => camera.orbit(drag.x, drag.y),
            CameraMove::Pan(drag) => camera.pan(drag.x, drag.y),
            CameraMove::Zoom(factor) => camera.zoom(factor),
            CameraMove::Fit => target.fit(&world.bounds, self.size[0] as f32 / self.size[1] as f32),
            CameraMove::Home => target = Camera::new(&world.viewpoint, &world.bounds),
        }
        let flies = matches!(movement, CameraMove::Fit | CameraMove::Home);
        self.flight = flies.then(|| (Flight { from: *camera, to: target }, Instant::now()));
    }

    /// Moves a flying camera on; returns whether it is still under way.
    pub fn fly(&mut self) -> bool {
        let Some((flight, start)) = &self.flight else { return false };
        let now = flight.at(start.elapsed().as_secs_f32());
        self.camera = Some(now.unwrap_or(flight.to));
        if now.is_none() {
            self.flight = None;
        }
        now.is_some()
    }

    /// What a picture of this size shows now; `None` while no scene is open.
    pub fn frame(&self, look: &Look, filter: PathFilter, size: [u32; 2]) -> Option<Frame> {
        Some(Frame {
            camera: self.camera?,
            size,
            view: look.view,
            bounce: look.bounce,
            ambient: look.ambient,
            wireframe: look.wireframe,
            show_shooter: look.show_shooter,
            photons: look.photons,
            filter,
            exposure_ev: self.exposure_ev(look),
            tone: look.tone,
        })
    }

    /// The place on a patch that is seen at a point, in shares of the picture's width and height from the top left.
    pub fn place_at(&self, at: Vec2) -> Option<Place> {
        let (world, camera) = (self.world.as_ref()?, self.camera.as_ref()?);
        let patch = pick_patch(world, camera, self.pixel(at), self.size)?;
        let (point, _) = pick_point(world, camera, self.pixel(at), self.size)?;
        Some(Place { world: Arc::clone(world), patch, point })
    }

    /// The middle of the patch with this index.
    pub fn middle_of(&self, patch: u32) -> Option<Place> {
        let world = self.world.as_ref()?;
        let point = world.mesh.patches.get(patch as usize)?.center.into();
        Some(Place { world: Arc::clone(world), patch, point })
    }

    /// The points of an equation, as they are seen now.
    pub fn marks(&self, equation: &Equation) -> Option<Marks> {
        Some(Marks::of(equation, self.camera.as_ref()?, self.size))
    }

    /// The photon that is seen nearest to a point, a few pixels away at most.
    pub fn photon_at(&self, at: Vec2, look: &Look, filter: PathFilter) -> Option<u32> {
        let (world, photons) = (self.world.as_ref()?, self.light.as_ref()?.photons.as_ref()?);
        let frame = self.frame(look, filter, self.size)?;
        pick_photon(world, &photons.photons, &frame, self.pixel(at)).filter(|_| look.view.shows_photons())
    }

    /// The point of a surface that is seen at a point of the viewport.
    pub fn spot_at(&self, at: Vec2) -> Option<Spot> {
        let (world, camera) = (self.world.as_ref()?, self.camera.as_ref()?);
        pick_point(world, camera, self.pixel(at), self.size).map(|(point, normal)| Spot { point, normal })
    }

    /// From shares of width and height.
    fn pixel(&self, at: Vec2) -> [f32; 2] {
        (at * Vec2::new(self.size[0] as f32, self.size[1] as f32)).into()
    }

    /// What is on show, as the solver thread is told it; `None` while no scene is open.
    pub fn sight(&self, look: &Look) -> Option<Sight> {
        Some(Sight { subject: subject(look.view), camera: self.camera?, size: self.size })
    }

    /// The world and the light on show.
    pub fn shown(&self) -> Option<(&Arc<World>, &Light)> {
        self.world.as_ref().zip(self.light.as_ref())
    }

    /// Has the scene painted into `rect`.
    pub fn paint(&mut self, ui: &Ui, rect: Rect, look: &Look, filter: PathFilter) {
        // As egui rounds it: the edges go to whole pixels, not the size.
        let [min, max] = [rect.min, rect.max].map(|corner| corner.to_vec2() * ui.pixels_per_point());
        let pixels = (max.round() - min.round()).max(Vec2::splat(1.0));
        self.size = [pixels.x as u32, pixels.y as u32];
        if let Some(frame) = self.frame(look, filter, self.size) {
            ui.painter().add(Callback::new_paint_callback(rect, ScenePainter { frame }));
        }
    }
}

/// All that a snapshot knows of the light in its world.
fn light_of(snapshot: &Snapshot) -> Light {
    Light {
        solution: snapshot.solution.clone(),
        picked: snapshot.picked.clone(),
        photons: snapshot.photons.clone(),
        occlusion: snapshot.occlusion.clone(),
        image: snapshot.image.clone(),
        trail: snapshot.trail.clone(),
        gathered: snapshot.gathered.clone(),
    }
}

/// Whether two share every part.
fn is_same_light(one: &Light, other: &Light) -> bool {
    fn is_shared<T>(one: &Option<Arc<T>>, other: &Option<Arc<T>>) -> bool {
        one.as_ref().map(Arc::as_ptr) == other.as_ref().map(Arc::as_ptr)
    }
    is_shared(&one.solution, &other.solution)
        && is_shared(&one.picked, &other.picked)
        && is_shared(&one.photons, &other.photons)
        && is_shared(&one.occlusion, &other.occlusion)
        && is_shared(&one.image, &other.image)
        && is_shared(&one.trail, &other.trail)
        && is_shared(&one.gathered, &other.gathered)
}

fn is_same<T>(shown: &Option<Arc<T>>, new: &Arc<T>) -> bool {
    shown.as_ref().is_some_and(|shown| Arc::ptr_eq(shown, new))
}

/// Draws one frame within egui's own.
struct ScenePainter {
    frame: Frame,
}

impl CallbackTrait for ScenePainter {
    fn prepare(
        &self,
        _device: &wgpu::Device,
        _queue: &wgpu::Queue,
        _screen: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(viewport) = resources.get_mut::<Viewport>() {
            viewport.draw(encoder, &self.frame);
        }
        Vec::new()
    }

    fn paint(
        &self,
        _info: PaintCallbackInfo,
        pass: &mut egui_wgpu::wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        if let Some(viewport) = resources.get::<Viewport>() {
            viewport.present(pass);
        }
    }
}
