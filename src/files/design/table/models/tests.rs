use std::fmt::Write as _;

use nalgebra::{Point3, Rotation3, Vector3};

use super::*;
use platform::geom::Pose;

const BASE: [[f64; 3]; 6] = [
    [0.5, -0.1, 0.0],
    [0.5, 0.1, 0.02],
    [-0.2, 0.45, 0.0],
    [-0.3, 0.4, 0.0],
    [-0.3, -0.4, 0.0],
    [-0.2, -0.45, 0.0],
];
const PLATFORM: [[f64; 3]; 6] = [
    [0.2, -0.25, 0.0],
    [0.2, 0.25, 0.0],
    [0.1, 0.3, 0.01],
    [-0.3, 0.05, 0.0],
    [-0.3, -0.05, 0.0],
    [0.1, -0.3, 0.0],
];

/// A home pose rotated about all axes: 10, 20 and 30 degrees, each about the frame rotated by the earlier ones.
fn home() -> Pose {
    let [x, y, z] = [10.0_f64, 20.0, 30.0].map(f64::to_radians);
    let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
    let rotation = about(Vector3::x_axis(), x) * about(Vector3::y_axis(), y) * about(Vector3::z_axis(), z);
    Pose { rotation, position: Vector3::new(0.05, -0.03, 0.6) }
}

fn point(p: [f64; 3]) -> Point3<f64> {
    Point3::from(p)
}

fn text(p: &Vector3<f64>) -> String {
    format!("{} {} {}", p.x, p.y, p.z)
}

/// The two ends of a leg at home.
fn ends(i: usize) -> [Vector3<f64>; 2] {
    [Vector3::from(BASE[i]), home().transform(&point(PLATFORM[i])).coords]
}

fn is_meant(table: &PointTable) {
    for (i, leg) in table.legs.iter().enumerate() {
        assert!((leg.base - point(BASE[i])).norm() < 1e-12, "leg {}: {:?}", i + 1, leg.base);
        assert!((leg.platform - point(PLATFORM[i])).norm() < 1e-12, "leg {}: {:?}", i + 1, leg.platform);
    }
    let at = table.home.unwrap();
    let turned = (at.rotation.matrix() - home().rotation.matrix()).amax();
    assert!((at.position - home().position).norm() < 1e-12 && turned < 1e-12, "{at:?}");
}

fn refusal(model: &str) -> String {
    read(model).unwrap_err()
}

/// The platform floats in the world; cylinders hang on balls of the world and rods slide in them. The order of the legs
/// in the file differs from that of their names.
fn free_platform(joints: impl Fn(usize) -> String) -> String {
    let mut bodies = String::new();
    let mut loops = String::new();
    for i in [3, 0, 5, 1, 2, 4] {
        let [a, b] = ends(i);
        let length = (b - a).norm();
        let _ = write!(
            bodies,
            "<body name='cylinder{i}' pos='{}' zaxis='{}'>{}<geom size='0.1'/><body name='rod{i}' pos='0 0 {}'><joint name='drive_{i}' type='slide' axis='1 0 0'/></body></body>",
            text(&a),
            text(&(2.0 * (b - a))),
            joints(i),
            0.4 * length,
        );
        let _ = write!(loops, "<connect body1='rod{i}' body2='top' anchor='0 0 {}'/>", 0.6 * length);
    }
    format!(
        "<mujoco><worldbody><body name='top' pos='{}' euler='10 20 30'><freejoint/></body>{bodies}</worldbody><equality>{loops}</equality></mujoco>",
        text(&home().position)
    )
}

#[test]
fn a_floating_platform_on_six_connects_is_read_in_degrees_and_in_the_order_of_names() {
    let table = read(&free_platform(|_| "<joint type='ball'/>".into())).unwrap();
    is_meant(&table);
    assert_eq!(table.units.as_deref(), Some("m"));
    let said = table.guesses.join(" ");
    for word in ["qpos0", "drive_0, drive_1", "by the numbers", "`top`", "metres"] {
        assert!(said.contains(word), "{word}: {said}");
    }
}

