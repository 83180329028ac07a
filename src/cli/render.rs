//! `lightwell render`: a picture without a window.

use super::run_options::{RunOptions, Solved};
use super::solve::report;
use super::{Cli, CliError, picture, values};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::choice::{self, Choice};
use crate::methods::{Solver, radiosity};
use crate::scene::Viewpoint;
use crate::solution::{PathFilter, Picked};
use crate::viewport::diagram::{self, Diagram, MatrixDiagram};
use crate::viewport::{
    AdapterChoice, Exposure, Frame, Gpu, Legend, Light, PhotonLook, Picture, ToneCurve, View, pick_patch,
    render_picture,
};
use crate::world::World;
use clap::CommandFactory;
use clap::error::ErrorKind;
use glam::Vec3;
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// The picture's file, .png or .exr
    #[arg(short, long, value_name = "FILE", value_parser = values::picture_path)]
    output: PathBuf,
    /// What to show: patches, smooth, unshot, absorbed, bounces, form-factors, matrix or item-buffer
    #[arg(long, default_value = View::default().name(), value_parser = Subject::parse)]
    view: Subject,
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
    /// Width and height in pixels; a diagram fits in
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = values::size)]
    size: [u32; 2],
    /// Samples a pixel, in steps of four
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=4096))]
    samples: u32,
    /// Where the camera stands [default: chosen for the scene]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    eye: Option<Vec3>,
    /// What the camera looks at
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    target: Option<Vec3>,
    /// Which way is up
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    up: Option<Vec3>,
    /// Vertical angle of view
    #[arg(long, value_name = "DEG", value_parser = values::field_of_view)]
    fov: Option<f32>,
    /// Exposure in stops: radiance times 2^EV [default: automatic]
    #[arg(long, value_name = "EV", allow_hyphen_values = true, value_parser = values::stops)]
    exposure: Option<f32>,
    /// From radiance to the screen: filmic or linear
    #[arg(long, default_value = ToneCurve::default().name(), value_parser = choice::parse::<ToneCurve>)]
    tone: ToneCurve,
    /// The graphics adapter: `system` for the best one, `software`, or a part of its name
    #[arg(long, value_name = "software|NAME", default_value = "system")]
    adapter: AdapterChoice,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// What a picture is of.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Subject {
    View(View),
    Diagram(Diagram),
}

impl Subject {
    fn name(self) -> &'static str {
        match self {
            Self::View(view) => view.name(),
            Self::Diagram(diagram) => diagram.name(),
        }
    }

    fn all() -> impl Iterator<Item = Self> {
        View::ALL.iter().copied().map(Self::View).chain(Diagram::ALL.iter().copied().map(Self::Diagram))
    }

    fn parse(text: &str) -> Result<Self, String> {
        Self::all().find(|subject| subject.name() == text).ok_or_else(|| {
            let names: Vec<_> = Self::all().map(Self::name).collect();
            format!("no view is called `{text}` (there are {})", names.join(", "))
        })
    }
}

/// A picture, and what is said of it in its file and in the report.
struct Drawn {
    picture: Picture,
    facts: Vec<(String, String)>,
    report: Value,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    options.check();
    let (solved, drawn) = match options.view {
        Subject::View(view) => options.draw_view(view)?,
        Subject::Diagram(diagram) => options.draw_diagram(diagram)?,
    };
    picture::save(&options.output, &drawn.picture, &drawn.facts)?;
    if options.json {
        let mut report = report(&solved);
        report["picture"] = drawn.report;
        report["picture"]["file"] = json!(options.output);
        report["picture"]["size"] = json!(drawn.picture.size);
        report["picture"]["view"] = json!(options.view.name());
        writeln!(std::io::stdout(), "{report}")?;
    }
    Ok(())
}

impl Options {
    /// Ends the program, as any other wrong command line does, where the options cannot lead to the picture.
    fn check(&self) {
        let solver = self.run.settings().solver;
        let reason = match self.view {
            Subject::View(View::FormFactors) | Subject::Diagram(Diagram::ItemBuffer)
                if self.patch.is_none() && self.pick.is_none() =>
            {
                "this view is of one patch: --patch N or --pick X,Y says which"
            }
            Subject::View(View::Bounces) if solver != Solver::Jacobi => {
                "light is kept bounce by bounce by --solver jacobi alone"
            }
            Subject::Diagram(Diagram::Matrix) if !solver.needs_matrix() => {
                "a matrix is kept by --solver jacobi|gauss-seidel|southwell alone"
            }
            _ => return,
        };
        Cli::command().error(ErrorKind::ArgumentConflict, reason).exit();
    }

