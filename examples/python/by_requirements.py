"""A platform by its requirements: the best one, assessed over its whole workspace, rounded to a grid of holes, and exported for MuJoCo.

    python examples/python/by_requirements.py [FOLDER]
"""

import pathlib
import sys
import tempfile

import equipod


def main() -> None:
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp())
    start = equipod.Design.load("designs/worked/bench-octahedral.toml")
    best, answer = start.optimize(seed=1)
    print(answer.status)
    if best is None:
        return
    assessed = best.assess()
    print("meets its requirements:", {True: "proved", False: "no", None: "not decided"}[assessed.met])
    for row in assessed.requirements:
        print(f"  {row.name:18} {row.margin:10.3f} {row.unit:6} {row.status}")
    best.save(folder / "best.toml")
    for name, text in best.export("mjcf").items():
        (folder / name).write_text(text)
        print("wrote", folder / name)


if __name__ == "__main__":
    main()