#[test]
fn hinges_with_a_common_point_are_a_joint_wherever_they_stand_on_their_axes() {
    let universal =
        |_| "<joint axis='1 0 0' pos='0.25 0 0'/><joint axis='0 1 0' pos='0 -0.125 0'/>".to_string();
    is_meant(&read(&free_platform(universal)).unwrap());
    // the rod may rotate in the cylinder
    let turning =
        |_| "<joint axis='1 0 0'/><joint axis='0 1 0'/><joint axis='0 0 1' pos='0 0 0.3'/>".to_string();
    is_meant(&read(&free_platform(turning)).unwrap());
    // the second axis passes the first at a hundredth of a metre
    let offset = |i| {
        let pos = if i == 2 { "0 0 0.01" } else { "0 0 0" };
        format!("<joint axis='1 0 0'/><joint axis='0 1 0' pos='{pos}'/>")
    };
    let said = refusal(&free_platform(offset));
    assert!(said.contains("`drive_2` and the base pass 0.00") && said.contains("from each other"), "{said}");
    // six digits of a file leave micrometres
    let rounded = |_| "<joint axis='1 0 0'/><joint axis='0 1 0' pos='0 0 0.000001'/>".to_string();
    let table = read(&free_platform(rounded)).unwrap();
    assert!(
        table.guesses.iter().any(|g| g.contains("from each other: the nearest point")),
        "{:?}",
        table.guesses
    );
    let parallel = |_| "<joint axis='1 0 0'/><joint axis='1 0 0' pos='0 0.1 0'/>".to_string();
    assert!(refusal(&free_platform(parallel)).contains("are parallel"));
    let said = refusal(&free_platform(|_| "<joint axis='1 0 0'/>".into()));
    assert!(said.contains("one hinge only"), "{said}");
    let said = refusal(&free_platform(|_| String::new()));
    assert!(said.contains("no joint between it and the base"), "{said}");
}

#[test]
fn legs_that_hang_on_the_platform_are_read_with_defaults_frames_and_other_angles() {
    let mut legs = String::new();
    let mut loops = String::new();
    for i in 0..6 {
        let [a, b] = ends(i);
        // in the frame of the platform
        let direction = home().rotation.inverse() * (a - b);
        let _ = write!(
            legs,
            "<frame pos='{}'><body zaxis='{}'><joint class='ball'/><body name='tube' pos='0 0 0.2'><joint name='actuator {}'/><site name='foot{i}' pos='0 0 {}'/></body></body></frame>",
            text(&Vector3::from(PLATFORM[i])),
            text(&direction),
            i + 1,
            direction.norm() - 0.2,
        );
        let _ = write!(loops, "<connect site1='foot{i}' site2='ground{i}'/>");
    }
    let legs = legs.replace(" name='tube'", "");
    let ground = |i: usize| format!("<site name='ground{i}' pos='{}'/>", text(&Vector3::from(BASE[i])));
    let grounds = [0, 1, 2, 3, 4, 5].map(ground).concat();
    // about fixed axes, the last first: the same rotation
    let [x, y, z] = [10.0_f64, 20.0, 30.0].map(f64::to_radians);
    let model = format!(
        "<mujoco><compiler angle='radian' eulerseq='ZYX'/>
         <default><joint type='slide'/><default class='swing'><joint type='hinge'/><default class='ball'><joint type='ball'/></default></default></default>
         <worldbody>{grounds}<frame pos='{}'><frame euler='{z} {y} {x}'><body name='plate'><joint class='swing' type='free'/>{legs}</body></frame></frame></worldbody>
         <equality>{loops}</equality></mujoco>",
        text(&home().position)
    );
    let table = read(&model).unwrap();
    is_meant(&table);
    let moved = model.replacen("<connect site1='foot3'", "<connect active='false' site1='foot3'", 1);
    assert!(refusal(&moved).contains("joins nothing to the base"), "{}", refusal(&moved));
    let shifted = model.replace("<site name='ground4' pos='-0.3", "<site name='ground4' pos='-0.31");
    assert!(refusal(&shifted).contains("`actuator 5` and the base pass"), "{}", refusal(&shifted));
    assert!(refusal(&model.replace("class='ball'/><body", "class='bal'/><body")).contains("class `bal`"));
}

fn tendons() -> String {
    let mut sites = [String::new(), String::new()];
    let mut list = String::new();
    for i in 0..6 {
        for (body, (side, of)) in sites.iter_mut().zip([('a', BASE), ('b', PLATFORM)]) {
            let _ = write!(body, "<site name='{side}{i}' pos='{}'/>", text(&Vector3::from(of[i])));
        }
        let (first, second) = if i % 2 == 0 { ('a', 'b') } else { ('b', 'a') };
        let _ =
            write!(list, "<spatial name='leg'><site site='{first}{i}'/><site site='{second}{i}'/></spatial>");
    }
    let r = home().rotation;
    let axes = [r * Vector3::x() * 3.0, r * Vector3::new(0.5, 2.0, 0.0)].map(|v| text(&v)).join(" ");
    format!(
        "<mujoco><worldbody>{}<body name='moved' pos='{}' xyaxes='{axes}'><freejoint/>{}</body></worldbody><tendon>{list}</tendon></mujoco>",
        sites[0],
        text(&home().position),
        sites[1]
    )
}

