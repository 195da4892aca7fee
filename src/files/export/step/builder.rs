//! Entities of an exchange file (ISO 10303-21), numbered in order of creation.

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use crate::export::text::{one_line, step_real};

/// The number of an entity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Id(usize);

impl std::fmt::Display for Id {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// The data section under construction; lengths are in millimetres.
#[derive(Debug, Default)]
pub(super) struct Builder {
    out: String,
    count: usize,
}

/// References separated by commas, in parentheses.
pub(super) fn list(ids: &[Id]) -> String {
    let ids: Vec<String> = ids.iter().map(Id::to_string).collect();
    format!("({})", ids.join(","))
}

/// A string: apostrophes and backslashes are doubled; characters outside ASCII are written as UTF-16 in hexadecimal.
pub(super) fn string(text: &str) -> String {
    let mut out = String::from("'");
    for c in one_line(text).chars() {
        match c {
            '\'' => out.push_str("''"),
            '\\' => out.push_str("\\\\"),
            c if c.is_ascii() => out.push(c),
            c => {
                let mut units = [0; 2];
                out.push_str("\\X2\\");
                for unit in c.encode_utf16(&mut units) {
                    let _ = write!(out, "{unit:04X}");
                }
                out.push_str("\\X0\\");
            }
        }
    }
    out.push('\'');
    out
}

impl Builder {
    pub(super) fn add(&mut self, entity: &str) -> Id {
        self.count += 1;
        let _ = writeln!(self.out, "#{}={entity};", self.count);
        Id(self.count)
    }

    pub(super) fn finish(self) -> String {
        self.out
    }

    pub(super) fn point(&mut self, p: &Point3<f64>) -> Id {
        let [x, y, z] = [p.x, p.y, p.z].map(step_real);
        self.add(&format!("CARTESIAN_POINT('',({x},{y},{z}))"))
    }

    fn direction(&mut self, d: &Vector3<f64>) -> Id {
        let [x, y, z] = [d.x, d.y, d.z].map(step_real);
        self.add(&format!("DIRECTION('',({x},{y},{z}))"))
    }

    /// A frame by its origin, third and first axis.
    pub(super) fn frame(&mut self, origin: &Point3<f64>, z: &Vector3<f64>, x: &Vector3<f64>) -> Id {
        let (o, z, x) = (self.point(origin), self.direction(z), self.direction(x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',{o},{z},{x})"))
    }

    pub(super) fn vertex(&mut self, p: &Point3<f64>) -> Id {
        let p = self.point(p);
        self.add(&format!("VERTEX_POINT('',{p})"))
    }

    /// The straight edge between two vertices at these points.
    pub(super) fn straight(&mut self, ends: (Id, Id), from: &Point3<f64>, to: &Point3<f64>) -> Id {
        let (p, d) = (self.point(from), self.direction(&(to - from).normalize()));
        let vector = self.add(&format!("VECTOR('',{d},1.0)"));
        let line = self.add(&format!("LINE('',{p},{vector})"));
        self.add(&format!("EDGE_CURVE('',{},{},{line},.T.)", ends.0, ends.1))
    }

    /// The edge on a circle about the direction of z, counter-clockwise; a full circle if both ends are equal.
    pub(super) fn round(&mut self, ends: (Id, Id), centre: &Point3<f64>, radius: f64) -> Id {
        let frame = self.frame(centre, &Vector3::z(), &Vector3::x());
        let circle = self.add(&format!("CIRCLE('',{frame},{})", step_real(radius)));
        self.add(&format!("EDGE_CURVE('',{},{},{circle},.T.)", ends.0, ends.1))
    }

    /// A closed loop of edges, each forwards or backwards.
    pub(super) fn edge_loop(&mut self, edges: &[(Id, bool)]) -> Id {
        let oriented: Vec<Id> = edges
            .iter()
            .map(|(edge, forwards)| {
                let sense = if *forwards { "T" } else { "F" };
                self.add(&format!("ORIENTED_EDGE('',*,*,{edge},.{sense}.)"))
            })
            .collect();
        self.add(&format!("EDGE_LOOP('',{})", list(&oriented)))
    }

    /// A face: outer loop, holes, surface; `along` if its outward normal is that of the surface.
    pub(super) fn face(&mut self, outer: Id, holes: &[Id], surface: Id, along: bool) -> Id {
        let mut bounds = vec![self.add(&format!("FACE_OUTER_BOUND('',{outer},.T.)"))];
        bounds.extend(holes.iter().map(|h| self.add(&format!("FACE_BOUND('',{h},.T.)"))));
        let sense = if along { "T" } else { "F" };
        self.add(&format!("ADVANCED_FACE('',{},{surface},.{sense}.)", list(&bounds)))
    }

    pub(super) fn plane(&mut self, p: &Point3<f64>, normal: &Vector3<f64>, x: &Vector3<f64>) -> Id {
        let frame = self.frame(p, normal, x);
        self.add(&format!("PLANE('',{frame})"))
    }

    /// The cylinder of this radius about the direction of z.
    pub(super) fn cylinder(&mut self, centre: &Point3<f64>, radius: f64) -> Id {
        let frame = self.frame(centre, &Vector3::z(), &Vector3::x());
        self.add(&format!("CYLINDRICAL_SURFACE('',{frame},{})", step_real(radius)))
    }

    pub(super) fn solid(&mut self, name: &str, faces: &[Id]) -> Id {
        let shell = self.add(&format!("CLOSED_SHELL('',{})", list(faces)));
        self.add(&format!("MANIFOLD_SOLID_BREP({},{shell})", string(name)))
    }
}
