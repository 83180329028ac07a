//! The keys of the window: one table that drives the window, its menus, its tooltips and its help.

use super::action::{Action, CameraMove};
use super::model::{Dialog, Look, LowerPanel, Model};
use crate::solution::{CameraView, Judged};
use crate::viewport::{PhotonLook, View};
use crate::worker::Command;
use egui::{Event, InputState, Key, KeyboardShortcut, Modifiers};

/// A key, what it is for, and what it asks of the window as it stands.
pub struct Binding {
    pub shortcut: KeyboardShortcut,
    /// `Run or pause`
    pub purpose: &'static str,
    /// Whether holding the key down asks again and again.
    repeats: bool,
    action: fn(&Model) -> Option<Action>,
}

impl Binding {
    const fn new(shortcut: KeyboardShortcut, purpose: &'static str, action: fn(&Model) -> Option<Action>) -> Self {
        Self { shortcut, purpose, repeats: false, action }
    }

    const fn repeating(self) -> Self {
        Self { repeats: true, ..self }
    }
}

const fn key(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

pub const RUN: KeyboardShortcut = key(Key::Space);
pub const STEP_1: KeyboardShortcut = key(Key::ArrowRight);
pub const STEP_10: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::ArrowRight);
pub const STEP_100: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::ArrowRight);
pub const RESET: KeyboardShortcut = key(Key::R);
pub const PATCHES: KeyboardShortcut = key(Key::Num1);
pub const SMOOTH: KeyboardShortcut = key(Key::Num2);
pub const UNSHOT: KeyboardShortcut = key(Key::Num3);
pub const ABSORBED: KeyboardShortcut = key(Key::Num4);
pub const BOUNCES: KeyboardShortcut = key(Key::Num5);
pub const FORM_FACTORS: KeyboardShortcut = key(Key::Num6);
pub const PHOTONS: KeyboardShortcut = key(Key::Num7);
pub const KD_TREE: KeyboardShortcut = key(Key::Num8);
pub const PHOTON_IRRADIANCE: KeyboardShortcut = key(Key::Num9);
pub const PHOTON_RADIANCE: KeyboardShortcut = key(Key::Num0);
pub const CAUSTICS: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num1);
pub const RAY_TRACED: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num2);
pub const RADIOSITY_SPECULAR: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num3);
pub const FINAL_GATHER: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num4);
pub const AMBIENT_OCCLUSION: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num5);
pub const DIFFUSE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num6);
pub const DIFFUSE_AMBIENT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num7);
pub const OCCLUSION_VERTICES: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num8);
pub const AMBIENT_MINUS_INDIRECT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num9);
pub const REFERENCE: KeyboardShortcut = KeyboardShortcut::new(Modifiers::SHIFT, Key::Num0);
pub const RADIOSITY_DIRECT: KeyboardShortcut = key(Key::D);
pub const ERROR: KeyboardShortcut = key(Key::X);
pub const WIREFRAME: KeyboardShortcut = key(Key::W);
pub const SHOOTER: KeyboardShortcut = key(Key::O);
pub const TICKS: KeyboardShortcut = key(Key::T);
pub const UNPICK: KeyboardShortcut = key(Key::Escape);
pub const EQUATION: KeyboardShortcut = key(Key::E);
pub const CONVERGENCE: KeyboardShortcut = key(Key::C);
pub const ACCURACY: KeyboardShortcut = key(Key::P);
pub const HARD_CASES: KeyboardShortcut = key(Key::K);
pub const MATRIX: KeyboardShortcut = key(Key::M);
pub const AMBIENT: KeyboardShortcut = key(Key::A);
pub const LESS_BOUNCES: KeyboardShortcut = key(Key::Comma);
pub const MORE_BOUNCES: KeyboardShortcut = key(Key::Period);
pub const FIT: KeyboardShortcut = key(Key::F);
pub const HOME: KeyboardShortcut = key(Key::H);
pub const SAVE_PICTURE: KeyboardShortcut = key(Key::S);
pub const OPEN: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::O);
pub const QUIT: KeyboardShortcut = KeyboardShortcut::new(Modifiers::COMMAND, Key::Q);
pub const HELP: KeyboardShortcut = key(Key::F1);

