//! `lightwell inspect`.

use crate::{assert_contains, folder, json, keys, printed, write_dark_scene};

#[test]
fn an_inspection_is_a_census() {
    let folder = folder();
    let census = json(&folder, "inspect furnace --element 0.25 --json");
    let fields = [
        "closed",
        "effects",
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

#[test]
fn a_plan_judges_all_effects_and_names_a_method() {
    let folder = folder();
    let plan = json(&folder, "plan furnace --json");
    assert_eq!(keys(&plan), ["effects", "method", "method_reason", "parts", "scene"]);
    assert_eq!(plan["method"], "radiosity");
    let effects = plan["effects"].as_array().expect("a list");
    let needed: Vec<_> = effects.iter().filter(|verdict| verdict["needed"] == true).collect();
    assert_eq!((effects.len(), needed.len()), (10, 2), "{plan}");
    assert_eq!(keys(&effects[0]), ["effect", "if_missed", "needed", "reason", "saves"]);
    let inspected = json(&folder, "inspect furnace --json");
    assert_eq!(keys(&inspected["effects"][0]), ["effect", "needed", "reason", "saves"]);
    for (verdict, planned) in inspected["effects"].as_array().expect("a list").iter().zip(effects) {
        assert_eq!(verdict["reason"], planned["reason"]);
    }
    assert_contains(
        &printed(&folder, "plan furnace"),
        &["furnace: radiosity", "not needed  shadows", "needed      direct-light"],
    );
}

#[test]
fn a_dark_scene_is_planned_with_a_ceiling_light_or_as_it_is() {
    let folder = folder();
    write_dark_scene(&folder);
    assert_eq!(json(&folder, "plan dark.obj --json")["method"], "ambient-occlusion");
    assert_eq!(json(&folder, "plan dark.obj --ceiling-light --json")["method"], "radiosity");
}
