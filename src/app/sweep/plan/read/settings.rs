//! Settings of a plan: poses, effort, accuracy.

use super::{PlanReader, pose_of};
use crate::plan::{AssessEffort, PoseChoice};
use files::design::Code;
use files::design::spanned::{Entry, Node, Value, check_keys, find, number, shown, table};
use machine::manufacture::ErrorBound;
use platform::geom::Pose;
impl PlanReader<'_, '_> {
    pub(super) fn poses(&mut self, entry: Option<&Entry>) -> Option<PoseChoice> {
        const FORM: &str = "write \"workspace\", \"home\", { region = N } or a list of poses [x, y, z, roll_deg, pitch_deg, yaw_deg]";
        let Some(entry) = entry else { return Some(PoseChoice::Workspace) };
        match &entry.node.value {
            Value::Text(word) => match word.as_str() {
                "workspace" => Some(PoseChoice::Workspace),
                "home" => Some(PoseChoice::Home),
                other => {
                    let message = format!("`{}` is not a set of poses", shown(other));
                    self.report.refused(Code::UnknownName, &entry.node.span, message, FORM)
                }
            },
            Value::Table(inner) => {
                check_keys(self.report, inner, &["region"], "`poses`");
                let Some(region) = find(inner, "region") else {
                    return self.report.refused(
                        Code::MissingKey,
                        &entry.node.span,
                        "`poses` says nothing",
                        FORM,
                    );
                };
                self.whole(region, 1_000_000).map(|n| PoseChoice::Region(n as usize))
            }
            _ => {
                let list = self.list(&entry.node, "`poses`", FORM)?;
                list.iter()
                    .map(|node| self.pose(node))
                    .collect::<Vec<_>>()
                    .into_iter()
                    .collect::<Option<_>>()
                    .map(PoseChoice::Listed)
            }
        }
    }

    fn pose(&mut self, node: &Node) -> Option<Pose> {
        const FORM: &str = "give six numbers x, y, z, roll_deg, pitch_deg, yaw_deg";
        let list = self.list(node, "a pose", FORM)?;
        let values: Vec<Option<f64>> =
            list.iter().map(|n| number(self.report, n, "a coordinate of a pose")).collect();
        let values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
        let Ok(six) = <[f64; 6]>::try_from(values) else {
            return self.report.refused(
                Code::CoordinateCount,
                &node.span,
                format!("a pose has {} numbers", list.len()),
                FORM,
            );
        };
        Some(pose_of(six))
    }

    pub(super) fn assess(&mut self, entry: Option<&Entry>) -> Option<AssessEffort> {
        let mut effort = AssessEffort::default();
        let Some(entry) = entry else { return Some(effort) };
        let inner = table(self.report, &entry.node, "`assess`")?;
        check_keys(self.report, inner, &["points", "searches", "cells"], "`assess`");
        let mut take = |key: &str, most: u64, into: &mut usize| -> Option<()> {
            if let Some(entry) = find(inner, key) {
                *into = self.whole_from(0, entry, most)? as usize;
            }
            Some(())
        };
        let points = take("points", 10_000_000, &mut effort.points);
        let searches = take("searches", 1000, &mut effort.searches);
        let cells = take("cells", 100_000_000, &mut effort.cells);
        points.and(searches).and(cells).map(|()| effort)
    }

    pub(super) fn accuracy(&mut self, entry: &Entry) -> Option<ErrorBound> {
        const FORM: &str = "write accuracy = [0.1, 0.05]: of the position in the unit of the design, of the rotation in degrees";
        let list = self.list(&entry.node, "`accuracy`", FORM)?;
        let values: Vec<Option<f64>> = list.iter().map(|n| number(self.report, n, "an accuracy")).collect();
        match values.into_iter().collect::<Option<Vec<f64>>>()?[..] {
            [position, rotation_deg] if position > 0.0 && rotation_deg > 0.0 => {
                Some(ErrorBound { position, rotation_deg })
            }
            _ => self.report.refused(
                Code::NotPositive,
                &entry.node.span,
                "`accuracy` is not two positive numbers",
                FORM,
            ),
        }
    }
}
