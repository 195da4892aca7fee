"""Commands inside the process: the answers of the command line, interrupts, progress, refusals, and streams that stay untouched."""

import json
import pathlib
import subprocess
import sys
import threading

import pytest

import equipod
from equipod import _core
from equipod._program import ask, text_of

DESIGNS = pathlib.Path(__file__).parents[2] / "designs"
OCTAHEDRAL = str(DESIGNS / "rbt-octahedral.toml")


def by_process(*words):
    done = subprocess.run([sys.executable, "-m", "equipod", *words], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


@pytest.fixture
def plan(tmp_path):
    """A sweep of an hour, which says so in its first line."""
    content = {
        "name": "offsets",
        "design": OCTAHEDRAL,
        "compute": ["det_a", "spacing", "conditioning"],
        "poses": {"region": 300},
        "vary": [{"by": "sobol", "count": 100_000, "values": {"offsets": {"from": 0.1, "to": 0.9}}}],
    }
    file = tmp_path / "plan.json"
    file.write_text(json.dumps(content))
    return ["sweep", "run", str(file), "--shards", "1000", "--output", str(tmp_path / "out")]


@pytest.mark.parametrize(
    "words",
    [
        ["check", OCTAHEDRAL, "--json"],
        ["check", OCTAHEDRAL],
        ["--help"],
        ["design", "presets"],
        ["fk", OCTAHEDRAL, "--method", "magic"],
        ["fk", "no-such-file.toml", "--json"],
        ["export", OCTAHEDRAL, "--csv", "-"],
        ["check", "-"],
        ["chekc"],
        [],
    ],
    ids=" ".join,
)
def test_code_output_and_error_are_those_of_a_process(words):
    done = subprocess.run(
        [sys.executable, "-m", "equipod", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )
    assert _core.ask(["equipod", *words], None) == (done.returncode, done.stdout, done.stderr)


def test_threads_ask_at_once():
    commands = [
        ["check", OCTAHEDRAL],
        ["check", str(DESIGNS / "symmetric-hexapod.toml")],
        ["limits", str(DESIGNS / "worked" / "simulator-300kg.toml")],
        ["verify", OCTAHEDRAL, str(DESIGNS / "rbt-griffis-duffy.toml"), "--samples", "2"],
    ]
    answers = {}

    def work(number):
        answers[number] = ask(commands[number % len(commands)])

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    expected = [json.loads(by_process(*words, "--json", "--quiet")[1]) for words in commands]
    assert [answers[number] for number in range(8)] == expected * 2


def test_a_refusal_keeps_code_help_and_line(tmp_path):
    file = tmp_path / "slip.toml"
    file.write_text("name = 'slip'\nunit = 'mm'\n")
    with pytest.raises(equipod.DesignError) as caught:
        ask(["check", str(file)])
    error = caught.value
    assert error.code == "design::invalid" and "violation" in str(error)
    assert any(f.code == "design::unknown_key" and f.line == 2 and "units" in f.message + f.help for f in error.faults)
    assert error.line == error.faults[0].line and error.help == error.faults[0].help
    with pytest.raises(equipod.DesignError) as caught:
        ask(["fk", "no-such-file.toml"])
    error = caught.value
    assert error.code == "file::not_readable" and error.line is None
    assert error.help and str(error).endswith(f"; {error.help}")
    with pytest.raises(equipod.DesignError, match="no-such-figure"):
        text_of(["plot", "no-such-figure", OCTAHEDRAL])


def test_the_streams_of_the_process_stay_untouched(capfd):
    assert "provenance" in ask(["check", OCTAHEDRAL])
    assert "<svg" in text_of(["plot", "modes", OCTAHEDRAL])
    with pytest.raises(equipod.DesignError):
        ask(["check", "-"])
    with pytest.raises(equipod.DesignError):
        ask(["new"], [].append)
    assert capfd.readouterr() == ("", "")


def test_progress_comes_as_lines_to_the_thread_that_asks(plan):
    lines = []

    def observer(line):
        lines.append((line, threading.get_ident()))
        raise KeyboardInterrupt

    # the first interrupt is answered with what is done so far
    assert ask(plan, observer)["missing"]
    assert lines and all("\n" not in line and thread == threading.get_ident() for line, thread in lines)
    assert lines[0][0].startswith("100000 candidates in 1000 shards")


def test_what_progress_raises_ends_the_question(plan):
    def observer(line):
        raise ValueError(line)

    with pytest.raises(ValueError, match="100000 candidates"):
        ask(plan, observer)
