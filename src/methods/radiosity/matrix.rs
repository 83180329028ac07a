//! The matrix of form factors between all patches, built column by column and made to obey its laws.
//!
//! Two matrices belong together. Patches exchange light by F_ij, which the equations are solved with; elements get their
//! share of it by the form factor from each element to each patch, so that a shadow's edge is seen where it falls.

use super::form_factor::{Outcome, out_of_sight};
use crate::cancel::{Cancel, Cancelled};
use crate::math::rgb::Rgb;
use crate::math::sparse::Sparse;
use crate::mesh::{Mesh, Patch};
use crate::solution::{Closure, FormFactorMatrix, Solution, Zero};
use crate::world::World;
use std::sync::Arc;

/// Symmetric scaling ends when no row is further from closing than this, or after [`MAX_SWEEPS`]; what is left is up to
/// [`Matrix::closing`].
const CLOSED: f64 = 1e-10;
/// Factors keep within this, since those of sums that contradict each other would run away.
const MAX_SCALE: f64 = 1e6;
/// Some tens are enough, but for patches that see little but each other.
const MAX_SWEEPS: u32 = 200;

/// Form factors as they come from a method, one column after the other.
pub struct Columns {
    /// Row j: the form factor from each element to patch j, where it is not 0.
    toward: Sparse<f32>,
    /// Share of the flux of each patch that leaves the scene.
    escaping: Vec<f64>,
}

impl Columns {
    pub fn new(mesh: &Mesh) -> Self {
        let patches = mesh.patches.len();
        Self { toward: Sparse::with_capacity(patches, 0), escaping: Vec::with_capacity(patches) }
    }

    /// How many columns there are.
    pub fn len(&self) -> usize {
        self.escaping.len()
    }

    /// Adds the form factors from all elements to the next patch.
    pub fn push(&mut self, form_factors: &[f64], outcome: &Outcome) {
        for (element, &form_factor) in form_factors.iter().enumerate() {
            if form_factor > 0.0 {
                self.toward.push(element as u32, form_factor as f32);
            }
        }
        self.toward.end_row();
        self.escaping.push(outcome.escaping);
    }
}

/// All form factors of a scene: in [0, 1], reciprocal, and with rows that close.
pub struct Matrix {
    pub patches: FormFactorMatrix,
    /// Row j: the irradiance of each element per radiosity that patch j sends.
    pub elements: Sparse<f32>,
    /// See [`super::System::closing`].
    pub closing: Vec<f64>,
    /// Share of the flux of each patch that leaves the scene; what arrives makes it 1.
    pub escaping: Vec<f64>,
    /// How far form factors were from obeying.
    pub closure: Closure,
}

impl Matrix {
    /// Bytes that a matrix of a mesh takes at most, with what is needed to build it.
    pub fn bytes(mesh: &Mesh) -> u64 {
        let (patches, elements) = (mesh.patches.len(), mesh.elements.len());
        // Elements: as computed and as agreed on. Patches: as computed, transposed, the mean, and zeros.
        2 * Sparse::<f32>::bytes(patches, patches * elements)
            + 3 * Sparse::<f64>::bytes(patches, patches * patches)
            + (patches * patches * size_of::<Option<Zero>>()) as u64
            + ((Solution::MAX_BOUNCES + 1) * elements * size_of::<Rgb>()) as u64
    }

