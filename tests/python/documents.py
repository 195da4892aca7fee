"""Runs the programs in docs/python.md and README.md, each on its own, with the installed package."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).parents[2]

pages = [(ROOT / name).read_text() for name in ("docs/python.md", "README.md")]
programs = [program for page in pages for program in re.findall(r"^```python\n(.*?)^```", page, re.S | re.M)]
assert len(programs) >= 5
for program in programs:
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout:
        sys.exit(f"{program}\n{done.stdout}{done.stderr}")
print(f"{len(programs)} programs of the pages run")
