//! The graph of topologies in the language of Graphviz.

use std::fmt::Write as _;

use super::family::Family;

impl Family {
    /// Topologies as nodes, and moves that split a joint as edges. The topology that these moves do not reach hangs on
    /// the octahedral one by a dashed edge.
    #[must_use]
    pub fn to_dot(&self) -> String {
        let mut out = String::from(
            "digraph octahedral_class {\n  rankdir=TB;\n  node [shape=box, fontname=\"sans-serif\"];\n",
        );
        for (k, t) in self.topologies().iter().enumerate() {
            let _ = writeln!(
                out,
                "  t{k} [label=\"{} base + {} platform joints\\n{} shared\\n{}\"];",
                t.topology.base_joints(),
                t.topology.platform_joints(),
                t.topology.shared_joints(),
                t.example
            );
        }
        let levels = (6..=12).map(|joints| {
            let same = self.topologies().iter().enumerate();
            let same =
                same.filter(|(_, t)| t.topology.base_joints() + t.topology.platform_joints() == joints);
            same.map(|(k, _)| format!("t{k}")).collect::<Vec<_>>().join("; ")
        });
        for level in levels {
            let _ = writeln!(out, "  {{ rank=same; {level} }}");
        }
        for (k, t) in self.topologies().iter().enumerate() {
            for next in &t.next {
                let _ = writeln!(out, "  t{k} -> t{next};");
            }
            if !t.sequential {
                let _ = writeln!(out, "  t0 -> t{k} [style=dashed, label=\"all six at once\"];");
            }
        }
        out.push_str("}\n");
        out
    }
}
