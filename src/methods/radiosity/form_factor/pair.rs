//! Form factors of one pair of polygons by every method in its plain form, beside the truth. Solvers guard the methods besides:
//! they cut down what is above 1, see by shares of rays, and leave near pairs to the closed form.

use super::centroid::{Facet, centroid, disc};
use super::hemicube::{Hemicube, Item};
use super::polygon::TOLERANCE;
use crate::math::polygon::{Plate, area_form_factor, form_factor, occluded_area_form_factor, vector_area};
use crate::math::random::{hash, sobol2};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::mesh::Region;
use crate::methods::FormFactorMethod;
use crate::solution::ItemBuffer;
use crate::tracer::{Ray, SurfacePoint, Tracer};
use glam::{DVec3, Vec2, Vec3, Vec3A};

/// Polygons in the tracer: the one that shines, the one that is lit, then the occluders.
const FROM: u32 = 0;
const TO: u32 = 1;
/// The reference with occluders is good to about this much.
const REFERENCE_TOLERANCE: f64 = 1e-6;
/// Gauss-Legendre points of order 2 on [0, 1]; they have equal weights.
const GAUSS: [f32; 2] = [0.211_324_87, 0.788_675_1];
/// A sequence of Sobol points is good for 2^16; more points take several.
const SEQUENCE: u32 = 1 << 16;

/// How much work the methods do that can do more or less.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Cosine-distributed rays of [`FormFactorMethod::Rays`].
    pub rays: u32,
    /// Visibility rays of [`FormFactorMethod::Polygon`] from each point, where there are occluders.
    pub shadow_rays: u32,
    /// Every random number comes from this.
    pub seed: u64,
}

/// Two planar convex polygons and what may stand between them.
pub struct Pair {
    from: Side,
    to: Side,
    occluders: Vec<Vec<DVec3>>,
    tracer: Tracer,
    /// What a hemicube on the first draws.
    items: Vec<Item>,
}

struct Side {
    corners: Vec<DVec3>,
    region: Region,
    facet: Facet,
    normal: Vec3A,
}

impl Side {
    fn new(corners: Vec<DVec3>) -> Self {
        let vector_area = vector_area(&corners);
        let single = single(&corners);
        let normal = vector_area.normalize_or_zero();
        let center = corners.iter().sum::<DVec3>() / corners.len() as f64;
        let last = single[single.len() - 1];
        Self {
            region: Region::new([single[0], single[1], single[2], last].map(Vec3A::from), single.len()),
            facet: Facet { center, normal, area: vector_area.length() },
            normal: normal.as_vec3a(),
            corners,
        }
    }

    fn center(&self) -> Vec3A {
        self.facet.center.as_vec3a()
    }
}

fn single(corners: &[DVec3]) -> Vec<Vec3> {
    corners.iter().map(|corner| corner.as_vec3()).collect()
}

impl Pair {
    /// Each polygon has three or four corners, counter-clockwise seen from its front; occluders hide from both sides.
    pub fn new(from: &[DVec3], to: &[DVec3], occluders: &[Vec<DVec3>]) -> Self {
        // Rays and hemicubes work in single precision, which has digits to spare near the origin only.
        let middle = from.iter().sum::<DVec3>() / from.len() as f64;
        let near = |corners: &[DVec3]| corners.iter().map(|corner| corner - middle).collect::<Vec<_>>();
        let (from, to) = (near(from), near(to));
        let occluders: Vec<Vec<DVec3>> = occluders.iter().map(|corners| near(corners)).collect();
        let polygons = [&from, &to].into_iter().chain(&occluders);
        let triangles: Vec<(u32, [Vec3; 3])> = (FROM..)
            .zip(polygons)
            .flat_map(|(polygon, corners)| {
                let corners = single(corners);
                (2..corners.len()).map(move |i| (polygon, [corners[0], corners[i - 1], corners[i]]))
            })
            .collect();
        let mut items = vec![Item::new(&single(&to), 0)];
        items.extend(occluders.iter().map(|corners| Item::new(&single(corners), ItemBuffer::NOTHING)));
        Self { from: Side::new(from), to: Side::new(to), occluders, tracer: Tracer::new(&triangles), items }
    }

