use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use super::*;

const BASE: [[f64; 3]; 6] = [
    [500.0, -100.0, 0.0],
    [500.0, 100.0, 0.0],
    [-200.0, 450.0, 0.0],
    [-300.0, 400.0, 0.0],
    [-300.0, -400.0, 0.0],
    [-200.0, -450.0, 0.0],
];
const PLATFORM: [[f64; 3]; 6] = [
    [200.0, -250.0, 600.0],
    [200.0, 250.0, 600.0],
    [100.0, 300.0, 600.0],
    [-300.0, 50.0, 600.0],
    [-300.0, -50.0, 600.0],
    [100.0, -300.0, 600.0],
];

/// Entities as they come.
#[derive(Default)]
struct Entities {
    out: String,
    count: usize,
}

impl Entities {
    fn add(&mut self, entity: &str) -> usize {
        self.count += 1;
        let _ = writeln!(self.out, "#{} = {entity};", self.count);
        self.count
    }

    fn placement(&mut self, p: Vector3<f64>, z: Vector3<f64>, x: Option<Vector3<f64>>) -> usize {
        let mut triple =
            |kind: &str, v: Vector3<f64>| self.add(&format!("{kind}('',({:?},{:?},{:?}))", v.x, v.y, v.z));
        let (at, z) = (triple("CARTESIAN_POINT", p), triple("DIRECTION", z));
        let x = x.map_or("$".into(), |x| format!("#{}", triple("DIRECTION", x)));
        self.add(&format!("AXIS2_PLACEMENT_3D('',#{at},#{z},{x})"))
    }

    fn sphere(&mut self, p: Vector3<f64>) -> usize {
        let at = self.placement(p, Vector3::z(), None);
        self.add(&format!("SPHERICAL_SURFACE('',#{at},10.)"))
    }

    fn cylinder(&mut self, p: Vector3<f64>, d: Vector3<f64>) -> usize {
        let at = self.placement(p, d, None);
        self.add(&format!("CYLINDRICAL_SURFACE('',#{at},5.)"))
    }

    fn units(&mut self, unit: &str) -> usize {
        let length = self.add(unit);
        self.add(&format!("( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length})) REPRESENTATION_CONTEXT('','') )"))
    }

    fn representation(&mut self, items: &[usize], context: usize) -> usize {
        let items: Vec<String> = items.iter().map(|i| format!("#{i}")).collect();
        self.add(&format!("SHAPE_REPRESENTATION('',({}),#{context})", items.join(",")))
    }

    /// A product with a shape: its definition.
    fn product(&mut self, name: &str, shape: usize) -> usize {
        let product = self.add(&format!("PRODUCT('{name}','{name}','',())"));
        let formation = self.add(&format!("PRODUCT_DEFINITION_FORMATION('','',#{product})"));
        let definition = self.add(&format!("PRODUCT_DEFINITION('','',#{formation},$)"));
        let property = self.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{definition})"));
        self.add(&format!("SHAPE_DEFINITION_REPRESENTATION(#{property},#{shape})"));
        definition
    }

    /// `child` in `parent` (definition, shape, placement of each).
    fn occurrence(&mut self, name: &str, child: [usize; 3], parent: [usize; 3]) {
        let used = self.add(&format!(
            "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{name}','{name}','',#{},#{},$)",
            parent[0], child[0]
        ));
        let property = self.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{used})"));
        let moved = self.add(&format!("ITEM_DEFINED_TRANSFORMATION('','',#{},#{})", child[2], parent[2]));
        let related = self.add(&format!("( REPRESENTATION_RELATIONSHIP('','',#{},#{}) REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{moved}) SHAPE_REPRESENTATION_RELATIONSHIP() )", child[1], parent[1]));
        self.add(&format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{related},#{property})"));
    }

    fn file(&self) -> String {
        format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
            self.out
        )
    }
}

const MILLIMETRE: &str = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )";
const METRE: &str = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )";

fn ends(i: usize) -> [Vector3<f64>; 2] {
    [Vector3::from(BASE[i]), Vector3::from(PLATFORM[i])]
}

/// Everything in one part: bare surfaces.
fn one_part(legs: &[usize], turn: impl Fn(Vector3<f64>) -> Vector3<f64>, unit: &str) -> String {
    let mut e = Entities::default();
    let context = e.units(unit);
    let mut items = Vec::new();
    for i in legs {
        let [a, b] = ends(*i).map(&turn);
        items.push(e.cylinder(a + 0.3 * (b - a), 2.0 * (a - b)));
        items.push(e.sphere(b));
        items.push(e.sphere(a));
        items.push(e.sphere(a + Vector3::repeat(1e-9)));
    }
    e.representation(&items, context);
    e.file()
}