    /// Makes form factors reciprocal and rows close. Both estimates of what two patches exchange, A_i F_ij and A_j F_ji, are
    /// replaced by their mean; then D A F D with a diagonal matrix D has the row sums that it must have, stays symmetric
    /// and keeps its zeros (Sinkhorn, Knopp 1967).
    ///
    /// # Errors
    /// If cancelled.
    pub fn new(world: &World, columns: &Columns, cancel: &Cancel) -> Result<Self, Cancelled> {
        let mesh = &world.mesh;
        let Columns { toward, escaping } = columns;
        let raw = exchanges(mesh, toward, cancel)?;
        let transposed = raw.transposed();
        let mut exchange = mean(&raw, &transposed, cancel)?;
        let closure = closure(mesh, &raw, &transposed, escaping);
        drop(transposed);
        let area: Vec<f64> = mesh.patches.iter().map(|patch| patch.area).collect();
        // As one row closes by itself: what arrives and what escapes are scaled alike. Where most of the light escapes, the
        // noise of its rays must not be forced onto the little that arrives.
        let leaving = |i: usize| exchange.row(i).1.iter().sum::<f64>() / area[i] + escaping[i];
        let leaving: Vec<f64> = (0..area.len()).map(|i| if area[i] > 0.0 { leaving(i) } else { 0.0 }).collect();
        let escaping: Vec<f64> = leaving
            .iter()
            .zip(escaping)
            .map(|(leaving, share)| if *leaving > 0.0 { share / leaving } else { 1.0 })
            .collect();
        let wanted: Vec<f64> = area.iter().zip(&escaping).map(|(area, escaping)| area * (1.0 - escaping)).collect();
        close(&mut exchange, &wanted, &area, cancel)?;
        let elements = spread(mesh, toward, &raw, &exchange, cancel)?;
        drop(raw);
        // Where nothing is received, everything escapes.
        let escapes = |(i, share): (usize, &f64)| if exchange.row(i).0.is_empty() { 1.0 } else { *share };
        let escaping: Vec<f64> = escaping.iter().enumerate().map(escapes).collect();
        let closing = (0..exchange.rows()).map(|i| {
            let sum: f64 = exchange.row(i).1.iter().sum();
            if sum > 0.0 { wanted[i] / sum } else { 0.0 }
        });
        let closing = closing.collect();
        for (i, area) in area.iter().enumerate() {
            exchange.row_mut(i).1.iter_mut().for_each(|value| *value /= area);
        }
        let zeros = Arc::new(zeros(world, &exchange, cancel)?);
        let patches = FormFactorMatrix { form_factors: Arc::new(exchange), zeros };
        Ok(Self { patches, elements, closing, escaping, closure })
    }
}

/// For a look between rows.
fn unless(cancel: &Cancel) -> Result<(), Cancelled> {
    if cancel.is_requested() { Err(Cancelled) } else { Ok(()) }
}

/// Row j: Σ A_e F_ej over the elements e of each patch, m². The flux that patch j sends there, per radiosity.
fn exchanges(mesh: &Mesh, toward: &Sparse<f32>, cancel: &Cancel) -> Result<Sparse, Cancelled> {
    let mut exchange = Sparse::with_capacity(toward.rows(), 0);
    for j in 0..toward.rows() {
        unless(cancel)?;
        let (elements, form_factors) = toward.row(j);
        let mut entries = elements.iter().zip(form_factors).peekable();
        while let Some(&(&first, _)) = entries.peek() {
            let patch = mesh.elements[first as usize].patch;
            let end = mesh.patches[patch as usize].elements.end;
            let mut sum = 0.0;
            while let Some((&element, &form_factor)) = entries.next_if(|(element, _)| **element < end) {
                sum += mesh.elements[element as usize].area * f64::from(form_factor);
            }
            if sum > 0.0 {
                exchange.push(patch, sum);
            }
        }
        exchange.end_row();
    }
    Ok(exchange)
}

/// (A + Aᵀ)/2.
fn mean(matrix: &Sparse, transposed: &Sparse, cancel: &Cancel) -> Result<Sparse, Cancelled> {
    let mut mean = Sparse::with_capacity(matrix.rows(), matrix.entries());
    for i in 0..matrix.rows() {
        unless(cancel)?;
        for (column, one, other) in merged(matrix.row(i), transposed.row(i)) {
            mean.push(column, 0.5 * (one + other));
        }
        mean.end_row();
    }
    Ok(mean)
}

/// The entries of two rows, column by column, 0 where one has none.
fn merged<'a>(
    one: (&'a [u32], &'a [f64]),
    other: (&'a [u32], &'a [f64]),
) -> impl Iterator<Item = (u32, f64, f64)> + 'a {
    let mut one = one.0.iter().copied().zip(one.1.iter().copied()).peekable();
    let mut other = other.0.iter().copied().zip(other.1.iter().copied()).peekable();
    std::iter::from_fn(move || {
        let column = match (one.peek(), other.peek()) {
            (Some(a), Some(b)) => a.0.min(b.0),
            (Some(a), None) => a.0,
            (None, Some(b)) => b.0,
            (None, None) => return None,
        };
        let here = one.next_if(|entry| entry.0 == column).map_or(0.0, |entry| entry.1);
        let there = other.next_if(|entry| entry.0 == column).map_or(0.0, |entry| entry.1);
        Some((column, here, there))
    })
}

