//! The derivation of the leg map from coplanar joints: the sheet of `equivalents family --explain`.

use serde::Serialize;

use super::request::Refusal;
use super::session::{Equivalent, InvalidStart, Session};
use fk::FkOptions;
use records::DerivationRecord;

/// The sheet as markup, in which every text is escaped.
#[derive(Debug, Serialize)]
pub(super) struct DerivedRecord {
    html: String,
}

/// The steps to an equivalent, and forward kinematics of both platforms.
pub(super) fn record(session: &Session, e: &Equivalent) -> Result<DerivedRecord, Refusal> {
    let original = session.original.as_ref().ok_or(InvalidStart::NoOriginal)?;
    let (second, _) = session.second(e)?;
    let found = DerivationRecord::compared(original, &e.pattern, &second, &FkOptions::new())
        .map_err(|why| Refusal::new("derivation", why))?;
    let (found, _) = found
        .ok_or_else(|| Refusal::new("derivation", "an edge of the octahedral platform has no length"))?;
    let sheet = sheet::answers::derivation(&found, &original.design.name, &second.name);
    Ok(DerivedRecord { html: sheet::shown(&sheet.html()) })
}
