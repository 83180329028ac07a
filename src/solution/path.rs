//! Paths of light in Heckbert's notation (1990): from the light L over diffuse (D) and specular (S) surfaces to the eye E.

use regex::Regex;
use std::fmt;
use std::str::FromStr;

/// What a surface did to light on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scattering {
    /// D
    Diffuse,
    /// S: a mirror, gloss or glass.
    Specular,
}

impl Scattering {
    pub const ALL: [Self; 2] = [Self::Diffuse, Self::Specular];
}

/// The events of a path after it left the light, the first one foremost: at most [`Path::MAX_EVENTS`] of them.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct Path(u32);

impl Path {
    /// Straight from the light.
    pub const LIGHT: Self = Self(1);
    pub const MAX_EVENTS: usize = 31;

    /// The path with one event more; what is past [`Path::MAX_EVENTS`] is dropped at the front, near the light.
    #[must_use]
    pub fn then(self, event: Scattering) -> Self {
        let grown = self.0 << 1 | u32::from(event == Scattering::Specular);
        Self(if self.len() == Self::MAX_EVENTS { grown | 1 << Self::MAX_EVENTS } else { grown })
    }

    /// How many surfaces it met.
    pub fn len(self) -> usize {
        self.0.ilog2() as usize
    }

    /// What happened last.
    pub fn last(self) -> Option<Scattering> {
        self.events().next_back()
    }

    /// How many surfaces were diffuse.
    pub fn diffuse_count(self) -> usize {
        self.len() - (self.0.count_ones() as usize - 1)
    }

    /// Whether it comes straight from the light.
    pub fn is_empty(self) -> bool {
        self == Self::LIGHT
    }

    /// Its events, from the light on.
    pub fn events(self) -> impl DoubleEndedIterator<Item = Scattering> {
        let event = move |i: usize| if self.0 >> i & 1 == 1 { Scattering::Specular } else { Scattering::Diffuse };
        (0..self.len()).rev().map(event)
    }

    /// Whether every surface that it met was specular, and there was one: what makes a caustic where it lands. Of the longest
    /// paths the beginning is not known: they count as any other light.
    pub fn is_caustic(self) -> bool {
        (1..Self::MAX_EVENTS).contains(&self.len()) && self.events().all(|event| event == Scattering::Specular)
    }
}

/// `LSD`
impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("L")?;
        self.events().try_for_each(|event| f.write_str(if event == Scattering::Specular { "S" } else { "D" }))
    }
}

impl fmt::Debug for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A pattern of paths, such as `LDE`, `LS+DE` or `L(S|D)*E`: letters, `.` for either of D and S, and the operators of
/// regular expressions `* + ? | ( )`. The empty pattern lets every path pass.
#[derive(Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct PathFilter {
    text: [u8; Self::MAX_LENGTH],
    length: u8,
}

impl PathFilter {
    /// Of its text, bytes.
    pub const MAX_LENGTH: usize = 32;

    /// Its text.
    pub fn as_str(&self) -> &str {
        std::str::from_utf8(&self.text[..self.length as usize]).unwrap_or_default()
    }

    /// Whether every path passes.
    pub fn passes_all(&self) -> bool {
        self.length == 0
    }

    /// The pattern ready to be held against paths.
    pub fn matcher(&self) -> PathMatcher {
        PathMatcher((!self.passes_all()).then(|| compiled(self.as_str()).expect("it was compiled when it was read")))
    }
}

impl FromStr for PathFilter {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let text: String = text.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_uppercase()).collect();
        if text.len() > Self::MAX_LENGTH {
            return Err(format!("a pattern of paths has at most {} letters", Self::MAX_LENGTH));
        }
        if let Some(stranger) = text.chars().find(|&c| !"LDSE.*+?|()".contains(c)) {
            return Err(format!("`{stranger}` is no part of a pattern of paths, as in LDE, LS+DE or L(S|D)*E"));
        }
        if !text.is_empty() {
            compiled(&text).map_err(|_| format!("`{text}` is no pattern of paths, as in LDE, LS+DE or L(S|D)*E"))?;
        }
        let mut bytes = [0; Self::MAX_LENGTH];
        bytes[..text.len()].copy_from_slice(text.as_bytes());
        Ok(Self { text: bytes, length: text.len() as u8 })
    }
}

impl TryFrom<String> for PathFilter {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<PathFilter> for String {
    fn from(filter: PathFilter) -> Self {
        filter.as_str().to_owned()
    }
}

impl fmt::Debug for PathFilter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.as_str())
    }
}

fn compiled(text: &str) -> Result<Regex, regex::Error> {
    Regex::new(&format!("^(?:{})$", text.replace('.', "[DS]")))
}

/// A pattern that paths can be held against; by default every path passes.
#[derive(Clone, Debug, Default)]
pub struct PathMatcher(Option<Regex>);

impl PathMatcher {
    /// Whether every path passes.
    pub fn passes_all(&self) -> bool {
        self.0.is_none()
    }

    /// Whether light passes that came along `from_light`, met one surface more if `landing` says so, and then went over
    /// `to_eye`, the events met from the eye backwards, into the eye.
    pub fn passes(&self, from_light: Path, landing: Option<Scattering>, to_eye: Path) -> bool {
        let Some(pattern) = &self.0 else { return true };
        let events = from_light.events().chain(landing).chain(to_eye.events().rev());
        let letters = events.map(|event| if event == Scattering::Specular { 'S' } else { 'D' });
        pattern.is_match(&std::iter::once('L').chain(letters).chain(std::iter::once('E')).collect::<String>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Scattering::{Diffuse, Specular};

    #[test]
    fn paths_are_written_as_heckbert_does() {
        let path = Path::LIGHT.then(Specular).then(Diffuse);
        assert_eq!((path.to_string().as_str(), path.len(), path.is_caustic()), ("LSD", 2, false));
        assert!(Path::LIGHT.then(Specular).is_caustic() && !Path::LIGHT.is_caustic());
        let other = path.then(Specular).then(Diffuse);
        assert_eq!((other.diffuse_count(), other.last(), Path::LIGHT.last()), (2, Some(Diffuse), None));
        let long = (0..40).fold(Path::LIGHT.then(Specular), |path, _| path.then(Diffuse));
        assert_eq!(long.to_string(), format!("L{}", "D".repeat(Path::MAX_EVENTS)));
    }

    #[test]
    fn patterns_let_the_right_paths_pass() {
        let passes = |pattern: &str, from_light: Path, to_eye: Path| {
            pattern.parse::<PathFilter>().unwrap().matcher().passes(from_light, Some(Diffuse), to_eye)
        };
        let (light, glass) = (Path::LIGHT, Path::LIGHT.then(Specular));
        assert!(passes("LDE", light, light) && !passes("LDE", glass, light) && passes("", glass, light));
        assert!(passes("LS+DE", glass.then(Specular), light) && !passes("LS+DE", light, light));
        assert!(passes("l(s|d)*de", glass, light) && passes("LD.E", light, glass) && !passes("LDDE", light, glass));
        // From the eye backwards: first a mirror, then a diffuse surface that light reaches by glass.
        assert!(passes("LSDDSE", glass, Path::LIGHT.then(Specular).then(Diffuse)));
        for wrong in ["LXE", "L(DE", "*", &"D".repeat(40)] {
            assert!(wrong.parse::<PathFilter>().is_err(), "{wrong}");
        }
    }
}
