//! Diagrams: the matrix of form factors, and what one patch sees.

use super::{Drawn, Options};
use crate::cancel::Cancel;
use crate::choice::Choice;
use crate::cli::run_options::Solved;
use crate::cli::solve::report;
use crate::cli::{CliError, picture};
use crate::methods::radiosity;
use crate::solution::Picked;
use crate::viewport::diagram::{self, Diagram, MatrixDiagram};
use crate::viewport::{Light, pick_patch};
use crate::worker::check_picture;
use crate::world::World;
use serde_json::json;
use std::sync::Arc;

impl Options {
    pub(super) fn draw_diagram(&self, diagram: Diagram) -> Result<Drawn, CliError> {
        check_picture(self.camera.size)?;
        let (solved, light) = self.solve()?;
        let Solved { world, settings, .. } = &solved;
        let limit = self.camera.size[0].min(self.camera.size[1]);
        let missing = || CliError::Missing(diagram.remedy());
        let mut report = report(&solved);
        let picture = match diagram {
            Diagram::Matrix => {
                let matrix = solved.solution.matrix.as_ref().ok_or_else(missing)?;
                let MatrixDiagram { picture, legend, zeros } = diagram::matrix(matrix, limit);
                let legend = legend.map(|legend| json!({ "low": legend.low, "high": legend.high }));
                let zeros = zeros.map(|zero| json!({ "reason": zero.label, "share": zero.share }));
                report["picture"] = json!({ "legend": legend, "zeros": zeros });
                picture
            }
            Diagram::ItemBuffer => {
                let picked = light.picked.as_ref().ok_or_else(missing)?;
                report["picture"] = json!({ "patch": picked.patch });
                diagram::item_buffer(&picked.item_buffer, world, limit)
            }
        };
        report["picture"]["view"] = json!(diagram.name());
        let facts = picture::diagram_facts(world, &light, settings, diagram);
        Ok(Drawn { picture, facts, report, account: None })
    }

    /// The scene with its radiosity, and with what the picked patch sees.
    pub(super) fn solve(&self) -> Result<(Solved, Light), CliError> {
        let world = self.run.open()?;
        let picked = self.picked(&world)?;
        let solved = self.run.solve_in(world, self.settings())?;
        let light = Light { picked, ..Light::from(solved.solution.clone()) };
        Ok((solved, light))
    }

    fn picked(&self, world: &World) -> Result<Option<Arc<Picked>>, CliError> {
        let patches = world.mesh.patches.len();
        let patch = match (self.patch, self.pick) {
            (Some(patch), _) if patch as usize >= patches => return Err(CliError::NoSuchPatch { patch, patches }),
            (Some(patch), _) => patch,
            (None, Some(at)) => pick_patch(world, &self.camera.camera(world), at, self.camera.size)
                .ok_or(CliError::NothingPicked { at })?,
            (None, None) => return Ok(None),
        };
        Ok(radiosity::pick(world, &self.run.settings(), patch, &Cancel::default()).map(Arc::new))
    }
}
