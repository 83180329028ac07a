//! Scenes and settings: another of either begins anew what depends on it, and nothing else.

use super::{Part, Solver};
use crate::effects::Switches;
use crate::errors::with_causes;
use crate::mesh::MeshSettings;
use crate::methods::{ImageSettings, PhotonSettings, Settings, repertoire};
use crate::scene::Scene;
use crate::solution::CameraView;
use crate::worker::going::Going;
use crate::worker::workshop::Workshop;
use crate::worker::{LightKind, Refused};
use crate::world::{World, WorldError, with_ceiling_light};
use std::sync::Arc;

/// Why there is no new world.
pub(super) enum NoWorld {
    /// A newer command made it pointless, which is no trouble.
    Superseded,
    Failed(String),
}

impl From<Refused> for NoWorld {
    fn from(refused: Refused) -> Self {
        Self::Failed(with_causes(&refused))
    }
}

impl From<WorldError> for NoWorld {
    fn from(error: WorldError) -> Self {
        match error {
            WorldError::Cancelled => Self::Superseded,
            error => Self::Failed(with_causes(&error)),
        }
    }
}

impl<W: Workshop> Solver<W> {
    pub(super) fn load(&mut self, name: &str, open: impl FnOnce() -> Result<Scene, String>) {
        self.loading = Some(name.to_owned());
        self.publish();
        let old = self.snapshot.settings;
        if self.snapshot.world.is_some() {
            // A size in metres that suits one scene may be far too fine for another, and each calls for effects of its own.
            let mesh = MeshSettings { element_size: None, ..old.mesh };
            self.snapshot.settings = Settings { mesh, effects: Switches::default(), ..old };
        }
        let built = open().map_err(NoWorld::Failed).and_then(|scene| self.build(scene));
        let old_history = std::mem::take(&mut self.history);
        if !self.take_over(built) {
            self.snapshot.settings = old;
            self.history = old_history;
        }
        self.loading = None;
        self.publish();
    }

    pub(super) fn add_ceiling_light(&mut self) {
        let Some(world) = self.snapshot.world.clone().filter(|world| !world.scene.has_emitter()) else { return };
        let built = self.build(with_ceiling_light(&world.scene));
        self.take_over(built);
        self.publish();
    }

    fn build(&self, scene: Scene) -> Result<World, NoWorld> {
        Ok(World::build(scene, &self.snapshot.settings.mesh, self.mailbox.load_cancel())?)
    }

    pub(super) fn configure(&mut self, settings: Settings) {
        let old = std::mem::replace(&mut self.snapshot.settings, settings);
        let Some(world) = self.snapshot.world.clone() else { return self.publish() };
        if old.mesh == settings.mesh {
            let mut refusal = self.configure_photons(&world, &old).err();
            if refusal.is_some() {
                // All light has the same seed.
                self.snapshot.settings = Settings { photons: old.photons, seed: old.seed, ..settings };
            }
            self.configure_occlusion(&world);
            self.configure_pictures(&old);
            if let Err(refused) = self.configure_radiosity(world) {
                let Settings { photons, image, occlusion, effects, .. } = self.snapshot.settings;
                self.snapshot.settings = Settings { photons, image, occlusion, effects, ..old };
                refusal = Some(refused);
            }
            self.snapshot.error = refusal.map(|refused| with_causes(&refused));
        } else {
            let remeshed = world.remeshed(&settings.mesh, self.mailbox.mesh_cancel()).map_err(NoWorld::from);
            if !self.take_over(remeshed) {
                self.snapshot.settings = old;
            }
        }
        self.publish();
    }

    fn configure_radiosity(&mut self, world: Arc<World>) -> Result<(), Refused> {
        let settings = self.snapshot.settings;
        self.at_work = Part::Light(LightKind::Radiosity);
        if self.radiosity.run.as_mut().is_some_and(|run| run.configure(&settings)) {
            self.history.reconfigure(&settings);
        } else {
            self.start_radiosity(world)?;
        }
        self.radiosity.going.renew();
        Ok(())
    }

    fn configure_photons(&mut self, world: &Arc<World>, old: &Settings) -> Result<(), Refused> {
        let settings = self.snapshot.settings;
        self.at_work = Part::Light(LightKind::Photons);
        let has_begun = self.photons.run.is_some() || self.photons.going == Going::Crashed;
        if has_begun && !self.photons.run.as_mut().is_some_and(|run| run.configure(&settings)) {
            self.start_photons(world)?;
        } else if (PhotonSettings { passes: old.photons.passes, ..settings.photons }) != old.photons {
            // The same photons, read off in another way.
            self.judge.tracks.begin(LightKind::Photons, &settings);
        }
        self.photons.going.renew();
        Ok(())
    }

    fn configure_occlusion(&mut self, world: &Arc<World>) {
        let settings = self.snapshot.settings;
        let has_begun = self.occlusion.run.is_some() || self.occlusion.going == Going::Crashed;
        if has_begun && !self.occlusion.run.as_mut().is_some_and(|run| run.configure(&settings)) {
            self.start_occlusion(world);
        }
        self.record_occlusion();
        self.occlusion.going.renew();
    }

    /// Pictures go on where they only get more samples, or fewer. The same photons may be read off in another way.
    fn configure_pictures(&mut self, old: &Settings) {
        let Settings { image, seed, photons, occlusion, effects, form_factor, .. } = self.snapshot.settings;
        if occlusion != old.occlusion {
            self.easel.forget(CameraView::is_occluded);
        }
        if (PhotonSettings { passes: old.photons.passes, ..photons }) != old.photons {
            self.easel.forget(CameraView::needs_photons);
        }
        if effects != old.effects {
            let switches = |switches: Switches, view| switches.among(repertoire::of_view(view, form_factor));
            self.easel.forget(|view| switches(effects, view) != switches(old.effects, view));
        }
        if seed != old.seed || (ImageSettings { samples: old.image.samples, ..image }) != old.image {
            self.easel.clear();
        }
    }

    /// Shows a new world before its first step, or says why there is none, leaves everything as it was and returns false.
    fn take_over(&mut self, built: Result<World, NoWorld>) -> bool {
        let started = built.and_then(|world| Ok(self.start_radiosity(Arc::new(world))?));
        match started {
            Ok(()) => {
                self.snapshot.error = None;
                self.radiosity.going.renew();
                self.photons.going.renew();
                self.photons.run = None;
                self.forget_photons();
                self.occlusion.going.renew();
                self.occlusion.run = None;
                self.snapshot.occlusion = None;
                self.easel.clear();
                self.snapshot.image = None;
                self.start_what_is_needed();
                true
            }
            Err(no_world) => {
                if let NoWorld::Failed(reason) = no_world {
                    self.snapshot.error = Some(reason);
                }
                false
            }
        }
    }
}
