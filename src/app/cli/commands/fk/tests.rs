//! Poses as JSON and as text.

use fk::{
    Completeness, FkRoot, FkSolutions, Method, PathEnd, PathReport, Reality, Reason, Rejected,
    RejectionReason,
};
use nalgebra::{Rotation3, Vector3};
use platform::geom::{ComplexPose, Pose};
use records::{FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord, RowFailure, SolvedRecord};
use serde_json::{Value, json};

use crate::app::cli::failure::Failure;

fn solutions(condition: f64) -> FkSolutions {
    let pose = Pose { rotation: Rotation3::identity(), position: Vector3::new(1.0, 2.0, 0.1 + 0.2) };
    let root = |reality| {
        let mut root = FkRoot::new(ComplexPose::from(pose), reality, 1e-15, condition);
        root.multiplicity = 2;
        root
    };
    let roots = [Reality::Real, Reality::Undecided, Reality::NonReal].map(root).to_vec();
    let unproved = Completeness::unproved([Reason::LegsNearlyDependent]);
    let mut solutions = FkSolutions::new(Method::Homotopy, roots, unproved, 7);
    solutions.paths = vec![PathReport::new(3, PathEnd::AtInfinity)];
    solutions.rejected = vec![Rejected { reason: RejectionReason::Duplicate, residual: 0.0 }];
    solutions
}

#[test]
fn the_document_has_the_fields_of_the_contract() {
    let fields = serde_json::to_value(SolvedRecord::from(&solutions(10.0))).unwrap();
    assert_eq!(fields["completeness"], "unproved");
    assert_eq!((&fields["finite_count"], &fields["real_count"]), (&json!(3), &json!(1)));
    assert_eq!(fields["finite_count_with_multiplicity"], 6);
    let real: Vec<&Value> = fields["solutions"].as_array().unwrap().iter().map(|s| &s["real"]).collect();
    assert_eq!(real, [&json!(true), &Value::Null, &json!(false)]);
    let first = &fields["solutions"][0];
    assert_eq!(first["R"]["re"], json!([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]));
    assert_eq!(first["p"], json!({ "re": [1.0, 2.0, 0.1 + 0.2], "im": [0.0, 0.0, 0.0] }));
    assert!(fields.to_string().contains("0.30000000000000004"), "all digits");
    assert_eq!(fields["paths"][0]["end"], "at_infinity");
    assert_eq!(fields["rejected"][0]["reason"], "duplicate");
    assert!(fields.get("notes").is_none());
}

#[test]
fn what_is_not_finite_is_null_with_a_word_of_explanation() {
    let fields = serde_json::to_value(SolvedRecord::from(&solutions(f64::INFINITY))).unwrap();
    assert!(fields["solutions"][0]["condition"].is_null());
    assert!(fields["notes"][0].as_str().unwrap().contains("null stands for"));
}

#[test]
fn people_are_told_when_roots_may_be_missing() {
    let answer = FkAnswer::One(Box::new(FkOneAnswer::from(SolvedRecord::from(&solutions(10.0)))));
    let shown = sheet::answers::fk("x", "mm", &answer).to_string();
    assert!(
        shown.starts_with("x: 3 finite poses, 1 of them real, 1 undecided (method homotopy)\nINCOMPLETE")
    );
}

#[test]
fn a_row_without_answer_says_why_in_the_last_column() {
    let failure = Failure::refused("fk::not_applicable", "the legs are not octahedral".to_owned());
    let row = |line, outcome| FkRowRecord { line, time: None, lengths: [1.0; 6], angles_deg: None, outcome };
    let solved = FkOneAnswer::from(SolvedRecord::from(&solutions(10.0)));
    let rows = vec![
        row(2, FkRowOutcome::Failed(RowFailure { error: (&failure).into() })),
        row(3, FkRowOutcome::Solved(Box::new(solved))),
    ];
    assert_eq!(
        sheet::answers::fk("x", "mm", &FkAnswer::rows(rows)).to_string(),
        "line  method         finite  real  complete\n   \
         2  -                   -     -  the legs are not octahedral\n   \
         3  homotopy            3     1  ROOTS MAY BE MISSING\n"
    );
}
