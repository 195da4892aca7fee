"""Runs the programs in docs/python.md, each on its own, with the installed package."""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).parents[2]

programs = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/python.md").read_text(), re.S | re.M)
assert len(programs) >= 4
for program in programs:
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0 or not done.stdout:
        sys.exit(f"{program}\n{done.stdout}{done.stderr}")
print(f"{len(programs)} programs of docs/python.md run")
