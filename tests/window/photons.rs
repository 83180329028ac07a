//! Views of photons and pictures from a camera: their settings, figures and picks.

use super::props::{gathered, image, photons, trail};
use super::stage::{LARGE, Stage, showing};
use super::{click, key, thin};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use lightwell::app::action::Action;
use lightwell::app::model::Look;
use lightwell::methods::{ImageSettings, OcclusionSettings, PhotonSettings, Range, Settings};
use lightwell::solution::{CameraView, PhotonSolution};
use lightwell::viewport::{PhotonColour, PhotonLook, View};
use lightwell::worker::{Command, Phase};

fn photon_stage() -> Stage {
    Stage { photons: Some(photons()), ..showing(View::Photons) }
}

fn gather_stage() -> Stage {
    let view = CameraView::FinalGather;
    Stage { image: Some(image(view)), ..Stage { photons: Some(photons()), ..showing(View::Camera(view)) } }
}

fn is_shown(stage: Stage, label: &str) -> bool {
    stage.window(LARGE).query_all_by_label(label).next().is_some()
}

fn with_filter(pattern: &str) -> Action {
    let filter = pattern.parse().expect("a pattern");
    let settings = Settings::default();
    Action::ApplySettings(Settings { image: ImageSettings { filter, ..settings.image }, ..settings })
}

#[test]
fn settings_are_those_of_the_view() {
    let all = [
        "Solver",
        "Photons",
        "For caustics",
        "Nearest",
        "Kernel",
        "Samples",
        "Gather rays",
        "Shadow rays",
        "Lamp rays",
        "Paths",
        "AO rays",
        "Fall-off",
        "Distance",
    ];
    let expect = |view, shown: &[&str]| {
        for label in all {
            let harness = showing(view).window(LARGE);
            // The view itself is a button of this name, too.
            let labels = harness.query_all_by_role_and_label(Role::Label, label);
            assert_eq!(labels.count() > 0, shown.contains(&label), "{label} with {view:?}");
        }
    };
    expect(View::Smooth, &["Solver", "Shadow rays"]);
    expect(View::Photons, &["Photons", "For caustics", "Nearest", "Kernel", "Paths"]);
    let camera = View::Camera;
    expect(camera(CameraView::RayTraced), &["Samples", "Lamp rays", "Paths"]);
    expect(camera(CameraView::RadiositySpecular), &["Samples", "Shadow rays", "Solver"]);
    expect(camera(CameraView::RadiosityDirect), &["Samples", "Lamp rays", "Shadow rays", "Solver"]);
    let photon_map = ["Photons", "For caustics", "Nearest", "Kernel", "Paths", "Samples"];
    expect(camera(CameraView::PhotonRadiance), &photon_map);
    expect(camera(CameraView::FinalGather), &[&photon_map[..], &["Gather rays", "Lamp rays"]].concat());
    expect(camera(CameraView::Reference), &["Samples", "Paths"]);
    let occlusion = ["Samples", "AO rays", "Fall-off", "Distance"];
    expect(camera(CameraView::AmbientOcclusion), &occlusion);
    expect(View::OcclusionVertices, &["AO rays", "Fall-off", "Distance"]);
    expect(camera(CameraView::Diffuse), &["Samples", "Lamp rays"]);
    expect(camera(CameraView::DiffuseAmbient), &[&occlusion[..], &["Lamp rays"]].concat());
}

#[test]
fn the_range_of_occlusion_is_drawn_or_said_to_be_unlimited() {
    let stage = |range| {
        let occlusion = OcclusionSettings { range, ..OcclusionSettings::default() };
        Stage {
            settings: Settings { occlusion, ..Settings::default() },
            ..showing(View::Camera(CameraView::AmbientOcclusion))
        }
    };
    let has_text = |range, text: &str| stage(range).window(LARGE).query_all_by_label_contains(text).next().is_some();
    for (range, is_drawn, is_set, is_dark) in [
        (Range::Automatic, true, false, false),
        (Range::Metres(0.25), true, true, false),
        (Range::Unlimited, false, false, true),
    ] {
        assert_eq!(has_text(range, "Occlusion over distance"), is_drawn, "{range:?}");
        assert_eq!(is_shown(stage(range), "At most"), is_set, "{range:?}");
        assert_eq!(has_text(range, "a closed room is black"), is_dark, "{range:?}");
        let harness = stage(range).window(LARGE);
        let rights = harness.root().children_recursive().filter_map(|node| node.accesskit_node().bounding_box());
        let right = rights.map(|bounds| bounds.x1).fold(0.0, f64::max);
        assert!(right <= f64::from(LARGE.x), "{range:?}: something reaches to {right}");
    }
}

#[test]
fn exposure_is_offered_where_it_changes_something() {
    for (view, is_offered) in [(CameraView::AmbientOcclusion, false), (CameraView::DiffuseAmbient, true)] {
        assert_eq!(is_shown(showing(View::Camera(view)), "Automatic exposure"), is_offered, "{view:?}");
    }
}

