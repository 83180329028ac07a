//! `lightwell scenes`: what is built in.

use super::CliError;
use crate::scene::BUILTINS;
use serde_json::json;
use std::io::Write;

#[derive(clap::Args, Debug)]
pub struct Options {
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let mut out = std::io::stdout().lock();
    if options.json {
        let scenes: Vec<_> =
            BUILTINS.iter().map(|scene| json!({ "name": scene.name, "description": scene.description })).collect();
        writeln!(out, "{}", json!({ "scenes": scenes }))?;
        return Ok(());
    }
    for scene in BUILTINS {
        writeln!(out, "{:<14} {}", scene.name, scene.description)?;
    }
    Ok(())
}
