//! SDF, the format of Gazebo, whose joints may close loops.

use std::fmt::Write as _;

use super::{Robot, RobotLink, Shape, ShapeKind, angles, moments};
use crate::export::text::{one_line, real, reals};
use crate::export::{Export, ExportedFile, Unsupported, Writer};
use crate::plot::escape;
use platform::geom::Pose;

/// Text about this kind of model for the comment in the file.
const ABOUT: &str = "The joints ball2 to ball6 close the loops: Gazebo Classic simulates them; Gazebo with DART loads a tree and leaves them out.";

/// The format `sdf`.
pub(in crate::export) static WRITER: Writer = Writer {
    leaves_out: "contacts, friction, controllers of the drives, limits of speeds and joint angles",
    ..Writer::new("Gazebo model in metres and kilograms, its loops closed by ball joints", |export| {
        Ok(vec![ExportedFile::new("platform.sdf", model(export)?)])
    })
};

fn pose(pose: &Pose) -> String {
    format!("{} {}", reals(pose.position.iter().copied(), " "), reals(angles(pose), " "))
}

fn shape(out: &mut String, number: usize, shape: &Shape) {
    let geometry = match shape.kind {
        ShapeKind::Sphere { radius } => format!("<sphere><radius>{}</radius></sphere>", real(radius)),
        ShapeKind::Cylinder { radius, length } => {
            format!("<cylinder><radius>{}</radius><length>{}</length></cylinder>", real(radius), real(length))
        }
    };
    let (at, colour) = (pose(&shape.at), shape.colour);
    let _ = writeln!(
        out,
        "      <visual name=\"shape{number}\"><pose>{at}</pose><geometry>{geometry}</geometry>\
         <material><ambient>{colour}</ambient><diffuse>{colour}</diffuse></material></visual>"
    );
}

fn link(out: &mut String, robot: &Robot, link: &RobotLink) {
    let RobotLink { name, at, mass, shapes } = link;
    let gravity = if robot.weighs { "" } else { "<gravity>false</gravity>" };
    let inertia: String =
        moments(mass).map(|(tag, value)| format!("<{tag}>{}</{tag}>", real(value))).concat();
    let _ = writeln!(
        out,
        "    <link name=\"{name}\">\n      <pose>{}</pose>{gravity}\n      \
         <inertial><pose>{} 0 0 0</pose><mass>{}</mass><inertia>{inertia}</inertia></inertial>",
        pose(at),
        reals(mass.center.iter().copied(), " "),
        real(mass.mass)
    );
    for (i, one) in shapes.iter().enumerate() {
        shape(out, i + 1, one);
    }
    out.push_str("    </link>\n");
}

fn model(export: &Export) -> Result<String, Unsupported> {
    let robot = Robot::of(export, ABOUT)?;
    let mut out = robot.heading.clone();
    let _ = writeln!(
        out,
        "<sdf version=\"1.7\">\n  <model name=\"{}\">\n    \
         <joint name=\"ground\" type=\"fixed\"><parent>world</parent><child>base</child></joint>",
        escape(&one_line(&export.name))
    );
    link(&mut out, &robot, &robot.base);
    link(&mut out, &robot, &robot.platform);
    let effort = robot.effort.map_or_else(String::new, |f| format!("<effort>{}</effort>", real(f)));
    for leg in &robot.legs {
        let i = leg.number;
        link(&mut out, &robot, &leg.cylinder);
        link(&mut out, &robot, &leg.rod);
        let [from, to] = leg.range.map(real);
        let _ = writeln!(
            out,
            "    <joint name=\"universal{i}\" type=\"universal\"><parent>base</parent><child>cylinder{i}</child>\
             <axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>\n    \
             <joint name=\"leg{i}\" type=\"prismatic\"><parent>cylinder{i}</parent><child>rod{i}</child>\
             <axis><xyz>0 0 1</xyz><limit><lower>{from}</lower><upper>{to}</upper>{effort}</limit></axis></joint>"
        );
    }
    // the tree first, then the joints that close loops
    let _ = writeln!(
        out,
        "    <joint name=\"ball1\" type=\"ball\"><pose relative_to=\"rod1\">0 0 0 0 0 0</pose>\
         <parent>rod1</parent><child>platform</child></joint>"
    );
    for leg in robot.legs.iter().skip(1) {
        let i = leg.number;
        let _ = writeln!(
            out,
            "    <joint name=\"ball{i}\" type=\"ball\"><parent>platform</parent><child>rod{i}</child></joint>"
        );
    }
    out.push_str("  </model>\n</sdf>\n");
    Ok(out)
}