#[test]
fn six_tendons_from_site_to_site_are_legs() {
    let table = read(&tendons()).unwrap();
    is_meant(&table);
    assert!(table.guesses.iter().any(|g| g.contains("as they stand in the file")), "{:?}", table.guesses);
    let five = tendons().replacen("<site site='a0'/>", "", 1);
    let said = refusal(&five);
    assert!(said.contains("0 slide joints, 5 such tendons and 1 others"), "{said}");
    assert!(refusal(&tendons().replacen("site='a2'", "site='a9'", 1)).contains("names nothing"));
    assert!(
        refusal(&tendons().replacen("site='a2'", "site='b3'", 1)).contains("does not lead from the base")
    );
}

#[test]
fn all_orientations_turn_as_they_are_defined() {
    let [w, x, y, z] = home().quaternion();
    let scaled = format!("quat='{} {} {} {}'", 2.0 * w, 2.0 * x, 2.0 * y, 2.0 * z);
    let (axis, angle) = home().rotation.axis_angle().unwrap();
    let about = format!("axisangle='{} {}'", text(&axis), angle.to_degrees());
    let model = free_platform(|_| "<joint type='ball'/>".into());
    for orientation in [scaled, about] {
        is_meant(&read(&model.replace("euler='10 20 30'", &orientation)).unwrap());
    }
    assert!(refusal(&model.replace("euler='10 20 30'", "quat='0 0 0 0'")).contains("no direction"));
    assert!(refusal(&model.replace("euler='10 20 30'", "euler='10 20'")).contains("is not 3 numbers"));
    assert!(
        refusal(&model.replace("euler='10 20 30'", "euler='1 2 3' zaxis='0 0 1'")).contains("more than one")
    );
}

#[test]
fn a_weld_makes_two_bodies_one() {
    let model = free_platform(|_| "<joint type='ball'/>".into());
    // the rods are joined to a second body at the place of the platform, with a weld between both
    let r = home().rotation;
    let second = format!(
        "<body name='plate' pos='{}' zaxis='{}'><freejoint/></body></worldbody>",
        text(&home().position),
        text(&(r * Vector3::z()))
    );
    let split = model.replace("body2='top'", "body2='plate'").replace("</worldbody>", &second);
    let welded = split.replace("</equality>", "<weld body1='top' body2='plate'/></equality>");
    is_meant(&read(&welded).unwrap());
    let placed = welded.replace("body2='plate'/></", "body2='plate' relpose='0 0 1 1 0 0 0'/></");
    assert!(refusal(&placed).contains("relpose"));
}

#[test]
fn what_is_no_hexapod_is_told() {
    let model = free_platform(|_| "<joint type='ball'/>".into());
    let five = model.replacen("type='slide'", "type='ball'", 1);
    assert!(refusal(&five).contains("5 slide joints, 0 such tendons"), "{}", refusal(&five));
    assert!(refusal(&model.replace("</worldbody>", "")).contains("the XML is broken"));
    assert!(refusal("<machine name='x'/>").contains("root element `machine`"));
    let parts = model.replace("<equality>", "<include file='x.xml'/><equality>");
    assert!(refusal(&parts).contains("`include` is not read"));
    assert!(
        refusal(&model.replace("<equality>", "<frame><replicate count='3'/></frame><equality>"))
            .contains("`replicate`")
    );
    let deep = format!(
        "<mujoco><worldbody>{}{}</worldbody></mujoco>",
        "<body>".repeat(100_000),
        "</body>".repeat(100_000)
    );
    assert!(refusal(&deep).contains("nested in each other"));
    let classes =
        format!("<mujoco>{}{}</mujoco>", "<default class='a'>".repeat(150), "</default>".repeat(150));
    assert!(refusal(&classes).contains("a second time"));
    // a rod that is joined to the world too
    let twice = model.replace("</equality>", "<connect body1='rod2' anchor='0 0 0'/></equality>");
    assert!(
        refusal(&twice).contains("carries without it") || refusal(&twice).contains("loop"),
        "{}",
        refusal(&twice)
    );
    let cranks = model.replace("type='slide'", "type='hinge'").replace(
        "</mujoco>",
        "<actuator><position joint='drive_0'/><motor joint='drive_1'/></actuator></mujoco>",
    );
    assert!(refusal(&cranks).contains("2 of its hinges are driven"), "{}", refusal(&cranks));
}

