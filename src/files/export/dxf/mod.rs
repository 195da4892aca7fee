//! Hole plans of the plates as DXF R12 in millimetres.

mod dimension;
mod page;

use nalgebra::{Point2, Vector2};

use num::shown::{fixed, rounded_down};

use self::dimension::dimensions;
use self::page::Page;
use super::plate::ClearanceHole;
use super::text::one_line;
use super::{DrilledHole, Export, ExportBody, ExportedFile, OutlinePart, Plate, Unsupported, Writer};

/// The format `dxf`.
pub(super) static WRITER: Writer = Writer {
    leaves_out: "legs; heights of joints above the plate are text only",
    ..Writer::new(
        "hole plans of both plates with dimensions (DXF R12, millimetres), for laser, plasma, mill and drill",
        files,
    )
};

fn files(export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
    let plan = |body: &ExportBody| {
        Ok(ExportedFile::new(&format!("{}-plate.dxf", body.body), plan(export, body, body.plate()?)))
    };
    export.bodies.iter().map(plan).collect()
}

/// Height of text over the greater extent of the plate.
const TEXT: f64 = 0.018;

/// Least and greatest coordinates of the plate, millimetres.
fn extent(plate: &Plate, mm: f64) -> [Point2<f64>; 2] {
    let corners = &plate.outline.hull;
    let start = corners.first().copied().unwrap_or_else(Point2::origin);
    let (low, high) = corners.iter().fold((start, start), |(low, high), p| (low.inf(p), high.sup(p)));
    let margin = Vector2::repeat(plate.outline.margin);
    [(low - margin) * mm, (high + margin) * mm]
}

fn plan(export: &Export, body: &ExportBody, plate: &Plate) -> String {
    let mm = export.unit.millimetres;
    let extent = extent(plate, mm);
    let mut page = Page::new(TEXT * (extent[1] - extent[0]).max());
    for line in export.heading("mm") {
        page.comment(&line);
    }
    let side = if plate.legs_above { "the viewer's" } else { "the far" };
    let axes: Vec<String> =
        plate.axes.column_iter().map(|c| format!("({} {} {})", c[0] + 0.0, c[1] + 0.0, c[2] + 0.0)).collect();
    page.comment(&format!(
        "Plate of the {}: drawing x, y, z (towards the viewer) are {}, {}, {} in the frame of the {}; the legs are on {side} side",
        body.body, axes[0], axes[1], axes[2], body.body
    ));
    page.comment(&format!("Plate thickness {} mm; cut the layers OUTLINE and HOLES", plate.thickness * mm));
    for corner in extent {
        page.reaches(corner);
    }
    outline(&mut page, plate, mm);
    holes(&mut page, plate, mm);
    origin(&mut page, extent);
    let centres: Vec<Point2<f64>> = plate.holes.iter().map(|h| h.at * mm).collect();
    dimensions(&mut page, &centres, extent, has_origin(extent).then(Point2::origin));
    table(&mut page, export, body, plate, extent);
    page.finish()
}

fn outline(page: &mut Page, plate: &Plate, mm: f64) {
    for part in plate.outline.parts() {
        match part {
            OutlinePart::Line { from, to } => page.entities.line("OUTLINE", from * mm, to * mm),
            OutlinePart::Arc { centre, radius, start, turn } => {
                page.entities.pairs(&[(0, "ARC"), (8, "OUTLINE")]);
                page.entities.point(10, centre * mm);
                let (from, to) = (start.to_degrees(), (start + turn).to_degrees());
                page.entities.reals(&[(40, radius * mm), (50, from), (51, to)]);
            }
        }
    }
}

fn holes(page: &mut Page, plate: &Plate, mm: f64) {
    for (at, diameter) in plate.all_holes() {
        page.entities.pairs(&[(0, "CIRCLE"), (8, "HOLES")]);
        page.entities.point(10, at * mm);
        page.entities.reals(&[(40, 0.5 * diameter * mm)]);
    }
    let radius = 0.5 * plate.hole_diameter * mm;
    for hole in &plate.holes {
        let at = hole.at * mm;
        page.text(
            "NAMES",
            at + Vector2::repeat(0.8 * radius + 0.3 * page.text_height),
            &hole.joints.join("/"),
        );
    }
}

