//! Parquet: rows written as a file that describes its columns, and read back.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical};
use parquet::column::reader::ColumnReader;
use parquet::column::writer::ColumnWriter;
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{ChunkReader, FileReader, SerializedFileReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};
use thiserror::Error;

use super::column::{CANDIDATE, ColumnKind, SweepCell, SweepColumn};
use super::rows::SweepRow;
use num::Purpose;
use records::SweepColumnRecord;

/// Number of rows collected before they are written.
const ROWS: usize = 1 << 14;

/// Greatest size of a column's dictionary in a group of rows, bytes: 1024 numbers. From there on the column is written
/// plainly. A dictionary of values that hardly repeat makes the file larger and takes most of the writing time.
const DICTIONARY: usize = 1 << 13;

/// Number of sampled cells for detecting repetition in a column, one from each of as many equal parts. Sampled from
/// 1024 different numbers, they show a repetition in all but a few of ten thousand cases.
const LOOKED_AT: usize = 128;

/// The key of the description of the columns.
const COLUMNS_KEY: &str = "equipod.columns";

/// The reason why a part cannot be written or read.
#[derive(Debug, Error)]
pub enum PartError {
    /// An error of Parquet, or of the file below it.
    #[error("{0}")]
    Parquet(#[from] ParquetError),
    /// A file that is no part of a sweep.
    #[error("{0}")]
    Foreign(String),
}

impl PartError {
    /// The error of the system, if there is one.
    pub fn system(&self) -> Option<&std::io::Error> {
        match self {
            Self::Parquet(ParquetError::External(inner)) => inner.downcast_ref(),
            _ => None,
        }
    }
}

impl From<&SweepColumn> for SweepColumnRecord {
    fn from(c: &SweepColumn) -> Self {
        let (name, kind) = (c.name.clone(), c.kind.name().into());
        Self { name, kind, unit: c.unit.clone(), meaning: c.meaning.clone() }
    }
}

/// The description of the columns in the file.
fn described(columns: &[SweepColumn]) -> String {
    let all: Vec<SweepColumnRecord> = columns.iter().map(SweepColumnRecord::from).collect();
    serde_json::to_string(&all).unwrap_or_default()
}

fn columns_from(text: &str) -> Option<Vec<SweepColumn>> {
    let all: Vec<SweepColumnRecord> = serde_json::from_str(text).ok()?;
    let column = |c: SweepColumnRecord| {
        let kind = ColumnKind::ALL.into_iter().find(|k| k.name() == c.kind)?;
        Some(SweepColumn { name: c.name, kind, unit: c.unit, meaning: c.meaning })
    };
    all.into_iter().map(column).collect()
}

/// The cells of a column that wait for writing.
#[derive(Debug)]
struct WaitingColumn {
    /// The level of each row: 1, or 0 for an empty cell; no list until the first empty cell.
    levels: Vec<i16>,
    /// The cells that are not empty.
    values: WaitingValues,
}

#[derive(Debug)]
enum WaitingValues {
    Numbers(Vec<f64>),
    Integers(Vec<i64>),
    Truths(Vec<bool>),
    Texts(Vec<ByteArray>),
}

impl WaitingColumn {
    /// A column with space for this number of cells; texts get less, since they are rarely in every row.
    fn new(kind: ColumnKind, capacity: usize) -> Self {
        let values = match kind {
            ColumnKind::Number => WaitingValues::Numbers(Vec::with_capacity(capacity)),
            ColumnKind::Integer => WaitingValues::Integers(Vec::with_capacity(capacity)),
            ColumnKind::Truth => WaitingValues::Truths(Vec::with_capacity(capacity)),
            ColumnKind::Text => WaitingValues::Texts(Vec::new()),
        };
        Self { levels: Vec::new(), values }
    }

    /// Takes the cell of row `row` of the group; `false` for a cell of another kind.
    fn push(&mut self, cell: &mut SweepCell, row: usize) -> bool {
        match (&mut self.values, cell) {
            (WaitingValues::Numbers(to), SweepCell::Number(x)) => to.push(*x),
            (WaitingValues::Integers(to), SweepCell::Integer(n)) => to.push(*n),
            (WaitingValues::Truths(to), SweepCell::Truth(b)) => to.push(*b),
            (WaitingValues::Texts(to), SweepCell::Text(text)) => {
                to.push(std::mem::take(text).into_bytes().into());
            }
            (_, SweepCell::Empty) => {
                if self.levels.is_empty() {
                    self.levels.resize(row, 1);
                }
                self.levels.push(0);
                return true;
            }
            _ => return false,
        }
        if !self.levels.is_empty() {
            self.levels.push(1);
        }
        true
    }