#[test]
fn a_progressive_run_has_passes_and_a_radius_may_be_set() {
    let progressive = |is_progressive| {
        let settings = Settings::default();
        Settings { photons: PhotonSettings { is_progressive, ..settings.photons }, ..settings }
    };
    assert!(!is_shown(photon_stage(), "Passes"));
    assert!(is_shown(Stage { settings: progressive(true), ..photon_stage() }, "Passes"));
    let mut harness = photon_stage().window(LARGE);
    harness.get_by_role_and_label(Role::CheckBox, "Progressive").click();
    harness.run();
    assert_eq!(harness.state().actions, [Action::ApplySettings(progressive(true))]);
    let mut harness = photon_stage().window(LARGE);
    harness.get_by_role_and_label(Role::CheckBox, "Automatic radius").click();
    harness.run();
    let mut settings = Settings::default();
    settings.photons.max_radius = Some(0.04);
    assert_eq!(harness.state().actions, [Action::ApplySettings(settings)], "what the run has chosen, to begin with");
}

#[test]
fn a_pattern_of_paths_is_typed_or_chosen() {
    assert_eq!(click(photon_stage(), "LS+DE"), [Action::EditFilter(None), with_filter("LS+DE")]);
    let mut settings = Settings::default();
    settings.image.filter = "LDE".parse().expect("a pattern");
    assert_eq!(click(Stage { settings, ..photon_stage() }, "LDE"), [Action::EditFilter(None), with_filter("")]);

    let mut harness = photon_stage().window(LARGE);
    harness.get_by_role_and_label(Role::TextInput, "Paths").focus();
    harness.run();
    harness.get_by_role_and_label(Role::TextInput, "Paths").type_text("ld");
    harness.step();
    assert_eq!(harness.state().actions, [Action::EditFilter(Some("ld".to_owned()))]);
    harness.state_mut().filter_draft = Some("lde".to_owned());
    harness.state_mut().actions.clear();
    harness.key_press(Key::Enter);
    harness.run();
    // The field may be left in two frames; the settings in force are the same in both.
    assert_eq!(harness.state().actions[..2], [Action::EditFilter(None), with_filter("LDE")]);
}

#[test]
fn a_pattern_that_is_none_is_said_to_be_none_and_stays() {
    let wrong = || Stage { filter_draft: Some("LXE".to_owned()), ..photon_stage() };
    assert!(is_shown(wrong(), "`X` is no part of a pattern of paths, as in LDE, LS+DE or L(S|D)*E"));
    let mut harness = wrong().window(LARGE);
    harness.get_by_role_and_label(Role::TextInput, "Paths").focus();
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    let kept = Action::EditFilter(Some("LXE".to_owned()));
    assert!(!harness.state().actions.is_empty() && harness.state().actions.iter().all(|action| *action == kept));
}

#[test]
fn photons_are_drawn_as_the_side_panel_says() {
    let with = |photons| [Action::SetLook(Look { view: View::Photons, photons, ..Look::default() })];
    let look = PhotonLook::default();
    let mut harness = photon_stage().small();
    harness.get_by_role_and_label(Role::CheckBox, "Ticks").click();
    harness.run();
    assert_eq!(harness.state().actions, with(PhotonLook { ticks: true, ..look }));
    assert_eq!(key(photon_stage(), Modifiers::NONE, Key::T), with(PhotonLook { ticks: true, ..look }));
    assert_eq!(click(photon_stage(), "Bounce"), with(PhotonLook { colour: PhotonColour::Bounce, ..look }));
    assert!(is_shown(showing(View::KdTree), "Tree depth") && !is_shown(photon_stage(), "Tree depth"));
    assert!(!is_shown(Stage::default(), "Ticks"));
}

#[test]
fn a_click_with_shift_picks_a_point() {
    let click = |stage: Stage| {
        let mut harness = stage.small();
        harness.get_by_label("Viewport").click_modifiers(Modifiers::SHIFT);
        harness.run();
        std::mem::take(&mut harness.state_mut().actions)
    };
    assert!(matches!(click(photon_stage())[..], [Action::PickPoint(_)]));
    assert!(matches!(click(Stage::default())[..], [Action::PickPoint(_)]), "the second one of the equation");
    let traced = || showing(View::Camera(CameraView::RayTraced));
    assert!(matches!(click(traced())[..], [Action::Pick(_)]));
}

#[test]
fn classes_of_photons_have_a_legend() {
    let coloured = |colour| {
        let photons = PhotonLook { colour, ..PhotonLook::default() };
        Stage { look: Look { view: View::Photons, photons, ..Look::default() }, ..photon_stage() }
    };
    for colour in [PhotonColour::Bounce, PhotonColour::Path] {
        for (label, _) in colour.classes() {
            assert!(is_shown(coloured(colour), label), "{label}");
        }
    }
    assert!(!is_shown(coloured(PhotonColour::Flux), "Indirect"));
}

