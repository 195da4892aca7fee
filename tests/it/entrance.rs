//! The front page: its promises, with the cases without an answer.

use std::error::Error as _;
use std::ops::ControlFlow;

use equipod::prelude::*;

const OCTAHEDRAL: &str = "designs/rbt-octahedral.toml";

fn octahedral() -> Design {
    Design::load(OCTAHEDRAL).unwrap()
}

fn one() -> Threads {
    Threads::Count(std::num::NonZeroUsize::MIN)
}

fn two() -> Threads {
    Threads::Count(std::num::NonZeroUsize::new(2).unwrap())
}

#[test]
fn solvers_errors_and_designs_go_to_other_threads() {
    fn sent<T: Send + Sync + 'static>() {}
    fn moved<T: Send + 'static>() {}
    sent::<Error>();
    sent::<Design>();
    sent::<Solver>();
    sent::<Cancel>();
    moved::<Batch>();
    moved::<Tracker>();
}

#[test]
fn a_design_file_gives_all_its_violations_in_one_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slips.toml");
    std::fs::write(&path, "name = 'x'\nunit = 'mm'\nlegs = [['A', 'B']]\n").unwrap();
    let error = Design::load(&path).unwrap_err();
    assert!(error.violations().len() >= 3, "{error}");
    let text = error.to_string();
    assert!(text.contains("slips.toml") && text.contains("did you mean `units`?"), "{text}");
    let missing = Design::load(folder.path().join("none.toml")).unwrap_err();
    assert!(
        missing.violations().is_empty()
            && missing.source().is_some()
            && missing.to_string().contains("none.toml")
    );
    std::fs::write(&path, [0xff, 0xfe]).unwrap();
    assert!(matches!(Design::load(&path), Err(Error::File { .. })), "no UTF-8");
    assert!(matches!("".parse::<Design>(), Err(Error::Design { file: None, .. })));
}

#[test]
fn a_saved_design_keeps_its_comments_and_reads_back_equal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("saved.toml");
    let before = std::fs::read_to_string("designs/presets/bench-l16.toml").unwrap();
    let mut design = Design::load("designs/presets/bench-l16.toml").unwrap();
    design.save(&path).unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), before);

    let (lengths, description) = (design.lengths, design.description.clone());
    let name = format!("platform.{}", design.platform_names()[1]);
    design.set_joint(&name, [1.0, 2.0, 3.5]).unwrap();
    assert_eq!((design.lengths, &design.description), (lengths, &description));
    design.save(&path).unwrap();
    let after = std::fs::read_to_string(&path).unwrap();
    assert_eq!(before.lines().filter(|l| !after.contains(l)).count(), 1, "one line is another");
    assert!(after.contains("[1.0, 2.0, 3.5]"));
    assert_eq!(Design::load(&path).unwrap(), design);

    let json = folder.path().join("saved.json");
    design.save(&json).unwrap();
    assert_eq!(Design::load(&json).unwrap(), design);
    assert!(matches!(design.save(folder.path().join("no/such/folder.toml")), Err(Error::File { .. })));
    let left = std::fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 2, "nothing but the two files");
}

#[test]
fn a_trajectory_is_read_from_beside_the_design() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("moving.toml");
    let text = octahedral().to_toml().replace("[workspace]\n", "[workspace]\ntrajectory = \"way.csv\"\n");
    std::fs::write(&path, &text).unwrap();
    assert!(matches!(Design::load(&path), Err(Error::File { .. })), "the table is missing");
    let table = folder.path().join("way.csv");
    std::fs::write(&table, "x,y,z,roll,pitch,yaw\n1,2,3,0,0,90\n0,0,17,1,0,0,x\n").unwrap();
    let bad = Design::load(&path).unwrap_err().to_string();
    assert!(bad.contains("way.csv") && bad.contains("line 3"), "{bad}");
    // below names of six columns a row of seven has a number too many; without names the length of a row decides its
    // meaning
    std::fs::write(&table, "x,y,z,roll,pitch,yaw\n1,2,3,0,0,90\n0,0,17,1,0,0,0\n").unwrap();
    assert!(Design::load(&path).unwrap_err().to_string().contains("line 3"));
    std::fs::write(&table, "1,2,3,0,0,90\n0,0,17,1,0,0,0\n").unwrap();
    let design = Design::load(&path).unwrap();
    let poses = &design.workspace.trajectory.as_ref().unwrap().poses;
    assert!((poses[0].angles().degrees()[2] - 90.0).abs() < 1e-12 && poses.len() == 2);
    assert_eq!(design.text(), text, "it still says what the design is");
}