    /// Whether a dictionary or compression may help. It may if two of the sampled numbers have equal lower halves, as
    /// equal numbers and whole numbers have. Computed numbers hardly ever do, and then both would waste half of the
    /// writing time.
    fn repeats(&self) -> bool {
        let WaitingValues::Numbers(values) = &self.values else { return true };
        let each = values.len() / LOOKED_AT;
        if each == 0 {
            return true;
        }
        // places at equal distances would miss numbers that alternate
        let mut rng = Purpose::SWEPT_CELLS.rng(0);
        let half = |part: &[f64]| part[(rng.next_u64() % part.len() as u64) as usize].to_bits() as u32;
        let mut halves: Vec<u32> = values.chunks(each).map(half).collect();
        halves.sort_unstable();
        halves.windows(2).any(|w| w[0] == w[1])
    }

    /// Writes the cells and removes them, keeping the memory. The argument `full` holds the levels of a column without
    /// empty cells. Returns `false` for a column of another type.
    fn write(&mut self, to: &mut ColumnWriter<'_>, full: &[i16]) -> Result<bool, ParquetError> {
        let levels = Some(if self.levels.is_empty() { full } else { &self.levels });
        match (&mut self.values, to) {
            (WaitingValues::Numbers(from), ColumnWriter::DoubleColumnWriter(to)) => {
                to.write_batch(from, levels, None)?;
                from.clear();
            }
            (WaitingValues::Integers(from), ColumnWriter::Int64ColumnWriter(to)) => {
                to.write_batch(from, levels, None)?;
                from.clear();
            }
            (WaitingValues::Truths(from), ColumnWriter::BoolColumnWriter(to)) => {
                to.write_batch(from, levels, None)?;
                from.clear();
            }
            (WaitingValues::Texts(from), ColumnWriter::ByteArrayColumnWriter(to)) => {
                to.write_batch(from, levels, None)?;
                from.clear();
            }
            _ => return Ok(false),
        }
        self.levels.clear();
        Ok(true)
    }
}

/// The data for beginning a file, once the first rows show how to write their columns.
struct PartHead<W> {
    to: W,
    schema: Arc<Type>,
    notes: Vec<KeyValue>,
}

/// Writes rows; the output depends only on columns, notes and rows.
#[allow(missing_debug_implementations, reason = "the writer of Parquet has none")]
pub struct PartWriter<W: Write + Send> {
    /// Present until the first rows are written.
    head: Option<PartHead<W>>,
    /// Present from then on.
    writer: Option<SerializedFileWriter<W>>,
    columns: Vec<SweepColumn>,
    waiting: Vec<WaitingColumn>,
    rows: usize,
}

impl<W: Write + Send> PartWriter<W> {
    /// Begins a file with these columns, and with these keys and values as its metadata. Memory for `rows` rows is
    /// reserved from the start, up to the size of a group.
    ///
    /// # Errors
    /// The errors of the file.
    pub fn new(
        to: W,
        columns: &[SweepColumn],
        notes: &[(String, String)],
        capacity: u64,
    ) -> Result<Self, PartError> {
        let field = |c: &SweepColumn| {
            let (physical, logical) = match c.kind {
                ColumnKind::Number => (Physical::DOUBLE, None),
                ColumnKind::Integer => (Physical::INT64, None),
                ColumnKind::Truth => (Physical::BOOLEAN, None),
                ColumnKind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            };
            let built = Type::primitive_type_builder(&c.name, physical)
                .with_repetition(Repetition::OPTIONAL)
                .with_logical_type(logical)
                .build();
            built.map(Arc::new)
        };
        let fields = columns.iter().map(field).collect::<Result<Vec<_>, _>>()?;
        let schema = Arc::new(Type::group_type_builder("sweep").with_fields(fields).build()?);
        let own = (COLUMNS_KEY.to_owned(), described(columns));
        let notes = notes.iter().chain([&own]).map(|(k, v)| KeyValue::new(k.clone(), v.clone())).collect();
        let capacity = ROWS.min(usize::try_from(capacity).unwrap_or(ROWS));
        let waiting = columns.iter().map(|c| WaitingColumn::new(c.kind, capacity)).collect();
        let head = Some(PartHead { to, schema, notes });
        Ok(Self { head, writer: None, columns: columns.to_vec(), waiting, rows: 0 })
    }