/// An element with very many attributes is refused before the costly check; apostrophes in comments are no quotes.
#[test]
fn too_many_attributes_are_refused_with_their_line() {
    let many: String = (0..200_000).fold(String::new(), |mut out, k| {
        let _ = write!(out, " a{k}=\"x\"");
        out
    });
    for before in ["<mujoco>", "<!-- it isn't -->\n<?xml-model it's?>\n<mujoco><![CDATA[it's >]]>"] {
        let said = refusal(&format!("{before}\n<body{many}/></mujoco>"));
        let line = before.matches('\n').count() + 2;
        assert!(said.starts_with(&format!("line {line}: an element has 200000 attributes")), "{said}");
    }
    let few = "<mujoco><!-- it isn't --><body a='>' b=\"it's\"/></mujoco>";
    assert!(!refusal(few).contains("attributes"), "{}", refusal(few));
}

const URDF: &str = include_str!("../../../../../tests/fixtures/models/six.urdf");
const SDF: &str = include_str!("../../../../../tests/fixtures/models/six.sdf");

/// The joints of both files: on circles, at these angles in degrees, the platform 0.4 higher.
fn is_on_circles(table: &PointTable) {
    let at = |radius: f64, degrees: f64| {
        let angle = degrees.to_radians();
        Point3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let base = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0];
    let platform = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0];
    for (i, leg) in table.legs.iter().enumerate() {
        // the files have six decimals
        assert!((leg.base - at(0.3, base[i])).norm() < 1e-6, "leg {}: {:?}", i + 1, leg.base);
        assert!((leg.platform - at(0.18, platform[i])).norm() < 3e-6, "leg {}: {:?}", i + 1, leg.platform);
    }
    let home = table.home.unwrap();
    assert!((home.position - Vector3::new(0.0, 0.0, 0.4)).norm() < 1e-6, "{home:?}");
    assert_eq!(table.units.as_deref(), Some("m"));
}

#[test]
fn an_sdf_model_closes_its_loops_itself() {
    is_on_circles(&read(SDF).unwrap());
}

#[test]
fn legs_of_a_urdf_tree_end_at_one_platform() {
    let table = read(URDF).unwrap();
    is_on_circles(&table);
    let said = table.guesses.join("\n");
    assert!(said.contains("URDF has no closed loops") && said.contains("floating"), "{said}");
}

#[test]
fn models_without_six_legs_or_with_a_doubtful_base_are_refused() {
    for (model, why) in [
        (
            URDF.replace("name=\"slide6\" type=\"prismatic\"", "name=\"slide6\" type=\"fixed\""),
            "5 slide joints",
        ),
        (URDF.replace("type=\"floating\"", "type=\"planar\""), "`planar` are not read"),
        (URDF.replace("type=\"floating\"", "type=\"fixed\""), "nothing follows the slide"),
        (URDF.replace("<child link=\"u2\"/>", "<child link=\"u1\"/>"), "two joints"),
        (
            URDF.replace("<robot name", "<robot xmlns:xacro=\"x\" name")
                .replace("<link name=\"u1\"/>", "<xacro:a/>"),
            "xacro",
        ),
        (SDF.replace("\"base\"", "\"lower\"").replace(">base<", ">lower<"), "name it `base`"),
        (
            SDF.replace("<parent>base</parent><child>cyl3", "<parent>floor</parent><child>cyl3"),
            "names no link",
        ),
        (
            SDF.replace("name=\"slide2\" type=\"prismatic\"", "name=\"slide2\" type=\"screw\""),
            "`screw` are not read",
        ),
        (SDF.replace("<xyz>0 1 0</xyz>", "<xyz>0 0 0</xyz>"), "no direction"),
        (SDF.replace("name=\"rod2\"><pose>", "name=\"rod2\"><pose relative_to=\"rod2\">"), "given by itself"),
    ] {
        let said = refusal(&model);
        assert!(said.contains(why), "{why}: {said}");
    }
}

#[test]
fn poses_of_sdf_are_read_in_the_frames_that_they_name() {
    // link 1 of the legs is placed in the frame of the base, which is turned and moved in the model
    let turned = SDF
        .replace("name=\"base\"><pose>0 0 0 0 0 0", "name=\"base\"><pose degrees=\"true\">1 2 3 10 20 30")
        .replace("name=\"platform\"><pose>", "name=\"platform\"><pose relative_to=\"base\">");
    let mut text = String::new();
    for line in turned.lines() {
        let leg = line.trim_start().starts_with("<link name=\"cyl")
            || line.trim_start().starts_with("<link name=\"rod");
        let line = if leg { line.replace("<pose>", "<pose relative_to=\"base\">") } else { line.into() };
        let _ = writeln!(text, "{line}");
    }
    is_on_circles(&read(&text).unwrap());
}
