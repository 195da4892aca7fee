"""Sweeps over many designs on an engine that starts many processes: Dask on this machine, or on any cluster that it reaches.

A plan and its parts are those of ``equipod sweep``: parts computed here are the bytes that the command line writes, and one may go on where the other ended.

    >>> import equipod.sweep                                                  # doctest: +SKIP
    >>> equipod.sweep.estimate("plan.toml", threads=64)["seconds"]            # doctest: +SKIP
    4200.0
    >>> status = equipod.sweep.run("plan.toml", output="sweep", shards=64)    # doctest: +SKIP
    >>> status["missing"]                                                     # doctest: +SKIP
    []
"""

from __future__ import annotations

import importlib
import json
import os
import pathlib
from collections.abc import Mapping
from typing import Any

from ._errors import CommandError, DesignError
from ._program import Workshop, ask

__all__ = ["estimate", "parts", "run", "status"]

#: A plan: a file, or the same structure as a mapping, with an absolute path (or one relative to the working directory) as its ``design``.
Plan = str | os.PathLike[str] | Mapping[str, Any]


def status(folder: str | os.PathLike[str]) -> dict[str, Any]:
    """The finished and the missing parts of a sweep, as ``equipod sweep status``: all parts are read and compared with their digests."""
    return ask(["sweep", "status", os.fspath(folder)])


def parts(folder: str | os.PathLike[str]) -> list[str]:
    """The Parquet files of the shards that are done, in the order of the candidates."""
    document = status(folder)
    shards = document["shards"]
    wide = max(5, len(str(shards)))
    base = pathlib.Path(folder)
    return [str(base / f"part-{shard:0{wide}d}-of-{shards:0{wide}d}.parquet") for shard in document["done"]]


def _shard(plan: str, folder: str, shard: int, shards: int, seed: int, threads: int) -> int:
    """One shard, as a task of a worker."""
    document = ask(
        [
            "sweep",
            "run",
            plan,
            "--shard",
            f"{shard}/{shards}",
            "--seed",
            str(seed),
            "--threads",
            str(threads),
            "--output",
            folder,
        ]
    )
    if shard in document["missing"]:
        raise CommandError(f"shard {shard} of {shards} was not computed", code="sweep::missing")
    return shard


def _written(plan: Plan, folder: pathlib.Path) -> str:
    """The plan as a file that other processes read."""
    if not isinstance(plan, Mapping):
        return os.path.abspath(os.fspath(plan))
    content = dict(plan)
    if "design" in content:
        content["design"] = os.path.abspath(os.fspath(content["design"]))
    if "drives" in content:
        content["drives"] = os.path.abspath(os.fspath(content["drives"]))
    path = folder / "plan.json"
    text = json.dumps(content, indent=1, sort_keys=True) + "\n"
    if path.exists() and path.read_text(encoding="utf-8") != text:
        raise DesignError(f"{folder} holds another plan", code="sweep::other_sweep")
    path.write_text(text, encoding="utf-8")
    return str(path)


def estimate(plan: Plan, *, shards: int | None = None, seed: int = 1, threads: int = 1) -> dict[str, Any]:
    """How long a sweep takes and which columns it has, from a sample of its candidates, as ``equipod sweep run --estimate``: nothing is written.

    `threads` is how many processors share the work; ``seconds`` is the time on so many, ``seconds_each`` that of a candidate on one.

    :raises DesignError: a plan that is refused
    """
    with Workshop() as place:
        words = ["sweep", "run", _written(plan, place.path), "--estimate", "--seed", str(seed), "--threads", str(threads)]
        return ask(words if shards is None else [*words, "--shards", str(shards)])


def run(
    plan: Plan,
    client: Any = None,
    *,
    output: str | os.PathLike[str],
    shards: int | None = None,
    seed: int = 1,
    threads: int = 1,
) -> dict[str, Any]:
    """Computes the shards of a plan that are missing in the folder `output`, one task a shard, and returns the :func:`status`.

    `client` is a ``dask.distributed.Client``; without one a ``LocalCluster`` is started, with a worker for each processor, and closed at the end. The folder has to be
    one that all workers see under the same name. A worker that dies costs the shard at work, which Dask gives to another one. `threads` is how many each shard
    uses. `shards` is needed for a new folder with a number of shards other than the default of ``equipod sweep run``.

    :raises DesignError: a plan that is refused, or a folder that holds another sweep
    :raises CommandError: a shard that failed on every worker it was given to
    """
    folder = pathlib.Path(os.path.abspath(os.fspath(output)))
    folder.mkdir(parents=True, exist_ok=True)
    path = _written(plan, folder)
    known = folder / "sweep.json"
    if shards is None:
        shards = json.loads(known.read_text(encoding="utf-8"))["shards"] if known.exists() else None
    if shards is None:
        shards = ask(["sweep", "run", path, "--estimate", "--seed", str(seed)])["shards"]
    # the first shard makes the folder, and tells of a bad plan before a cluster is started
    _shard(path, str(folder), 0, shards, seed, threads)
    missing = status(folder)["missing"]
    if not missing:
        return status(folder)
    if client is not None:
        _spread(client, path, str(folder), missing, shards, seed, threads)
        return status(folder)
    distributed = _distributed()
    with (
        distributed.LocalCluster(threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as local,
    ):
        _spread(local, path, str(folder), missing, shards, seed, threads)
    return status(folder)


def _distributed() -> Any:
    """The engine, where it is installed."""
    try:
        return importlib.import_module("distributed")
    except ImportError as error:
        raise ImportError("equipod.sweep.run needs Dask: pip install 'equipod[sweep]'") from error


def _spread(client: Any, plan: str, folder: str, missing: list[int], shards: int, seed: int, threads: int) -> None:
    """The shards as tasks; results are numbers, the parts stay where they are written."""
    tasks = [
        client.submit(_shard, plan, folder, shard, shards, seed, threads, pure=False, retries=2, key=f"{folder}-{shard}")
        for shard in missing
    ]
    for task in _distributed().as_completed(tasks):
        task.result()
        task.release()
