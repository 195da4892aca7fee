//! Reads and writes texts: design files, tables, drawings, models of simulators, code of controllers, pictures.
//!
//! It knows `num`, `platform`, `fk` and `machine`. It turns text into values and values into text, and opens no file.
//!
//! * [`DesignModel`](design::DesignModel): what a design file holds once it is valid.
//! * [`Export`](export::Export): a design with all sizes that a file for other programs needs.
//! * [`ModesFigure`](plot::ModesFigure): what a picture shows, as every kind of picture has it; a function writes it as
//!   SVG.
//!
//! A text is read into a table with places, checked key by key, and becomes a design; a design becomes an export, and
//! each format writes its texts from that.

pub mod design;
pub mod export;
pub mod plot;
