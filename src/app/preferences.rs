//! What the window remembers from one start to the next.

use super::chart::Chart;
use super::model::{LowerPanel, Theme};
use super::wish::Wish;
use std::path::{Path, PathBuf};

#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Preferences {
    pub theme: Theme,
    /// Scene files, newest first.
    pub recent: Vec<PathBuf>,
    /// What is open below the viewport.
    pub lower: Option<LowerPanel>,
    pub chart: Chart,
    /// The error that is wanted, and the time allowed.
    pub wish: Wish,
}

impl Default for Preferences {
    fn default() -> Self {
        Self { theme: Theme::Dark, recent: Vec::new(), lower: None, chart: Chart::default(), wish: Wish::default() }
    }
}

impl Preferences {
    /// Where they lie in eframe's storage.
    pub const KEY: &'static str = "preferences";
    /// As many files as a menu shows at one look.
    const MOST_RECENT: usize = 10;

    /// Puts a scene file at the head of the recent ones.
    pub fn remember(&mut self, scene: &Path) {
        // A relative path would be lost when the program is started elsewhere.
        let path = std::path::absolute(scene).unwrap_or_else(|_| scene.to_owned());
        self.recent.retain(|other| *other != path);
        self.recent.insert(0, path);
        self.recent.truncate(Self::MOST_RECENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_file_comes_first_and_none_twice() {
        let mut preferences = Preferences::default();
        for name in ["/a.obj", "/b.obj", "/a.obj"] {
            preferences.remember(Path::new(name));
        }
        assert_eq!(preferences.recent, [PathBuf::from("/a.obj"), PathBuf::from("/b.obj")]);
        for i in 0..20 {
            preferences.remember(Path::new(&format!("/{i}.obj")));
        }
        assert_eq!(preferences.recent.len(), Preferences::MOST_RECENT);
    }
}
