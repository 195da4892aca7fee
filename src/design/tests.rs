//! Reading, refusing and writing designs.
