//! A drawing under construction: group codes and values of R12, its blocks, and its extent.

use std::fmt::Write as _;

use nalgebra::Point2;

use crate::export::text::{ascii, real};

/// Layers: name and colour. Only the first two are cut.
const LAYERS: [(&str, u8); 5] = [("OUTLINE", 7), ("HOLES", 1), ("NAMES", 3), ("DIMENSIONS", 5), ("TABLE", 8)];

/// Group codes and values.
#[derive(Debug, Default)]
pub(super) struct Groups(String);

impl Groups {
    pub(super) fn pair(&mut self, code: u16, value: &str) {
        let _ = writeln!(self.0, "{code:3}\n{value}");
    }

    pub(super) fn pairs(&mut self, values: &[(u16, &str)]) {
        for (code, value) in values {
            self.pair(*code, value);
        }
    }

    pub(super) fn reals(&mut self, values: &[(u16, f64)]) {
        for (code, value) in values {
            self.pair(*code, &real(*value));
        }
    }

    /// A point under `code`, `code + 10`, `code + 20`.
    pub(super) fn point(&mut self, code: u16, p: Point2<f64>) {
        self.reals(&[(code, p.x), (code + 10, p.y), (code + 20, 0.0)]);
    }

    pub(super) fn line(&mut self, layer: &str, from: Point2<f64>, to: Point2<f64>) {
        self.pairs(&[(0, "LINE"), (8, layer)]);
        self.point(10, from);
        self.point(11, to);
    }

    /// Text of a height, rotated by degrees; centred on the point if `centred`, otherwise to its right.
    pub(super) fn text(
        &mut self,
        layer: &str,
        at: Point2<f64>,
        height: f64,
        text: &str,
        centred: Option<f64>,
    ) {
        self.pairs(&[(0, "TEXT"), (8, layer)]);
        self.point(10, at);
        self.reals(&[(40, height)]);
        // characters outside ASCII are written as their code, as in AutoCAD
        self.pair(1, &ascii(text, |c| format!("\\U+{:04X}", c as u32)));
        if let Some(turn) = centred {
            self.reals(&[(50, turn)]);
            self.pair(72, "1");
            self.point(11, at);
        }
    }
}

/// The drawing; lengths are in millimetres.
#[derive(Debug)]
pub(super) struct Page {
    comments: Groups,
    blocks: Groups,
    pub(super) entities: Groups,
    /// Height of all text.
    pub(super) text_height: f64,
    reach: [Point2<f64>; 2],
}

impl Page {
    pub(super) fn new(text_height: f64) -> Self {
        let far = Point2::new(f64::INFINITY, f64::INFINITY);
        Self {
            comments: Groups::default(),
            blocks: Groups::default(),
            entities: Groups::default(),
            text_height,
            reach: [far, -far],
        }
    }

    pub(super) fn comment(&mut self, text: &str) {
        self.comments.pair(999, &ascii(text, |_| "?".to_string()));
    }

    /// Extends the drawing to a point.
    pub(super) fn reaches(&mut self, p: Point2<f64>) {
        self.reach[0] = self.reach[0].inf(&p);
        self.reach[1] = self.reach[1].sup(&p);
    }

    /// The right end of the drawing.
    pub(super) fn right(&self) -> f64 {
        self.reach[1].x
    }

    pub(super) fn text(&mut self, layer: &str, at: Point2<f64>, text: &str) {
        self.entities.text(layer, at, self.text_height, text, None);
        self.reaches(at);
        // letters are about as wide as high
        self.reaches(Point2::new(
            at.x + self.text_height * text.chars().count() as f64,
            at.y + self.text_height,
        ));
    }

    /// An anonymous block: R12 readers draw it where an entity names it.
    pub(super) fn block(&mut self, name: &str, draw: impl FnOnce(&mut Groups)) {
        self.blocks.pairs(&[(0, "BLOCK"), (8, "DIMENSIONS"), (2, name), (70, "1")]);
        self.blocks.point(10, Point2::origin());
        self.blocks.pair(3, name);
        draw(&mut self.blocks);
        self.blocks.pairs(&[(0, "ENDBLK"), (8, "DIMENSIONS")]);
    }

    fn header(&self) -> Groups {
        let mut out = Groups::default();
        out.pairs(&[
            (0, "SECTION"),
            (2, "HEADER"),
            (9, "$ACADVER"),
            (1, "AC1009"),
            (9, "$INSUNITS"),
            (70, "4"),
        ]);
        for (name, p) in ["$EXTMIN", "$EXTMAX"].into_iter().zip(self.reach) {
            out.pair(9, name);
            out.point(10, p);
        }
        out.pair(0, "ENDSEC");
        out
    }

    fn tables(&self) -> Groups {
        let mut out = Groups::default();
        out.pairs(&[(0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LTYPE"), (70, "1"), (0, "LTYPE")]);
        out.pairs(&[(2, "CONTINUOUS"), (70, "0"), (3, "Solid line"), (72, "65"), (73, "0"), (40, "0.0")]);
        out.pairs(&[(0, "ENDTAB"), (0, "TABLE"), (2, "LAYER"), (70, &LAYERS.len().to_string())]);
        for (name, colour) in LAYERS {
            out.pairs(&[(0, "LAYER"), (2, name), (70, "0"), (62, &colour.to_string()), (6, "CONTINUOUS")]);
        }
        out.pairs(&[
            (0, "ENDTAB"),
            (0, "TABLE"),
            (2, "STYLE"),
            (70, "1"),
            (0, "STYLE"),
            (2, "STANDARD"),
            (70, "0"),
        ]);
        out.reals(&[(40, 0.0), (41, 1.0), (50, 0.0)]);
        out.pair(71, "0");
        out.reals(&[(42, self.text_height)]);
        out.pairs(&[(3, "txt"), (4, ""), (0, "ENDTAB"), (0, "TABLE"), (2, "DIMSTYLE"), (70, "1")]);
        out.pairs(&[(0, "DIMSTYLE"), (2, "STANDARD"), (70, "0")]);
        // scale, arrow, extension line: offset and overshoot; tick instead of arrow; text height, gap
        let h = self.text_height;
        out.reals(&[
            (40, 1.0),
            (41, h),
            (42, 0.5 * h),
            (44, 0.5 * h),
            (140, h),
            (142, 0.7 * h),
            (147, 0.5 * h),
        ]);
        out.pairs(&[(77, "1"), (0, "ENDTAB"), (0, "ENDSEC")]);
        out
    }

    /// The file.
    pub(super) fn finish(self) -> String {
        let mut out = Groups::default();
        out.0.push_str(&self.comments.0);
        out.0.push_str(&self.header().0);
        out.0.push_str(&self.tables().0);
        out.pairs(&[(0, "SECTION"), (2, "BLOCKS")]);
        out.0.push_str(&self.blocks.0);
        out.pairs(&[(0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")]);
        out.0.push_str(&self.entities.0);
        out.pairs(&[(0, "ENDSEC"), (0, "EOF")]);
        out.0
    }
}
