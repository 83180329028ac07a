//! Which effects each way to simulate light tells apart from the others, so that it can leave them out.

use super::FormFactorMethod;
use crate::effects::{Effect, Effects};
use crate::solution::CameraView;

const SPECULAR: Effects = Effects::of(&[Effect::SpecularReflection, Effect::Gloss, Effect::Transmission]);
const PHOTONS: Effects = Effects::of(&[Effect::Interreflection, Effect::Colour, Effect::Caustics]).and(SPECULAR);
/// What shadow rays to emitters find.
const BY_SHADOW_RAYS: Effects = Effects::of(&[Effect::DirectLight, Effect::Shadows, Effect::Colour]);

/// What paths find that begin at a surface and not at an emitter.
const INDIRECT: Effects = Effects::of(&[Effect::Interreflection, Effect::Shadows, Effect::Colour]).and(SPECULAR);

/// Of radiosity. Hemicubes, and form factors by rays, meet what stands in the way without looking for it.
pub fn of_radiosity(form_factor: FormFactorMethod) -> Effects {
    let all = Effects::of(&[Effect::DirectLight, Effect::Interreflection, Effect::Colour, Effect::Escape]);
    match form_factor {
        FormFactorMethod::Centroid | FormFactorMethod::Disc | FormFactorMethod::Polygon => {
            all.and(Effects::of(&[Effect::Shadows]))
        }
        FormFactorMethod::Rays | FormFactorMethod::Hemicube => all,
    }
}

/// Of photons where they landed. Those that come straight from an emitter are among them, whatever becomes of them.
pub fn of_photons() -> Effects {
    PHOTONS
}

/// What a view is there to show, whether the scene calls for it or not.
pub fn asked_for_by(view: CameraView) -> Effects {
    match view {
        CameraView::DiffuseAmbient => Effects::of(&[Effect::AmbientLight]),
        CameraView::Error(judged) => asked_for_by(judged.view()),
        _ => Effects::default(),
    }
}

/// Of a picture from a camera with the light that it is read off.
pub fn of_view(view: CameraView, form_factor: FormFactorMethod) -> Effects {
    match view {
        CameraView::PhotonIrradiance | CameraView::PhotonRadiance => PHOTONS.and(Effects::of(&[Effect::DirectLight])),
        CameraView::Caustics => PHOTONS,
        CameraView::FinalGather => PHOTONS.and(BY_SHADOW_RAYS),
        CameraView::RayTraced => SPECULAR.and(BY_SHADOW_RAYS),
        CameraView::RadiosityDirect => SPECULAR.and(of_radiosity(form_factor)).and(BY_SHADOW_RAYS),
        CameraView::RadiositySpecular => SPECULAR.and(of_radiosity(form_factor)),
        CameraView::Diffuse | CameraView::DiffuseAmbient => BY_SHADOW_RAYS.and(Effects::of(&[Effect::AmbientLight])),
        CameraView::AmbientOcclusion => Effects::default(),
        CameraView::AmbientMinusIndirect => INDIRECT,
        CameraView::Reference => PHOTONS.and(BY_SHADOW_RAYS),
        CameraView::Error(judged) => {
            of_view(judged.view(), form_factor).and(of_view(CameraView::Reference, form_factor))
        }
    }
}
