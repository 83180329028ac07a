//! `lightwell check`.

use crate::{assert_contains, folder, json, keys, printed, refusal};

#[test]
fn one_case_prints_a_table() {
    let text = printed(&folder(), "check --case horizon");
    let lines: Vec<&str> = text.lines().collect();
    assert_contains(lines[0], &["verdict", "case", "quantity", "expected", "got", "tolerance", "guard"]);
    let (rows, summary) = (&lines[1..lines.len() - 1], lines[lines.len() - 1]);
    assert!(rows.len() > 1 && rows.iter().all(|row| row.starts_with("pass     horizon ")), "{text}");
    assert_eq!(summary, format!("{0} rows: {0} pass, 0 fail, 0 known limits", rows.len()));
    let column = |line: &str| line.find("the polygon is clipped");
    assert!(rows.iter().all(|row| column(row).is_some() && column(row) == column(rows[0])), "{text}");
}

#[test]
fn as_json_every_row_is_an_object() {
    let report = json(&folder(), "check --json --case point-on-edge");
    let rows = report["cases"].as_array().expect("rows");
    assert!(rows.iter().all(|row| {
        keys(row) == ["case", "expected", "got", "guard", "quantity", "tolerance", "verdict"]
            && row["case"] == "point-on-edge"
    }));
    let verdicts: Vec<_> = rows.iter().map(|row| row["verdict"].as_str().expect("a word")).collect();
    assert_eq!(verdicts, ["limit", "pass"]);
}

#[test]
fn an_unknown_case_is_refused_with_the_names_there_are() {
    let message = refusal(&folder(), "check --case no-such-case", 2);
    assert_contains(&message, &["no-such-case", "horizon", "shared-edge"]);
}
