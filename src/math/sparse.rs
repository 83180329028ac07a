//! A matrix most of whose entries are zero, row after row.

/// Compressed sparse rows; the columns of a row ascend.
#[derive(Clone, Debug, PartialEq)]
pub struct Sparse<V = f64> {
    /// Row `i` has the entries `starts[i] .. starts[i + 1]`.
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<V>,
}

impl<V> Sparse<V> {
    /// A matrix without rows yet, with room for this many rows and entries.
    pub fn with_capacity(rows: usize, entries: usize) -> Self {
        let mut starts = Vec::with_capacity(rows + 1);
        starts.push(0);
        Self { starts, columns: Vec::with_capacity(entries), values: Vec::with_capacity(entries) }
    }

    /// Bytes that a matrix of this size takes.
    pub fn bytes(rows: usize, entries: usize) -> u64 {
        ((rows + 1) * size_of::<usize>() + entries * (size_of::<u32>() + size_of::<V>())) as u64
    }

    /// Adds an entry to the row under way; columns must ascend.
    pub fn push(&mut self, column: u32, value: V) {
        self.columns.push(column);
        self.values.push(value);
    }

    /// Ends the row under way.
    pub fn end_row(&mut self) {
        self.starts.push(self.columns.len());
    }

    /// Rows and columns exchanged, of a square matrix.
    pub fn transposed(&self) -> Self
    where
        V: Copy + Default,
    {
        let mut starts = vec![0; self.starts.len()];
        for &column in &self.columns {
            starts[column as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut columns = vec![0; self.columns.len()];
        let mut values = vec![V::default(); self.values.len()];
        for row in 0..self.rows() {
            let (row_columns, row_values) = self.row(row);
            for (&column, &value) in row_columns.iter().zip(row_values) {
                let place = next[column as usize];
                columns[place] = row as u32;
                values[place] = value;
                next[column as usize] += 1;
            }
        }
        Self { starts, columns, values }
    }

    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Entries that are not zero.
    pub fn entries(&self) -> usize {
        self.columns.len()
    }

    /// Columns of a row and their values.
    pub fn row(&self, row: usize) -> (&[u32], &[V]) {
        let range = self.starts[row]..self.starts[row + 1];
        (&self.columns[range.clone()], &self.values[range])
    }

    /// The values of a row, to be changed.
    pub fn row_mut(&mut self, row: usize) -> (&[u32], &mut [V]) {
        let range = self.starts[row]..self.starts[row + 1];
        (&self.columns[range.clone()], &mut self.values[range])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_as_they_were_put_in() {
        let mut matrix = Sparse::with_capacity(3, 3);
        matrix.push(1, 0.5);
        matrix.push(4, 0.25);
        matrix.end_row();
        matrix.end_row();
        matrix.push(0, 1.0);
        matrix.end_row();
        assert_eq!((matrix.rows(), matrix.entries()), (3, 3));
        assert_eq!(matrix.row(0), (&[1, 4][..], &[0.5, 0.25][..]));
        assert_eq!(matrix.row(1), (&[][..], &[][..]));
        let mut square = Sparse::with_capacity(2, 3);
        square.push(0, 1.0);
        square.push(1, 2.0);
        square.end_row();
        square.push(0, 3.0);
        square.end_row();
        let transposed = square.transposed();
        assert_eq!((transposed.row(0), transposed.row(1)), ((&[0, 1][..], &[1.0, 3.0][..]), (&[0][..], &[2.0][..])));
        assert_eq!(transposed.transposed(), square);
        matrix.row_mut(2).1[0] = 2.0;
        assert_eq!(matrix.row(2), (&[0][..], &[2.0][..]));
    }
}
