//! What was found at points, printed as a table or as JSON.

use super::super::CliError;
use super::super::judge::Verdict;
use crate::accuracy::ProbePoint;
use crate::cli::budget::BudgetOutcome;
use crate::math::rgb::Rgb;
use crate::world::World;
use serde_json::{Value, json};
use std::io::Write;

/// What was found at a point, and how good it is.
pub struct Measured {
    pub at: ProbePoint,
    /// The irradiance, W/m², or the share of ambient light that arrives.
    pub value: Rgb,
    pub quality: Quality,
}

pub enum Quality {
    /// Of radiosity, which does not tell.
    Unknown,
    /// Of an estimate from the photons within a radius, m: the relative standard error of its noise, infinite where no photon
    /// landed.
    Estimate { relative_error: f32, radius: f32, photons: u32 },
    /// Of a mean over passes: its standard error, W/m², by channel.
    Mean { standard_error: [f64; 3], passes: u64 },
    /// Of a mean over samples as a picture has them: at most its standard error, W/m², by channel, that of the photons that all
    /// samples share included. Infinite where it cannot be told from one sample. A bias is not in it.
    Samples { standard_error: [f64; 3], samples: u64 },
    /// Of a mean over paths: its standard error, W/m², by channel.
    Paths { standard_error: [f64; 3], paths: u64 },
    /// Of a share: its standard error, the same in all channels.
    Share { standard_error: f64, rays: u64 },
}

/// In the coordinates of the file; with how far off they are, where that was measured, and with what a budget has led to, if there was one.
pub fn print(
    world: &World,
    measured: &[Measured],
    verdict: Option<&Verdict>,
    account: Option<&BudgetOutcome>,
    as_json: bool,
) -> Result<(), CliError> {
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    if as_json {
        let points: Vec<Value> = measured.iter().map(|measured| measured.json(world)).collect();
        let mut report = json!({ "points": points });
        if let Some(verdict) = verdict {
            report["accuracy"] = verdict.json();
        }
        if let Some(account) = account {
            account.add_to(&mut report);
        }
        writeln!(out, "{report}")?;
    } else {
        let columns = measured.first().map_or("", |first| first.quality.columns());
        writeln!(out, "x,y,z,nx,ny,nz,r,g,b{columns}")?;
        for Measured { at, value, quality } in measured {
            let point = world.scene.file_from_scene(at.point.into());
            let numbers = [at.normal.into(), *value].map(|v| format!("{},{},{}", v.x, v.y, v.z));
            writeln!(out, "{},{},{},{}{}", point.x, point.y, point.z, numbers.join(","), quality.values())?;
        }
        if let Some(verdict) = verdict {
            eprint!("{}", verdict.text());
        }
        if let Some(account) = account {
            eprint!("{}", account.text());
        }
    }
    out.flush()?;
    Ok(())
}

impl Measured {
    fn json(&self, world: &World) -> Value {
        let ProbePoint { point, normal } = self.at;
        let mut object = json!({
            "point": world.scene.file_from_scene(point.into()).to_array(),
            "normal": normal.to_array(),
            "on_surface": world.meet_at(point, normal).is_some(),
        });
        let what = if let Quality::Share { .. } = self.quality { "share" } else { "irradiance" };
        object[what] = json!(self.value.to_array());
        match self.quality {
            Quality::Unknown => {}
            Quality::Estimate { relative_error, radius, photons } => {
                object["relative_error"] = json!(relative_error);
                object["radius"] = json!(radius);
                object["photons"] = json!(photons);
            }
            Quality::Mean { standard_error, passes } => {
                object["standard_error"] = json!(standard_error);
                object["passes"] = json!(passes);
            }
            Quality::Samples { standard_error, samples } => {
                object["standard_error"] = json!(standard_error);
                object["samples"] = json!(samples);
            }
            Quality::Paths { standard_error, paths } => {
                object["standard_error"] = json!(standard_error);
                object["paths"] = json!(paths);
            }
            Quality::Share { standard_error, rays } => {
                object["standard_error"] = json!(standard_error);
                object["rays"] = json!(rays);
            }
        }
        object
    }
}

impl Quality {
    /// Names of further columns of the table.
    fn columns(&self) -> &'static str {
        match self {
            Self::Unknown => "",
            Self::Estimate { .. } => ",relative_error,radius,photons",
            Self::Mean { .. } => ",r_error,g_error,b_error,passes",
            Self::Samples { .. } => ",r_error,g_error,b_error,samples",
            Self::Paths { .. } => ",r_error,g_error,b_error,paths",
            Self::Share { .. } => ",standard_error,rays",
        }
    }

    fn values(&self) -> String {
        match self {
            Self::Unknown => String::new(),
            Self::Estimate { relative_error, radius, photons } => format!(",{relative_error},{radius},{photons}"),
            Self::Mean { standard_error: [r, g, b], passes } => format!(",{r},{g},{b},{passes}"),
            Self::Samples { standard_error: [r, g, b], samples } => format!(",{r},{g},{b},{samples}"),
            Self::Paths { standard_error: [r, g, b], paths } => format!(",{r},{g},{b},{paths}"),
            Self::Share { standard_error, rays } => format!(",{standard_error},{rays}"),
        }
    }
}
