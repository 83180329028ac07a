//! Material libraries (MTL), read statement by statement, so that a value out of its range is mended by name and line.
//!
//! `Tf` is what a material lets through where it is transparent, per channel, as the format's specification has it:
//! 1 means all, and `0 1 0` is green glass. It says nothing about opaque materials, for which exporters often write
//! `Tf 1 1 1`. There are files, though, that state what is kept back: the glass ball and the water of McGuire's Computer
//! Graphics Archive have `Tf 0.1 0.1 0.1`, and are clear in its pictures and in Jensen's (2001), of which they are copies.
//! With the specification's reading one hundredth of the light would come through a ball. A grey `Tf` below one half is
//! therefore taken for the share that is kept back, and a finding says so. A coloured one has its colour either way, so it
//! is left alone.

use super::doctor::{Finding, FindingKind};
use super::lines::{keyword_and_rest, logical_lines, name, words};
use super::material::Material;
use crate::math::rgb::Rgb;
use std::collections::HashMap;

/// Largest emitted radiance that is accepted, W/(m²·sr): far above the sun's 2e7, and its square is far below `f32::MAX`.
const MAX_RADIANCE: f32 = 1e12;

/// Materials by name, each with what had to be mended in it.
#[derive(Debug, Default)]
pub struct Library {
    pub entries: Vec<Entry>,
    /// From a material's name to its place in `entries`.
    pub index: HashMap<String, usize>,
    /// What was wrong with the file outside of any material.
    pub findings: Vec<Finding>,
}

#[derive(Debug)]
pub struct Entry {
    pub material: Material,
    pub findings: Vec<Finding>,
    states_diffuse: bool,
    states_opacity: bool,
    ignores_texture: bool,
}

impl Library {
    /// Adds the materials of one file; `file` is its name, for findings.
    pub fn read(&mut self, text: &str, file: &str) {
        let mut current = None;
        for (line, content) in logical_lines(text) {
            let Some((keyword, rest)) = keyword_and_rest(&content) else { continue };
            if keyword == "newmtl" {
                current = Some(self.begin(name(rest), file, line));
            } else if let Some(entry) = current {
                self.entries[entry].statement(keyword, rest, line);
            } else {
                let subject = format!("{file}, line {line}");
                let problem = format!("`{keyword}` stands before any `newmtl`");
                self.findings.push(Finding::warning(FindingKind::MalformedLine, subject, problem, "ignored"));
            }
        }
    }

    /// Begins a material and returns its place. Of two with one name, the later one counts.
    fn begin(&mut self, name: &str, file: &str, line: u32) -> usize {
        let place = self.entries.len();
        self.entries.push(Entry::new(name));
        let is_repeated = self.index.insert(name.to_owned(), place).is_some();
        let (problem, remedy) = match (name, is_repeated) {
            ("", _) => ("`newmtl` states no name".to_owned(), "no face can use this material"),
            (_, true) => (format!("material '{name}' is stated twice"), "the later one is used"),
            (_, false) => return place,
        };
        let subject = format!("{file}, line {line}");
        self.findings.push(Finding::warning(FindingKind::MalformedLine, subject, problem, remedy));
        place
    }
}

impl Entry {
    fn new(name: &str) -> Self {
        Self {
            material: Material::grey(name),
            findings: Vec::new(),
            states_diffuse: false,
            states_opacity: false,
            ignores_texture: false,
        }
    }

