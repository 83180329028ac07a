//! `lightwell render`: a picture without a window.

mod budget;
mod diagrams;
mod subject;
mod views;

use super::budget::BudgetOutcome;
use super::camera_options::CameraOptions;
use super::image_options::ImageOptions;
use super::occlusion_options::OcclusionOptions;
use super::photon_options::PhotonOptions;
use super::run_options::RunOptions;
use super::{CliError, picture, refuse, values};
use crate::methods::{ImageSettings, OcclusionSettings, Settings};
use crate::viewport::{Picture, View};
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use subject::Subject;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// The picture's file, .png or .exr
    #[arg(short, long, value_name = "FILE", value_parser = values::picture_path)]
    output: PathBuf,
    /// What to show: patches, smooth, unshot, absorbed, bounces or form-factors of radiosity; photons or kd-tree;
    /// photon-irradiance, photon-radiance, caustics, ray-traced, radiosity-specular, radiosity-direct or final-gather by rays from the
    /// camera, reference by path tracing; ambient-occlusion, diffuse or diffuse-ao with even light from everywhere, ambient-occlusion-vertices on the
    /// mesh, ao-minus-indirect against the true light between surfaces; error-of- and a view, against the reference; the
    /// diagrams matrix or item-buffer [default: smooth, or with --error, or --time, what suits it best]
    #[arg(long, value_name = "VIEW", value_parser = Subject::parse)]
    view: Option<Subject>,
    /// Choose the settings, and the view unless --view says it: the cheapest picture whose error is at most this share of the
    /// mean radiance of the surfaces that are seen. With --time instead, and no --view, the most accurate within this time in
    /// all; with both, the same, but no longer than the error takes
    #[arg(long, value_name = "PERCENT", conflicts_with_all = ["steps", "converge"], value_parser = values::percent)]
    error: Option<f64>,
    /// How many bounces of light the view `bounces` shows
    #[arg(long, value_name = "N", default_value_t = 0)]
    bounce: usize,
    /// Add to patches and smooth light what the unshot light will bring on average
    #[arg(long)]
    ambient: bool,
    /// The patch that the views `form-factors` and `item-buffer` are of
    #[arg(long, value_name = "N", group = "picked")]
    patch: Option<u32>,
    /// The same: the patch seen at this place in a view of this size, in pixels from the top left
    #[arg(long, value_name = "X,Y", group = "picked", value_parser = values::pixel)]
    pick: Option<[f32; 2]>,
    /// Outline the elements
    #[arg(long)]
    wireframe: bool,
    /// Samples a pixel, by rays from the camera one by one and else in steps of four [default: 16, of an error 256, or as many
    /// as --time allows]; where --passes asks for more passes than one, each gives a sample; for ambient-occlusion-vertices,
    /// rounds of rays from every vertex
    #[arg(long, value_name = "N", value_parser = values::count::<{ ImageSettings::MAX_SAMPLES }>)]
    samples: Option<u32>,
    #[command(flatten)]
    photons: PhotonOptions,
    #[command(flatten)]
    image: ImageOptions,
    #[command(flatten)]
    occlusion: OcclusionOptions,
    #[command(flatten)]
    camera: CameraOptions,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// A picture, what is said of it in its file, and the report.
struct Drawn {
    picture: Picture,
    facts: Vec<(String, String)>,
    /// What is said of the picture itself goes under `picture`.
    report: Value,
    /// What a budget has led to, if there was one.
    account: Option<BudgetOutcome>,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let budget = options.budget();
    let Drawn { picture, facts, mut report, account } = match budget {
        Some(budget) => options.draw_within(&budget)?,
        None => {
            if let Some(objection) = options.objection() {
                refuse(&objection);
            }
            match options.view() {
                Subject::View(view) => options.draw_view(view)?,
                Subject::Diagram(diagram) => options.draw_diagram(diagram)?,
            }
        }
    };
    picture::save(&options.output, &picture, &facts)?;
    if options.json {
        report["picture"]["file"] = json!(options.output);
        report["picture"]["size"] = json!(picture.size);
        if let Some(account) = &account {
            account.add_to(&mut report);
        }
        writeln!(std::io::stdout(), "{report}")?;
    } else if let Some(account) = &account {
        write!(std::io::stdout(), "{}", account.text())?;
    }
    Ok(())
}

/// Samples a pixel where nothing is said.
const SAMPLES: u32 = 16;

impl Options {
    fn view(&self) -> Subject {
        self.view.unwrap_or(Subject::View(View::default()))
    }

    fn settings(&self) -> Settings {
        let settings = self.run.settings();
        // Radiosity's own, or those of the view: one option, but two numbers.
        let is_of_view = self.view().samples_emitters();
        let light_rays = if is_of_view { Settings::default().light_rays } else { settings.light_rays };
        let own = self.run.light_rays.filter(|_| is_of_view);
        let image = self.image.settings(own);
        let occlusion = self.occlusion.settings(OcclusionSettings::default().rays);
        Settings { light_rays, photons: self.photons.settings(), image, occlusion, ..settings }
    }
}
