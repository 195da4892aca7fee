//! Integration tests: one binary, one module a topic.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a failing test panics")]

mod allocations;
mod architecture;
mod bench;
mod certify;
mod cli_align;
mod cli_bench;
mod cli_check;
mod cli_components;
mod cli_explore;
mod cli_fk;
mod cli_frame;
mod cli_locus;
mod cli_move;
mod cli_near;
mod cli_optimize;
mod cli_singularities;
mod cli_synthesis;
mod cli_topologies;
mod cli_verify;
mod closure;
mod completeness;
mod design_files;
mod documents;
mod eliminations;
mod examples;
mod fk_laws;
mod hidden_lengths;
mod instances;
mod leg_maps;
mod octahedral_class;
mod rearrangements;
mod reference;
mod singularity;
mod topologies;
mod trilateration;
