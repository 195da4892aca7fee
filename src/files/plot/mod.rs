//! Draws pictures as SVG text, by pure functions that give the same bytes for the same input.
//!
//! The module `style` has line widths, fonts and colours. Every distinction by colour is also one by line pattern,
//! shape or text.

mod along;
mod components;
mod contour;
mod convergence;
mod determinant;
mod front;
mod labels;
mod locus;
mod modes;
mod motion;
mod noise;
mod oblique;
mod pair;
mod slice;
mod steps;
mod style;
mod surface;
mod sweep;
mod three_view;
mod thumbnail;
mod topologies;
mod workspace;

pub use style::{escape, visible};
pub use surface::{TriangleSurface, ValueBox};
pub use sweep::{SweptColumn, SweptFigure, swept_cloud, swept_field, swept_histogram, swept_parallel};

pub use along::{AlongFigure, AlongPart, sign_along};
pub use components::{CurveFigure, CurveMark, CurvePanel, component_curves};
pub use contour::ValueGrid;
pub use convergence::{ConvergenceCurve, ConvergenceFigure, convergence_chart};
pub use determinant::{OffsetPlane, PlaneAxis, PlanePoint, determinant_plane};
pub use front::{FrontAxis, FrontFigure, pareto_front};
pub use locus::{LocusFigure, LocusMeeting, LocusStep, LocusValue, locus_chart, locus_meetings};
pub use modes::{ModesFigure, assembly_modes};
pub use motion::{MotionFigure, motion};
pub use noise::{NoiseCurve, NoiseFigure, NoisePoint, noise_chart};
pub use pair::{PairFigure, platform_pair};
pub use slice::{SliceAxis, SliceFigure, singular_slice};
pub use steps::{SearchStep, StepsFigure, steps_chart};
pub use style::LIMIT_FILLS;
pub use three_view::{ThreeViewBody, ThreeViewFigure, three_views};
pub use thumbnail::thumbnail;
pub use topologies::{TopologyFigure, topology_diagram, topology_sheet};
pub use workspace::{RequiredSection, SectionOutline, WorkspaceFigure, WorkspaceLimit, workspace_slice};
