//! The error of a view, as a picture of its own.

use super::props::image;
use super::stage::{LARGE, Stage, showing};
use super::{click, thin};
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lightwell::app::action::Action;
use lightwell::app::model::Look;
use lightwell::solution::{CameraImage, CameraView, Comparison, Judged, PictureError};
use lightwell::viewport::View;

const ERROR: CameraView = CameraView::Error(Judged::RadiosityDirect);

fn compared() -> Stage {
    let error = PictureError { mean: 2.0, range: 0.2, offset: -0.003, rms: 0.042, uncertainty: 0.001, floor: 0.012 };
    let comparison = Some(Comparison::Error(error));
    Stage { image: Some(CameraImage { comparison, ..image(ERROR) }), ..showing(View::Camera(ERROR)) }
}

#[test]
fn an_error_tells_its_size_and_how_sure_it_is() {
    let harness = compared().window(LARGE);
    for figure in ["4.20_% ± 0.1_%", "−0.30_%", "1.20_%"] {
        harness.get_by_label(&thin(figure));
    }
    harness.get_by_label(&thin("error 4.20_% ± 0.1_%"));
    // Of the 16 samples that are wanted, sixteen times as many are taken.
    harness.get_by_label("Progress: 4 of 256 samples");
    for (label, is_shown) in [("Samples", true), ("Lamp rays", true), ("Solver", true), ("Paths", false)] {
        assert_eq!(harness.query_all_by_label(label).next().is_some(), is_shown, "{label}");
    }
}

#[test]
fn what_an_error_is_of_is_chosen_beside_it() {
    let mut harness = compared().window(LARGE);
    harness.get_by_role_and_label(Role::ComboBox, "of").click();
    harness.run();
    harness.get_by_label("Final gather").click();
    harness.run();
    let view = View::Camera(CameraView::Error(Judged::FinalGather));
    assert_eq!(harness.state().actions, [Action::SetLook(Look { view, ..Look::default() })]);
    // From the reference, of what it is nearest to.
    let actions = click(showing(View::Camera(CameraView::Reference)), "Error");
    assert_eq!(actions, [Action::SetLook(Look { view: View::Camera(ERROR), ..Look::default() })]);
}
