//! The program: a window, or one of the commands that need none.

use clap::Parser;
use lightwell::app;
use lightwell::cli::{Cli, WindowOptions};
use lightwell::errors::with_causes;
use std::process::ExitCode;

fn main() -> ExitCode {
    env_logger::init();
    let cli = Cli::parse();
    let result = match &cli.command {
        Some(command) => command.run().map_err(|error| with_causes(&error)),
        None => {
            let WindowOptions { scene, adapter } = cli.window;
            app::run(app::Options { scene, adapter }).map_err(|error| with_causes(&error))
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("lightwell: {message}");
            ExitCode::FAILURE
        }
    }
}
