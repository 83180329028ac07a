//! Light, and pictures, for a budget.

use super::CliError;
use super::budget::{BudgetOutcome, CommandBudget};
use super::camera_options::CameraOptions;
use super::progress_line::ProgressLine;
use super::run_options::RunOptions;
use crate::accuracy::Cache;
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::Settings;
use crate::study::{Bench, Light, PictureRequest, PictureResult, SearchResult, Way, Worlds, picture, seek};
use crate::world::World;
use std::sync::Arc;
use std::time::Duration;

/// What is kept of the time allowed for telling what was found, and for drawing and writing a picture.
const FOR_TELLING: Duration = Duration::from_millis(50);
const FOR_DRAWING: Duration = Duration::from_millis(200);
const FOR_A_PIXEL: Duration = Duration::from_nanos(400);

/// Light that a budget has led to.
pub struct Found {
    pub light: Light,
    pub settings: Settings,
    pub account: BudgetOutcome,
}

/// The settings that all is tried with, but for what is turned.
fn plain(run: &RunOptions) -> Settings {
    Settings { unshot_limit: Settings::default().unshot_limit, ..run.settings() }
}

/// Looks for light that keeps to the budget, by what is known of the scene and what it finds out, which is kept.
pub fn light_for(budget: &CommandBudget, run: &RunOptions) -> Result<Found, CliError> {
    let world = run.open()?;
    let settings = plain(run);
    let mut bench = Bench::open(world, settings.mesh, Cache::of_user());
    let mut progress = ProgressLine::new();
    let of_search = budget.of_search(FOR_TELLING);
    let found = seek(&mut bench, &settings, &of_search, &Cancel::default(), &mut |news| progress.tell(news));
    drop(progress);
    if let Err(error) = bench.keep() {
        eprintln!("warning: {}", with_causes(&error));
    }
    let SearchResult { outcome, error, prediction } = found?;
    let recipe = outcome.recipe;
    Ok(Found {
        light: outcome.light.expect("light that is sought is everywhere"),
        settings: recipe.settings,
        account: BudgetOutcome {
            budget: *budget,
            recipe,
            options: recipe.options(),
            error,
            solver_seconds: outcome.price.seconds,
            prediction,
        },
    })
}

/// Makes a picture that keeps to the budget, in this way if there is one.
pub fn picture_for(
    budget: &CommandBudget,
    run: &RunOptions,
    camera: &CameraOptions,
    way: Option<Way>,
) -> Result<(Arc<World>, PictureResult, BudgetOutcome), CliError> {
    let world = run.open()?;
    let settings = plain(run);
    let mut worlds = Worlds::new(world.clone(), settings.mesh);
    let pixels = camera.size.map(f64::from).iter().product::<f64>();
    let request = PictureRequest {
        camera: camera.camera(&world),
        size: camera.size,
        way,
        budget: budget.of_search(FOR_DRAWING + FOR_A_PIXEL.mul_f64(pixels)),
    };
    let mut progress = ProgressLine::new();
    let found = picture(&mut worlds, &settings, &request, &Cancel::default(), &mut |news| progress.tell(news));
    drop(progress);
    let found = found?;
    let account = BudgetOutcome {
        budget: *budget,
        recipe: found.recipe,
        options: found.recipe.options_of_picture(),
        error: found.error,
        solver_seconds: found.seconds,
        prediction: found.prediction,
    };
    // Light of elements is kept in the world that was cut into them.
    let world = match &found.light {
        Some(Light::Radiosity(world, _) | Light::Photons(world, _)) => world.clone(),
        None => world,
    };
    Ok((world, found, account))
}
