//! What was found out about a scene is kept on disk, under the scene's own fingerprint: the truth is dear and never changes.

use super::points::ProbePoint;
use crate::math::rgb::Rgb64;
use crate::methods::path_trace::Sensors;
use crate::scene::{Material, Scene};
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// To be raised whenever the same scene has another truth, or files another shape.
const VERSION: u32 = 1;

/// For each point the sums of its independent estimates.
type Sums = Vec<[Rgb64; Sensors::REPLICATES]>;

/// Which scene it is, and which points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    scene: u64,
    points: u64,
}

impl Key {
    pub fn of(scene: &Scene, points: &[ProbePoint]) -> Self {
        let mut hasher = DefaultHasher::new();
        for at in points {
            numbers(&mut hasher, &at.point.to_array());
            numbers(&mut hasher, &at.normal.to_array());
        }
        Self { scene: fingerprint(scene), points: hasher.finish() }
    }

    pub fn is_of(&self, scene: &Scene) -> bool {
        self.scene == fingerprint(scene)
    }
}

/// Of all that light depends on: neither names nor where the eye is.
fn fingerprint(scene: &Scene) -> u64 {
    let mut hasher = DefaultHasher::new();
    VERSION.hash(&mut hasher);
    for vector in scene.positions.iter().chain(&scene.normals) {
        numbers(&mut hasher, &vector.to_array());
    }
    for polygon in &scene.polygons {
        (polygon.corners(), polygon.normals(), polygon.material).hash(&mut hasher);
    }
    for material in &scene.materials {
        let Material {
            name: _,
            diffuse,
            specular,
            shininess,
            emission,
            refraction_index,
            transmission,
            opacity,
            illumination_model,
        } = material;
        for colour in [diffuse, specular, emission, transmission] {
            numbers(&mut hasher, &colour.to_array());
        }
        numbers(&mut hasher, &[*shininess, *refraction_index, *opacity]);
        illumination_model.hash(&mut hasher);
    }
    hasher.finish()
}

fn numbers(hasher: &mut DefaultHasher, numbers: &[f32]) {
    for number in numbers {
        number.to_bits().hash(hasher);
    }
}

/// A folder with one file for each scene.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
}

/// Why something was not kept.
#[derive(Debug, thiserror::Error)]
#[error("cannot keep what was found out about the scene in {path}")]
pub struct CacheError {
    path: PathBuf,
    source: io::Error,
}

impl Cache {
    pub fn at(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// In the folder that the system has for this; `None` where it has none.
    pub fn of_user() -> Option<Self> {
        dirs::cache_dir().map(|folder| Self::at(folder.join("lightwell")))
    }

    fn path(&self, key: &Key) -> PathBuf {
        self.folder.join(format!("reference-{:016x}-{:016x}", key.scene, key.points))
    }

    /// Paths of each estimate, and the sums; `None` where nothing is kept, or what is kept is damaged.
    pub fn load(&self, key: &Key) -> Option<(u64, Sums)> {
        let bytes = fs::read(self.path(key)).ok()?;
        let mut words = bytes.chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().expect("eight bytes")));
        let (paths, checksum) = (words.next()?, words.next()?);
        let numbers: Vec<u64> = words.collect();
        let sums: Sums = numbers.chunks_exact(3 * Sensors::REPLICATES).map(sums_of_point).collect();
        (checksum == checksum_of(paths, &numbers)).then_some((paths, sums))
    }

    /// What is known of runs on a scene, as text; `None` where nothing is kept.
    pub fn load_runs(&self, key: &Key) -> Option<String> {
        fs::read_to_string(self.path_of_runs(key)).ok()
    }

    /// Keeps what is known of runs on a scene.
    ///
    /// # Errors
    /// If the folder or the file cannot be written.
    pub fn store_runs(&self, key: &Key, text: &str) -> Result<(), CacheError> {
        let path = self.path_of_runs(key);
        write_whole(&self.folder, &path, text.as_bytes()).map_err(|source| CacheError { path, source })
    }

    fn path_of_runs(&self, key: &Key) -> PathBuf {
        self.folder.join(format!("runs-{:016x}-{:016x}.json", key.scene, key.points))
    }

    /// Keeps the sums, unless those of as many paths are kept. Whoever reads at the same time finds the old file or the new one,
    /// never a part.
    ///
    /// # Errors
    /// If the folder or the file cannot be written.
    pub fn store(&self, key: &Key, paths: u64, sums: &[[Rgb64; Sensors::REPLICATES]]) -> Result<(), CacheError> {
        if self.load(key).is_some_and(|(kept, _)| kept >= paths) {
            return Ok(());
        }
        let path = self.path(key);
        let numbers: Vec<u64> = sums.iter().flatten().flat_map(|sum| sum.to_array().map(f64::to_bits)).collect();
        let words = [paths, checksum_of(paths, &numbers)].into_iter().chain(numbers);
        let bytes: Vec<u8> = words.flat_map(u64::to_le_bytes).collect();
        write_whole(&self.folder, &path, &bytes).map_err(|source| CacheError { path, source })
    }
}