    /// Adds a row and takes its texts.
    ///
    /// # Errors
    /// The errors of the file; a row that does not fit the columns.
    pub fn push(&mut self, row: &mut [SweepCell]) -> Result<(), PartError> {
        if row.len() != self.columns.len() {
            let message = format!("a row has {} cells for {} columns", row.len(), self.columns.len());
            return Err(PartError::Foreign(message));
        }
        for (k, (waiting, cell)) in self.waiting.iter_mut().zip(row).enumerate() {
            if !waiting.push(cell, self.rows) {
                return Err(other_type(&self.columns[k]));
            }
        }
        self.rows += 1;
        if self.rows == ROWS { self.write_group() } else { Ok(()) }
    }

    /// The writing properties of the columns, as suits the waiting rows best.
    fn properties(&self, notes: Vec<KeyValue>) -> WriterProperties {
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_dictionary_page_size_limit(DICTIONARY)
            .set_created_by(format!("equipod {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(notes));
        for (column, waiting) in self.columns.iter().zip(&self.waiting) {
            let path = || ColumnPath::from(column.name.clone());
            if !waiting.repeats() {
                properties = properties
                    .set_column_dictionary_enabled(path(), false)
                    .set_column_compression(path(), Compression::UNCOMPRESSED);
            } else if column.name == CANDIDATE && self.rows >= LOOKED_AT {
                // increasing numbers, mostly by one
                properties = properties
                    .set_column_dictionary_enabled(path(), false)
                    .set_column_encoding(path(), Encoding::DELTA_BINARY_PACKED);
            }
        }
        properties.build()
    }

    /// Begins the file, if this is not done yet.
    fn begin(&mut self) -> Result<(), PartError> {
        if let Some(PartHead { to, schema, notes }) = self.head.take() {
            let properties = Arc::new(self.properties(notes));
            self.writer = Some(SerializedFileWriter::new(to, schema, properties)?);
        }
        Ok(())
    }

    fn write_group(&mut self) -> Result<(), PartError> {
        if self.rows == 0 {
            return Ok(());
        }
        self.begin()?;
        let mut group = self.writer.as_mut().ok_or_else(not_begun)?.next_row_group()?;
        let full = vec![1; self.rows];
        let mut k = 0;
        while let Some(mut column) = group.next_column()? {
            if !self.waiting[k].write(column.untyped(), &full)? {
                return Err(other_type(&self.columns[k]));
            }
            column.close()?;
            k += 1;
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }

    /// Writes the rest and the end of the file.
    ///
    /// # Errors
    /// The errors of the file.
    pub fn finish(mut self) -> Result<W, PartError> {
        self.write_group()?;
        // the file may have no rows
        self.begin()?;
        Ok(self.writer.ok_or_else(not_begun)?.into_inner()?)
    }
}

fn not_begun() -> PartError {
    PartError::Foreign("the file could not be begun".into())
}

fn other_type(column: &SweepColumn) -> PartError {
    PartError::Foreign(format!("{} has another type", column.name))
}

/// A reader of a part, one group of rows after the other.
#[allow(missing_debug_implementations, reason = "the reader of Parquet has none")]
pub struct PartReader {
    reader: Box<dyn FileReader>,
    /// The columns of the table.
    pub columns: Vec<SweepColumn>,
}

impl PartReader {
    /// Opens a part: reads its end, and its description of the columns.
    ///
    /// # Errors
    /// A file that is not Parquet, or no part of a sweep.
    pub fn new(from: impl ChunkReader + 'static) -> Result<Self, PartError> {
        let reader: Box<dyn FileReader> = Box::new(SerializedFileReader::new(from)?);
        let foreign =
            || PartError::Foreign("this is no table of a sweep: it does not say what its columns are".into());
        let text = note_of(reader.as_ref(), COLUMNS_KEY).ok_or_else(foreign)?;
        let columns = columns_from(&text).ok_or_else(foreign)?;
        if reader.metadata().file_metadata().schema_descr().num_columns() != columns.len() {
            return Err(foreign());
        }
        Ok(Self { reader, columns })
    }

    /// The metadata under a key.
    pub fn note(&self, key: &str) -> Option<String> {
        note_of(self.reader.as_ref(), key)
    }

    /// Number of groups of rows.
    pub fn groups(&self) -> usize {
        self.reader.num_row_groups()
    }

    /// The rows of a group, of some columns or all.
    ///
    /// # Errors
    /// A truncated or altered file.
    pub fn group(&self, group: usize, chosen: &[usize]) -> Result<Vec<SweepRow>, PartError> {
        let group = self.reader.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        let mut out = vec![Vec::with_capacity(chosen.len()); rows];
        for k in chosen {
            let cells = match group.get_column_reader(*k)? {
                ColumnReader::DoubleColumnReader(from) => cells_of(from, rows, |x| SweepCell::Number(*x))?,
                ColumnReader::Int64ColumnReader(from) => cells_of(from, rows, |n| SweepCell::Integer(*n))?,
                ColumnReader::BoolColumnReader(from) => cells_of(from, rows, |b| SweepCell::Truth(*b))?,
                ColumnReader::ByteArrayColumnReader(from) => cells_of(from, rows, |bytes: &ByteArray| {
                    SweepCell::Text(String::from_utf8_lossy(bytes.data()).into_owned())
                })?,
                _ => {
                    return Err(PartError::Foreign(format!(
                        "column {k} has a type that sweeps do not write"
                    )));
                }
            };
            if cells.len() != rows {
                return Err(PartError::Foreign(format!("column {k} has {} of {rows} rows", cells.len())));
            }
            for (row, cell) in out.iter_mut().zip(cells) {
                row.push(cell);
            }
        }
        Ok(out)
    }
}

fn note_of(reader: &dyn FileReader, key: &str) -> Option<String> {
    let notes = reader.metadata().file_metadata().key_value_metadata()?;
    notes.iter().find(|note| note.key == key)?.value.clone()
}

fn cells_of<T: DataType>(
    mut from: parquet::column::reader::ColumnReaderImpl<T>,
    rows: usize,
    cell: impl Fn(&T::T) -> SweepCell,
) -> Result<Vec<SweepCell>, PartError> {
    let (mut values, mut levels) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    while levels.len() < rows {
        let (read, _, _) = from.read_records(rows - levels.len(), Some(&mut levels), None, &mut values)?;
        if read == 0 {
            break;
        }
    }
    let mut values = values.iter();
    Ok(levels
        .iter()
        .map(|level| if *level == 0 { None } else { values.next() }.map_or(SweepCell::Empty, &cell))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use parquet::file::reader::Length;

    /// Bytes as a file.
    fn opened(bytes: &[u8]) -> Result<PartReader, PartError> {
        let file = tempfile::tempfile().unwrap();
        (&file).write_all(bytes).unwrap();
        assert_eq!(file.len(), bytes.len() as u64);
        PartReader::new(file)
    }

    fn columns() -> Vec<SweepColumn> {
        vec![
            SweepColumn::new("candidate", ColumnKind::Integer, None, "number"),
            SweepColumn::number("x", Some("mm"), "length"),
            SweepColumn::new("met", ColumnKind::Truth, None, "met"),
            SweepColumn::new("word", ColumnKind::Text, None, "a \"word\""),
        ]
    }

    fn rows(n: i64) -> Vec<SweepRow> {
        let row = |k: i64| {
            vec![
                SweepCell::Integer(k),
                if k % 3 == 0 { SweepCell::Empty } else { SweepCell::Number(k as f64 / 7.0) },
                SweepCell::truth((k % 4 != 1).then_some(k % 2 == 0)),
                SweepCell::text((k % 5 != 0).then_some(["a", "\u{e9}", ""][(k % 3) as usize])),
            ]
        };
        (0..n).map(row).collect()
    }

    fn written(n: i64) -> Vec<u8> {
        let notes = [("equipod.seed".to_owned(), "7".to_owned())];
        let mut writer = PartWriter::new(Vec::new(), &columns(), &notes, n as u64).unwrap();
        for mut row in rows(n) {
            writer.push(&mut row).unwrap();
        }
        writer.finish().unwrap()
    }

    #[test]
    fn what_is_written_is_read_back_with_its_columns_and_notes() {
        let n = ROWS as i64 + 100;
        let bytes = written(n);
        assert_eq!(bytes, written(n), "the same rows make the same bytes");
        let reader = opened(&bytes).unwrap();
        assert_eq!((reader.columns.clone(), reader.groups()), (columns(), 2));
        assert_eq!(reader.note("equipod.seed").as_deref(), Some("7"));
        let mut back = Vec::new();
        for group in 0..reader.groups() {
            back.extend(reader.group(group, &[0, 1, 2, 3]).unwrap());
        }
        assert_eq!(back, rows(n));
        assert_eq!(
            reader.group(1, &[3, 0]).unwrap()[99],
            [rows(n)[n as usize - 1][3].clone(), SweepCell::Integer(n - 1)]
        );
        assert_eq!(opened(&written(0)).unwrap().groups(), 0);
    }

    #[test]
    fn columns_of_many_different_numbers_are_written_without_a_table_of_them() {
        let column = [SweepColumn::number("x", None, "")];
        let bytes = |different: i64| {
            let mut writer = PartWriter::new(Vec::new(), &column, &[], 0).unwrap();
            for k in 0..ROWS as i64 {
                // digits that do not compress
                writer.push(&mut [SweepCell::Number(1.0 / (1.5 + (k % different) as f64))]).unwrap();
            }
            writer.finish().unwrap()
        };
        let (few, many) = (bytes(100), bytes(ROWS as i64));
        assert!(few.len() < 2 * ROWS, "numbers that repeat take less than two bytes each: {}", few.len());
        assert!(many.len() < 8 * ROWS + 8 * 1024, "others their eight: {}", many.len());
        for (bytes, different) in [(few, 100), (many, ROWS)] {
            let back = opened(&bytes).unwrap().group(0, &[0]).unwrap();
            let value = |k: usize| SweepCell::Number(1.0 / (1.5 + (k % different) as f64));
            assert!(back.iter().enumerate().all(|(k, row)| row[0].is_same(&value(k))));
        }
    }

    #[test]
    fn numbers_that_come_in_turn_are_seen_to_repeat_and_computed_ones_not_to() {
        let columns =
            [SweepColumn::new(CANDIDATE, ColumnKind::Integer, None, ""), SweepColumn::number("x", None, "")];
        let described = |n: usize, value: &dyn Fn(usize) -> f64| {
            let mut writer = PartWriter::new(Vec::new(), &columns, &[], 0).unwrap();
            for k in 0..n {
                writer.push(&mut [SweepCell::Integer(k as i64), SweepCell::Number(value(k))]).unwrap();
            }
            let reader = opened(&writer.finish().unwrap()).unwrap();
            let back = reader.group(0, &[0, 1]).unwrap();
            assert!(back.iter().enumerate().all(|(k, row)| {
                row[0] == SweepCell::Integer(k as i64) && row[1].is_same(&SweepCell::Number(value(k)))
            }));
            let [candidate, x] = [0, 1].map(|k| reader.reader.metadata().row_group(0).column(k).clone());
            let delta = candidate.encodings().any(|e| e == Encoding::DELTA_BINARY_PACKED);
            (delta, x.compression(), x.encodings().any(|e| e == Encoding::RLE_DICTIONARY))
        };
        let computed = |k: usize| 1.0 / (1.5 + k as f64);
        let plain = (true, Compression::UNCOMPRESSED, false);
        assert_eq!([200, 5000, ROWS].map(|n| described(n, &computed)), [plain; 3]);
        // few rows show nothing
        assert_eq!(described(LOOKED_AT - 1, &computed), (false, Compression::SNAPPY, true));
        // alternating numbers with periods that share factors with everything here, or with nothing; whole numbers; a
        // constant number
        for turn in [2, 64, 127, 128, 625, 1000, 1009, 1024] {
            let repeated = |k: usize| computed(k % turn);
            assert_eq!(
                [5000, ROWS].map(|n| described(n, &repeated)),
                [(true, Compression::SNAPPY, true); 2],
                "{turn}"
            );
        }
        assert_eq!(described(5000, &|k| k as f64), (true, Compression::SNAPPY, true));
    }

    #[test]
    fn rows_that_the_columns_do_not_fit_are_refused() {
        let mut writer = PartWriter::new(Vec::new(), &columns(), &[], 0).unwrap();
        assert!(writer.push(&mut [SweepCell::Empty]).is_err(), "too few cells");
        let mut row = rows(2).remove(1);
        row[1] = SweepCell::Truth(true);
        assert!(writer.push(&mut row).is_err(), "a truth value among numbers");
    }

    #[test]
    fn torn_files_and_foreign_ones_are_refused() {
        let bytes = written(50);
        assert!(opened(&bytes[..bytes.len() - 3]).is_err() && opened(b"PAR1").is_err());
        assert!(opened(&[]).is_err());
    }

    #[test]
    fn numbers_that_are_none_keep_their_bits() {
        let column = [SweepColumn::number("x", None, "")];
        let values = [f64::NAN, f64::INFINITY, -0.0, f64::MIN_POSITIVE / 8.0];
        let mut writer = PartWriter::new(Vec::new(), &column, &[], 0).unwrap();
        for x in values {
            writer.push(&mut [SweepCell::Number(x)]).unwrap();
        }
        let reader = opened(&writer.finish().unwrap()).unwrap();
        let back = reader.group(0, &[0]).unwrap();
        assert!(back.iter().zip(values).all(|(row, x)| row[0].is_same(&SweepCell::Number(x))));
    }
}