    fn draw_view(&self, view: View) -> Result<(Solved, Drawn), CliError> {
        // Whether there is something to draw with is told before the time is spent.
        let gpu = Gpu::new(&self.adapter)?;
        let (solved, light) = self.solve()?;
        if let Some(reason) = view.missing(&light) {
            return Err(CliError::Missing(reason));
        }
        let kept = solved.solution.bounces.len();
        if view == View::Bounces && self.bounce >= kept {
            return Err(CliError::NoSuchBounce { kept: kept - 1 });
        }
        let Solved { world, settings, solution } = &solved;
        let exposure = self.exposure.map_or(Exposure::Automatic, Exposure::Manual);
        let frame = Frame {
            camera: self.camera(world),
            size: self.size,
            view,
            bounce: self.bounce,
            ambient: self.ambient,
            wireframe: self.wireframe,
            show_shooter: false,
            photons: PhotonLook::default(),
            filter: PathFilter::default(),
            exposure_ev: exposure.ev(world, Some(solution)),
            tone: self.tone,
        };
        let picture = render_picture(&gpu, world, &light, &frame, self.samples)?;
        let facts = picture::facts(world, &light, settings, &frame);
        let report = match &light.picked {
            Some(picked) if view.is_false_colour() => {
                let legend = Legend::of(view, &light).map(|legend| json!({ "low": legend.low, "high": legend.high }));
                json!({ "patch": picked.patch, "legend": legend })
            }
            _ => json!({ "exposure": frame.exposure_ev }),
        };
        Ok((solved, Drawn { picture, facts, report }))
    }

    fn draw_diagram(&self, diagram: Diagram) -> Result<(Solved, Drawn), CliError> {
        let (solved, light) = self.solve()?;
        let Solved { world, settings, .. } = &solved;
        let limit = self.size[0].min(self.size[1]);
        let missing = || CliError::Missing(diagram.remedy());
        let (picture, report) = match diagram {
            Diagram::Matrix => {
                let matrix = solved.solution.matrix.as_ref().ok_or_else(missing)?;
                let MatrixDiagram { picture, legend, zeros } = diagram::matrix(matrix, limit);
                let legend = legend.map(|legend| json!({ "low": legend.low, "high": legend.high }));
                let zeros = zeros.map(|zero| json!({ "reason": zero.label, "share": zero.share }));
                (picture, json!({ "legend": legend, "zeros": zeros }))
            }
            Diagram::ItemBuffer => {
                let picked = light.picked.as_ref().ok_or_else(missing)?;
                (diagram::item_buffer(&picked.item_buffer, world, limit), json!({ "patch": picked.patch }))
            }
        };
        let facts = picture::diagram_facts(world, &light, settings, diagram);
        Ok((solved, Drawn { picture, facts, report }))
    }

    /// The scene with its light, and with what the picked patch sees.
    fn solve(&self) -> Result<(Solved, Light), CliError> {
        let world = self.run.open()?;
        let picked = self.picked(&world)?;
        let solved = self.run.solve_in(world)?;
        let light = Light { picked, ..Light::from(solved.solution.clone()) };
        Ok((solved, light))
    }

    fn picked(&self, world: &World) -> Result<Option<Arc<Picked>>, CliError> {
        let patches = world.mesh.patches.len();
        let patch = match (self.patch, self.pick) {
            (Some(patch), _) if patch as usize >= patches => return Err(CliError::NoSuchPatch { patch, patches }),
            (Some(patch), _) => patch,
            (None, Some(at)) => {
                pick_patch(world, &self.camera(world), at, self.size).ok_or(CliError::NothingPicked { at })?
            }
            (None, None) => return Ok(None),
        };
        Ok(radiosity::pick(world, &self.run.settings(), patch, &Cancel::default()).map(Arc::new))
    }

    /// At the scene's viewpoint, as far as no option says otherwise.
    fn camera(&self, world: &World) -> Camera {
        let scene = world.viewpoint;
        let viewpoint = Viewpoint {
            eye: self.eye.unwrap_or(scene.eye),
            target: self.target.unwrap_or(scene.target),
            up: self.up.unwrap_or(scene.up),
            vertical_fov: self.fov.unwrap_or(scene.vertical_fov),
        };
        Camera::new(&viewpoint, &world.bounds)
    }
}
