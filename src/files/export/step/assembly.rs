//! Products, their shapes, and their places in the assembly.

use nalgebra::{Point3, Vector3};

use super::builder::{Builder, Id, list, string};
use crate::export::Export;
use crate::export::text::reals;
use platform::geom::Pose;

/// A part: product definition, shape representation, and the frame it is given in.
#[derive(Debug, Clone, Copy)]
pub(super) struct StepPart {
    definition: Id,
    shape: Id,
    frame: Id,
}

/// An occurrence: the placed frame, the part, the name.
#[derive(Debug)]
struct Occurrence {
    part: StepPart,
    frame: Id,
    name: String,
}

/// Parts that are placed together.
#[derive(Debug, Default)]
pub(super) struct Group(Vec<Occurrence>);

/// An assembly under construction.
#[derive(Debug)]
pub(super) struct StepAssembly {
    b: Builder,
    header: String,
    name: String,
    mm: f64,
    context: Id,
    geometry: Id,
}

const HEADER_END: &str = "FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }'));\nENDSEC;\nDATA;\n";

impl StepAssembly {
    pub(super) fn new(export: &Export, legs: Vec<String>) -> Self {
        let mut lines = export.heading("mm");
        lines.push("Assembly frame: the base frame; the platform is at home".to_string());
        // the shape of the assembly does not give the home position, so the text does
        let place = export.home.position.iter().map(|x| x * export.unit.millimetres);
        lines.push(format!(
            "Platform frame at home: {} {}",
            reals(place, " "),
            reals(export.home.quaternion(), " ")
        ));
        lines.extend(legs);
        let description: Vec<String> = lines.iter().map(|l| string(l)).collect();
        // a time of day would make two runs differ
        let header = format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(({}),'2;1');\nFILE_NAME('platform.step','1970-01-01T00:00:00',(''),(''),{},{},'');\n{HEADER_END}",
            description.join(","),
            string(&export.program),
            string(&export.program)
        );
        let mut b = Builder::default();
        let context = b.add("APPLICATION_CONTEXT('managed model based 3d engineering')");
        b.add(&format!(
            "APPLICATION_PROTOCOL_DEFINITION('international standard','ap242_managed_model_based_3d_engineering',2014,{context})"
        ));
        let length = b.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
        let angle = b.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
        let solid_angle = b.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
        let accuracy = b.add(&format!(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.0E-7),{length},'distance_accuracy_value','confusion accuracy')"
        ));
        let geometry = b.add(&format!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({accuracy}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))REPRESENTATION_CONTEXT('','3D'))"
        ));
        let (name, mm) = (export.name.clone(), export.unit.millimetres);
        Self { b, header, name, mm, context, geometry }
    }

    /// A product with an empty place for its shape: its definition.
    fn product(&mut self, name: &str, description: &str) -> Id {
        let (b, context) = (&mut self.b, self.context);
        let (name, description) = (string(name), string(description));
        let kind = b.add(&format!("PRODUCT_CONTEXT('',{context},'mechanical')"));
        let product = b.add(&format!("PRODUCT({name},{name},{description},({kind}))"));
        b.add(&format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"));
        let formation = b.add(&format!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
        let kind = b.add(&format!("PRODUCT_DEFINITION_CONTEXT('part definition',{context},'design')"));
        b.add(&format!("PRODUCT_DEFINITION('design','',{formation},{kind})"))
    }

    fn has_shape(&mut self, definition: Id, shape: Id) {
        let property = self.b.add(&format!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
        self.b.add(&format!("SHAPE_DEFINITION_REPRESENTATION({property},{shape})"));
    }

    fn own_frame(&mut self) -> Id {
        self.b.frame(&Point3::origin(), &Vector3::z(), &Vector3::x())
    }

    /// A part with one solid, and its description.
    pub(super) fn part(
        &mut self,
        (name, description): (&str, &str),
        solid: impl FnOnce(&mut Builder) -> Id,
    ) -> StepPart {
        let definition = self.product(name, description);
        let (frame, solid) = (self.own_frame(), solid(&mut self.b));
        let shape = self.b.add(&format!(
            "ADVANCED_BREP_SHAPE_REPRESENTATION({},{},{})",
            string(name),
            list(&[frame, solid]),
            self.geometry
        ));
        self.has_shape(definition, shape);
        StepPart { definition, shape, frame }
    }

    /// Puts a part into a group at a frame in design units.
    pub(super) fn place(&mut self, group: &mut Group, part: StepPart, name: &str, at: &Pose) {
        let axes = at.rotation.matrix();
        let frame = self.b.frame(
            &Point3::from(at.position * self.mm),
            &axes.column(2).into(),
            &axes.column(0).into(),
        );
        group.0.push(Occurrence { part, frame, name: name.to_string() });
    }

    /// A part made of the parts of a group.
    pub(super) fn assembled(&mut self, name: &str, description: &str, group: &Group) -> StepPart {
        let definition = self.product(name, description);
        let own = self.own_frame();
        let mut frames = vec![own];
        frames.extend(group.0.iter().map(|o| o.frame));
        let shape = self.b.add(&format!(
            "SHAPE_REPRESENTATION({},{},{})",
            string(name),
            list(&frames),
            self.geometry
        ));
        self.has_shape(definition, shape);
        let b = &mut self.b;
        for (k, Occurrence { part, frame, name }) in group.0.iter().enumerate() {
            let name = string(name);
            let used = b.add(&format!(
                "NEXT_ASSEMBLY_USAGE_OCCURRENCE('{}',{name},'',{definition},{},$)",
                k + 1,
                part.definition
            ));
            let property = b.add(&format!("PRODUCT_DEFINITION_SHAPE('Placement','',{used})"));
            let moved = b.add(&format!("ITEM_DEFINED_TRANSFORMATION('','',{},{frame})", part.frame));
            let related = b.add(&format!(
                "(REPRESENTATION_RELATIONSHIP('','',{},{shape})\
                 REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION({moved})SHAPE_REPRESENTATION_RELATIONSHIP())",
                part.shape
            ));
            b.add(&format!("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION({related},{property})"));
        }
        StepPart { definition, shape, frame: own }
    }

    /// The file, with a top-level part made of the parts of a group.
    pub(super) fn finish(mut self, group: &Group) -> String {
        let name = self.name.clone();
        self.assembled(&name, "", group);
        format!("{}{}ENDSEC;\nEND-ISO-10303-21;\n", self.header, self.b.finish())
    }
}
