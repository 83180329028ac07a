//! The menus: the same wishes as the buttons and keys, where people look for them first.

use super::icons::Icon;
use crate::app::action::{Action, CameraMove};
use crate::app::keys;
use crate::app::model::{Dialog, Look, LowerPanel, Model, PictureRequest, Theme};
use crate::app::views::ViewGroup;
use crate::choice::Choice;
use crate::cli::picture::Format;
use crate::scene::BUILTINS;
use crate::worker::Command;
use egui::accesskit::Role;
use egui::{Atom, Button, IdSalt, KeyboardShortcut, MenuBar, Response, Ui, WidgetInfo, vec2};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    MenuBar::new().ui(ui, |ui| {
        ui.menu_button("File", |ui| file_menu(ui, model, actions));
        ui.menu_button("View", |ui| view_menu(ui, model, actions));
        ui.menu_button("Help", |ui| help_menu(ui, actions));
    });
}

fn file_menu(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    item(ui, "Open…", Some(&keys::OPEN), || actions.push(Action::BrowseForScene));
    submenu(ui, "Built-in scenes", |ui| {
        for builtin in BUILTINS {
            if ui.button(builtin.name).on_hover_text(builtin.description).clicked() {
                actions.push(Action::Open(builtin.name.to_owned()));
            }
        }
    });
    ui.add_enabled_ui(!model.recent.is_empty(), |ui| {
        submenu(ui, "Recent files", |ui| {
            for path in model.recent {
                let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
                if ui.button(name).on_hover_text(path.display().to_string()).clicked() {
                    actions.push(Action::Open(path.to_string_lossy().into_owned()));
                }
            }
        });
    });
    ui.add_enabled_ui(model.scene.is_some_and(|scene| scene.is_dark()), |ui| {
        item(ui, "Add a ceiling light", None, || actions.push(Action::Send(Command::AddCeilingLight)));
    });
    ui.separator();
    ui.add_enabled_ui(model.scene.is_some(), |ui| {
        item(ui, "Save picture now", Some(&keys::SAVE_PICTURE), || actions.push(Action::SavePictureNow));
        item(ui, "Save picture as…", None, || {
            let request = PictureRequest { size: model.viewport_size, samples: 16, format: Format::Png };
            actions.push(Action::ShowDialog(Dialog::Picture(request)));
        });
    });
    ui.separator();
    item(ui, "Quit", Some(&keys::QUIT), || actions.push(Action::Quit));
}

fn view_menu(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look;
    for &group in ViewGroup::ALL {
        submenu(ui, group.label(), |ui| {
            for view in group.views() {
                let chosen = || actions.push(Action::SetLook(Look { view, ..look }));
                choice(ui, view.label(), look.view == view, Some(&keys::of_view(view)), chosen);
            }
        });
    }
    ui.separator();
    choice(ui, "Wireframe", look.wireframe, Some(&keys::WIREFRAME), || {
        actions.push(Action::SetLook(Look { wireframe: !look.wireframe, ..look }));
    });
    choice(ui, "Shooter", look.show_shooter, Some(&keys::SHOOTER), || {
        actions.push(Action::SetLook(Look { show_shooter: !look.show_shooter, ..look }));
    });
    choice(ui, "Ambient", look.ambient, Some(&keys::AMBIENT), || {
        actions.push(Action::SetLook(Look { ambient: !look.ambient, ..look }));
    });
    ui.separator();
    for &panel in LowerPanel::ALL {
        let is_open = model.lower == Some(panel);
        choice(ui, panel.label(), is_open, Some(&keys::of_lower_panel(panel)), || {
            actions.push(Action::ShowLowerPanel((!is_open).then_some(panel)));
        });
    }
    item(ui, "Matrix…", Some(&keys::MATRIX), || actions.push(Action::ShowDialog(Dialog::Matrix)));
    ui.separator();
    ui.add_enabled_ui(model.scene.is_some(), |ui| {
        item(ui, "Fit scene", Some(&keys::FIT), || actions.push(Action::Camera(CameraMove::Fit)));
        item(ui, "First view", Some(&keys::HOME), || actions.push(Action::Camera(CameraMove::Home)));
    });
    ui.separator();
    for (name, theme) in [("Dark theme", Theme::Dark), ("Light theme", Theme::Light)] {
        choice(ui, name, model.theme == theme, None, || actions.push(Action::SetTheme(theme)));
    }
}

fn help_menu(ui: &mut Ui, actions: &mut Vec<Action>) {
    item(ui, "Keys and mouse", Some(&keys::HELP), || actions.push(Action::ShowDialog(Dialog::Keys)));
    item(ui, "About Lightwell", None, || actions.push(Action::ShowDialog(Dialog::About)));
}

/// An entry that does something.
fn item(ui: &mut Ui, name: &str, shortcut: Option<&KeyboardShortcut>, chosen: impl FnOnce()) {
    if entry(ui, name, false, shortcut).clicked() {
        chosen();
        ui.close();
    }
}

/// An entry with a tick before it while it is in force.
fn choice(ui: &mut Ui, name: &str, is_on: bool, shortcut: Option<&KeyboardShortcut>, chosen: impl FnOnce()) {
    let response = entry(ui, name, is_on, shortcut);
    response.widget_info(|| WidgetInfo::selected(Role::MenuItemCheckBox, response.enabled(), is_on, name));
    if response.clicked() {
        chosen();
        ui.close();
    }
}

fn entry(ui: &mut Ui, name: &str, is_ticked: bool, shortcut: Option<&KeyboardShortcut>) -> Response {
    let tick = IdSalt::new("tick");
    let mut button = Button::new((Atom::custom(tick, vec2(Icon::SIZE, Icon::SIZE)), name));
    if let Some(shortcut) = shortcut {
        button = button.shortcut_text(ui.ctx().format_shortcut(shortcut));
    }
    let button = button.atom_ui(ui);
    if let Some(rect) = button.rect(tick).filter(|_| is_ticked) {
        Icon::Chosen.paint(ui.painter(), rect, ui.visuals().text_color());
    }
    // The label of a button with a shortcut would be both.
    button.response.accessible_name(name)
}

/// An entry that opens another menu, in line with those above and below it.
fn submenu(ui: &mut Ui, name: &str, contents: impl FnOnce(&mut Ui)) {
    let gutter = Atom::custom(IdSalt::new("tick"), vec2(Icon::SIZE, Icon::SIZE));
    ui.menu_button((gutter, name), contents);
}
