"""Calibrations of simulated machines with gross errors, beside a robust least squares fit of SciPy that knows nothing of ours."""

import pathlib

import numpy as np
import pytest

from scipy.optimize import least_squares

import equipod

DESIGNS = pathlib.Path(__file__).parents[2] / "designs"
NOISE, POSES = 0.01, 40


def lengths_of(numbers, poses):
    """Lengths that the legs show: eighteen coordinates of the base, as many of the platform, six offsets."""
    base, platform, offsets = numbers[:18].reshape(6, 3), numbers[18:36].reshape(6, 3), numbers[36:]
    tips = np.einsum("nij,kj->nki", poses[:, :3, :3], platform) + poses[:, None, :3, 3]
    return np.linalg.norm(tips - base, axis=2) + offsets


def machine(design, seed, share):
    """A machine built from a design, and the measurements of it. A share of the lengths is off by 1 to 40 mm."""
    rng = np.random.default_rng([seed, round(1000 * share)])
    nominal = np.concatenate([design.joints.base_ends.ravel(), design.joints.platform_ends.ravel(), np.zeros(6)])
    truth = nominal + np.concatenate([rng.normal(0, 0.5, 36), rng.normal(0, 2, 6)])
    home = design.home[:3, 3]
    poses = equipod.pose(home + rng.uniform(-60, 60, (POSES, 3)), rpy=rng.uniform(-20, 20, (POSES, 3)), degrees=True)
    lengths = lengths_of(truth, poses) + rng.normal(0, NOISE, (POSES, 6))
    gross = np.zeros(POSES * 6, bool)
    gross[rng.choice(POSES * 6, round(share * POSES * 6), replace=False)] = True
    off = rng.uniform(1, 40, POSES * 6) * rng.choice([-1, 1], POSES * 6)
    lengths += np.where(gross, off, 0).reshape(POSES, 6)
    return nominal, truth, poses, lengths, gross.reshape(POSES, 6)


@pytest.mark.parametrize("share", [0.0, 0.01, 0.03, 0.1])
@pytest.mark.parametrize("seed", range(5))
def test_gross_errors_leave_the_machine_as_near_as_scipy_finds_it(seed, share):
    design = equipod.Design.load(DESIGNS / "symmetric-hexapod.toml")
    nominal, truth, poses, lengths, gross = machine(design, seed, share)
    other = least_squares(
        lambda x: ((lengths_of(x, poses) - lengths) / NOISE).ravel(), nominal, loss="soft_l1", x_scale="jac", max_nfev=400
    )
    found = design.calibrate(poses, lengths, sigma_length=NOISE, options=["--loss=tukey", "--loss-of=leg"])
    assert found.record.outcome == "calibrated", found.record.reason
    joints = found.design.joints
    offsets = [offset.offset for offset in found.record.calibration.offsets]
    ours = np.concatenate([joints.base_ends.ravel(), joints.platform_ends.ravel(), offsets])
    off, theirs = (float(np.linalg.norm(x - truth)) for x in (ours, other.x))
    # both estimate from the same good lengths; a loss that takes outliers away does not weigh them
    assert off < 1.25 * theirs, (off, theirs)
    # what is far off is named; right lengths all stay below the threshold with a probability of 99 %
    named = {(outlier.line - 2, outlier.leg - 1) for outlier in found.record.calibration.outliers}
    wrong = set(map(tuple, np.argwhere(gross)))
    assert wrong <= named and len(named - wrong) <= 1, (named ^ wrong)
