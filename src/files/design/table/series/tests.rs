use super::*;
use platform::geom::{AngleUnit, ListedFrom, RotationOrder};

fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let fields: Vec<&str> = text.split(',').collect();
    if !(6..=7).contains(&fields.len()) {
        return Err(format!("{} values", fields.len()));
    }
    fields.into_iter().map(|f| f.parse().map_err(|_| format!("`{f}` is not a number"))).collect()
}

fn read(kind: SeriesKind, text: &str) -> TimeSeries<Vec<f64>> {
    kind.read(text.as_bytes(), "mm", numbers).unwrap_or_else(|why| panic!("{why}\n{text}"))
}

#[test]
fn times_and_names_are_recognised_in_any_order() {
    let meant = vec![1.5, 2.0, 3.0, 4.0, 5.0, 6.0];
    for (text, time) in [
        ("1.5,2,3,4,5,6\n", None),
        ("l1,l2,l3,l4,l5,l6\n1.5,2,3,4,5,6\n", None),
        ("t;a;b;c;d;e;f\n0,25;1,5;2;3;4;5;6\n", Some(0.25)),
        ("leg_6_mm,leg_5_mm,leg_4_mm,leg_3_mm,leg_2_mm,leg_1_mm,time_s\n6,5,4,3,2,1.5,0.25\n", Some(0.25)),
        (
            "Time [s]\tv1\tv2\tv3\tv4\tv5\tv6\tL1\tL2\tL3\tL4\tL5\tL6\n0.25\t9\t9\t9\t9\t9\t9\t1.5\t2\t3\t4\t5\t6\n",
            Some(0.25),
        ),
        ("# t l1 l2 l3 l4 l5 l6\n0.25 1.5 2 3 4 5 6\n", Some(0.25)),
        ("Log of May\n1.5 2 3 4 5 6", None),
    ] {
        let found = read(SeriesKind::Lengths, text);
        assert_eq!((&found.rows[0].value, found.rows[0].time), (&meant, time), "{text}");
    }
}

fn home() -> Pose {
    Pose::new([1.0, 2.0, 300.0], platform::geom::Angles::from_degrees([0.0, 0.0, 30.0]))
}

fn poses(text: &str, stated: &PoseConvention) -> TimeSeries<Pose> {
    read_poses(text.as_bytes(), stated, &home(), "mm").unwrap_or_else(|why| panic!("{why}\n{text}"))
}

fn usual(text: &str) -> TimeSeries<Pose> {
    poses(text, &PoseConvention::default())
}

#[test]
fn conventions_of_makers_are_taken_by_their_names_or_refused() {
    let found = usual("X,Y,Z,U,V,W\n0,0,650,5,3,10\n");
    assert!(found.guesses.iter().any(|g| g.contains("Rx(U) Ry(V) Rz(W)")));
    assert_eq!(found.frames.order(), RotationOrder::MOVING_XYZ);
    // the rotation about the platform's own z comes first, that about x last: the column of Rx(U) Ry(V) is its z
    // axis
    let (u, v) = (5.0_f64.to_radians(), 3.0_f64.to_radians());
    let meant = [v.sin(), -u.sin() * v.cos(), u.cos() * v.cos()];
    let pose = found.rows[0].value;
    assert!((0..3).all(|k| (pose.rotation.matrix()[(k, 2)] - meant[k]).abs() < 1e-15));
    assert_eq!(pose.position.z.to_bits(), 650.0_f64.to_bits());
    let moved = usual("surge,sway,heave,roll,pitch,yaw\n0,0,0,0,0,0\n");
    assert!(moved.guesses.iter().any(|g| g.contains("count from home")));
    assert_eq!((moved.rows[0].value, moved.frames.measured_from()), (home(), ListedFrom::Home));
    // A is a turn about z for some makers and about x for others
    for names in ["rx, ry, rz", "A, B, C", "alpha, beta, gamma"] {
        let text = format!("x, y, z, {names}\n1,2,3,4,5,6\n");
        let unclear = read_poses(text.as_bytes(), &PoseConvention::default(), &home(), "mm");
        assert!(matches!(&unclear, Err(InvalidSeries::Order(shown)) if shown == names), "{unclear:?}");
    }
}

