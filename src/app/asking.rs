//! Settings that suit a wish, or a study, looked for while the window goes on.

use crate::accuracy::Cache;
use crate::cli::picture::{QualityReport, TargetMet, TargetsMet, subject};
use crate::scene::Scene;
use crate::solution::CameraView;
use crate::study::{Answer, Choice, Inquiry, Question, State};
use crate::viewport::View;
use crate::worker::{Snapshot, TrackPoint};
use std::sync::Arc;

/// What is asked about the scene on show, if anything is.
pub struct Asking {
    cache: Option<Cache>,
    inquiry: Option<Inquiry>,
    /// What the inquiry is about.
    scene: Option<Arc<Scene>>,
    /// Whether its end has not been told yet.
    is_awaited: bool,
}

/// What is told once of an inquiry.
#[derive(Clone, Debug)]
pub enum News {
    /// It is over, and nothing is to be done about it.
    Over,
    /// These settings are to be used.
    Found(Arc<Choice>),
}

impl Asking {
    /// What is found out about scenes is kept in the cache, if there is one.
    pub fn new(cache: Option<Cache>) -> Self {
        Self { cache, inquiry: None, scene: None, is_awaited: false }
    }

    /// Begins to look for an answer about the scene on show, in place of any other; false without a scene.
    pub fn ask(&mut self, question: Question, snapshot: &Snapshot, wake: impl Fn() + Send + 'static) -> bool {
        let Some(world) = &snapshot.world else { return false };
        self.scene = Some(world.scene.clone());
        self.inquiry = Some(Inquiry::spawn(question, world.clone(), &snapshot.settings, self.cache.clone(), wake));
        self.is_awaited = true;
        true
    }

    /// Gives it up.
    pub fn stop(&mut self) {
        self.inquiry = None;
    }

    /// What is known of the answer.
    pub fn latest(&self) -> Option<Arc<Answer>> {
        self.inquiry.as_ref().map(Inquiry::latest)
    }

    /// How far off the light is that a view shows itself, and how it was chosen if the settings in force are those that were
    /// found; `None` where that was not measured.
    pub fn claim(&self, snapshot: &Snapshot, view: View) -> Option<QualityReport> {
        let kind = subject(view).light().filter(|_| shows_light_as_it_is(view))?;
        let track = snapshot.tracks.iter().rfind(|track| track.kind == kind)?;
        let TrackPoint { seconds, error } = *track.points.last()?;
        let quality = QualityReport {
            error_wanted: None,
            error_foreseen: None,
            time_allowed: None,
            error,
            seconds,
            targets: None,
            options: None,
        };
        let answer = self.latest();
        let Some(Answer { question, state: State::Found(choice) }) = answer.as_deref() else { return Some(quality) };
        let found = choice.recipe.settings;
        let is_chosen = choice.recipe.applied_to(&track.settings) == track.settings
            && (found.seed, found.effects) == (track.settings.seed, track.settings.effects);
        if !is_chosen {
            return Some(quality);
        }
        // Of what a search takes, only the light that it found is made again here.
        let targets = TargetsMet {
            error: question.error().map(|wanted| TargetMet::of_error(wanted, &error)),
            time: question.time().map(|allowed| TargetMet::of_time(allowed, seconds)),
        };
        Some(QualityReport {
            error_wanted: question.error(),
            error_foreseen: choice.prediction.error,
            time_allowed: question.time(),
            targets: Some(targets),
            options: Some(choice.recipe.options()),
            ..quality
        })
    }

    /// What is new since the last call. An answer about another scene than the one on show is given up.
    pub fn news(&mut self, snapshot: &Snapshot) -> Option<News> {
        let is_about_this = match (&self.scene, &snapshot.world) {
            (Some(scene), Some(world)) => Arc::ptr_eq(scene, &world.scene),
            _ => false,
        };
        if !is_about_this {
            self.stop();
        }
        let answer = self.latest().filter(|answer| !answer.is_awaited());
        let is_over = answer.is_some() || self.inquiry.is_none();
        if !is_over || !std::mem::take(&mut self.is_awaited) {
            return None;
        }
        match answer.as_deref() {
            Some(Answer { state: State::Found(choice), .. }) => Some(News::Found(choice.clone())),
            _ => Some(News::Over),
        }
    }
}

/// Whether what a view shows of light is what its error was measured of: nothing but specular surfaces between.
fn shows_light_as_it_is(view: View) -> bool {
    match view {
        View::Camera(view) => {
            matches!(view, CameraView::RadiositySpecular | CameraView::PhotonIrradiance | CameraView::PhotonRadiance)
        }
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::Error;
    use crate::cancel::Cancel;
    use crate::effects::{Effect, Effects, Switches};
    use crate::mesh::MeshSettings;
    use crate::methods::Settings;
    use crate::worker::{LightKind, Track};
    use crate::world::World;
    use std::time::{Duration, Instant};

    /// With a run of radiosity that was measured.
    fn measured(settings: Settings, rms: f64) -> Snapshot {
        let error = Error { rms, ..Error::default() };
        let points = vec![TrackPoint { seconds: 0.5, error }];
        let track = Track { number: 1, kind: LightKind::Radiosity, settings, points };
        Snapshot { tracks: vec![Arc::new(track)], ..Snapshot::default() }
    }

    #[test]
    fn an_error_is_claimed_for_views_that_show_the_light_as_it_is() {
        let (asking, snapshot) = (Asking::new(None), measured(Settings::default(), 0.03));
        for view in [View::Smooth, View::Camera(CameraView::RadiositySpecular)] {
            let claim = asking.claim(&snapshot, view).expect("a claim");
            assert!(claim.error.rms == 0.03 && claim.targets.is_none() && claim.options.is_none(), "{view:?}");
        }
        // Rays find a part of the light, or all of it; and of photons nothing was measured.
        for view in [CameraView::RadiosityDirect, CameraView::Reference, CameraView::PhotonRadiance] {
            assert!(asking.claim(&snapshot, View::Camera(view)).is_none(), "{view:?}");
        }
    }

    #[test]
    fn a_promise_is_claimed_for_the_very_light_that_was_found() {
        let scene = Scene::open("furnace").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let snapshot = Snapshot { world: Some(Arc::new(world)), ..Snapshot::default() };
        let mut asking = Asking::new(None);
        assert!(asking.ask(Question::Error(0.2), &snapshot, || ()));
        let start = Instant::now();
        let recipe = loop {
            match &asking.latest().expect("an answer").state {
                State::Found(choice) => break choice.recipe,
                State::Doing(_) => std::thread::sleep(Duration::from_millis(5)),
                other => panic!("{other:?}"),
            }
            assert!(start.elapsed() < Duration::from_secs(300));
        };
        let settings = recipe.applied_to(&Settings::default());
        let kept = |settings, rms| {
            let quality = asking.claim(&measured(settings, rms), View::Smooth).expect("a claim");
            quality.targets.map(|targets| targets.in_words())
        };
        assert_eq!(kept(settings, 0.1).as_deref(), Some("error target met"));
        assert_eq!(kept(settings, 0.3).as_deref(), Some("target missed: 30.0 % > 20.0 %"));
        let effects = Switches { off: Effects::of(&[Effect::Shadows]), ..Switches::default() };
        assert_eq!(kept(Settings { effects, ..settings }, 0.1), None);
        assert_eq!(kept(Settings { seed: 7, ..settings }, 0.1), None);
    }
}