    /// F without the error of any method: by contours, or with occluders the mean over the points of the first polygon
    /// of the closed form of what each sees, refined to about 1e-6.
    pub fn reference(&self) -> f64 {
        if self.occluders.is_empty() {
            area_form_factor(&self.from.corners, &self.to.corners)
        } else {
            occluded_area_form_factor(&self.from.corners, &self.to.corners, &self.occluders, REFERENCE_TOLERANCE)
        }
    }

    /// F by a method. `hemicube` is drawn upon.
    pub fn form_factor(&self, method: FormFactorMethod, effort: &Effort, hemicube: &mut Hemicube) -> f64 {
        match method {
            FormFactorMethod::Centroid => centroid(&self.from.facet, &self.to.facet) * self.center_is_visible(),
            FormFactorMethod::Disc => disc(&self.from.facet, &self.to.facet) * self.center_is_visible(),
            FormFactorMethod::Polygon => self.by_polygon(effort),
            FormFactorMethod::Rays => self.by_rays(effort),
            FormFactorMethod::Hemicube => self.by_hemicube(hemicube),
        }
    }

    /// 1 if the centres see each other, or 0.
    fn center_is_visible(&self) -> f64 {
        f64::from(u8::from(self.occluders.is_empty() || self.sees(self.from.center(), self.to.center())))
    }

    /// Whether nothing stands between a point of the first polygon and one of the second.
    fn sees(&self, from: Vec3A, to: Vec3A) -> bool {
        let [from, to] = [(from, FROM), (to, TO)].map(|(point, polygon)| SurfacePoint { point, polygon });
        self.tracer.is_unoccluded(from, to)
    }

    /// The closed form, integrated over the first polygon; with occluders its mean over Gauss points, each times the
    /// share of its visibility rays that arrive.
    fn by_polygon(&self, effort: &Effort) -> f64 {
        if self.occluders.is_empty() {
            let from = Plate::new(&self.from.corners);
            return from.exchange(&Plate::new(&self.to.corners), TOLERANCE) / from.area();
        }
        let points = self.gauss_points();
        let targets = self.to.region.sampler();
        let at = |(index, point): (u64, &Vec3A)| {
            let whole = form_factor(point.as_dvec3(), self.from.facet.normal, &self.to.corners);
            if whole == 0.0 {
                return whole;
            }
            let seed = hash(effort.seed, 0, index) as u32;
            let is_visible = |i: &u32| self.sees(*point, targets.point(sobol2(*i, 0, seed)));
            whole * (0..effort.shadow_rays).filter(is_visible).count() as f64 / f64::from(effort.shadow_rays.max(1))
        };
        (0..).zip(&points).map(at).sum::<f64>() / points.len() as f64
    }

    /// Points of equal weight: three of a triangle, four of a quad.
    fn gauss_points(&self) -> Vec<Vec3A> {
        if let &[a, b, c] = self.from.region.corners() {
            return [a, b, c].map(|corner| corner.midpoint(self.from.center())).into();
        }
        let [low, high] = GAUSS;
        [(low, low), (high, low), (low, high), (high, high)]
            .map(|(u, v)| self.from.region.point(Vec2::new(u, v)))
            .into()
    }

    /// Share of cosine-distributed rays from all over the first polygon that land on the front of the second.
    fn by_rays(&self, effort: &Effort) -> f64 {
        let origins = self.from.region.sampler();
        let frame = frame(self.from.normal);
        let arrives = |i: &u32| {
            let (index, seed) = (i % SEQUENCE, hash(effort.seed, 1, u64::from(i / SEQUENCE)) as u32);
            let from = SurfacePoint { point: origins.point(sobol2(index, 0, seed)), polygon: FROM };
            let direction = frame * cosine_hemisphere(sobol2(index, 1, seed));
            self.tracer.closest(&Ray::leaving(from, direction)).is_some_and(|hit| hit.polygon == TO && hit.is_front)
        };
        (0..effort.rays).filter(arrives).count() as f64 / f64::from(effort.rays.max(1))
    }

    fn by_hemicube(&self, hemicube: &mut Hemicube) -> f64 {
        hemicube.draw(self.tracer.lift(self.from.center(), self.from.normal), self.from.normal, &self.items);
        let mut sums = [0.0];
        hemicube.add_form_factors(&mut sums);
        sums[0]
    }
}