/// Every key of the window, in the order of its help.
pub const BINDINGS: &[Binding] = &[
    Binding::new(RUN, "Run or pause", |model| model.can_run().then(|| run_or_pause(model))),
    Binding::new(STEP_1, "One step: a shot, a sweep or a batch", |model| step(model, 1)).repeating(),
    Binding::new(STEP_10, "Ten steps", |model| step(model, 10)),
    Binding::new(STEP_100, "A hundred steps", |model| step(model, 100)),
    Binding::new(RESET, "Start over from the emitters", |model| {
        model.scene.is_some().then_some(Action::Send(Command::Reset))
    }),
    Binding::new(PATCHES, "View: one colour a patch", |model| view(model, View::Patches)),
    Binding::new(SMOOTH, "View: smooth light", |model| view(model, View::Smooth)),
    Binding::new(UNSHOT, "View: light not shot yet", |model| view(model, View::Unshot)),
    Binding::new(ABSORBED, "View: absorbed light", |model| view(model, View::Absorbed)),
    Binding::new(BOUNCES, "View: light after some bounces", |model| view(model, View::Bounces)),
    Binding::new(FORM_FACTORS, "View: form factors from the picked patch", |model| view(model, View::FormFactors)),
    Binding::new(PHOTONS, "View: photons", |model| view(model, View::Photons)),
    Binding::new(KD_TREE, "View: photons and their kd-tree", |model| view(model, View::KdTree)),
    Binding::new(PHOTON_IRRADIANCE, "View: irradiance from photons", |model| {
        view(model, View::Camera(CameraView::PhotonIrradiance))
    }),
    Binding::new(PHOTON_RADIANCE, "View: radiance from photons", |model| {
        view(model, View::Camera(CameraView::PhotonRadiance))
    }),
    Binding::new(CAUSTICS, "View: caustics", |model| view(model, View::Camera(CameraView::Caustics))),
    Binding::new(RAY_TRACED, "View: ray-traced", |model| view(model, View::Camera(CameraView::RayTraced))),
    Binding::new(RADIOSITY_SPECULAR, "View: radiosity with specular surfaces traced", |model| {
        view(model, View::Camera(CameraView::RadiositySpecular))
    }),
    Binding::new(RADIOSITY_DIRECT, "View: radiosity with direct light by rays", |model| {
        view(model, View::Camera(CameraView::RadiosityDirect))
    }),
    Binding::new(FINAL_GATHER, "View: final gather", |model| view(model, View::Camera(CameraView::FinalGather))),
    Binding::new(AMBIENT_OCCLUSION, "View: ambient occlusion", |model| {
        view(model, View::Camera(CameraView::AmbientOcclusion))
    }),
    Binding::new(DIFFUSE, "View: diffuse colour in direct light", |model| {
        view(model, View::Camera(CameraView::Diffuse))
    }),
    Binding::new(DIFFUSE_AMBIENT, "View: the same with ambient occlusion", |model| {
        view(model, View::Camera(CameraView::DiffuseAmbient))
    }),
    Binding::new(OCCLUSION_VERTICES, "View: ambient occlusion on the mesh", |model| {
        view(model, View::OcclusionVertices)
    }),
    Binding::new(AMBIENT_MINUS_INDIRECT, "View: ambient occlusion against indirect light", |model| {
        view(model, View::Camera(CameraView::AmbientMinusIndirect))
    }),
    Binding::new(REFERENCE, "View: the unbiased reference", |model| view(model, View::Camera(CameraView::Reference))),
    Binding::new(ERROR, "View: the error of what is shown, and back", |model| {
        view(model, error_and_back(model.look.view))
    }),
    Binding::new(WIREFRAME, "Show or hide the elements' edges", |model| {
        Some(Action::SetLook(Look { wireframe: !model.look.wireframe, ..model.look }))
    }),
    Binding::new(SHOOTER, "Show or hide the outline of the shooter", |model| {
        Some(Action::SetLook(Look { show_shooter: !model.look.show_shooter, ..model.look }))
    }),
    Binding::new(TICKS, "Show or hide where photons came from", |model| {
        let photons = PhotonLook { ticks: !model.look.photons.ticks, ..model.look.photons };
        Some(Action::SetLook(Look { photons, ..model.look }))
    }),
    Binding::new(AMBIENT, "Show or hide the light to come, as its mean", |model| {
        Some(Action::SetLook(Look { ambient: !model.look.ambient, ..model.look }))
    }),
    Binding::new(LESS_BOUNCES, "View of bounces: one less", |model| bounce(model, -1)).repeating(),
    Binding::new(MORE_BOUNCES, "View of bounces: one more", |model| bounce(model, 1)).repeating(),
    Binding::new(UNPICK, "Forget what is picked", |model| model.has_pick().then_some(Action::Unpick)),
    Binding::new(EQUATION, "Open or close the rendering equation", |model| lower(model, LowerPanel::Equation)),
    Binding::new(CONVERGENCE, "Open or close the convergence chart", |model| lower(model, LowerPanel::Convergence)),
    Binding::new(ACCURACY, "Open or close the chart of errors over time", |model| lower(model, LowerPanel::Accuracy)),
    Binding::new(HARD_CASES, "Open or close the hard cases", |model| lower(model, LowerPanel::HardCases)),
    Binding::new(MATRIX, "Show the matrix of form factors", |_| Some(Action::ShowDialog(Dialog::Matrix))),
    Binding::new(FIT, "Fit the scene into the view", |model| camera(model, CameraMove::Fit)),
    Binding::new(HOME, "Back to the first view of the scene", |model| camera(model, CameraMove::Home)),
    Binding::new(SAVE_PICTURE, "Save a picture of the view", |model| {
        model.scene.is_some().then_some(Action::SavePictureNow)
    }),
    Binding::new(OPEN, "Open a scene", |_| Some(Action::BrowseForScene)),
    Binding::new(HELP, "Show these keys", |_| Some(Action::ShowDialog(Dialog::Keys))),
    Binding::new(QUIT, "Quit", |_| Some(Action::Quit)),
];

