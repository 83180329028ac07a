//! The program behind the window: it holds what is on show and is the one place that acts on wishes.

mod picking;

use super::action::Action;
use super::asking::{Asking, News};
use super::diagrams::Diagrams;
use super::effects::EffectFacts;
use super::equation::EquationFacts;
use super::file_dialogs::{FileDialogs, Outcome};
use super::frame_clock::FrameClock;
use super::model::{Dialog, Look, Model, PathPurpose, PictureRequest, SceneFacts, extension};
use super::notices::Notices;
use super::panels;
use super::patch::PatchFacts;
use super::pictures::{Destination, Job, Pictures};
use super::preferences::Preferences;
use super::theme;
use super::viewport_pane::ViewportPane;
use super::views::{self, ViewGroup};
use crate::accuracy::Cache;
use crate::cli::picture::{self, Format, QualityReport};
use crate::hard_cases::cases;
use crate::methods::Settings;
use crate::scene::Source;
use crate::solution::CameraView;
use crate::study::{Question, Way};
use crate::viewport::{Legend, View};
use crate::worker::{Checks, Command, Shown, Sight, Snapshot, Worker};
use egui::{Ui, ViewportCommand};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Where drawing takes processors from the solver, new light waits this long for company. What the person does is
/// drawn at once.
const SOFTWARE_PACE: Duration = Duration::from_millis(100);

/// The window's state.
pub struct Explorer {
    worker: Worker,
    snapshot: Arc<Snapshot>,
    pane: ViewportPane,
    pictures: Pictures,
    diagrams: Diagrams,
    checks: Option<Checks>,
    asking: Asking,
    file_dialogs: FileDialogs,
    look: Look,
    /// What the solver thread was told last of what is on show.
    told: Option<Sight>,
    /// The pattern of paths that is being typed.
    filter_draft: Option<String>,
    /// Settings that are being edited, or were sent and are not in force yet.
    edited: Option<Settings>,
    dialog: Option<Dialog>,
    notices: Notices,
    /// Whether the snapshot's error was dismissed.
    is_error_dismissed: bool,
    preferences: Preferences,
    adapter: String,
    clock: FrameClock,
}

