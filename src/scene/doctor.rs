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

impl Finding {
    /// Something worth knowing that leaves the picture as its author meant it.
    pub fn note(
        kind: FindingKind,
        subject: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { severity: Severity::Note, kind, subject: subject.into(), problem: problem.into(), remedy: remedy.into() }
    }

    /// Something because of which the picture is likely to differ from what its author meant.
    pub fn warning(
        kind: FindingKind,
        subject: impl Into<String>,
        problem: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { severity: Severity::Warning, ..Self::note(kind, subject, problem, remedy) }
    }
}

/// `object 'lamp', line 12: the face has no area; left out`
impl std::fmt::Display for Finding {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}; {}", self.subject, self.problem, self.remedy)
    }
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
    CrossedFace,
    NonFiniteVertex,
    MalformedLine,
    IndexOutOfRange,
    NormalIgnored,
    UnusedVertices,
    SceneMoved,
    FaceTooFar,
    DetailLost,
    FaceTooNarrow,
    MissingMaterialFile,
    MissingMaterial,
    ValueOutOfRange,
    ReflectanceClamped,
    TextureIgnored,
    SpecularIgnored,
    SpecularScaled,
    FilterInverted,
    GlassTurned,
    GlassOpen,
    NoEmitter,
    EmitterTurned,
    EmitterMoved,
    EmitterHidden,
    CeilingLightAdded,
}