const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];

fn refusal(text: &str) -> String {
    read(text).unwrap_err()
}

fn is_meant(table: &PointTable, scale: f64) {
    let height = table.home.unwrap().position;
    assert!((height - Vector3::new(0.0, 0.0, 600.0 * scale)).norm() < 1e-9 * scale, "{height:?}");
    for (i, leg) in table.legs.iter().enumerate() {
        let [a, b] = ends(i).map(|v| Point3::from(v * scale));
        assert!((leg.base - a).norm() < 1e-9 * scale, "leg {}: {:?}", i + 1, leg.base);
        assert!((leg.platform - (b - height)).norm() < 1e-9 * scale, "leg {}: {:?}", i + 1, leg.platform);
    }
}

#[test]
fn bare_surfaces_in_one_part_are_legs_in_the_unit_of_the_file() {
    let table = read(&one_part(&ALL, |v| v, MILLIMETRE)).unwrap();
    is_meant(&table, 1.0);
    assert_eq!(table.units.as_deref(), Some("mm"));
    let table = read(&one_part(&ALL, |v| v, METRE)).unwrap();
    is_meant(&table, 1.0);
    assert_eq!(table.units.as_deref(), Some("m"));
    let inch = "( CONVERSION_BASED_UNIT('INCH',#9001) LENGTH_UNIT() NAMED_UNIT(#9002) )";
    let measure = format!(
        "DATA;\n#9001 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#9003);\n#9003 = {MILLIMETRE};\n"
    );
    let table = read(&one_part(&ALL, |v| v, inch).replace("DATA;\n", &measure)).unwrap();
    is_meant(&table, 1.0);
    assert_eq!(table.units.as_deref(), Some("in"));
    // a platform along y, as some programs draw
    let table = read(&one_part(&ALL, |v| Vector3::new(v.x, v.z, -v.y), MILLIMETRE)).unwrap();
    assert!((table.home.unwrap().position - Vector3::new(0.0, 600.0, 0.0)).norm() < 1e-9);
    assert!(table.guesses.iter().any(|g| g.contains("above along y")), "{:?}", table.guesses);
}