    /// Takes in one line of the file. A line that cannot be used leaves the material as it was.
    fn statement(&mut self, keyword: &str, rest: &str, line: u32) {
        let done = match keyword {
            "Kd" => self.color(rest, line, Quantity::Reflectance).map(|diffuse| {
                self.material.diffuse = diffuse;
                self.states_diffuse = true;
            }),
            "Ks" => self.color(rest, line, Quantity::Share("Ks")).map(|specular| self.material.specular = specular),
            "Ke" => self.color(rest, line, Quantity::Radiance).map(|emission| self.material.emission = emission),
            "Tf" => self.color(rest, line, Quantity::Share("Tf")).map(|share| self.material.transmission = share),
            "Ns" => number(rest).map(|value| {
                self.material.shininess = self.mend(value, 0.0, f32::MAX, line, "Ns");
            }),
            "Ni" => number(rest).map(|value| {
                // The specification's own range.
                self.material.refraction_index = self.mend(value, 0.001, 10.0, line, "Ni");
            }),
            "d" => number(rest.strip_prefix("-halo").unwrap_or(rest)).map(|value| {
                self.material.opacity = self.mend(value, 0.0, 1.0, line, "d");
                self.states_opacity = true;
            }),
            // `Tr` is 1 − `d`; where a file has both, `d` counts, because some programs write `Tr` as if it were `d`.
            "Tr" => number(rest).map(|value| {
                let transparency = self.mend(value, 0.0, 1.0, line, "Tr");
                if !self.states_opacity {
                    self.material.opacity = 1.0 - transparency;
                }
            }),
            "illum" => illumination_model(rest).map(|model| self.material.illumination_model = Some(model)),
            "bump" | "disp" | "decal" | "refl" | "norm" => {
                self.texture(keyword, line);
                Ok(())
            }
            _ if keyword.starts_with("map_") => {
                self.texture(keyword, line);
                Ok(())
            }
            // `Ka`, and what newer programs add: no part of a diffuse surface.
            _ => Ok(()),
        };
        if let Err(problem) = done {
            let finding = Finding::warning(FindingKind::MalformedLine, self.subject(line), problem, "ignored");
            self.findings.push(finding);
        }
    }

    fn subject(&self, line: u32) -> String {
        format!("material '{}', line {line}", self.material.name)
    }

    /// One value per channel; a single value stands for all three.
    fn color(&mut self, rest: &str, line: u32, quantity: Quantity) -> Result<Rgb, String> {
        let values = words(rest).map(parse).collect::<Result<Vec<f32>, _>>()?;
        let stated = match values[..] {
            [all] => Rgb::splat(all),
            [red, green, blue] => Rgb::new(red, green, blue),
            _ => return Err(format!("`{rest}` is no colour: it needs three numbers")),
        };
        Ok(match quantity {
            Quantity::Share(keyword) => self.mend_color(stated, 1.0, line, keyword),
            Quantity::Radiance => self.mend_color(stated, MAX_RADIANCE, line, "Ke"),
            Quantity::Reflectance => {
                let limit = Material::MAX_REFLECTANCE;
                // An infinite value is a broken one; a value from the limit up means "reflects (nearly) all".
                if stated.is_finite() && stated.max_element() > limit {
                    let problem = format!("Kd {} is a reflectance above {limit}", channels(stated));
                    let remedy = format!("clamped to {limit}, so that light dies out");
                    let finding =
                        Finding::warning(FindingKind::ReflectanceClamped, self.subject(line), problem, remedy);
                    self.findings.push(finding);
                    self.mend_color(stated.min(Rgb::splat(limit)), limit, line, "Kd")
                } else {
                    self.mend_color(stated, limit, line, "Kd")
                }
            }
        })
    }

    /// Puts each channel into [0, `max`]; one that is no finite number becomes 0.
    fn mend_color(&mut self, stated: Rgb, max: f32, line: u32, keyword: &str) -> Rgb {
        let mended = stated.map(|channel| mended(channel, 0.0, max));
        if mended != stated {
            let problem = format!("{keyword} {} is not within 0 … {max}", channels(stated));
            self.report_range(problem, format!("{} is used", channels(mended)), line);
        }
        mended
    }

    /// Puts a value into [`min`, `max`]; one that is no finite number becomes `min`.
    fn mend(&mut self, stated: f32, min: f32, max: f32, line: u32, keyword: &str) -> f32 {
        let mended = mended(stated, min, max);
        if mended != stated {
            let range = if max == f32::MAX { format!("{min} or more") } else { format!("within {min} … {max}") };
            self.report_range(format!("{keyword} {stated} is not {range}"), format!("{mended} is used"), line);
        }
        mended
    }

    fn report_range(&mut self, problem: String, remedy: String, line: u32) {
        let finding = Finding::warning(FindingKind::ValueOutOfRange, self.subject(line), problem, remedy);
        self.findings.push(finding);
    }