/// The key of a view.
pub fn of_view(view: View) -> KeyboardShortcut {
    match view {
        View::Patches => PATCHES,
        View::Smooth => SMOOTH,
        View::Unshot => UNSHOT,
        View::Absorbed => ABSORBED,
        View::Bounces => BOUNCES,
        View::FormFactors => FORM_FACTORS,
        View::Photons => PHOTONS,
        View::KdTree => KD_TREE,
        View::OcclusionVertices => OCCLUSION_VERTICES,
        View::Camera(CameraView::PhotonIrradiance) => PHOTON_IRRADIANCE,
        View::Camera(CameraView::PhotonRadiance) => PHOTON_RADIANCE,
        View::Camera(CameraView::Caustics) => CAUSTICS,
        View::Camera(CameraView::RayTraced) => RAY_TRACED,
        View::Camera(CameraView::RadiositySpecular) => RADIOSITY_SPECULAR,
        View::Camera(CameraView::RadiosityDirect) => RADIOSITY_DIRECT,
        View::Camera(CameraView::FinalGather) => FINAL_GATHER,
        View::Camera(CameraView::AmbientOcclusion) => AMBIENT_OCCLUSION,
        View::Camera(CameraView::Diffuse) => DIFFUSE,
        View::Camera(CameraView::DiffuseAmbient) => DIFFUSE_AMBIENT,
        View::Camera(CameraView::AmbientMinusIndirect) => AMBIENT_MINUS_INDIRECT,
        View::Camera(CameraView::Reference) => REFERENCE,
        View::Camera(CameraView::Error(_)) => ERROR,
    }
}

/// The key of a panel below the viewport.
pub fn of_lower_panel(panel: LowerPanel) -> KeyboardShortcut {
    match panel {
        LowerPanel::Equation => EQUATION,
        LowerPanel::Convergence => CONVERGENCE,
        LowerPanel::Accuracy => ACCURACY,
        LowerPanel::HardCases => HARD_CASES,
    }
}

