//! `lightwell check`: the gallery of hard cases, as a table.

use super::CliError;
use crate::cancel::Cancel;
use crate::hard_cases::{Row, Verdict, cases};
use clap::builder::PossibleValuesParser;
use serde_json::json;
use std::io::Write;

#[derive(clap::Args, Debug)]
pub struct Options {
    /// Run one case only
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(cases().map(|case| case.name)))]
    case: Option<String>,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// Fails if a row does.
pub fn run(options: &Options) -> Result<(), CliError> {
    let is_wanted = |name: &str| options.case.as_deref().is_none_or(|wanted| wanted == name);
    let wanted = cases().filter(|case| is_wanted(case.name));
    let rows: Vec<Row> = wanted.flat_map(|case| case.run(&Cancel::default()).unwrap_or_default()).collect();
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{}", json!({ "cases": rows }))?;
    } else {
        write!(out, "{}", table(&rows))?;
    }
    match count(&rows, Verdict::Fail) {
        0 => Ok(()),
        failed => Err(CliError::Check { failed, rows: rows.len() }),
    }
}

fn count(rows: &[Row], verdict: Verdict) -> usize {
    rows.iter().filter(|row| row.verdict == verdict).count()
}

/// Columns as wide as their longest word; numbers to the right.
fn table(rows: &[Row]) -> String {
    let head = ["verdict", "case", "quantity", "expected", "got", "tolerance", "guard, or reason for the limit"];
    let cells = rows.iter().map(|row| {
        let verdict = match row.verdict {
            Verdict::Pass => "pass",
            Verdict::Fail => "FAIL",
            Verdict::Limit => "limit",
        };
        let [expected, got] = [row.expected, row.got].map(number);
        let tolerance = if row.tolerance == 0.0 { "exact".to_owned() } else { format!("{:.0e}", row.tolerance) };
        [verdict.to_owned(), row.case.to_owned(), row.quantity.clone(), expected, got, tolerance, row.guard.clone()]
    });
    let lines: Vec<[String; 7]> = std::iter::once(head.map(str::to_owned)).chain(cells).collect();
    let width = |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0);
    let widths = [0, 1, 2, 3, 4, 5, 6].map(width);
    let mut text = String::new();
    for [verdict, case, quantity, expected, got, tolerance, guard] in &lines {
        let [v, c, q, e, g, t, _] = widths;
        text +=
            &format!("{verdict:v$}  {case:c$}  {quantity:q$}  {expected:>e$}  {got:>g$}  {tolerance:>t$}  {guard}\n");
    }
    let [passed, failed, limits] = [Verdict::Pass, Verdict::Fail, Verdict::Limit].map(|verdict| count(rows, verdict));
    text + &format!("{} rows: {passed} pass, {failed} fail, {limits} known limits\n", rows.len())
}

/// Up to nine digits.
fn number(value: f64) -> String {
    let size = value.abs();
    if value.fract() == 0.0 && size < 1e9 || !value.is_finite() {
        format!("{value}")
    } else if (1e-3..1e6).contains(&size) {
        format!("{value:.9}")
    } else {
        format!("{value:.6e}")
    }
}
