//! Light, and pictures, for a budget.

use super::CliError;
use super::budget::{Account, Budget};
use super::camera_options::CameraOptions;
use super::run_options::RunOptions;
use crate::accuracy::Cache;
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::Settings;
use crate::study::{Bench, Goal, Light, PictureGoal, Pictured, Sought, Way, Worlds, picture, seek};
use crate::world::World;
use std::sync::Arc;
use std::time::Duration;

/// What is kept of the time allowed for telling what was found, and for drawing and writing a picture.
const FOR_TELLING: Duration = Duration::from_millis(50);
const FOR_DRAWING: Duration = Duration::from_millis(150);

/// Light that a budget has led to.
pub struct Found {
    pub light: Light,
    pub settings: Settings,
    pub account: Account,
}

/// The settings that all is tried with, but for what is turned.
fn plain(run: &RunOptions) -> Settings {
    Settings { unshot_limit: Settings::default().unshot_limit, ..run.settings() }
}

/// Looks for light that keeps to the budget, by what is known of the scene and what it finds out, which is kept.
pub fn light_for(budget: &Budget, run: &RunOptions) -> Result<Found, CliError> {
    let world = run.open()?;
    let settings = plain(run);
    let mut bench = Bench::open(world, settings.mesh, Cache::of_user());
    let goal = Goal { error: budget.error, end: budget.end(FOR_TELLING) };
    let sought = seek(&mut bench, &settings, &goal, &Cancel::default());
    if let Err(error) = bench.keep() {
        eprintln!("warning: {}", with_causes(&error));
    }
    let Sought { outcome, error, promise } = sought?;
    let recipe = outcome.recipe;
    Ok(Found {
        light: outcome.light.expect("light that is sought is everywhere"),
        settings: recipe.settings,
        account: Account {
            budget: *budget,
            recipe,
            options: recipe.options(),
            error,
            solver_seconds: outcome.price.seconds,
            promise,
        },
    })
}

/// Makes a picture that keeps to the budget, in this way if there is one.
pub fn picture_for(
    budget: &Budget,
    run: &RunOptions,
    camera: &CameraOptions,
    way: Option<Way>,
) -> Result<(Arc<World>, Pictured, Account), CliError> {
    let world = run.open()?;
    let settings = plain(run);
    let mut worlds = Worlds::new(world.clone(), settings.mesh);
    let goal = PictureGoal {
        camera: camera.camera(&world),
        size: camera.size,
        way,
        error: budget.error,
        end: budget.end(FOR_DRAWING),
    };
    let found = picture(&mut worlds, &settings, &goal, &Cancel::default())?;
    let account = Account {
        budget: *budget,
        recipe: found.recipe,
        options: found.recipe.options_of_picture(),
        error: found.error,
        solver_seconds: found.seconds,
        promise: found.promise,
    };
    // Light of elements is kept in the world that was cut into them.
    let world = match &found.light {
        Some(Light::Radiosity(world, _) | Light::Photons(world, _)) => world.clone(),
        None => world,
    };
    Ok((world, found, account))
}
