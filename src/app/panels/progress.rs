//! How far what is on show has come: a bar and a few words.

use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::math::rgb::Rgb64;
use crate::solution::{CameraImage, PhotonSolution, Solution, VertexShares};
use crate::worker::{LightKind, Phase};
use egui::accesskit::Role;
use egui::{Align2, Color32, FontId, Painter, Rect, Sense, Ui, WidgetInfo, pos2, vec2};

/// What the bar shows.
struct Progress {
    text: String,
    /// In [0, 1].
    share: f32,
    color: Color32,
    hover: String,
    /// Where tenths of what is left are marked, down to this.
    limit: Option<f64>,
}

pub fn show(ui: &mut Ui, model: &Model) {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let progress = progress(model, Palette::of(ui.visuals()));
    let text = progress.text.clone();
    response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, format!("Progress: {text}")));
    if ui.is_rect_visible(rect) {
        paint(ui, rect, &progress);
    }
    response.on_hover_text(progress.hover);
}

/// Of the light while it is on its way or there is no picture that is read off it, and else of the picture.
fn progress(model: &Model, palette: Palette) -> Progress {
    if let Phase::Loading(_) = model.phase {
        return Progress { text: "Loading".to_owned(), ..empty(palette) };
    }
    let image = model.image.filter(|_| !model.is_running() || model.light().is_none());
    if let Some(image) = image {
        return of_image(image, model.settings.image.samples_of(image.view), palette);
    }
    let of_light = match model.light() {
        Some(LightKind::Radiosity) => model.solution.map(|solution| of_radiosity(model, solution, palette)),
        Some(LightKind::Photons) => model.photons.map(|photons| of_photons(model, photons, palette)),
        Some(LightKind::Occlusion) => model.occlusion.map(|occlusion| of_occlusion(model, occlusion, palette)),
        None => None,
    };
    of_light.unwrap_or_else(|| empty(palette))
}

fn empty(palette: Palette) -> Progress {
    Progress { text: String::new(), share: 0.0, color: palette.accent, hover: String::new(), limit: None }
}

fn of_image(image: &CameraImage, wanted: u32, palette: Palette) -> Progress {
    let text = match image.samples {
        0 => "Coarse picture".to_owned(),
        samples => format!("{} of {}", format::count(samples.into()), format::counted(wanted.into(), "sample")),
    };
    let share = if image.is_complete { 1.0 } else { image.samples as f32 / wanted.max(1) as f32 };
    let hover = "Samples of every pixel, of those that are wanted".to_owned();
    Progress { text, share, hover, ..empty(palette) }
}

fn of_photons(model: &Model, photons: &PhotonSolution, palette: Palette) -> Progress {
    let wanted = model.settings.photons;
    let emitted = photons.counters.emitted + photons.counters.caustic_emitted;
    let text = if wanted.is_progressive {
        format!("{} of {} passes", format::count(photons.passes), format::count(wanted.passes.into()))
    } else {
        let caustic = if photons.counters.caustic_emitted > 0 { wanted.caustic_count } else { 0 };
        let all = u64::from(wanted.count) + u64::from(caustic);
        format!("{} of {} photons", format::short(emitted as f64, ""), format::short(all as f64, ""))
    };
    let hover =
        "Photons that have left the emitters, of those that are wanted; of a progressive run, passes".to_owned();
    Progress { text, share: model.photon_progress(), hover, ..empty(palette) }
}

fn of_occlusion(model: &Model, occlusion: &VertexShares, palette: Palette) -> Progress {
    let wanted = model.settings.image.samples;
    let text = format!("{} of {}", format::count(occlusion.rounds.into()), format::counted(wanted.into(), "round"));
    let hover = "Rounds of rays from every vertex, of those that are wanted".to_owned();
    Progress { text, share: model.occlusion_progress(), hover, ..empty(palette) }
}

fn of_radiosity(model: &Model, solution: &Solution, palette: Palette) -> Progress {
    let limit = model.settings.unshot_limit;
    let text = radiosity_text(solution);
    if let Some(share) = solution.preparation {
        let hover = "How much of the matrix of form factors is there. The first light moves when it is whole.";
        return Progress { text, share, color: palette.absorbed, hover: hover.to_owned(), limit: None };
    }
    let hover = format!(
        "How much of the emitted light is still unshot, on a logarithmic scale from all of it down to the stop limit of \
         {}",
        format::percent(limit)
    );
    Progress { text, share: model.radiosity_progress(), color: palette.accent, hover, limit: Some(limit) }
}

fn radiosity_text(solution: &Solution) -> String {
    match solution.preparation {
        Some(share) => format!("Building matrix {}", format::percent_whole(share)),
        None if solution.energy.emitted == Rgb64::ZERO => "No light".to_owned(),
        None if solution.converged => "Converged".to_owned(),
        None => format!("{} unshot", format::percent(solution.unshot_share)),
    }
}

fn paint(ui: &Ui, rect: Rect, progress: &Progress) {
    let painter = ui.painter_at(rect);
    let font = FontId::proportional(14.0);
    let galley = painter.layout_no_wrap(progress.text.clone(), font, ui.visuals().text_color());
    let text_width = (galley.size().x + 3.0 * UNIT).max(28.0 * UNIT);
    let bar = Rect::from_min_max(
        pos2(rect.left(), rect.top() + UNIT),
        pos2((rect.right() - text_width).max(rect.left()), rect.top() + 3.0 * UNIT),
    );
    painter.rect_filled(bar, UNIT, ui.visuals().widgets.inactive.bg_fill);
    painter.rect_filled(bar.with_max_x(bar.left() + bar.width() * progress.share), UNIT, progress.color);
    if let Some(limit) = progress.limit {
        ticks(ui, &painter, bar, limit);
    }
    let place = Align2::RIGHT_CENTER.anchor_size(pos2(rect.right(), rect.center().y), galley.size());
    painter.galley(place.min, galley, ui.visuals().text_color());
}

/// A tick below the bar at each tenth of what is left, from 100 % at its left end to the limit at its right end.
fn ticks(ui: &Ui, painter: &Painter, bar: Rect, limit: f64) {
    let color = ui.visuals().weak_text_color();
    let decades = -limit.log10();
    let label = |x: f32, align: Align2, share: f64| {
        painter.text(
            pos2(x, bar.bottom() + 2.0),
            align,
            format::percent_short(share),
            FontId::proportional(10.0),
            color,
        );
    };
    label(bar.left(), Align2::LEFT_TOP, 1.0);
    label(bar.right(), Align2::RIGHT_TOP, limit);
    for decade in (1..).take_while(|&decade| f64::from(decade) < decades - 0.3) {
        let x = bar.left() + bar.width() * (f64::from(decade) / decades) as f32;
        label(x, Align2::CENTER_TOP, 10_f64.powi(-decade));
    }
}
