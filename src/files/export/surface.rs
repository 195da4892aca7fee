//! Surfaces of triangles as files: STL, PLY, or their corners as a table.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::Point3;

use super::stl::solid;
use super::text::{ascii, csv_field};
use num::names::{UnknownName, named};

/// A closed surface of triangles, counter-clockwise seen from outside.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceFile {
    /// The title, with its unit.
    pub title: String,
    /// Label of the unit of length.
    pub units: String,
    /// Corners.
    pub points: Vec<[f64; 3]>,
    /// A word for each corner, in the table alone.
    pub words: Vec<String>,
    /// Triangles by their corners.
    pub triangles: Vec<[usize; 3]>,
}

/// The notation of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SurfaceFormat {
    /// ASCII STL.
    Stl,
    /// ASCII PLY.
    Ply,
    /// A table of corners.
    Csv,
}

impl SurfaceFormat {
    const ALL: [(&'static str, Self); 3] = [("stl", Self::Stl), ("ply", Self::Ply), ("csv", Self::Csv)];

    /// The notation that the end of a name says.
    ///
    /// # Errors
    /// Another end.
    pub fn of_path(path: &Path) -> Result<Self, UnknownName> {
        let end = path.extension().map(|end| end.to_string_lossy().to_lowercase()).unwrap_or_default();
        named("format of a surface", &end, &Self::ALL, |known| known.0).map(|known| known.1)
    }
}

impl SurfaceFile {
    /// The text of the file. All digits are written.
    #[must_use]
    pub fn text(&self, format: SurfaceFormat) -> String {
        match format {
            SurfaceFormat::Stl => self.stl(),
            SurfaceFormat::Ply => self.ply(),
            SurfaceFormat::Csv => self.csv(),
        }
    }

    fn stl(&self) -> String {
        let corners = self.triangles.iter().map(|triangle| triangle.map(|k| Point3::from(self.points[k])));
        solid(&ascii(&self.title, |_| "?".into()), corners, 1.0)
    }

    fn ply(&self) -> String {
        let mut out = format!(
            "ply\nformat ascii 1.0\ncomment {}\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            ascii(&self.title, |_| "?".into()),
            self.points.len(),
            self.triangles.len()
        );
        for [x, y, z] in &self.points {
            let _ = writeln!(out, "{x:?} {y:?} {z:?}");
        }
        for [a, b, c] in &self.triangles {
            let _ = writeln!(out, "3 {a} {b} {c}");
        }
        out
    }

    fn csv(&self) -> String {
        let unit: String =
            self.units.trim().chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let mut out = format!("x_{unit},y_{unit},z_{unit},ends_at\n");
        for ([x, y, z], word) in self.points.iter().zip(&self.words) {
            let _ = writeln!(out, "{x:?},{y:?},{z:?},{}", csv_field(word));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_notation_has_every_corner_and_triangle() {
        let surface = SurfaceFile {
            title: "tetrahedron (mm)".into(),
            units: "mm".into(),
            points: vec![[0.0, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            words: ["a", "b,c", "", "d"].map(String::from).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        };
        let read = |name: &str| SurfaceFormat::of_path(Path::new(name)).map(|format| surface.text(format));
        let stl = read("a.STL").unwrap();
        assert_eq!(stl.matches("facet normal").count(), 4);
        assert!(stl.contains("facet normal 0.0 0.0 -1.0") && stl.contains("vertex 1.5 0.0 0.0"));
        let ply = read("a.ply").unwrap();
        assert!(ply.contains("element vertex 4\n") && ply.ends_with("3 1 2 3\n"));
        assert_eq!(read("a.csv").unwrap().lines().nth(2), Some("1.5,0.0,0.0,\"b,c\""));
        assert!(read("a.obj").is_err());
    }
}