#[test]
fn poses_come_back_from_their_lengths_and_real_roots_are_real_poses() {
    let design = octahedral();
    let home = design.home_or_default();
    let lengths = design.ik(&home).unwrap();
    let found = design.fk(lengths).unwrap();
    let same = |pose: &Pose| {
        (pose.position - home.position).norm() < 1e-9
            && (pose.rotation.matrix() - home.rotation.matrix()).amax() < 1e-9
    };
    assert!(found.real_poses().any(|pose| same(&pose)));
    for root in &found.roots {
        assert_eq!(root.real_pose().is_some(), root.reality == Reality::Real);
        if let Some(pose) = root.real_pose() {
            let again = design.ik(&pose).unwrap().get();
            assert!(again.iter().zip(lengths.get()).all(|(x, y)| (x - y).abs() < 1e-9));
        }
    }
    assert!(matches!(design.fk([1.0, 2.0, 3.0, 4.0, 5.0, -1.0]), Err(Error::Lengths(_))));
    assert!(matches!(design.fk([f64::NAN; 6]), Err(Error::Lengths(_))));
    let far = Pose::new([1e200, 0.0, 0.0], home.rotation);
    assert!(matches!(design.ik(&far), Err(Error::Overflow)));
    let general = Design::load("designs/general-6-6.toml").unwrap();
    let octic = general.fk_with([20.0; 6], FkOptions::new().method(Method::Octic));
    assert!(matches!(octic, Err(Error::Fk(_))), "the octic is for octahedral designs");
}

#[test]
fn a_solver_owns_its_design_and_streams_rows_in_order_on_any_threads() {
    let solver = {
        let design = octahedral();
        design.solver(FkOptions::new())
    };
    let row = |k: u32| [18.0 + 0.01 * f64::from(k), 18.5, 18.0, 17.5, 18.0, 17.8];
    let of = |threads| -> Vec<String> {
        let rows = (0..12).map(row).chain([[-1.0; 6]]).chain([row(0)]);
        let found = solver.clone().threads(threads).solve_all(rows);
        found.map(|f| f.map_or_else(|e| e.to_string(), |f| format!("{f:?}"))).collect()
    };
    let alone = of(one());
    assert_eq!(alone.len(), 14);
    assert!(alone[12].contains("cannot be negative"), "a bad row leaves the others alone: {}", alone[12]);
    assert_eq!((&alone[13], &alone), (&alone[0], &of(two())));
    assert_eq!(solver.solve_all(Vec::<LegLengths>::new()).count(), 0);
    let from_a_thread = std::thread::spawn(move || solver.solve(row(0)).unwrap().roots.len());
    assert_eq!(from_a_thread.join().unwrap(), 16);
}

#[test]
fn an_endless_batch_ends_when_it_is_cancelled() {
    for threads in [one(), two()] {
        let cancel = Cancel::new();
        let solver = octahedral().solver(FkOptions::new()).threads(threads).cancel(&cancel);
        let mut seen = 0;
        for found in solver.solve_all(std::iter::repeat([18.0, 18.5, 18.0, 17.5, 18.0, 17.8])) {
            assert_eq!(found.unwrap().roots.len(), 16);
            seen += 1;
            if seen == 5 {
                cancel.cancel();
            }
        }
        assert_eq!(seen, 5);
    }
}

#[test]
fn a_tracker_follows_its_pose_and_stays_where_it_is_lost() {
    let design = octahedral();
    let mut pose = design.home_or_default();
    let mut tracker = design.tracker(pose);
    for _ in 0..10 {
        pose.position.x += 0.05;
        assert!(matches!(tracker.step(design.ik(&pose).unwrap()).unwrap(), NearOutcome::Tracked { .. }));
    }
    assert!((tracker.pose().position - pose.position).norm() < 1e-9);
    let before = tracker.pose();
    assert!(
        !matches!(tracker.step([1e-3; 6]).unwrap(), NearOutcome::Tracked { .. }),
        "no pose has such legs"
    );
    assert_eq!(tracker.pose(), before);
    assert!(tracker.step([f64::INFINITY; 6]).is_err());
}

