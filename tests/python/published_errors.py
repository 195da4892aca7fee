"""Errors of Martyushev's published solver on random platforms, in the measure of his paper (eqs. 18 and 19).

    git clone https://github.com/martyushev/fkSGP
    python tests/python/published_errors.py fkSGP [COUNT]        needs numpy and scipy

`docs/evidence/eliminations.md` compares them with `equipod bench --method template`.
"""

import importlib.util
import pathlib
import sys
import types

import numpy as np


def load(folder):
    """The module of the general solver, without its package, whose test module needs Python 3.12."""
    package = types.ModuleType("published")
    package.__path__ = [str(folder)]
    sys.modules["published"] = package
    spec = importlib.util.spec_from_file_location("published.solver66", folder / "solver66.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def draw(kind, rng):
    """Joints of base and platform, and squared lengths, as in section 5 of the paper."""
    base, platform = (np.vstack([np.zeros((1, 3)), rng.uniform(-2, 2, (5, 3))]) for _ in range(2))
    if kind == "6-5":
        platform[5] = platform[4]
    elif kind == "6P-6":
        base[:, 2] = 0
    elif kind == "almost-planar":
        base[:, 2] = 0
        platform[:, 2] = 0
        body, joint, height = [base, platform][rng.integers(2)], rng.integers(6), rng.uniform(-2, 2)
        body[joint, 2] = height
        body[:, 2] -= body[0, 2]  # the solver takes the first joint as origin
    return base, platform, rng.uniform(0.5, 3, 6)


def residuals(module, problem):
    """Residuals of all 69 candidates, ascending, before the false ones are left out."""
    found = []

    def keep(candidates, coefficients, monomials, _frames, _real_only):
        z = np.array([monomials(candidate) for candidate in candidates.T]).T
        found.append(np.sort(np.linalg.norm(coefficients @ (z / np.linalg.norm(z, axis=0)), axis=0)))
        return None, None

    module.S2Rt66 = keep
    module.solver66(*problem, 0)
    return found[0]


def main():
    folder = pathlib.Path(sys.argv[1]) / "python"
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    module = load(folder)
    np.seterr(all="ignore")
    for kind in ["6-6", "6-5", "6P-6", "almost-planar"]:
        rng = np.random.default_rng(1)
        np.random.seed(1)
        all_residuals = [residuals(module, draw(kind, rng)) for _ in range(count)]
        errors = np.array([0.5 * np.log10(np.sum(e[:40] ** 2)) for e in all_residuals])
        gaps = np.array([np.log10(e[39] / e[40]) for e in all_residuals])
        above = [100 * np.mean(errors > limit) for limit in (-5, -6)]
        print(
            f"{kind}: median {np.median(errors):.2f} mean {errors.mean():.2f} max {errors.max():.2f}, "
            f"above -5 {above[0]:.2f} %, above -6 {above[1]:.2f} %, "
            f"gap median {np.median(gaps):.2f} mean {gaps.mean():.2f}"
        )


if __name__ == "__main__":
    main()
