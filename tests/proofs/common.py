"""The common parts of all topics: the program, exact numbers, random designs."""

import json
import random
import subprocess

from flint import arb, fmpq


class Tally:
    """Counts of what was checked, and the complaints."""

    def __init__(self):
        self.checked, self.faults, self.found, self.missed = {}, [], 0, []

    def count(self, what, n=1):
        self.checked[what] = self.checked.get(what, 0) + n

    def fault(self, text):
        self.faults.append(text)
        print(f"FAIL {text}", flush=True)

    def planted(self, name, complaint):
        """A fault was planted: `complaint` has to name it."""
        if complaint:
            self.found += 1
        else:
            self.missed.append(name)
            print(f"FAIL planted fault not found: {name}", flush=True)


def answer(program, *arguments):
    """The JSON document of a command, and its exit code."""
    done = subprocess.run([program, *map(str, arguments), "--json"], capture_output=True, text=True)
    try:
        return json.loads(done.stdout), done.returncode
    except json.JSONDecodeError:
        raise SystemExit(f"{' '.join(map(str, arguments))}: no JSON, exit {done.returncode}\n{done.stderr[:2000]}")


def rational(x):
    """A double as the fraction it is."""
    n, d = float(x).as_integer_ratio()
    return fmpq(n, d)


def exact(x):
    """A double as a ball of radius zero."""
    return arb(float(x))


def stream(seed, *names):
    """A generator that depends on the seed and the names alone."""
    return random.Random("/".join(map(str, (seed, *names))))
