//! URDF, the format of ROS: a tree of links; another program must close the loops.

use std::fmt::Write as _;

use super::{Robot, RobotLink, Shape, ShapeKind, angles, moments, seen_from};
use crate::export::masses::Solid;
use crate::export::text::{one_line, real, reals};
use crate::export::{Export, ExportedFile, Unsupported, Writer};
use crate::plot::escape;
use platform::geom::Pose;

/// Text about this kind of model for the comment in the file.
const ABOUT: &str = "URDF has trees only: the platform hangs on leg 1, and each other leg ends in a link closure2 to closure6.\n  The loops are closed when these links coincide with the platform, as they do at home; weld them if the simulator can.\n  A ball joint is three hinges about axes through its centre.";

/// Value for efforts and speeds that the design does not limit, since URDF requires a number.
const UNLIMITED: f64 = 1e9;

/// The format `urdf`.
pub(in crate::export) static WRITER: Writer = Writer {
    leaves_out: "closed loops, contacts, friction, limits of speeds and joint angles",
    ..Writer::new(
        "ROS model in metres and kilograms: a tree, with links that say where its loops close",
        |export| Ok(vec![ExportedFile::new("platform.urdf", model(export)?)]),
    )
};

fn origin(pose: &Pose) -> String {
    format!(
        "<origin xyz=\"{}\" rpy=\"{}\"/>",
        reals(pose.position.iter().copied(), " "),
        reals(angles(pose), " ")
    )
}

fn shape(out: &mut String, shape: &Shape) {
    let geometry = match shape.kind {
        ShapeKind::Sphere { radius } => format!("<sphere radius=\"{}\"/>", real(radius)),
        ShapeKind::Cylinder { radius, length } => {
            format!("<cylinder radius=\"{}\" length=\"{}\"/>", real(radius), real(length))
        }
    };
    // a colour has one name in the whole file
    let (at, rgba) = (origin(&shape.at), shape.colour);
    let name = rgba.replace([' ', '.'], "_");
    let _ = writeln!(
        out,
        "    <visual>{at}<geometry>{geometry}</geometry><material name=\"colour_{name}\"><color rgba=\"{rgba}\"/></material></visual>"
    );
}

fn link(out: &mut String, name: &str, mass: Option<&Solid>, shapes: &[Shape]) {
    let _ = writeln!(out, "  <link name=\"{name}\">");
    if let Some(solid) = mass {
        let inertia = moments(solid).map(|(tag, value)| format!("{tag}=\"{}\"", real(value))).join(" ");
        let _ = writeln!(
            out,
            "    <inertial><origin xyz=\"{}\" rpy=\"0 0 0\"/><mass value=\"{}\"/><inertia {inertia}/></inertial>",
            reals(solid.center.iter().copied(), " "),
            real(solid.mass)
        );
    }
    for one in shapes {
        shape(out, one);
    }
    out.push_str("  </link>\n");
}

/// A joint: its kind, its name, parent and child, the frame of the child in the frame of the parent, and its further
/// elements.
fn joint(out: &mut String, (kind, name): (&str, &str), [parent, child]: [&str; 2], at: &Pose, rest: &str) {
    let _ = writeln!(
        out,
        "  <joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{child}\"/>{}{rest}</joint>",
        origin(at)
    );
}

fn model(export: &Export) -> Result<String, Unsupported> {
    let robot = Robot::of(export, ABOUT)?;
    let here = &robot.base.at;
    let hinge = |axis: &str| format!("<axis xyz=\"{axis}\"/>");
    let mut out = robot.heading.clone();
    let _ = writeln!(out, "<robot name=\"{}\">", escape(&one_line(&export.name)));
    // dynamics libraries refuse a root with mass
    link(&mut out, &robot.base.name, None, &robot.base.shapes);
    for leg in &robot.legs {
        let (i, RobotLink { at: foot, .. }) = (leg.number, &leg.cylinder);
        let named = |part: &str| format!("{part}{i}");
        let (yoke, cylinder, rod) = (named("yoke"), &leg.cylinder.name, &leg.rod.name);
        link(&mut out, &yoke, Some(&robot.nothing), &[]);
        joint(&mut out, ("continuous", &named("universal_x")), ["base", &yoke], foot, &hinge("1 0 0"));
        link(&mut out, cylinder, Some(&leg.cylinder.mass), &leg.cylinder.shapes);
        joint(&mut out, ("continuous", &named("universal_y")), [&yoke, cylinder], here, &hinge("0 1 0"));
        link(&mut out, rod, Some(&leg.rod.mass), &leg.rod.shapes);
        let [from, to] = leg.range.map(real);
        let slide = format!(
            "<axis xyz=\"0 0 1\"/><limit lower=\"{from}\" upper=\"{to}\" effort=\"{}\" velocity=\"{}\"/>",
            real(robot.effort.unwrap_or(UNLIMITED)),
            real(UNLIMITED)
        );
        joint(&mut out, ("prismatic", &named("leg")), [cylinder, rod], &seen_from(foot, &leg.rod.at), &slide);
        let (first, second) = (named("ball_x_link"), named("ball_y_link"));
        link(&mut out, &first, Some(&robot.nothing), &[]);
        joint(&mut out, ("continuous", &named("ball_x")), [rod, &first], here, &hinge("1 0 0"));
        link(&mut out, &second, Some(&robot.nothing), &[]);
        joint(&mut out, ("continuous", &named("ball_y")), [&first, &second], here, &hinge("0 1 0"));
        let (tip, end) = (named("tip"), if i == 1 { robot.platform.name.clone() } else { named("closure") });
        link(&mut out, &tip, Some(&robot.nothing), &[]);
        joint(&mut out, ("continuous", &named("ball_z")), [&second, &tip], here, &hinge("0 0 1"));
        match i {
            1 => link(&mut out, &end, Some(&robot.platform.mass), &robot.platform.shapes),
            _ => link(&mut out, &end, None, &[]),
        }
        let at = seen_from(&leg.rod.at, &robot.platform.at);
        joint(&mut out, ("fixed", &named("end")), [&tip, &end], &at, "");
    }
    out.push_str("</robot>\n");
    Ok(out)
}
