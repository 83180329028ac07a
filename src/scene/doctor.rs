//! What was wrong in a scene and what was done about it.

/// One thing that the doctor noticed.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Finding {
    pub severity: Severity,
    pub kind: FindingKind,
    /// What it is about: object, material or file, with the line where there is one. `object 'lamp', line 12`
    pub subject: String,
    /// What was found. `the face has no area`
    pub problem: String,
    /// What was done about it. `left out`
    pub remedy: String,
}

/// Whether the picture is likely to differ from what the author meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Severity {
    Note,
    Warning,
}

/// The kinds of findings, by which tests and scripts can tell them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FindingKind {
    DegenerateFace,
    DuplicateFace,
    NonPlanarFace,
    NonFiniteVertex,
    MalformedLine,
    IndexOutOfRange,
    UnusedVertices,
    MissingMaterialFile,
    MissingMaterial,
    ValueOutOfRange,
    ReflectanceClamped,
    TextureIgnored,
    SpecularIgnored,
    NoEmitter,
    EmitterTurned,
    EmitterMoved,
    EmitterHidden,
    CeilingLightAdded,
}
