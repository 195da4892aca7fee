//! Reading and writing of texts: design files, tables, drawings, models of simulators, code of controllers, pictures.
//!
//! The crate uses `num`, `platform`, `fk` and `machine`. It converts text to values and values to text, and opens no
//! file.
//!
//! * [`DesignModel`](design::DesignModel): the contents of a valid design file.
//! * [`Export`](export::Export): a design with all sizes for files of other programs.
//! * [`ModesFigure`](plot::ModesFigure): the contents of a picture, as for every kind of picture; a function writes it
//!   as SVG.
//!
//! A text is read into a table with places, checked key by key, and becomes a design. A design becomes an export, from
//! which each format writes its texts.

pub mod design;
pub mod export;
pub mod plot;
