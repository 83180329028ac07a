//! Pictures for a budget.

use super::subject::Subject;
use super::{Drawn, Options};
use crate::choice::Choice;
use crate::cli::budget::CommandBudget;
use crate::cli::seeking::picture_for;
use crate::cli::{CliError, refuse};
use crate::study::{self, Way};
use crate::viewport::{Light, View};

/// Ways whose pictures can be made for a budget.
const WAYS: [Way; 4] = [Way::Reference, Way::RadiosityDirect, Way::FinalGather, Way::DiffuseAo];

impl Options {
    /// What is asked for instead of a way to make the picture, if anything is. Ends the program, as any other wrong command
    /// line does, where options say how it is made all the same.
    pub(super) fn budget(&self) -> Option<CommandBudget> {
        let view = self.view.map(|view| format!("--view {}", view.name()));
        // With an error, the settings of one view may be asked for; with a time, a view stops there.
        let budget = CommandBudget::of(&self.run, self.error, view.as_deref().filter(|_| self.error.is_none()))?;
        let says_how = self.samples.is_some()
            || self.photons.given().is_some()
            || self.image.gather_rays.is_some()
            || self.image.paths.is_some()
            || self.occlusion.given().is_some();
        if says_how {
            CommandBudget::refuse_choices();
        }
        if self.patch.is_some() || self.pick.is_some() || self.ambient || self.bounce > 0 || self.wireframe {
            refuse("--error, and --time without --view, make pictures by rays: they show no patches");
        }
        Some(budget)
    }

    /// The way that makes pictures of the view that is asked for, if one is.
    fn way(&self) -> Option<Way> {
        let view = self.view?;
        let is_of_view = |way: &Way| view == Subject::View(View::Camera(way.picture()));
        let way = WAYS.into_iter().find(is_of_view);
        if way.is_none() {
            let names: Vec<_> = WAYS.iter().map(|way| way.picture().name()).collect();
            refuse(&format!("--error goes with --view {}, or with no view", names.join("|")));
        }
        way
    }

    pub(super) fn draw_within(&self, budget: &CommandBudget) -> Result<Drawn, CliError> {
        let way = self.way();
        let gpu = self.camera.gpu()?;
        let (world, found, account) = picture_for(budget, &self.run, &self.camera, way)?;
        let light = match found.light {
            Some(study::Light::Radiosity(_, solution)) => Light { solution: Some(solution), ..Light::default() },
            Some(study::Light::Photons(_, photons)) => Light { photons: Some(photons), ..Light::default() },
            None => Light::default(),
        };
        let mut drawn = self.draw_image(&gpu, &world, &found.recipe.settings, light, found.image)?;
        drawn.facts.extend(account.quality().facts());
        Ok(Drawn { account: Some(account), ..drawn })
    }
}