    /// Reports the first texture of a material.
    fn texture(&mut self, keyword: &str, line: u32) {
        if !self.ignores_texture {
            self.ignores_texture = true;
            let problem = format!("`{keyword}` asks for a texture");
            let remedy = "textures are ignored; the material has one colour";
            let finding = Finding::warning(FindingKind::TextureIgnored, self.subject(line), problem, remedy);
            self.findings.push(finding);
        }
    }

    /// The material and everything that there is to say about it, once it is known to be used.
    pub fn into_material_and_findings(self) -> (Material, Vec<Finding>) {
        let Self { mut material, mut findings, states_diffuse, .. } = self;
        let subject = format!("material '{}'", material.name);
        if !states_diffuse {
            let problem = "it states no diffuse reflectance (Kd)";
            let remedy = format!("{} is used", material.diffuse.x);
            findings.push(Finding::note(FindingKind::MissingMaterial, &subject, problem, remedy));
        }
        findings.extend(leave_specular_light_the_rest(&mut material, &subject));
        if material.lobes().is_specular() {
            findings.extend(read_dark_filter_as_opacity(&mut material, &subject));
            let problem = "it asks for a mirror, gloss or transparency";
            let remedy = "rays and photons follow it; radiosity takes its diffuse part only";
            findings.push(Finding::note(FindingKind::SpecularIgnored, &subject, problem, remedy));
        }
        (material, findings)
    }
}

/// Scales `Ks` where more light would be reflected than arrives.
fn leave_specular_light_the_rest(material: &mut Material, subject: &str) -> Option<Finding> {
    let scale = material.specular_scale();
    (scale < 1.0).then(|| {
        let (diffuse, stated) = (material.diffuse, material.specular);
        material.specular = (scale * stated).min(Rgb::ONE - diffuse);
        let problem =
            format!("Kd {} and Ks {} together reflect more than arrives", channels(diffuse), channels(stated));
        let remedy = format!("Ks is scaled by {scale:.3} to {}", channels(material.specular));
        Finding::warning(FindingKind::SpecularScaled, subject, problem, remedy)
    })
}

/// Reads `Tf` of a transparent material as what is kept back, where it would let next to nothing through.
fn read_dark_filter_as_opacity(material: &mut Material, subject: &str) -> Option<Finding> {
    let stated = material.transmission;
    let lobes = material.lobes();
    let is_transparent = lobes.glass > 0.0 || material.opacity < 1.0;
    let is_dark_grey = stated.max_element() < 0.5 && stated.min_element() == stated.max_element();
    (is_transparent && is_dark_grey).then(|| {
        material.transmission = Rgb::ONE - stated;
        let problem = format!("it is transparent, but Tf {} would let next to nothing through", channels(stated));
        let remedy = format!("Tf is read as the share that is kept back; {} passes", channels(material.transmission));
        Finding::warning(FindingKind::FilterInverted, subject, problem, remedy)
    })
}

/// What a colour states, which decides its range.
#[derive(Clone, Copy)]
enum Quantity {
    /// ρ, in [0, [`Material::MAX_REFLECTANCE`]].
    Reflectance,
    /// A share of light, in [0, 1], with its keyword.
    Share(&'static str),
    /// W/(m²·sr)
    Radiance,
}

fn mended(value: f32, min: f32, max: f32) -> f32 {
    if value.is_finite() { value.clamp(min, max) } else { min }
}

fn channels(color: Rgb) -> String {
    format!("{} {} {}", color.x, color.y, color.z)
}

fn parse(word: &str) -> Result<f32, String> {
    word.parse().map_err(|_| format!("`{word}` is no number"))
}

fn number(rest: &str) -> Result<f32, String> {
    parse(words(rest).next().ok_or("a number is missing")?)
}

fn illumination_model(rest: &str) -> Result<u8, String> {
    let word = words(rest).next().unwrap_or("");
    match word.parse() {
        Ok(model @ 0..=10) => Ok(model),
        _ => Err(format!("`{word}` is no illumination model (0 … 10)")),
    }
}