#[test]
fn the_ledger_of_photons_closes_and_counts() {
    let harness = photon_stage().window(LARGE);
    harness.get_by_label(&thin("Energy: Absorbed 70.0_%, Escaped 25.0_%, Truncated 5.00_%"));
    harness.get_by_label("0 W, closes");
    harness.get_by_label(&thin("90_k of 50_k"));
    let mut leaking = photons();
    leaking.energy.absorbed.x -= 0.03125;
    assert!(is_shown(Stage { photons: Some(leaking), ..photon_stage() }, "3.1e−2 W, does not close"));
    let mut harness = photon_stage().window(LARGE);
    harness.get_by_label("By path").click();
    harness.run();
    harness.get_by_label("LDD");
    harness.get_by_label(&thin("30_000  33.3_%"));
}

#[test]
fn progress_is_that_of_the_view() {
    let progress = |stage: Stage, text: &str| assert!(is_shown(stage, &thin(&format!("Progress: {text}"))), "{text}");
    progress(photon_stage(), "50_k of 200_k photons");
    let mut settings = Settings::default();
    settings.photons.is_progressive = true;
    let passes = PhotonSolution { passes: 7, is_complete: true, ..photons() };
    progress(Stage { photons: Some(passes), settings, ..photon_stage() }, "7 of 100 passes");
    progress(gather_stage(), "4 of 16 samples");
    progress(Stage { phase: Phase::Running, ..gather_stage() }, "50_k of 200_k photons");
    let mut coarse = image(CameraView::FinalGather);
    coarse.samples = 0;
    progress(Stage { image: Some(coarse), ..gather_stage() }, "Coarse picture");
}

#[test]
fn every_picture_carries_its_price() {
    let harness = gather_stage().window(LARGE);
    for figure in ["4 samples a pixel", "1.50_s", "2.00_Mrays/s"] {
        assert!(harness.query_all_by_label(&thin(figure)).next().is_some(), "{figure}");
    }
}

#[test]
fn what_runs_is_the_light_of_the_view() {
    assert_eq!(click(photon_stage(), "Run"), [Action::Send(Command::Run)]);
    assert_eq!(click(photon_stage(), "Step 10"), [Action::Send(Command::Step(10))]);
    let traced = || showing(View::Camera(CameraView::RayTraced));
    assert_eq!(click(traced(), "Run"), [], "it is made by itself");
    assert_eq!(key(traced(), Modifiers::NONE, Key::Space), []);
}

#[test]
fn a_view_without_its_light_offers_to_run_it() {
    let missing = Some("There are no photons yet: press Run");
    let mut harness = Stage { missing, ..showing(View::Photons) }.window(LARGE);
    harness.get_by_label("There are no photons yet: press Run");
    let buttons: Vec<_> = harness.get_all_by_role_and_label(Role::Button, "Run").collect();
    assert_eq!(buttons.len(), 2, "the transport has one, too");
    buttons.into_iter().max_by(|a, b| a.rect().top().total_cmp(&b.rect().top())).expect("a button").click();
    harness.run();
    assert_eq!(harness.state().actions, [Action::Send(Command::Run)]);
    // A message that comes and goes by itself would change the size of the picture.
    let message = "The picture from this camera is not there yet";
    let coming = Stage { missing: Some(message), ..showing(View::Camera(CameraView::RayTraced)) };
    assert!(!is_shown(coming, message));
}

#[test]
fn a_picked_photon_and_a_picked_point_are_described_and_can_be_forgotten() {
    let picked = || Stage { trail: Some(trail()), ..photon_stage() };
    let harness = picked().window(LARGE);
    for text in ["Picked photon", "Emitted", "Specular", "Diffuse", "Absorbed", "90.0_%", "70.0_%", "3.00_mW"] {
        assert!(harness.query_all_by_label(&thin(text)).next().is_some(), "{text}");
    }
    assert_eq!(click(picked(), "Forget it"), [Action::Unpick]);
    assert_eq!(key(picked(), Modifiers::NONE, Key::Escape), [Action::Unpick]);
    assert_eq!(key(photon_stage(), Modifiers::NONE, Key::Escape), []);
    let mut whole = photons();
    whole.energy.truncated *= 0.01;
    let harness = Stage { gathered: Some(gathered()), photons: Some(whole), ..photon_stage() }.window(LARGE);
    for text in ["Picked point", "12.0 6.0 3.0_W/m²", "100", "2", "20.0_mm", "75.0_%", "10.0_%"] {
        assert!(harness.query_all_by_label(&thin(text)).next().is_some(), "{text}");
    }
}

/// A twentieth of the flux of the photons on this stage is truncated.
#[test]
fn truncated_flux_is_warned_of() {
    let warning = photons().warning().expect("a warning");
    assert!(warning.starts_with("5.0 % of the emitted flux is truncated"), "{warning}");
    assert!(is_shown(photon_stage(), &warning));
    let mut whole = photons();
    whole.energy.truncated *= 0.01;
    assert_eq!(whole.warning(), None);
}