#[test]
fn an_order_that_is_stated_holds_for_columns_of_every_name() {
    let stated = |order: &str| PoseConvention { rotation_order: order.parse().ok(), ..Default::default() };
    let table = |names: &str| format!("x,y,z,{names}\n1,2,3,4,5,6\n");
    // named columns are turns about x, y and z, whatever comes first; those without names stand in the order
    for (order, plain) in [("moving-zyx", "6,5,4"), ("fixed-yzx", "5,6,4"), ("vector", "4,5,6")] {
        let convention = stated(order);
        let meant = convention.read_text(&format!("1,2,3,{plain}"), &home()).unwrap();
        for names in ["roll,pitch,yaw", "u,v,w", "rx_deg,ry_deg,rz_deg"] {
            let found = poses(&table(names), &convention);
            assert_eq!(found.rows[0].value, meant, "{order} {names}");
            assert!(!found.guesses.iter().any(|g| g.contains("Rx(U)")));
        }
        assert_eq!(poses(&format!("1,2,3,{plain}\n"), &convention).rows[0].value, meant);
    }
    let twice = read_poses(table("rx,ry,rz").as_bytes(), &stated("moving-zxz"), &home(), "mm");
    assert!(matches!(twice, Err(InvalidSeries::Twice(..))), "{twice:?}");
    let unnamed = poses(&table("alpha,beta,gamma"), &stated("moving-zxz"));
    assert!(
        unnamed.guesses.iter().any(|g| g.contains("taken in the order x,y,z,three angles")),
        "{:?}",
        unnamed.guesses
    );
}