/// What the transport's first button and its key ask for.
pub fn run_or_pause(model: &Model) -> Action {
    Action::Send(if model.is_running() { Command::Pause } else { Command::Run })
}

/// The error of what a view shows; of an error, what it is of.
pub fn error_and_back(view: View) -> View {
    match view {
        View::Camera(CameraView::Error(Judged::Patches)) => View::Patches,
        View::Camera(CameraView::Error(judged)) => View::Camera(judged.view()),
        view => View::Camera(CameraView::Error(view.judged())),
    }
}

fn step(model: &Model, steps: u64) -> Option<Action> {
    model.can_run().then_some(Action::Send(Command::Step(steps)))
}

fn view(model: &Model, view: View) -> Option<Action> {
    Some(Action::SetLook(Look { view, ..model.look }))
}

fn bounce(model: &Model, change: isize) -> Option<Action> {
    let last = model.last_bounce();
    let bounce = model.look.bounce.min(last).checked_add_signed(change).filter(|bounce| *bounce <= last)?;
    (model.look.view == View::Bounces).then_some(Action::SetLook(Look { bounce, ..model.look }))
}

fn lower(model: &Model, panel: LowerPanel) -> Option<Action> {
    Some(Action::ShowLowerPanel(Some(panel).filter(|panel| model.lower != Some(*panel))))
}

fn camera(model: &Model, movement: CameraMove) -> Option<Action> {
    model.scene.is_some().then_some(Action::Camera(movement))
}

/// What has the keyboard.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Focus {
    /// Nothing: every key is the window's.
    Window,
    /// A control that Space and the arrows work on.
    Control,
    /// Text that is being edited: every key belongs to it.
    Text,
}

impl Focus {
    pub fn of(ctx: &egui::Context) -> Self {
        match ctx.egui_wants_keyboard_input() {
            _ if ctx.text_edit_focused() => Self::Text,
            true => Self::Control,
            false => Self::Window,
        }
    }
}

/// Takes the keys that were pressed in this frame. `before` is the focus that the frame began with: a field that is
/// left by Enter owns what was typed in the same frame. While a dialog is open, no key reaches the window behind it.
pub fn read(ctx: &egui::Context, before: Focus, model: &Model, actions: &mut Vec<Action>) {
    let focus = [before, Focus::of(ctx)];
    if focus.contains(&Focus::Text) || model.dialog.is_some() {
        return;
    }
    let control_has_focus = focus.contains(&Focus::Control);
    // The table has plain keys first, but a key with modifiers must be tried before the same key without.
    for needs_modifiers in [true, false] {
        for binding in BINDINGS.iter().filter(|b| b.shortcut.modifiers.any() == needs_modifiers) {
            let belongs_to_control = matches!(binding.shortcut.logical_key, Key::Space | Key::ArrowRight);
            if control_has_focus && belongs_to_control {
                continue;
            }
            if ctx.input_mut(|input| take(input, binding)) {
                actions.extend((binding.action)(model));
            }
        }
    }
}

/// Whether the binding's key went down in this frame; removes its events.
fn take(input: &mut InputState, binding: &Binding) -> bool {
    let mut pressed = false;
    input.events.retain(|event| match event {
        Event::Key { key, physical_key, pressed: true, repeat, modifiers }
            if is_key(binding.shortcut.logical_key, *key, *physical_key)
                && modifiers.matches_exact(binding.shortcut.modifiers) =>
        {
            pressed |= binding.repeats || !repeat;
            false
        }
        _ => true,
    });
    pressed
}

const DIGITS: [Key; 10] =
    [Key::Num0, Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8, Key::Num9];

/// Whether `wanted` was pressed. With Shift, a digit's key is for another sign, which depends on the keyboard: there the
/// place of the key tells.
fn is_key(wanted: Key, key: Key, place: Option<Key>) -> bool {
    key == wanted || (DIGITS.contains(&wanted) && place == Some(wanted))
}
