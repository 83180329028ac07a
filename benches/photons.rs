//! The hot paths of photons: tracing them, putting them into a tree, finding the nearest, and estimates of irradiance.
//!
//! `cargo bench --bench photons` prints elements per second: photons emitted, photons put into the tree, queries and estimates.
//! Searches and estimates run on one thread, the rest on all. A uniform grid stands beside the tree, to tell what
//! it would gain.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{UVec3, Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::bounds::Bounds;
use lightwell::mesh::MeshSettings;
use lightwell::methods::photon_map::{Entry, Found, Nearest, PhotonMapping, Scratch, Tree, Which};
use lightwell::methods::transport::{Surface, Transport};
use lightwell::methods::{PhotonSettings, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::Photon;
use lightwell::tracer::Ray;
use lightwell::world::World;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

const STORED: usize = 1_000_000;
const QUERIES: usize = 4096;

fn cornell_box() -> Arc<Transport> {
    transport("cornell-box")
}

fn transport(name: &str) -> Arc<Transport> {
    let scene = Scene::open(name).expect("a built-in scene");
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
    Arc::new(Transport::new(Arc::new(world), Switches::default()))
}

fn run(transport: &Arc<Transport>, photons: PhotonSettings, seed: u64) -> PhotonMapping {
    let settings = Settings { photons, seed, ..Settings::default() };
    let mut mapping = PhotonMapping::new(transport.clone(), &settings);
    while mapping.step(&Cancel::default()) == Step::Advanced {}
    mapping
}

fn photons(count: u32) -> PhotonSettings {
    PhotonSettings { count, ..PhotonSettings::default() }
}

/// A million photons in the Cornell box.
fn million(transport: &Arc<Transport>) -> Vec<Photon> {
    let mut photons = run(transport, photons(600_000), 0).solution().photons.to_vec();
    assert!(photons.len() >= STORED);
    photons.truncate(STORED);
    photons
}

fn entries(photons: &[Photon]) -> Vec<Entry> {
    let entry = |(index, photon): (usize, &Photon)| Entry { position: photon.position, index: index as u32, tag: 0 };
    photons.iter().enumerate().map(entry).collect()
}

/// Places of surfaces where other photons landed.
fn places(transport: &Arc<Transport>) -> Vec<Surface> {
    let others = run(transport, photons(20_000), 1).solution().photons;
    let place = |photon: &Photon| {
        let direction = Vec3A::from(photon.direction);
        transport.meet(&Ray::new(Vec3A::from(photon.position) - 0.01 * direction, direction))
    };
    let step = others.len() / QUERIES;
    others.iter().step_by(step).filter_map(place).take(QUERIES).collect()
}

fn tracing(criterion: &mut Criterion) {
    let transport = cornell_box();
    let count = 200_000;
    let mut group = criterion.benchmark_group("photons");
    let start = Instant::now();
    let solution = run(&transport, photons(count), 0).solution();
    let seconds = start.elapsed().as_secs_f64();
    let counters = &solution.counters;
    println!(
        "photons/trace: {} emitted, {} stored, {} rays: {:.2} M rays/s, {:.2} M stored/s",
        counters.emitted,
        counters.stored,
        counters.rays,
        counters.rays as f64 / seconds / 1e6,
        counters.stored as f64 / seconds / 1e6
    );
    group.sample_size(10).throughput(Throughput::Elements(count.into()));
    group.bench_function("trace", |bencher| bencher.iter(|| run(&transport, photons(count), 0)));
    group.finish();
}

fn searches(criterion: &mut Criterion) {
    let transport = cornell_box();
    let entries = entries(&million(&transport));
    let places = places(&transport);
    let mut group = criterion.benchmark_group("tree");
    group.sample_size(10).throughput(Throughput::Elements(STORED as u64));
    group.bench_function("build", |bencher| bencher.iter(|| Tree::new(entries.clone())));
    group.throughput(Throughput::Elements(places.len() as u64));
    let tree = Tree::new(entries.clone());
    for count in [50, 200] {
        // As large as a grid for this number of photons would be made for: cells that hold half of them on a flat surface.
        let grid = Grid::new(&entries, cell_size(&entries, count));
        let mut nearest = Nearest::default();
        group.bench_function(format!("nearest {count}"), |bencher| {
            bencher.iter(|| {
                for place in &places {
                    nearest.begin(count);
                    tree.search(place.point, f32::INFINITY, |found, bound| nearest.add(&found, bound));
                    black_box(nearest.end());
                }
            });
        });
        let farthest = |place: &Surface, nearest: &mut Nearest| {
            nearest.begin(count);
            tree.search(place.point, f32::INFINITY, |found, bound| nearest.add(&found, bound));
            nearest.end()
        };
        group.bench_function(format!("nearest {count}, uniform grid"), |bencher| {
            bencher.iter(|| {
                for place in &places {
                    black_box(grid.nearest(place.point.into(), count, &mut nearest));
                }
            });
        });
        let agree = places.iter().all(|place| {
            let by_tree = farthest(place, &mut nearest);
            by_tree == grid.nearest(place.point.into(), count, &mut nearest)
        });
        assert!(agree, "tree and grid find the same photons");
    }
    group.finish();
}

fn estimates(criterion: &mut Criterion) {
    let gallery = transport("gallery");
    let start = Instant::now();
    // Before the first photon there is only what surfaces belong together.
    black_box(PhotonMapping::new(gallery, &Settings::default()).maps());
    println!("estimate: which surfaces of the gallery belong together took {:.1?}", start.elapsed());
    let transport = cornell_box();
    let places = places(&transport);
    let mut group = criterion.benchmark_group("estimate");
    group.throughput(Throughput::Elements(places.len() as u64));
    for nearest in [50, 200] {
        let maps = run(&transport, PhotonSettings { nearest, ..photons(600_000) }, 0).maps();
        let mut scratch = Scratch::default();
        let near_edges = places.iter().filter(|at| maps.irradiance(at, Which::All, &mut scratch).inside < 1.0).count();
        println!("estimate/{nearest}: {near_edges} of {} discs meet an edge", places.len());
        group.bench_function(nearest.to_string(), |bencher| {
            bencher.iter(|| {
                for at in &places {
                    black_box(maps.irradiance(at, Which::All, &mut scratch));
                }
            });
        });
    }
    group.finish();
}

/// Edge of a cell that holds half of `count` photons where a flat surface goes through its middle, m.
fn cell_size(entries: &[Entry], count: usize) -> f32 {
    let extent = Bounds::of(entries.iter().map(|entry| entry.position)).extent();
    let area = 2.0 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
    (0.5 * count as f32 * area / entries.len() as f32).sqrt()
}

/// Photons sorted into equal cells.
struct Grid {
    bounds: Bounds,
    cell: f32,
    cells: UVec3,
    starts: Vec<u32>,
    positions: Vec<Vec3>,
}

impl Grid {
    fn new(entries: &[Entry], cell: f32) -> Self {
        let bounds = Bounds::of(entries.iter().map(|entry| entry.position));
        let cells = (bounds.extent() / cell).as_uvec3() + 1;
        let mut grid = Self { bounds, cell, cells, starts: Vec::new(), positions: Vec::new() };
        let mut sorted: Vec<(u32, Vec3)> =
            entries.iter().map(|entry| (grid.index(grid.cell_of(entry.position)), entry.position)).collect();
        sorted.sort_by_key(|&(index, _)| index);
        let count = cells.element_product();
        grid.starts = (0..=count).map(|cell| sorted.partition_point(|&(index, _)| index < cell) as u32).collect();
        grid.positions = sorted.into_iter().map(|(_, position)| position).collect();
        grid
    }

    fn cell_of(&self, position: Vec3) -> UVec3 {
        ((position - self.bounds.min) / self.cell).max(Vec3::ZERO).as_uvec3().min(self.cells - 1)
    }

    fn index(&self, cell: UVec3) -> u32 {
        (cell.z * self.cells.y + cell.y) * self.cells.x + cell.x
    }

    /// Square distance of the farthest of the nearest `count`: cells in a box about the place, a larger one until none that is
    /// outside can be nearer.
    fn nearest(&self, at: Vec3, count: usize, nearest: &mut Nearest) -> Option<f32> {
        let mut reach = self.cell;
        loop {
            nearest.begin(count);
            let mut bound = reach * reach;
            let (low, high) = (self.cell_of(at - reach), self.cell_of(at + reach));
            for z in low.z..=high.z {
                for y in low.y..=high.y {
                    let row = self.index(UVec3::new(low.x, y, z)) as usize;
                    let end = row + (high.x - low.x) as usize + 1;
                    let range = self.starts[row] as usize..self.starts[end] as usize;
                    for (slot, position) in range.clone().zip(&self.positions[range]) {
                        let square_distance = position.distance_squared(at);
                        if square_distance < bound {
                            bound = nearest.add(&Found { square_distance, slot: slot as u32, tag: 0 }, bound);
                        }
                    }
                }
            }
            match nearest.end() {
                Some(farthest) => return Some(farthest),
                None => reach *= 1.5,
            }
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(3)).without_plots();
    targets = tracing, searches, estimates
}
criterion_main!(benches);
