"""One verdict for each question: the package says of a design and of two what the commands say."""

import json
import pathlib
import subprocess
import sys

import pytest

import equipod

VERDICTS = pathlib.Path(__file__).parents[1] / "fixtures" / "verdicts"


def readable():
    """The designs among the fixtures whose legs change their lengths; some are there because they are refused."""
    for path in sorted(VERDICTS.glob("*.toml")):
        try:
            design = equipod.Design.load(path)
        except equipod.DesignError:
            continue
        if design.drive == "prismatic":
            yield design, path


def command(*words):
    """The program that comes with the package."""
    done = subprocess.run([sys.executable, "-m", "equipod", *map(str, words), "--json"], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1, 3), done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("design, path", [pytest.param(*pair, id=pair[1].stem) for pair in readable()])
def test_verdicts_are_those_of_the_commands(design, path):
    checked, said = design.check(), command("check", path)
    for field in ("architecturally_singular", "level", "leg_rank", "singular_as_written"):
        assert getattr(checked, field) == said[field], field
    assert checked.pose_count.finite == said["pose_count"]["finite"]
    mapped, said = equipod.leg_map(design, design).record, command("equivalents", "map", path, path)
    for field in ("relation", "level", "det_exact"):
        assert getattr(mapped, field) == said[field], field
    verified = equipod.verify(design, design, samples=1)
    assert verified.verdict == command("verify", path, path, "--samples", 1)["verdict"]
