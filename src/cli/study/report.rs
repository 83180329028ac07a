//! What a study has found, in words and tables.

use crate::accuracy::exponent;
use crate::choice::Choice;
use crate::study::{Gain, Measured, Setting, Study, Turn};

/// A step of the front that leaves more of the error is not told.
const WORTH_TELLING: f64 = 0.95;

/// A few lines for the shell: the front.
pub fn summary(study: &Study) -> String {
    let mut text = format!("{:>9} {:>9}   the cheapest way to that error\n", "error", "seconds");
    for measured in steps_of_front(study) {
        text += &format!(
            "{:>9} {:>9}   {}\n",
            percent(measured.error.rms),
            seconds(measured.price.seconds),
            measured.recipe.options()
        );
    }
    text
}

/// The report, in Markdown.
pub fn markdown(scene: &str, budget: f64, study: &Study) -> String {
    let truth = &study.truth;
    let mut text = format!("# What accuracy costs in time: {scene}\n\n");
    if study.measured.is_empty() {
        return text + "There is no light to measure.\n";
    }
    text += &format!(
        "Errors are root mean squares over {} points spread by area, as shares of the mean irradiance. The reference is path \
         traced, {} paths from each point; its own error, {}, is taken out. Seconds are those of the solver, on {} threads. \
         Radiosity and photon maps know light everywhere then; the other methods were asked at these points alone. The study \
         took {:.1} of {budget} s.\n\n![error over seconds](cost.svg)\n\n",
        truth.irradiance.len(),
        truth.paths,
        percent(truth.floor),
        study.threads,
        study.elapsed.as_secs_f64(),
    );
    text += "## The front: no other run was both faster and better\n\n";
    text += "| error | seconds | memory | how |\n|---:|---:|---:|---|\n";
    for measured in steps_of_front(study) {
        text += &row(measured);
    }
    text += "\n## How fast errors fall\n\n";
    text += "Noise of independent samples falls with the exponent −0.5 over time: four times the time for half the error; \
             that of well-spread ones a little faster. Where a bias is left, errors level off: towards 0.\n\n";
    text += "| method | exponent over the last tenfold of time |\n|---|---:|\n";
    for (way, slope) in &study.slopes {
        text += &format!("| {} | {} |\n", way.label(), exponent(*slope));
    }
    text += &levels(study);
    text += "\n## What each knob buys\n\nAll other settings are as they were.\n\n";
    text += "| method | turn | time | error |\n|---|---|---:|---:|\n";
    for gain in &study.gains {
        text += &turn(gain);
    }
    text += "\n## All runs\n\n| error | seconds | memory | how |\n|---:|---:|---:|---|\n";
    for measured in study.measured.iter().filter(|measured| measured.is_last(&study.measured)) {
        text += &row(measured);
    }
    for (recipe, reason) in &study.refused {
        text += &format!("\n`{}` was refused: {reason}\n", recipe.options());
    }
    text
}

/// Where solving any longer bought nothing.
fn levels(study: &Study) -> String {
    if study.levels.is_empty() {
        return String::new();
    }
    let mut text = String::from("\n## Where errors level off\n\n");
    text += "Radiosity tends to the bias of its elements and form factors: from then on, solving any longer bought nothing.\n\n";
    text += "| error | after seconds | of | how |\n|---:|---:|---:|---|\n";
    for since in study.levels.iter().map(|&index| &study.measured[index]) {
        let Some(last) = study.measured.iter().rfind(|measured| measured.run == since.run) else { continue };
        text += &format!(
            "| {} | {} | {} | `{}` |\n",
            percent(last.error.rms),
            seconds(since.price.seconds),
            seconds(last.price.seconds),
            last.recipe.options(),
        );
    }
    text
}

/// The front without steps that gain next to nothing.
fn steps_of_front(study: &Study) -> Vec<&Measured> {
    let mut steps: Vec<&Measured> = Vec::new();
    for measured in study.front.iter().map(|&index| &study.measured[index]) {
        if steps.last().is_none_or(|last| measured.error.rms < WORTH_TELLING * last.error.rms) {
            steps.push(measured);
        }
    }
    steps
}

fn row(measured: &Measured) -> String {
    let unfinished = if measured.is_finished { "" } else { " (stopped there)" };
    format!(
        "| {} ± {} | {} | {} | `{}`{unfinished} |\n",
        percent(measured.error.rms),
        percent(measured.error.uncertainty),
        seconds(measured.price.seconds),
        memory(measured.price.bytes),
        measured.recipe.options(),
    )
}

/// "halving the element size: 3.9 × the time, 0.52 × the error"
fn turn(gain: &Gain) -> String {
    let knob = gain.knob.label();
    let how = match gain.turn {
        Turn::Times { factor, from, to } => {
            let [from, to] = [from, to].map(Setting::Number);
            match factor {
                0.499..0.501 => format!("halving {knob} ({from} to {to})"),
                1.999..2.001 => format!("doubling {knob} ({from} to {to})"),
                _ => format!("{knob} from {from} to {to}"),
            }
        }
        Turn::Choice { from, to } => format!("{knob}: {to} instead of {from}"),
    };
    let by = gain.by.map_or(String::new(), |by| format!(", {by}"));
    format!("| {}{by} | {how} | {:.2} × | {:.2} × |\n", gain.way.label(), gain.time, gain.error)
}

fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 10.0 { format!("{percent:.1} %") } else { format!("{percent:.2} %") }
}

fn seconds(seconds: f64) -> String {
    if seconds < 0.1 { format!("{seconds:.3}") } else { format!("{seconds:.2}") }
}

fn memory(bytes: u64) -> String {
    let mib = bytes as f64 / f64::from(1 << 20);
    if bytes == 0 { "0".to_owned() } else { format!("{mib:.1} MiB") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::Error;
    use crate::methods::Settings;
    use crate::study::{Price, Recipe, Way};

    #[test]
    fn where_errors_level_off_is_told_with_what_was_spent_beyond() {
        let measured = |seconds, rms| Measured {
            run: 3,
            recipe: Recipe { way: Way::Radiosity, settings: Settings::default() },
            is_finished: true,
            price: Price { seconds, ..Price::default() },
            error: Error { rms, ..Error::default() },
        };
        let measured = vec![measured(0.2, 0.5), measured(1.0, 0.102), measured(4.0, 0.1)];
        let study = Study { measured, levels: vec![1], ..Study::default() };
        let text = markdown("a room", 60.0, &study);
        assert!(
            text.contains("## Where errors level off") && text.contains("| 10.0 % | 1.00 | 4.00 | `--method"),
            "{text}"
        );
        let none = markdown("a room", 60.0, &Study { levels: Vec::new(), ..study });
        assert!(!none.contains("level off\n"), "{none}");
    }
}