impl Explorer {
    /// Starts the solver thread and opens `scene`, a path or the name of a built-in one. What is found out about scenes is
    /// kept in the cache, if there is one.
    ///
    /// # Errors
    /// If eframe gives no graphics device.
    pub fn new(context: &eframe::CreationContext, scene: String, cache: Option<Cache>) -> Result<Self, &'static str> {
        let render_state = context.wgpu_render_state.clone().ok_or("the window has no graphics device")?;
        let ctx = &context.egui_ctx;
        let preferences: Preferences =
            context.storage.and_then(|storage| eframe::get_value(storage, Preferences::KEY)).unwrap_or_default();
        theme::install(ctx);
        ctx.set_theme(preferences.theme);
        let pane = ViewportPane::new(render_state);
        let waker = ctx.clone();
        let pace = if pane.gpu().is_software() { SOFTWARE_PACE } else { Duration::ZERO };
        let worker = Worker::spawn(cache.clone(), move || waker.request_repaint_after(pace));
        worker.send(Command::Load(scene));
        Ok(Self {
            snapshot: worker.latest(),
            worker,
            pictures: Pictures::spawn(pane.gpu().clone(), ctx.clone()),
            diagrams: Diagrams::default(),
            checks: None,
            asking: Asking::new(cache),
            file_dialogs: FileDialogs::new(ctx),
            look: Look::default(),
            told: None,
            filter_draft: None,
            edited: None,
            dialog: None,
            notices: Notices::default(),
            is_error_dismissed: false,
            preferences,
            adapter: pane.gpu().adapter_name(),
            pane,
            clock: FrameClock::default(),
        })
    }

    /// Takes in what other threads and the clock have brought since the last frame.
    fn catch_up(&mut self, ctx: &egui::Context) {
        let snapshot = self.worker.latest();
        let is_error_new = snapshot.error != self.snapshot.error;
        if is_error_new {
            self.is_error_dismissed = false;
        }
        if is_error_new || snapshot.settings != self.snapshot.settings {
            self.edited = None;
        }
        self.snapshot = snapshot;
        if self.pane.follow(&self.snapshot)
            && let Some(Source::File(path)) = self.snapshot.world.as_ref().map(|world| &world.scene.source)
        {
            self.preferences.remember(path);
        }
        self.diagrams.follow(ctx, &self.snapshot, self.dialog == Some(Dialog::Matrix));
        if self.pane.fly() {
            ctx.request_repaint();
        }
        self.take_answer();
        self.take_outcomes(ctx.input(|input| input.time));
        if let Some(seconds) = self.notices.expire(ctx.input(|input| input.time)) {
            ctx.request_repaint_after(Duration::from_secs_f64(seconds));
        }
    }

    /// Outcomes of file dialogs, of pictures and of the graphics device.
    fn take_outcomes(&mut self, now: f64) {
        match self.file_dialogs.poll() {
            Some(Outcome::Chosen(PathPurpose::OpenScene, path)) => self.open(path.to_string_lossy().into_owned()),
            Some(Outcome::Chosen(PathPurpose::SavePicture(request), path)) => {
                self.save_picture_as(request, path);
            }
            Some(Outcome::Unavailable(purpose)) => {
                self.dialog = Some(Dialog::Path { purpose, text: String::new() });
            }
            Some(Outcome::Cancelled) | None => {}
        }
        match self.pictures.poll() {
            Some(Ok(path)) => self.notices.tell(now, format!("Saved {}", path.display())),
            Some(Err(reason)) => self.notices.warn(format!("The picture was not saved: {reason}")),
            None => {}
        }
        if let Err(error) = self.pane.gpu().check() {
            log::error!("{error}");
            self.notices.warn(error.to_string());
        }
    }

    fn show(&mut self, ui: &mut Ui) -> Vec<Action> {
        let mut actions = Vec::new();
        let error = self.snapshot.error.as_deref().filter(|_| !self.is_error_dismissed);
        let report = self.checks.as_ref().map(Checks::latest);
        let answer = self.asking.latest();
        let settings = self.edited.unwrap_or(self.snapshot.settings);
        let is_radiosity = ViewGroup::of(self.look.view) == ViewGroup::Radiosity;
        let equation = EquationFacts::of(&self.snapshot).filter(|_| is_radiosity);
        let model = Model {
            phase: &self.snapshot.phase,
            scene: SceneFacts::of(&self.snapshot),
            effects: EffectFacts::of(&self.snapshot, &self.look, &settings),
            solution: self.snapshot.solution.as_deref(),
            photons: self.snapshot.photons.as_deref(),
            occlusion: self.snapshot.occlusion.as_deref(),
            image: views::image(self.look.view, &self.snapshot),
            trail: self.snapshot.trail.as_deref(),
            gathered: self.snapshot.gathered.as_deref(),
            filter_draft: self.filter_draft.as_deref(),
            settings,
            error,
            look: self.look,
            viewport_size: self.pane.size(),
            exposure_ev: self.pane.exposure_ev(&self.look),
            theme: self.preferences.theme,
            lower: self.preferences.lower,
            chart: self.preferences.chart,
            checks: report.as_deref(),
            missing: self.pane.shown().and_then(|(_, light)| self.look.view.missing(light)),
            legend: self.pane.shown().and_then(|(_, light)| Legend::of(self.look.view, light)),
            matrix: self.diagrams.matrix(),
            item_buffer: self.diagrams.item_buffer(),
            patch: PatchFacts::of(&self.snapshot),
            equation,
            marks: equation.and_then(|facts| self.pane.marks(facts.equation)),
            curves: &self.snapshot.curves,
            tracks: &self.snapshot.tracks,
            truth: self.snapshot.truth.as_deref(),
            wish: self.preferences.wish,
            inquiry: answer.as_deref(),
            recent: &self.preferences.recent,
            notices: self.notices.shown(),
            dialog: self.dialog.as_ref(),
            adapter: &self.adapter,
            frame_time: self.clock.frame_time(),
        };
        let (pane, look, filter) = (&mut self.pane, self.look, self.snapshot.settings.image.filter);
        panels::show(ui, &model, &mut actions, |ui, rect| pane.paint(ui, rect, &look, filter));
        actions
    }

    fn apply(&mut self, ctx: &egui::Context, action: Action) {
        match action {
            Action::Send(command) => self.worker.send(command),
            Action::Open(scene) => self.open(scene),
            Action::BrowseForScene => self.file_dialogs.open_scene(),
            Action::SetLook(look) => self.look = look,
            Action::EditSettings(settings) => self.edited = Some(settings),
            Action::ApplySettings(settings) => self.configure(settings),
            Action::Camera(movement) => self.pane.move_camera(movement),
            Action::Pick(at) => self.pick_at(at),
            Action::PickPoint(at) => self.pick_point(at),
            Action::PickPatch(patch) => self.worker.send(Command::Pick(self.pane.middle_of(patch))),
            Action::PickSource(patch) => self.pick_source(self.pane.middle_of(patch)),
            Action::Unpick => self.unpick(),
            Action::EditFilter(draft) => self.filter_draft = draft,
            Action::SavePictureNow => {
                let request = PictureRequest { size: self.pane.size(), samples: 16, format: Format::Png };
                self.save_picture(request, Destination::Free(request.format));
            }
            Action::BrowseForPicture(request) => {
                let scene = SceneFacts::of(&self.snapshot).map_or("scene", |facts| facts.name);
                let name = format!("lightwell-{scene}.{}", extension(request.format));
                self.file_dialogs.save_picture(request, name);
            }
            Action::SavePicture(request, path) => self.save_picture_as(request, path),
            Action::SetTheme(theme) => {
                self.preferences.theme = theme;
                ctx.set_theme(theme);
            }
            Action::ShowLowerPanel(panel) => self.preferences.lower = panel,
            Action::SetChart(chart) => self.preferences.chart = chart,
            Action::SetWish(wish) => self.preferences.wish = wish,
            Action::Inquire(question) => self.inquire(ctx, question),
            Action::StopInquiry => self.asking.stop(),
            Action::RunChecks => {
                let ctx = ctx.clone();
                self.checks = Some(Checks::spawn(move || ctx.request_repaint()));
            }
            Action::ShowCase(name) => self.show_case(ctx, name),
            Action::ShowDialog(dialog) => self.dialog = Some(dialog),
            Action::CloseDialog => self.dialog = None,
            Action::DismissError => self.is_error_dismissed = true,
            Action::DismissNotice(id) => self.notices.dismiss(id),
            Action::Quit => ctx.send_viewport_cmd(ViewportCommand::Close),
        }
    }

    fn open(&mut self, scene: String) {
        self.is_error_dismissed = false;
        self.worker.send(Command::Load(scene));
    }

    fn show_case(&mut self, ctx: &egui::Context, name: &str) {
        match cases().find(|case| case.name == name).and_then(|case| (case.scene)()) {
            Some(scene) => {
                self.is_error_dismissed = false;
                self.worker.send(Command::Show(Shown(scene)));
            }
            None => {
                let now = ctx.input(|input| input.time);
                self.notices.tell(now, format!("{name} is about numbers alone: there is no scene to open"));
            }
        }
    }

    /// Begins to look for settings that suit a wish; measuring of what is on show waits for it.
    fn inquire(&mut self, ctx: &egui::Context, question: Question) {
        let ctx = ctx.clone();
        let is_begun = self.asking.ask(question, &self.snapshot, move || ctx.request_repaint());
        self.worker.send(Command::Hush(is_begun));
    }

    /// Takes over what was looked for and found, and lets it run.
    fn take_answer(&mut self) {
        let Some(news) = self.asking.news(&self.snapshot) else { return };
        self.worker.send(Command::Hush(false));
        if let News::Found(choice) = news {
            let recipe = choice.recipe;
            let is_photons = recipe.way == Way::PhotonMap;
            let view = if is_photons { View::Camera(CameraView::PhotonRadiance) } else { View::Smooth };
            self.look = Look { view, ..self.look };
            self.tell_sight();
            self.configure(recipe.applied_to(&self.snapshot.settings));
            self.worker.send(Command::Run);
        }
    }

    /// Tells the solver thread what is on show, if that is another view, camera or size than in the last frame.
    fn tell_sight(&mut self) {
        if let Some(sight) = self.pane.sight(&self.look).filter(|sight| self.told != Some(*sight)) {
            self.told = Some(sight);
            self.worker.send(Command::Look(sight));
        }
    }

    fn configure(&mut self, settings: Settings) {
        if settings == self.snapshot.settings {
            self.edited = None;
        } else {
            self.edited = Some(settings);
            self.worker.send(Command::Configure(settings));
        }
    }

    /// A path without an ending gets the one of the format; one with an ending says the format.
    fn save_picture_as(&mut self, request: PictureRequest, path: PathBuf) {
        let path = if path.extension().is_some() { path } else { path.with_extension(extension(request.format)) };
        self.save_picture(request, Destination::File(path));
    }

    fn save_picture(&mut self, request: PictureRequest, destination: Destination) {
        let (Some((world, light)), Some(frame)) =
            (self.pane.shown(), self.pane.frame(&self.look, self.snapshot.settings.image.filter, request.size))
        else {
            return;
        };
        let mut facts = picture::facts(world, light, &self.snapshot.settings, &frame);
        facts.extend(self.asking.claim(&self.snapshot, frame.view).iter().flat_map(QualityReport::facts));
        let job =
            Job { facts, world: Arc::clone(world), light: light.clone(), frame, samples: request.samples, destination };
        if let Err(reason) = self.pictures.save(job) {
            self.notices.warn(reason);
        }
    }
}

impl eframe::App for Explorer {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let start = Instant::now();
        let ctx = ui.ctx().clone();
        self.catch_up(&ctx);
        let actions = self.show(ui);
        let is_changed = !actions.is_empty();
        for action in actions {
            self.apply(&ctx, action);
        }
        if is_changed {
            ctx.request_repaint();
        }
        self.tell_sight();
        self.clock.end_frame(start);
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        eframe::set_value(storage, Preferences::KEY, &self.preferences);
    }

    /// The layout is the same at every start; what is kept is in the preferences.
    fn persist_egui_memory(&self) -> bool {
        false
    }
}