fn sums_of_point(numbers: &[u64]) -> [Rgb64; Sensors::REPLICATES] {
    std::array::from_fn(|i| {
        let channel = |c: usize| f64::from_bits(numbers[3 * i + c]);
        Rgb64::new(channel(0), channel(1), channel(2))
    })
}

fn checksum_of(paths: u64, numbers: &[u64]) -> u64 {
    let mut hasher = DefaultHasher::new();
    (VERSION, paths, numbers).hash(&mut hasher);
    hasher.finish()
}

fn write_whole(folder: &Path, path: &Path, bytes: &[u8]) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    // Two programs may write at once, and two threads of one.
    static DRAFTS: AtomicU64 = AtomicU64::new(0);
    let draft = DRAFTS.fetch_add(1, Ordering::Relaxed);
    let draft = path.with_extension(format!("{}-{draft}", std::process::id()));
    let written = fs::File::create(&draft).and_then(|mut file| file.write_all(bytes));
    written.and_then(|()| fs::rename(&draft, path)).inspect_err(|_| {
        let _ = fs::remove_file(&draft);
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept() -> (tempfile::TempDir, Cache, Key, Sums) {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::at(folder.path().join("made when needed"));
        let sums = vec![[Rgb64::new(0.1, 2.0, -0.0); Sensors::REPLICATES]; 3];
        let key = Key { scene: 1, points: 2 };
        cache.store(&key, 5, &sums).expect("a file");
        (folder, cache, key, sums)
    }

    #[test]
    fn what_is_stored_is_found_by_its_key_alone() {
        let (_folder, cache, key, sums) = kept();
        assert_eq!(cache.load(&key), Some((5, sums)));
        assert_eq!(cache.load(&Key { points: 3, ..key }), None);
    }

    #[test]
    fn what_is_known_better_is_not_forgotten() {
        let (_folder, cache, key, sums) = kept();
        let other = vec![[Rgb64::ONE; Sensors::REPLICATES]; 3];
        cache.store(&key, 4, &other).expect("a file");
        assert_eq!(cache.load(&key), Some((5, sums)));
        cache.store(&key, 6, &other).expect("a file");
        assert_eq!(cache.load(&key), Some((6, other)));
    }

    #[test]
    fn damaged_files_are_as_good_as_none() {
        let (_folder, cache, key, _) = kept();
        let path = cache.path(&key);
        let whole = fs::read(&path).expect("a file");
        for damaged in [&whole[..0], &whole[..100], &whole[..whole.len() - 8]] {
            fs::write(&path, damaged).expect("a file");
            assert_eq!(cache.load(&key), None);
        }
        let mut flipped = whole;
        flipped[200] ^= 1;
        fs::write(&path, flipped).expect("a file");
        assert_eq!(cache.load(&key), None);
    }

    #[test]
    fn a_colour_makes_another_scene_and_a_name_does_not() {
        let scene = Scene::open("cornell-box").expect("a built-in scene");
        let mut renamed = scene.clone();
        renamed.materials[0].name = "another".to_owned();
        assert_eq!(fingerprint(&scene), fingerprint(&renamed));
        let mut painted = scene.clone();
        painted.materials[0].diffuse.x *= 0.5;
        assert_ne!(fingerprint(&scene), fingerprint(&painted));
    }
}