#[test]
fn angles_of_cranks_are_read_by_their_names() {
    let meant = [1.5, 2.0, 3.0, 4.0, 5.0, 6.0];
    for text in [
        "1.5,2,3,4,5,6\n",
        // the output of `ik` for a design with cranks
        "crank_1_deg,crank_2_deg,crank_3_deg,crank_4_deg,crank_5_deg,crank_6_deg,other_1_deg,other_2_deg,other_3_deg,other_4_deg,other_5_deg,other_6_deg\n1.5,2,3,4,5,6,9,9,9,9,9,9\n",
        "other1,other2,other3,other4,other5,other6,servo1,servo2,servo3,servo4,servo5,servo6\n9,9,9,9,9,9,1.5,2,3,4,5,6\n",
    ] {
        assert_eq!(read(SeriesKind::Angles, text).rows[0].value, meant, "{text}");
    }
    let found = read(SeriesKind::Angles, "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n1,0,0,0,0,0\n");
    assert_eq!(found.rows[0].value, [1f64.to_degrees(), 0.0, 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn poses_are_read_by_their_names() {
    let found = usual("time,yaw_rad,pitch_rad,roll_rad,x_mm,y_mm,z_mm\n1,0,0,1,10,20,30\n");
    let meant = Pose::new([10.0, 20.0, 30.0], platform::geom::Angles::from_radians([1.0, 0.0, 0.0]));
    assert_eq!((found.rows[0].value, found.frames.angles), (meant, Some(AngleUnit::Radians)));
    assert!(found.guesses.iter().any(|g| g.contains("radians")), "{:?}", found.guesses);
    assert_eq!(usual("x,y,z,roll [rad],pitch [rad],yaw [rad]\n10,20,30,1,0,0\n").rows[0].value, meant);
    let mixed = usual("x,y,z,roll_rad,pitch_deg,yaw\n10,20,30,1,0,0\n");
    assert_eq!(mixed.rows[0].value, meant);
    let radians = PoseConvention { angles: Some(AngleUnit::Radians), ..PoseConvention::default() };
    assert_eq!(poses("x,y,z,roll,pitch,yaw\n10,20,30,1,0,0\n", &radians).rows[0].value, meant);
    let degrees = poses("x,y,z,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,0,90\n", &radians).rows[0].value;
    assert!((degrees.angles().degrees()[2] - 90.0).abs() < 1e-12, "the header says the unit");
    for order in platform::geom::QuaternionOrder::ALL {
        let convention = PoseConvention { quaternion: Some(order), ..PoseConvention::default() };
        let found = poses("qw,qx,qy,qz,x,y,z,note\n0,1,0,0,10,20,30,\"a, b\"\n", &convention);
        let bits = found.rows[0].value.quaternion().map(f64::to_bits);
        assert_eq!(bits, [0.0_f64, 1.0, 0.0, 0.0].map(f64::to_bits));
        assert!(found.guesses.iter().any(|g| g.contains("`note`")), "{:?}", found.guesses);
    }
}

#[test]
fn words_of_other_languages_and_greek_letters_name_angles() {
    let meant = usual("10,20,30,1,2,3\n").rows[0].value;
    for names in [
        "gui\u{f1}ada;cabeceo;alabeo",
        "imbardata;beccheggio;rollio",
        "lacet;tangage;roulis",
        "psi;theta;phi",
    ] {
        let found = usual(&format!("tiempo;x;y;z;{names}\n0,5;10;20;30;3;2;1\n"));
        assert_eq!((found.rows[0].value, found.rows[0].time), (meant, Some(0.5)), "{names}");
    }
    let zxz = PoseConvention { rotation_order: "moving-zxz".parse().ok(), ..Default::default() };
    let stated = poses("x,y,z,phi,theta,psi\n10,20,30,1,2,3\n", &zxz).rows[0].value;
    assert_eq!(stated, zxz.read(&[10.0, 20.0, 30.0, 1.0, 2.0, 3.0], &home()).unwrap());
}

#[test]
fn poses_with_lengths_are_read_by_names_and_by_places() {
    let read = |text: &str| {
        let stated = PoseConvention::default();
        let table = read_poses_with_lengths(text.as_bytes(), &stated, &home(), "mm");
        table.unwrap_or_else(|why| panic!("{why}")).rows.remove(0).value
    };
    let pose = Pose::new([10.0, 20.0, 30.0], platform::geom::Angles::from_radians([1.0, 0.0, 0.0]));
    let named =
        "l6,l5,l4,l3,l2,l1,time,yaw_rad,pitch_rad,roll_rad,x_mm,y_mm,z_mm\n6,5,4,3,2,1,9,0,0,1,10,20,30\n";
    assert_eq!(read(named), (pose, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    let bits = read("1,2,3,4,5,6,7,8,9,10,11,12\n").1.map(f64::to_bits);
    assert_eq!(bits, [7.0_f64, 8.0, 9.0, 10.0, 11.0, 12.0].map(f64::to_bits));
    let quaternion = "x,y,z,qw,qx,qy,qz,leg_1,leg_2,leg_3,leg_4,leg_5,leg_6\n1,2,3,1,0,0,0,4,5,6,7,8,9\n";
    assert_eq!(read(quaternion).1.map(f64::to_bits), [4.0_f64, 5.0, 6.0, 7.0, 8.0, 9.0].map(f64::to_bits));
}

#[test]
fn lengths_of_other_units_are_converted_and_said() {
    let meant = usual("x,y,z,roll,pitch,yaw\n250,20,400.5,1,2,3\n").rows[0].value;
    for text in [
        "t,x [m],y [m],z [m],roll,pitch,yaw\n0,0.25,0.02,0.4005,1,2,3\n",
        "t,x_cm,y_mm,z_m,roll,pitch,yaw\n0,25,20,0.4005,1,2,3\n",
        "t,x,y,z,roll,pitch,yaw\ns,m,m,m,deg,deg,deg\n0,0.25,0.02,0.4005,1,2,3\n",
        "Log, positions in m\nx,y,z,roll,pitch,yaw\n0.25,0.02,0.4005,1,2,3\n",
        "a [m],b [m],c [m],d,e,f\n0.25,0.02,0.4005,1,2,3\n",
    ] {
        let found = usual(text);
        assert_eq!(found.rows[0].value, meant, "{text}");
        assert!(found.guesses.iter().any(|g| g.contains("converted to mm")), "{:?}", found.guesses);
    }
    let lengths = read(SeriesKind::Lengths, "l0_m,l1_m,l2_m,l3_m,l4_m,l5_m\n0.25,1,2,3,4,5\n");
    assert_eq!(lengths.rows[0].value, [250.0, 1000.0, 2000.0, 3000.0, 4000.0, 5000.0]);
    let unknown = SeriesKind::Lengths.read(b"l1_m,l2_m,l3_m,l4_m,l5_m,l6_m\n1,2,3,4,5,6\n", "1", numbers);
    assert!(matches!(unknown, Err(InvalidSeries::Unit(name, "m", _)) if name == "l1_m"));
    let both = "x [m],y [m],z [m],roll,pitch,yaw,l1,l2,l3,l4,l5,l6\n0.25,0.02,0.4005,1,2,3,1,2,3,4,5,6\n";
    let both = read_poses_with_lengths(both.as_bytes(), &PoseConvention::default(), &home(), "mm").unwrap();
    assert_eq!(both.rows[0].value, (meant, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
}

#[test]
fn units_of_angles_hold_wherever_they_are_written() {
    let meant = usual("x,y,z,roll_rad,pitch_rad,yaw_rad\n10,20,30,0.1,0.2,0.3\n").rows[0].value;
    for text in [
        "t,x,y,z,roll,pitch,yaw\ns,mm,mm,mm,rad,rad,rad\n0,10,20,30,0.1,0.2,0.3\n",
        "angles in rad\nx,y,z,roll,pitch,yaw\n10,20,30,0.1,0.2,0.3\n",
        "a,b,c,d [rad],e [rad],f [rad]\n10,20,30,0.1,0.2,0.3\n",
        "x,y,z,gier [rad],nick [rad],roll [rad]\n10,20,30,0.3,0.2,0.1\n",
    ] {
        let (found, meant) = (usual(text).rows[0].value, meant);
        let apart = (found.rotation.matrix() - meant.rotation.matrix()).amax();
        assert!(apart < 1e-15, "{text} {apart}");
    }
    let degrees = usual("x,y,z,roll [\u{b0}],pitch [\u{b0}],yaw [\u{b0}]\n0,0,0,0,0,90\n").rows[0].value;
    assert!((degrees.angles().degrees()[2] - 90.0).abs() < 1e-12);
}

#[test]
fn quaternions_are_read_by_their_letters_in_any_order() {
    let meant = usual("x,y,z,qw,qx,qy,qz\n1,2,3,0.5,0.1,-0.7,0.5\n").rows[0].value;
    for names in [
        "pose.position.x,pose.position.y,pose.position.z,pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w",
        "x,y,z,qi,qj,qk,qr",
        "tx,ty,tz,quat_x,quat_y,quat_z,quat_w",
    ] {
        let text = format!("{names}\n1,2,3,0.1,-0.7,0.5,0.5\n");
        assert_eq!(usual(&text).rows[0].value, meant, "{names}");
    }
    assert_eq!(usual("x,y,z,q0,q1,q2,q3\n1,2,3,0.5,0.1,-0.7,0.5\n").rows[0].value, meant);
    let unnamed = usual("1,2,3,0.5,0.1,-0.7,0.5\n");
    assert!(unnamed.guesses.iter().any(|g| g.contains("x,y,z,qw,qx,qy,qz")), "{:?}", unnamed.guesses);
    let angles = "x,y,z,theta_x,theta_y,theta_z\n1,2,3,4,5,6\n";
    let unclear = read_poses(angles.as_bytes(), &PoseConvention::default(), &home(), "mm");
    assert!(matches!(unclear, Err(InvalidSeries::Order(_))), "{unclear:?}");
}

#[test]
fn legs_may_count_from_0_and_travels_are_refused() {
    let reversed = "l5,l4,l3,l2,l1,l0\n6,5,4,3,2,1\n";
    let meant = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    assert_eq!(read(SeriesKind::Lengths, reversed).rows[0].value, meant);
    let states =
        "name,position[1],position[0],position[2],position[3],position[4],position[5]\nlegs,2,1,3,4,5,6\n";
    assert_eq!(read(SeriesKind::Lengths, states).rows[0].value, meant);
    let travel = SeriesKind::Lengths.read(b"ext1,ext2,ext3,ext4,ext5,ext6\n1,2,3,4,5,6\n", "mm", numbers);
    assert!(matches!(travel, Err(InvalidSeries::Travel(name)) if name == "ext1"));
}

#[test]
fn rows_may_be_legs() {
    let rows =
        "leg_2;2;20;200\nleg_1;1;10;100\nleg_3;3;30;300\nleg_4;4;40;400\nleg_5;5;50;500\nleg_6;6;60;600\n";
    let found = read(SeriesKind::Lengths, rows);
    let values: Vec<Vec<f64>> = found.rows.into_iter().map(|row| row.value).collect();
    let meant = [1.0, 10.0, 100.0].map(|x| [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|leg| leg * x).to_vec());
    assert_eq!(values, meant);
    let timed = read(SeriesKind::Lengths, &format!("time;0,5;1,5;2,5\n{rows}"));
    assert_eq!((timed.rows[2].time, timed.rows[2].value[1]), (Some(2.5), 200.0));
}

#[test]
fn brackets_without_end_are_refused_at_once() {
    let began = std::time::Instant::now();
    for open in ["[", "{", "(", "{\"a\": {", "- [", "[[1], ", "'\\", "1x"] {
        let text = open.repeat(60_000);
        assert!(read_poses(text.as_bytes(), &PoseConvention::default(), &home(), "mm").is_err());
        assert!(SeriesKind::Lengths.read(text.as_bytes(), "mm", numbers).is_err());
    }
    // each took minutes where every bracket was tried by itself
    assert!(began.elapsed().as_secs() < 60, "{:?}", began.elapsed());
}

#[test]
fn every_bad_row_is_named() {
    let text = "t,1,2,3,4,5,6\n0,1,2,3,4,5,6\n1,2,3\n?,1,2,3,4,5,6\n3,1,2,x,4,5,6\n";
    let Err(why) =
        SeriesKind::Lengths.read(text.replace("1,2,3,4,5,6\n0", "a,b,c,d,e,f\n0").as_bytes(), "mm", numbers)
    else {
        panic!()
    };
    let sentences = why.sentences();
    assert_eq!(sentences, ["line 3: 2 values", "line 4: `?` is not a time", "line 5: `x` is not a number"]);
    let named = "l1,l2,l3,l4,l5,l6\n1,2,3,4,5\n1,2,3,4,5,6,7\n";
    let why = SeriesKind::Lengths.read(named.as_bytes(), "mm", numbers).unwrap_err();
    assert_eq!(why.to_string(), "line 2: 5 values; line 3: 7 cells below 6 names of columns");
    assert_eq!(SeriesKind::Lengths.read(b"a,b\n", "mm", numbers), Err(InvalidSeries::Empty));
}

/// A pose with its matrix in decimals of this count, row by row.
fn matrix(digits: usize) -> (Pose, Vec<String>) {
    let pose = Pose::new([5.0, -7.0, 405.5], platform::geom::Angles::from_degrees([3.0, -4.0, 12.0]));
    let numbers = pose.matrix().transpose();
    (pose, numbers.iter().map(|x| format!("{x:.digits$}")).collect())
}

fn apart(found: &Pose, meant: &Pose) -> f64 {
    (found.matrix() - meant.matrix()).amax()
}

#[test]
fn matrices_are_poses_on_one_line_or_several() {
    let (meant, m) = matrix(15);
    let line = |list: &[String], separator: &str| list.join(separator);
    let by_columns: Vec<String> = (0..16).map(|k| m[k % 4 * 4 + k / 4].clone()).collect();
    let lines = |list: &[String], separator: &str| {
        list.chunks(4).map(|row| row.join(separator)).collect::<Vec<_>>().join("\n")
    };
    let origin = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
    let comma = |list: &[String]| list.iter().map(|x| x.replace('.', ",")).collect::<Vec<_>>();
    let rotation = |i: usize| [4 * i, 4 * i + 1, 4 * i + 2].map(|k| m[k].as_str()).join(",");
    let position = [&m[3], &m[7], &m[11]].map(String::as_str).join(",");
    for text in [
        line(&m[..12], " "),
        line(&m, ","),
        line(&by_columns, ",") + "\n" + &origin.replace(' ', ","),
        lines(&m[..12], "\t"),
        lines(&m, " ") + "\n\n" + &lines(&m, " "),
        lines(&comma(&m), ";"),
        lines(&by_columns, ", "),
        format!("T(:,:,1) =\n\n{}\n\nT(:,:,2) =\n\n{}\n", lines(&m, "   "), lines(&m, "   ")),
        format!("T(:,:,1) = [{}];\nT(:,:,2) = [{0}];\n", lines(&m, " ").replace('\n', "; ")),
        format!("[[[{}]]]", lines(&m, ", ").replace('\n', "], [")),
        format!("array([[{}]])\n", lines(&m, ", ").replace('\n', "],\n       [")),
        format!("[[{}]\n [{}]]", line(&m, " "), line(&m[..8], " ") + "\n  " + &line(&m[8..], " ")),
        format!(
            "t,r11,r12,r13,r21,r22,r23,r31,r32,r33,x,y,z\n0,{},{},{},{position}\n",
            rotation(0),
            rotation(1),
            rotation(2)
        ),
        format!(
            "x,y,z,R00,R01,R02,R10,R11,R12,R20,R21,R22\n{position},{},{},{}\n",
            rotation(0),
            rotation(1),
            rotation(2)
        ),
        format!("T11,T12,T13,T14,T21,T22,T23,T24,T31,T32,T33,T34\n{}\n", line(&m[..12], ",")),
    ] {
        let found = usual(&text);
        assert!(apart(&found.rows[0].value, &meant) < 1e-12, "{text}\n{:?}", found.guesses);
        assert!(
            found.guesses.iter().any(|g| g.contains("matri") || g.contains("Each pose"))
                || text.contains('[')
        );
    }
    // four decimals are a rotation to four decimals
    let (_, rounded) = matrix(4);
    assert!(apart(&usual(&lines(&rounded, " ")).rows[0].value, &meant) < 2e-4);
    let scaled = "   1.0e+03 *\n\n 0.001 0 0 0.005\n 0 0.001 0 -0.007\n 0 0 0.001 0.4055\n 0 0 0 0.001\n";
    let level = usual(scaled).rows[0].value;
    assert_eq!(level.position.as_slice(), [5.0, -7.0, 405.5]);
    let metres = format!(
        "positions in m\n{}\n",
        line(
            &[&m[..3], &["0.005".into()], &m[4..7], &["-0.007".into()], &m[8..11], &["0.4055".into()]]
                .concat(),
            " "
        )
    );
    assert!(apart(&usual(&metres).rows[0].value, &meant) < 1e-12);
    let with_lengths = format!("{},1,2,3,4,5,6\n", line(&m[..12], ","));
    let table = read_poses_with_lengths(with_lengths.as_bytes(), &PoseConvention::default(), &home(), "mm");
    let (pose, lengths) = table.unwrap().rows[0].value;
    assert!(apart(&pose, &meant) < 1e-12);
    assert_eq!(lengths.map(f64::to_bits), [1.0_f64, 2.0, 3.0, 4.0, 5.0, 6.0].map(f64::to_bits));
}

#[test]
fn matrices_that_are_unclear_are_refused_with_what_was_found() {
    let refusal = |text: &str| {
        let read = read_poses(text.as_bytes(), &PoseConvention::default(), &home(), "mm");
        read.map(|table| table.rows[0].value).expect_err(text).to_string()
    };
    let (_, m) = matrix(15);
    let entry = |k: usize| m[k / 3 * 4 + k % 3].clone();
    let nine: Vec<String> = (0..9).map(entry).collect();
    let mirrored: Vec<String> = m[..12]
        .iter()
        .enumerate()
        .map(|(k, x)| if k % 4 == 2 { format!("{}", -x.parse::<f64>().unwrap()) } else { x.clone() })
        .collect();
    for (text, part) in [
        (nine.join(","), "without a position"),
        (nine.chunks(3).map(|row| row.join(" ")).collect::<Vec<_>>().join("\n"), "without positions"),
        (format!("{},1,2,3", nine.join(",")), "do not tell rows from columns"),
        (format!("1,2,3,{}", nine.join(",")), "do not tell rows from columns"),
        (mirrored.join(","), "no rotation"),
        ("0.9,0.1,0,1,-0.1,0.9,0,2,0,0,1,3".into(), "no rotation"),
        ("0 1 0 0\n-1 0 0 0\n0 0 1 5\n0 0 0 2\n0 0 0 1\n".into(), "neither 4 x 4"),
        ("0,1,0,0,-1,0,0,0,0,0,1,0,0,0,0,1".into(), "rows and columns cannot be told apart"),
        ("poses = 0.001 * [[1, 2, 3, 4, 5, 6]]".into(), "programs are not run"),
        ("poses = np.deg2rad([[1, 2, 3, 4, 5, 6]])".into(), "programs are not run"),
        ("[[5. -7. 405. 3. -4. 12.]\n ...\n [0. 3. 410. 1. 5. 7.]]".into(), "abbreviated"),
    ] {
        assert!(refusal(&text).contains(part), "{text}: {}", refusal(&text));
    }
}

#[test]
fn poses_in_lists_and_objects_of_programs_are_read() {
    let meant = usual("10,20,30,1,2,3\n").rows[0].value;
    let q = meant.quaternion();
    let xyzw = format!("[{}, {}, {}, {}]", q[1], q[2], q[3], q[0]);
    let r = meant.rotation.matrix();
    let row = |i: usize| format!("[{}, {}, {}]", r[(i, 0)], r[(i, 1)], r[(i, 2)]);
    let rows = format!("[{}, {}, {}]", row(0), row(1), row(2));
    for text in [
        "[[10, 20, 30, 1, 2, 3],\n [0, 0, 30, 0, 0, 0]]",
        "poses = np.array([[10, 20, 30, 1, 2, 3],\n  [0, 0, 30, 0, 0, 0]])  # from the planner",
        "P = [10 20 30 1 2 3;\n     0 0 30 0 0 0];",
        "[[10. 20. 30. 1.\n   2. 3.]\n [ 0.  0. 30.  0.\n   0.  0.]]",
        "t = [0, 1]\nposes = [(10, 20, 30, 1, 2, 3), (0, 0, 30, 0, 0, 0)]",
        "[([10, 20, 30], [1, 2, 3]), ([0, 0, 30], [0, 0, 0])]",
        "[{\"x\": 10, \"y\": 20, \"z\": 30, \"roll\": 1, \"pitch\": 2, \"yaw\": 3, \"note\": \"a\"}]",
        "{\"x\": 10, \"y\": 20, \"z\": 30, \"roll\": 1, \"pitch\": 2, \"yaw\": 3}\n{\"x\": 0, \"y\": 0, \"z\": 30, \"roll\": 0, \"pitch\": 0, \"yaw\": 0}\n",
        "{\"x\": [10, 0], \"y\": [20, 0], \"z\": [30, 30], \"roll\": [1, 0], \"pitch\": [2, 0], \"yaw\": [3, 0]}",
        "{\"poses\": [{\"t\": 0.1, \"position\": [10, 20, 30], \"rpy_deg\": [1, 2, 3]}]}",
        "{\"units\": \"m\", \"poses\": [{\"position\": [0.01, 0.02, 0.03], \"rpy_deg\": [1, 2, 3]}]}",
        "poses:\n  - x: 10\n    y: 20\n    z: 30\n    roll: 1\n    pitch: 2\n    yaw: 3\n",
        "- [10, 20, 30, 1, 2, 3]\n- [0, 0, 30, 0, 0, 0]\n",
        &format!("[{{\"position\": [10, 20, 30], \"quat_xyzw\": {xyzw}}}]"),
        &format!(
            "{{\"poses\": [{{\"position\": {{\"x\": 10, \"y\": 20, \"z\": 30}}, \"orientation\": {{\"x\": {}, \"y\": {}, \"z\": {}, \"w\": {}}}}}]}}",
            q[1], q[2], q[3], q[0]
        ),
        &format!("[{{\"R\": {rows}, \"p\": [10, 20, 30]}}]"),
        &format!("R = {rows};\np = [10; 20; 30];\n"),
    ] {
        let found = usual(text);
        assert!(apart(&found.rows[0].value, &meant) < 1e-12, "{text}\n{:?}", found.guesses);
    }
    let object = "{\"x\": 10, \"y\": 20, \"z\": 30, \"roll\": 1, \"pitch\": 2, \"yaw\": 3}";
    for text in [
        format!("[{object}, {object}, {object}]"),
        format!("{object}\n{object}\n{object}\n"),
        format!("{{\"poses\": [{object}, {object}, {object}]}}"),
        "[[10, 20, 30, 1, 2, 3], [10, 20, 30, 1, 2, 3], [10, 20, 30, 1, 2, 3]]".into(),
        "{\"x\": [10, 10, 10], \"y\": [20, 20, 20], \"z\": [30, 30, 30], \"roll\": [1, 1, 1], \"pitch\": [2, 2, 2], \"yaw\": [3, 3, 3]}".into(),
    ] {
        let all: Vec<Pose> = usual(&text).rows.into_iter().map(|row| row.value).collect();
        assert_eq!(all, [meant; 3], "{text}");
    }
    let timed = usual("{\"poses\": [{\"t\": 0.5, \"pose\": [10, 20, 30, 1, 2, 3]}]}");
    assert_eq!((timed.rows[0].time, timed.rows[0].value), (Some(0.5), meant));
    let text = "{\"poses\": [\n {\"x\": 10, \"y\": 20, \"z\": 30, \"rx\": 1, \"ry\": 2, \"rz\": 3}]}";
    let unclear = read_poses(text.as_bytes(), &PoseConvention::default(), &home(), "mm");
    assert!(matches!(unclear, Err(InvalidSeries::Order(_))), "{unclear:?}");
    let text = "[[10, 20, 30, 1, 2, 3],\n [1, 2, 3, 4, 5]]";
    let line = read_poses(text.as_bytes(), &PoseConvention::default(), &home(), "mm").unwrap_err();
    assert!(line.to_string().contains("line 2: 5 values"), "{line}");
    for text in [
        "[{\"l1\": 1, \"l2\": 2, \"l3\": 3, \"l4\": 4, \"l5\": 5, \"l6\": 6}]",
        "{\"rows\": [{\"t\": 0, \"lengths\": [1, 2, 3, 4, 5, 6]}]}",
        "L = [1 2 3 4 5 6];",
    ] {
        assert_eq!(read(SeriesKind::Lengths, text).rows[0].value, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "{text}");
    }
}