/// How far rows were from closing and pairs from agreeing.
fn closure(mesh: &Mesh, raw: &Sparse, transposed: &Sparse, escaping: &[f64]) -> Closure {
    let rows = || (0..raw.rows()).filter(|&j| mesh.patches[j].area > 0.0);
    let error = |j: usize| (raw.row(j).1.iter().sum::<f64>() / mesh.patches[j].area + escaping[j] - 1.0).abs();
    let (mut apart, mut sum) = (0.0, 0.0);
    for j in 0..raw.rows() {
        for (_, one, other) in merged(raw.row(j), transposed.row(j)) {
            apart += (one - other).abs();
            sum += one + other;
        }
    }
    Closure {
        mean: rows().map(error).sum::<f64>() / rows().count().max(1) as f64,
        worst: rows().map(error).fold(0.0, f64::max),
        reciprocity: if sum > 0.0 { apart / sum } else { 0.0 },
    }
}

/// Scales a symmetric matrix to these row sums, D M D for M, as far as that is possible: row after row, as its factor must
/// be while the others stay. That descends to the minimum of ½ dᵀ M d − Σ w log d, which is where all rows sum to w.
fn close(matrix: &mut Sparse, wanted: &[f64], area: &[f64], cancel: &Cancel) -> Result<(), Cancelled> {
    let mut scale = vec![1.0; matrix.rows()];
    for _ in 0..MAX_SWEEPS {
        unless(cancel)?;
        let mut worst = 0.0_f64;
        for i in 0..matrix.rows() {
            let (columns, values) = matrix.row(i);
            let sum: f64 = columns.iter().zip(values).map(|(&j, value)| scale[j as usize] * value).sum();
            if sum > 0.0 && wanted[i] > 0.0 {
                worst = worst.max((scale[i] * sum / wanted[i] - 1.0).abs());
                scale[i] = (wanted[i] / sum).clamp(1.0 / MAX_SCALE, MAX_SCALE);
            }
        }
        if worst < CLOSED {
            break;
        }
    }
    for i in 0..matrix.rows() {
        let here = scale[i];
        let (columns, values) = matrix.row_mut(i);
        for (&j, value) in columns.iter().zip(values) {
            // No patch sends more than all it has.
            *value = (*value * here * scale[j as usize]).min(area[i]).min(area[j as usize]);
        }
    }
    Ok(())
}

/// Row j: what each element receives from patch j, so that its patch receives what was agreed on. Where only the other
/// patch saw this one, the elements share evenly.
fn spread(
    mesh: &Mesh,
    toward: &Sparse<f32>,
    raw: &Sparse,
    exchange: &Sparse,
    cancel: &Cancel,
) -> Result<Sparse<f32>, Cancelled> {
    let mut spread = Sparse::with_capacity(toward.rows(), toward.entries());
    for j in 0..toward.rows() {
        unless(cancel)?;
        let (elements, form_factors) = toward.row(j);
        for (patch, agreed, found) in merged(exchange.row(j), raw.row(j)) {
            let Patch { elements: range, area, .. } = &mesh.patches[patch as usize];
            if found > 0.0 {
                let start = elements.partition_point(|element| *element < range.start);
                let end = elements.partition_point(|element| *element < range.end);
                for (&element, &form_factor) in elements[start..end].iter().zip(&form_factors[start..end]) {
                    spread.push(element, (f64::from(form_factor) * agreed / found) as f32);
                }
            } else {
                for element in range.clone() {
                    spread.push(element, (agreed / area) as f32);
                }
            }
        }
        spread.end_row();
    }
    Ok(spread)
}

/// The reason for each zero, row by row.
fn zeros(world: &World, form_factors: &Sparse, cancel: &Cancel) -> Result<Vec<Option<Zero>>, Cancelled> {
    let patches = &world.mesh.patches;
    let mut zeros = Vec::with_capacity(patches.len() * patches.len());
    for (i, here) in patches.iter().enumerate() {
        unless(cancel)?;
        let out_of_sight = out_of_sight(world, here);
        let mut entries = form_factors.row(i).0.iter().peekable();
        zeros.extend(patches.iter().enumerate().map(|(j, there)| {
            let is_zero = entries.next_if(|column| **column as usize == j).is_none();
            is_zero.then(|| out_of_sight(there).unwrap_or(Zero::Occluded))
        }));
    }
    Ok(zeros)
}
