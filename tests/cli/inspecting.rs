//! `lightwell inspect`.

use crate::{assert_contains, folder, json, keys, printed, write_dark_scene};

#[test]
fn an_inspection_is_a_census() {
    let folder = folder();
    let census = json(&folder, "inspect furnace --element 0.25 --json");
    let fields = [
        "closed",
        "element_size",
        "elements",
        "emitters",
        "extent",
        "findings",
        "materials",
        "patches",
        "polygons",
        "scene",
        "triangles",
        "viewpoint",
    ];
    assert_eq!(keys(&census), fields);
    for (name, count) in
        [("polygons", 6), ("triangles", 12), ("materials", 1), ("emitters", 6), ("patches", 6), ("elements", 96)]
    {
        assert_eq!(census[name], count, "{name}");
    }
    assert_eq!(census["closed"], true);
    assert_eq!(census["extent"]["min"], serde_json::json!([0.0, 0.0, 0.0]));
    assert_eq!(census["extent"]["max"], serde_json::json!([1.0, 1.0, 1.0]));
    assert_eq!(json(&folder, "inspect cornell-box --json")["closed"], false);
    assert_contains(&printed(&folder, "inspect furnace --element 0.25"), &["6 polygons", "96 elements", "closed"]);
}

#[test]
fn an_inspection_tells_what_is_wrong() {
    let folder = folder();
    write_dark_scene(&folder);
    let census = json(&folder, "inspect dark.obj --json");
    let finding = &census["findings"][0];
    assert_eq!(keys(finding), ["kind", "problem", "remedy", "severity", "subject"]);
    assert_eq!((&finding["kind"], &finding["severity"]), (&"no-emitter".into(), &"warning".into()));
    assert_contains(&printed(&folder, "inspect dark.obj"), &["warning: the scene: no surface emits light"]);
}
