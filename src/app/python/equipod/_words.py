"""The words that options take and answers have."""

from __future__ import annotations

from typing import Literal, TypeAlias

#: Methods of forward kinematics.
Method: TypeAlias = Literal["octic", "homotopy", "trilateration", "sylvester", "template"]

#: Forms of a design text.
TextFormat: TypeAlias = Literal["toml", "json"]

#: Formats of `Design.export`.
ExportFormat: TypeAlias = Literal["c", "csv", "dxf", "hal", "json", "matlab", "mjcf", "step", "stl", "svg"]

#: Pictures of `Design.plot`.
FigureName: TypeAlias = Literal[
    "components", "det", "locus", "modes", "pair", "self-motion", "singular-poses", "topologies", "workspace"
]

#: A body of a design.
Body: TypeAlias = Literal["base", "platform"]

#: What moves the platform.
Drive: TypeAlias = Literal["prismatic", "rotary"]

#: What is known of the list of poses.
Completeness: TypeAlias = Literal["proved", "proved_bounded", "modular", "unproved"]

#: What became of a pose that was followed; `refused` are rows that are no lengths.
TrackStatus: TypeAlias = Literal["tracked", "near_singularity", "lost", "refused"]