/// Whether the origin of the drawing is on the plate.
fn has_origin([low, high]: [Point2<f64>; 2]) -> bool {
    low.x <= 0.0 && low.y <= 0.0 && high.x >= 0.0 && high.y >= 0.0
}

/// A cross at the origin of the drawing, if the plate is near it.
fn origin(page: &mut Page, [low, high]: [Point2<f64>; 2]) {
    if has_origin([low, high]) {
        for arm in [Vector2::x(), Vector2::y()] {
            let arm = Point2::from(arm * page.text_height);
            page.entities.line("TABLE", -arm, arm);
        }
    }
}

/// Title, scale, tolerance and datum in a frame.
fn title_block(
    page: &mut Page,
    export: &Export,
    (body, plate): (&ExportBody, &Plate),
    top: Point2<f64>,
    mm: f64,
) {
    let h = page.text_height;
    let material = plate.material.as_ref().map_or_else(|| "not stated".to_string(), |name| one_line(name));
    let datum = if has_origin(extent(plate, mm)) {
        "datum: the cross, which is the origin of the frame; dimensions start there"
    } else {
        "datum: the lowest holes; the table counts from the origin of the frame"
    };
    let lines = [
        format!("{}: {} plate", one_line(&export.name), body.body),
        format!("material {material}, thickness {}", fixed(plate.thickness * mm, 4)),
        "mm, scale 1:1; ISO 2768-m for sizes, not for the places of holes".to_string(),
        match export.hole_places {
            Some(diameter) => {
                format!(
                    "centres of holes: within circles of diameter {} about their places",
                    rounded_down(diameter * mm)
                )
            }
            None => "places of holes: no tolerance given (equipod export --bound)".to_string(),
        },
        datum.to_string(),
        export.program.clone(),
    ];
    let (left, mut at) = (top.x, Point2::new(top.x + h, top.y - 1.8 * h));
    for line in &lines {
        page.text("TABLE", at, line);
        at.y -= 1.8 * h;
    }
    let (right, low) = (page.right() + h, at.y);
    let corners = [
        Point2::new(left, top.y),
        Point2::new(right, top.y),
        Point2::new(right, low),
        Point2::new(left, low),
    ];
    for (k, corner) in corners.iter().enumerate() {
        page.entities.line("TABLE", *corner, corners[(k + 1) % 4]);
        page.reaches(*corner);
    }
}

/// Positions of the holes in the drawing, equal to those in the frame of the plate.
fn table(page: &mut Page, export: &Export, body: &ExportBody, plate: &Plate, extent: [Point2<f64>; 2]) {
    let (h, mm) = (page.text_height, export.unit.millimetres);
    let mut at = Point2::new(page.right() + 3.0 * h, extent[1].y);
    let mut lines = vec![
        format!("{} plate, mm, thickness {}", body.body, fixed(plate.thickness * mm, 4)),
        format!("{} holes, diameter {}", plate.holes.len(), fixed(plate.hole_diameter * mm, 4)),
        format!("corner radius {}", fixed(plate.outline.margin * mm, 4)),
        "hole   x   y".to_string(),
    ];
    if let Some(material) = &plate.material {
        lines.insert(1, format!("material {}", one_line(material)));
    }
    if plate.bolt_count() > 0 {
        let (count, diameter) = (plate.bolt_count(), plate.bolt_diameter * mm);
        let thread = ClearanceHole::of(diameter).map_or_else(String::new, |thread| format!(" ({thread})"));
        let line = format!("{count} bolt holes, diameter {}{thread}", fixed(diameter, 4));
        lines.insert(lines.len() - 1, line);
    }
    let place = |p: &Point2<f64>| format!("{}   {}", fixed(p.x * mm, 4), fixed(p.y * mm, 4));
    let row = |h: &DrilledHole| {
        let post = if h.post > 0.0 { format!("   post {}", fixed(h.post * mm, 4)) } else { String::new() };
        format!("{}   {}{post}", h.joints.join("/"), place(&h.at))
    };
    lines.extend(plate.holes.iter().map(row));
    for hole in &plate.holes {
        let bolt = |p: &Point2<f64>| format!("bolt of {}   {}", hole.joints.join("/"), place(p));
        lines.extend(hole.bolts.iter().map(bolt));
    }
    for line in lines {
        page.text("TABLE", at, &line);
        at.y -= 1.8 * h;
    }
    title_block(page, export, (body, plate), at, mm);
}