#[test]
fn verify_shows_its_samples_and_can_be_ended() {
    let (a, b) = (octahedral(), Design::load("designs/rbt-griffis-duffy.toml").unwrap());
    let mut seen = Vec::new();
    let options = VerifyOptions::new().samples(4).seed(3).threads(two()).on_sample(|s| {
        seen.push(s.pose);
        ControlFlow::Continue(())
    });
    let found = verify_with(&a, &b, options).unwrap();
    assert_eq!(found.verdict, Verdict::Equivalent);
    assert_eq!(seen, found.samples.iter().map(|s| s.pose).collect::<Vec<_>>());
    let alone = verify_with(&a, &b, VerifyOptions::new().samples(4).seed(3).threads(one())).unwrap();
    assert_eq!(alone, found, "whatever the threads");

    let mut count = 0;
    let options = VerifyOptions::new().samples(1000).on_sample(|_| {
        count += 1;
        if count == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(verify_with(&a, &b, options), Err(Error::Cancelled)));
    assert_eq!(count, 2);
    let cancel = Cancel::new();
    cancel.cancel();
    assert!(matches!(verify_with(&a, &b, VerifyOptions::new().cancel(&cancel)), Err(Error::Cancelled)));

    let mut inches = b.clone();
    inches.units = "in".into();
    assert!(matches!(verify(&a, &inches), Err(Error::Units(_))));
    assert!(leg_map(&a, &inches).unwrap_err().to_string().contains("has the unit"));
}

#[test]
fn verdicts_say_yes_no_and_not_known() {
    assert_eq!(octahedral().check().unwrap().is_singular(), Some(false));
    let singular = Design::load("designs/rbt-midline.toml").unwrap().check().unwrap();
    assert_eq!(singular.is_singular(), Some(true));
    assert!(singular.to_string().contains("is architecturally singular"), "{singular}");
    let general = Design::load("designs/general-6-6.toml").unwrap();
    assert!(matches!(general.assess(), Err(Error::NothingRequired)));
    let preset = Design::load("designs/presets/bench-l16.toml").unwrap();
    let quick = AssessOptions::new().points(200).searches(1).seed(1);
    let report = preset.assess_with(&quick, 50).unwrap();
    assert!(
        !report.proof.bounds.is_empty() && report.met() != Some(true),
        "{report}: too few cells for a proof"
    );
}

#[test]
fn equivalents_are_those_of_octahedral_designs_and_of_what_is_made_of_them() {
    let class = octahedral().equivalents().unwrap();
    assert_eq!((class.original().name.as_str(), class.family().counts().patterns), ("octahedral 12-6", 728));
    let (free, map) = class.joint_free([0.25; 6]).unwrap();
    assert!(map.determinant().abs() > 0.0);
    assert_eq!(leg_map(&octahedral(), &free).unwrap().relation, Relation::Equivalent);
    assert_eq!(free.equivalents().unwrap().original().manipulator().base_joints().len(), 3, "back again");
    assert!(matches!(class.joint_free([f64::NAN; 6]).map_err(Error::from), Err(Error::Offsets(_))));
    assert!(matches!("V99".parse::<Pattern>().map_err(Error::from), Err(Error::Pattern(_))));
    let general = Design::load("designs/general-6-6.toml").unwrap();
    assert!(matches!(general.equivalents(), Err(Error::NotOctahedral(_))));
}

#[test]
fn an_optimisation_reports_its_progress_and_can_be_ended() {
    let mut design = octahedral();
    design.optimize.min_joint_distance = Some(100.0);
    let none = design.optimize().unwrap();
    assert_eq!((none.status, none.design()), (OptimizeStatus::Infeasible, None));
    let cancel = Cancel::new();
    cancel.cancel();
    let ended = octahedral().optimize_with(OptimizeOptions::new().cancel(&cancel)).unwrap();
    assert_eq!(ended.status.to_string(), "interrupted");
    let mut shown = String::new();
    let options = OptimizeOptions::new().threads(two()).on_progress(|p| {
        shown = p.to_string();
        ControlFlow::Break(())
    });
    octahedral().optimize_with(options).unwrap();
    assert!(shown.starts_with("best "), "{shown}");
    let general = Design::load("designs/general-6-6.toml").unwrap();
    assert!(general.optimize().unwrap_err().to_string().contains("rational family"));
}

#[test]
fn designs_are_exported_by_the_names_of_formats() {
    let design = octahedral();
    for format in ExportFormat::ALL {
        assert_eq!(format.name().to_uppercase().parse::<ExportFormat>(), Ok(format));
    }
    let files = design.export("csv".parse().unwrap()).unwrap();
    assert!(!files.is_empty() && files.iter().all(|f| !f.text.is_empty()));
    assert!(matches!(
        design.export_with(ExportFormat::Stl, &ExportOptions::new().ball(-1.0)),
        Err(Error::Export(_))
    ));
    let mut unknown = design;
    unknown.units = "cubits".into();
    assert!(matches!(unknown.export(ExportFormat::Step), Err(Error::Export(_))));
}

#[test]
fn names_are_read_back_and_slips_are_told_what_there_is() {
    for &method in Method::ALL {
        assert_eq!(method.to_string().parse::<Method>(), Ok(method));
    }
    assert_eq!(" Homotopy ".parse::<Method>(), Ok(Method::Homotopy));
    assert_eq!(["toml", "json"].map(|f| f.parse::<Format>().unwrap()), [Format::Toml, Format::Json]);
    assert_eq!(["base", "platform"].map(|b| b.parse::<Body>().unwrap()), [Body::Base, Body::Platform]);
    let slip = Error::from("octics".parse::<Method>().unwrap_err()).to_string();
    assert!(slip.contains("`octics`") && slip.contains("octic, homotopy"), "{slip}");
    assert!(
        "".parse::<Method>().is_err()
            && "left".parse::<Body>().is_err()
            && "xml".parse::<ExportFormat>().is_err()
    );
}

/// Options, tables and answers with the names of the front page alone: nothing in this file is from `methods`.
#[test]
fn questions_are_asked_and_their_answers_matched_with_names_of_the_front_page() {
    let mut design = Design::load("designs/presets/bench-l16.toml").unwrap();
    let (home, frames) = (design.home_or_default(), design.pose_frames(PoseConvention::default()));

    design.hardware.leg_length = Some(LengthLimits::Range(198.0, 240.0));
    design.safety_margins.kinds.insert(TermKind::LegForce, SafetyMargin::Percent(5.0));
    let found = design.assess_with(&AssessOptions::new().points(20).searches(1), 20).unwrap();
    let verdict = |kind: TermKind| {
        let bound = found.proof.bounds.iter().find(|bound| bound.found.term.kind == kind).unwrap();
        (bound.verdict, kind.quantity(), bound.safety_margin.is_some())
    };
    assert!(matches!(verdict(TermKind::MaxLegLength), (MarginVerdict::Violated, Quantity::Length, false)));
    assert!(matches!(verdict(TermKind::LegForce), (_, Quantity::Force, true)));

    let asked = AtPoseOptions::at(home).wrench([0.0, 0.0, -30.0, 0.0, 0.0, 0.0]).axes(Body::Platform).leg(2);
    let at = design.at_pose(&frames, &asked).unwrap();
    let DrivesAt::Lengths(lengths) = at.drives else { panic!("{:?}", at.drives) };
    assert!((lengths[0] - design.ik(&home).unwrap().get()[0]).abs() < 1e-12);
    let held: f64 = at.held.last().unwrap().efforts.unwrap().iter().sum();
    assert!(at.singular.is_none() && at.stuck.is_some() && held > 30.0, "the legs push: {held}");

    let leg = LegIndex::FIRST;
    let refused = design.locus(&LocusOptions::new(design.ik(&home).unwrap(), leg, [-1.0, 240.0]).steps(2));
    assert!(matches!(refused, Err(NoLocus::Lengths(InvalidLengths::Negative { .. }))), "{refused:?}");
    let beyond = Pose::new([0.0, 0.0, 230.0], home.rotation);
    let nearest = design.nearest_allowed(&beyond, &NearestPoseOptions::default().starts(1)).unwrap();
    assert!(
        nearest
            .binding
            .iter()
            .any(|limit| matches!(limit, Limit::Term(t) if t.kind == TermKind::MaxLegLength))
    );
    let figures = design.figures(&FigureOptions::new(design.characteristic_length()).points(10));
    assert!(figures.assessment.is_some_and(|found| found.met() == Some(false)));

    let octahedral = octahedral();
    let asked = SingularPosesOptions::about(octahedral.home_or_default()).cells(200);
    assert!(octahedral.singular_poses(&asked).is_ok());
    let asked = SelfMotionOptions::new(MotionStart::Pose(octahedral.home_or_default())).sections(0);
    assert_eq!(octahedral.self_motions(&asked).unwrap().moves(), Some(false));
    let slip = octahedral.move_legs(&["1:9:0.2".parse().unwrap()], MoveOptions::default().together(true));
    assert!(matches!(slip, Err(NoMoves::NoSuchFamily { .. })), "{slip:?}");
    assert!(matches!("1:2".parse::<LegMoveRequest>(), Err(InvalidMove::Form(_))));
}