/// Balls and rods as parts with frames of their own, in metres where the assembly is in millimetres; `variant` counts ways to write the same.
fn assembly(variant: usize, names: [&str; 2]) -> String {
    let mut e = Entities::default();
    let (mm, m) = (e.units(MILLIMETRE), e.units(METRE));
    let origin = e.placement(Vector3::zeros(), Vector3::z(), Some(Vector3::x()));
    let moved = e.placement(Vector3::new(0.001, 0.002, 0.003), Vector3::x(), Some(Vector3::y()));
    let balls: Vec<[usize; 3]> = names
        .iter()
        .map(|name| {
            // the ball is at the moved placement of its part
            let ball = e.sphere(Vector3::new(0.001, 0.002, 0.003));
            let mut shape = e.representation(&[moved, ball], m);
            if variant == 1 {
                // the product has a representation of its own in the same frame
                let product = e.representation(&[moved], m);
                e.add(&format!("SHAPE_REPRESENTATION_RELATIONSHIP('','',#{product},#{shape})"));
                shape = product;
            }
            [e.product(name, shape), shape, moved]
        })
        .collect();
    let rod = e.cylinder(Vector3::zeros(), Vector3::z());
    let shape = e.representation(&[origin, rod], mm);
    let rod = [e.product("rod", shape), shape, origin];
    let mut items = vec![origin];
    let mut places = Vec::new();
    for i in [5, 4, 3, 2, 1, 0] {
        let [a, b] = ends(i);
        let along = e.placement(a + 0.1 * (b - a), b - a, None);
        for (part, at, name) in [
            (balls[0], e.placement(a, Vector3::z(), None), format!("ball-{i}")),
            (balls[1], e.placement(b, Vector3::y(), None), format!("ball-{i}")),
            (rod, along, format!("rod-{i}")),
        ] {
            items.push(at);
            places.push((part, at, name));
        }
    }
    if variant == 2 {
        for (part, at, name) in places {
            let map = e.add(&format!("REPRESENTATION_MAP(#{},#{})", part[2], part[1]));
            items.push(e.add(&format!("MAPPED_ITEM('{name}',#{map},#{at})")));
        }
        e.representation(&items, mm);
        return e.file();
    }
    let whole = e.representation(&items, mm);
    let definition = e.product("platform machine", whole);
    for (part, at, name) in places {
        match variant {
            // relationship and items the other way round
            3 => {
                let used = e.add(&format!(
                    "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{name}','','',#{definition},#{},$)",
                    part[0]
                ));
                let property = e.add(&format!("PRODUCT_DEFINITION_SHAPE('','',#{used})"));
                let by = e.add(&format!("ITEM_DEFINED_TRANSFORMATION('','',#{at},#{})", part[2]));
                let related = e.add(&format!("( REPRESENTATION_RELATIONSHIP('','',#{whole},#{}) REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{by}) SHAPE_REPRESENTATION_RELATIONSHIP() )", part[1]));
                e.add(&format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{related},#{property})"));
            }
            _ => e.occurrence(&name, part, [definition, whole, at]),
        }
    }
    e.file()
}

#[test]
fn parts_are_where_the_assembly_has_them_however_it_says_so() {
    for variant in 0..4 {
        let table =
            read(&assembly(variant, ["ball", "ball"])).unwrap_or_else(|why| panic!("{variant}: {why}"));
        is_meant(&table, 1.0);
        assert!(table.guesses.iter().any(|g| g.contains("order of the numbers")), "{:?}", table.guesses);
        assert!(table.guesses.iter().any(|g| g.contains("above along z")), "{:?}", table.guesses);
    }
}

#[test]
fn names_of_parts_tell_the_bodies_of_a_machine_that_hangs() {
    let table = read(&assembly(0, ["platform ball", "base ball"])).unwrap();
    assert!((table.legs[0].base - Point3::from(ends(0)[1])).norm() < 1e-9, "{:?}", table.legs[0]);
    assert!(table.home.unwrap().position.norm() < 1e-9);
    assert!(table.guesses.iter().any(|g| g.contains("names of the parts say")), "{:?}", table.guesses);
}

#[test]
fn what_is_no_hexapod_is_told() {
    let said = refusal(&one_part(&ALL[1..], |v| v, MILLIMETRE));
    assert!(
        said.contains("5 cylinders lead") && said.contains("10 centres of spheres and 5 cylinders"),
        "{said}"
    );
    // a rod that passes its balls at a distance
    let rod = ends(2)[0] + 0.3 * (ends(2)[1] - ends(2)[0]);
    let [x, beside] =
        [rod.x, rod.x + 0.1].map(|x| format!("CARTESIAN_POINT('',({x:?},{:?},{:?}))", rod.y, rod.z));
    let straight = one_part(&ALL, |v| v, MILLIMETRE);
    let crooked = straight.replace(&x, &beside);
    assert!(crooked != straight && refusal(&crooked).contains("5 cylinders lead"), "{}", refusal(&crooked));
    // two ends on the axis of another leg
    let flat = |v: Vector3<f64>| Vector3::new(v.x, v.y, 0.0);
    let said = refusal(&one_part(&ALL, flat, MILLIMETRE));
    assert!(said.contains("0 cylinders lead"), "{said}");
    let flat = |v: Vector3<f64>| Vector3::new(v.x + 0.02 * v.z, v.y + 0.05 * v.z, 0.0);
    let said = refusal(&one_part(&ALL, flat, MILLIMETRE));
    assert!(said.contains("which ends are of the base"), "{said}");
    assert!(refusal("ISO-10303-21;\nDATA;\n#1=A(;").starts_with("line 3:"));
    let empty = "ISO-10303-21;\nDATA;\nENDSEC;\nEND-ISO-10303-21;";
    assert!(refusal(empty).contains("0 centres of spheres"));
    let text = assembly(0, ["ball", "ball"]);
    let lost = text.replacen("AXIS2_PLACEMENT_3D", "AXIS3", 1);
    assert!(refusal(&lost).contains("is no placement"), "{}", refusal(&lost));
    let other =
        text.replacen("ITEM_DEFINED_TRANSFORMATION('','',", "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',", 1);
    assert!(refusal(&other).contains("no other is read"), "{}", refusal(&other));
}

#[test]
fn an_assembly_that_contains_itself_ends() {
    let mut e = Entities::default();
    let context = e.units(MILLIMETRE);
    let origin = e.placement(Vector3::zeros(), Vector3::z(), None);
    let ball = e.sphere(Vector3::zeros());
    let shapes: Vec<usize> = (0..3).map(|_| e.representation(&[origin, ball], context)).collect();
    let definitions: Vec<usize> = shapes.iter().map(|s| e.product("x", *s)).collect();
    for (child, parent) in [(1, 0), (1, 0), (1, 0), (2, 1), (2, 1), (1, 2), (1, 2)] {
        let of = |k: usize| [definitions[k], shapes[k], origin];
        e.occurrence("o", of(child), of(parent));
    }
    assert!(refusal(&e.file()).contains("contains itself"));
}
