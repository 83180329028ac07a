//! What the radiosity solver is told: how to solve, how finely to cut, how many rays to trace, when to stop. Only what the
//! chosen solver and form factors use is shown.

use super::{apply_when_done, count};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::{Model, SceneFacts};
use crate::app::panels::widgets::{Segment, choice, labelled, row, segmented, slider};
use crate::app::theme::UNIT;
use crate::methods::{FormFactorMethod, Settings, Solver};
use egui::{Checkbox, Ui};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let settings = model.settings;
    solver(ui, settings, actions);
    if settings.solver == Solver::Progressive {
        overshoot(ui, settings, actions);
    }
    form_factors(ui, settings, actions);
    match settings.form_factor {
        FormFactorMethod::Centroid | FormFactorMethod::Disc | FormFactorMethod::Polygon => {
            shadow_rays(ui, settings, actions);
        }
        FormFactorMethod::Rays => light_rays(ui, settings, actions),
        FormFactorMethod::Hemicube => hemicube_resolution(ui, settings, actions),
    }
    if let Some(scene) = model.scene {
        element_size(ui, settings, scene, actions);
    }
    patch_edge(ui, settings, actions);
    stop_limit(ui, settings, actions);
}

fn solver(ui: &mut Ui, settings: Settings, actions: &mut Vec<Action>) {
    let hover = "How the equations B = M + ρ Σ F B are solved";
    if let Some(solver) = choice(ui, "Solver", hover, settings.solver) {
        actions.push(Action::ApplySettings(Settings { solver, ..settings }));
    }
}

fn overshoot(ui: &mut Ui, settings: Settings, actions: &mut Vec<Action>) {
    let mut overshoot = settings.overshoot;
    let hover = "Each shot also carries the light that its patch is expected to receive later; what was too much is \
                 taken back by later shots";
    let response = row(ui, "Overshoot", hover, |ui, _| ui.add(Checkbox::new(&mut overshoot, "Shoot ahead")));
    if response.accessible_name("Overshoot").on_hover_text(hover).changed() {
        actions.push(Action::ApplySettings(Settings { overshoot, ..settings }));
    }
}

fn form_factors(ui: &mut Ui, settings: Settings, actions: &mut Vec<Action>) {
    let hover = "How the share of the light of one patch that arrives at another is computed";
    if let Some(form_factor) = choice(ui, "Form factors", hover, settings.form_factor) {
        actions.push(Action::ApplySettings(Settings { form_factor, ..settings }));
    }
}

fn shadow_rays(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Rays from each receiving point to the shooter, which find out how much of it is in sight";
    let response = count(ui, "Shadow rays", hover, &mut settings.shadow_rays, 1..=Settings::MAX_SHADOW_RAYS);
    apply_when_done(&response, settings, actions);
}

fn light_rays(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Rays that carry all the emitted flux; a patch shoots its share of them. Four times the rays halve the \
                 noise.";
    let range = Settings::MIN_LIGHT_RAYS..=Settings::MAX_LIGHT_RAYS;
    let response = count(ui, "Light rays", hover, &mut settings.light_rays, range);
    apply_when_done(&response, settings, actions);
}

fn hemicube_resolution(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Cells along the edge of a hemicube's top face; what is smaller than a cell may be missed";
    let range = Settings::MIN_HEMICUBE_RESOLUTION..=Settings::MAX_HEMICUBE_RESOLUTION;
    let response = count(ui, "Resolution", hover, &mut settings.hemicube_resolution, range);
    apply_when_done(&response, settings, actions);
}

fn element_size(ui: &mut Ui, mut settings: Settings, scene: SceneFacts, actions: &mut Vec<Action>) {
    let mut automatic = settings.mesh.element_size.is_none();
    let hover = "Chooses the size of the elements so that they show soft shadows and shots are quick";
    let response = row(ui, "Mesh", hover, |ui, _| ui.add(Checkbox::new(&mut automatic, "Automatic")));
    let response = response.accessible_name("Automatic mesh").on_hover_text(hover);
    if response.changed() {
        settings.mesh.element_size = (!automatic).then_some(scene.element_size);
        actions.push(Action::ApplySettings(settings));
    }
    let mut size = settings.mesh.element_size.unwrap_or(scene.element_size);
    let range = scene.radius / 1000.0..=scene.radius / 2.0;
    let hover = "Longest edge of an element. Half the size makes four times the elements.";
    let response = labelled(ui, "Element size", hover, |ui| {
        slider(ui, &mut size, range, true, |size| format::si(size, "m"), |text| format::parse(text, "m"))
    });
    settings.mesh.element_size = Some(size);
    apply_when_done(&response, settings, actions);
}

/// Elements along the edge of a patch that can be chosen: each halves the edge of the one before.
const PATCH_EDGES: [(u32, &str); 4] = [(1, "1"), (2, "2"), (4, "4"), (8, "8")];

fn patch_edge(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let elements = &mut settings.mesh.elements_per_patch_edge;
    let segments = PATCH_EDGES.map(|(edge, name)| Segment {
        name,
        hover: "Elements along the edge of a patch. With 1, every element shoots by itself, and a matrix has as many \
                rows as there are elements.",
        shortcut: None,
        is_chosen: edge == *elements,
    });
    let hover = "How many elements, which receive light, lie along the edge of a patch, which shoots it";
    if let Some(chosen) = row(ui, "Patch edge", hover, |ui, _| segmented(ui, 10.0 * UNIT, &segments)) {
        *elements = PATCH_EDGES[chosen].0;
        actions.push(Action::ApplySettings(settings));
    }
}

fn stop_limit(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Stops when this share of the emitted flux is left unshot";
    let response = labelled(ui, "Stop at", hover, |ui| {
        let limit = &mut settings.unshot_limit;
        let parse = |text: &str| format::parse(text, "%").map(|percent| percent / 100.0);
        slider(ui, limit, 1e-5..=0.1, true, format::percent, parse)
    });
    apply_when_done(&response, settings, actions);
}
