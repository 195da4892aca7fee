"""Sweeps on an engine: the bytes of the command line, a worker that is killed, and the tables in the hands of other programs."""

import hashlib
import json
import pathlib
import subprocess
import sys

import pytest

import equipod
import equipod.sweep

BASE = pathlib.Path(__file__).resolve().parents[2] / "designs" / "rbt-octahedral.toml"


def plan(count, **more):
    """Offsets of an octahedral platform with requirements."""
    return {
        "name": "offsets",
        "design": str(BASE),
        "compute": ["det_a", "spacing", "conditioning"],
        "vary": [{"by": "sobol", "count": count, "values": {"offsets": {"from": 0.1, "to": 0.9}}}],
        **more,
    }


def digests(folder):
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(pathlib.Path(folder).glob("part-*.parquet"))}


def by_command(source, folder, shards):
    """The same sweep by the command line."""
    words = [sys.executable, "-m", "equipod", "sweep", str(source), "--shards", str(shards), "--output", str(folder), "--quiet"]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """A finished sweep of some hundred designs a shard, so that parts have columns of all kinds of writing, by the command line."""
    folder = tmp_path_factory.mktemp("swept")
    source = folder / "plan.json"
    source.write_text(json.dumps(plan(900, keep=["base_spacing > 0.5"])))
    by_command(source, folder / "out", 3)
    return folder / "out"


def test_dask_writes_the_bytes_of_the_command_line_although_a_worker_is_killed(tmp_path):
    distributed = pytest.importorskip("distributed")
    content = plan(1500)
    # with few poses a shard would be done before its worker is killed
    content["poses"] = {"region": 300}
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        victim = next(iter(cluster.workers.values())).process.pid
        killer = subprocess.Popen(
            [sys.executable, "-c", _KILLER, str(tmp_path / "out"), str(victim)], stdout=subprocess.PIPE, text=True
        )
        status = equipod.sweep.run(content, client, output=tmp_path / "out", shards=12)
        said, _ = killer.communicate(timeout=60)
    assert said.strip() == "killed", "the worker was there until the end"
    assert (len(status["done"]), status["missing"], status["damaged"]) == (12, [], [])
    by_command(tmp_path / "out" / "plan.json", tmp_path / "again", 12)
    assert digests(tmp_path / "out") == digests(tmp_path / "again")
    assert len(equipod.sweep.parts(tmp_path / "out")) == 12


#: Waits until two shards are done, then kills a worker.
_KILLER = """
import os, pathlib, signal, sys, time
folder, pid = pathlib.Path(sys.argv[1]), int(sys.argv[2])
for _ in range(6000):
    if len(list(folder.glob("part-*.json"))) >= 2:
        os.kill(pid, signal.SIGKILL)
        print("killed" if len(list(folder.glob("part-*.json"))) < 12 else "late")
        break
    time.sleep(0.005)
"""


def test_a_sweep_goes_on_where_another_engine_ended(tmp_path):
    pytest.importorskip("distributed")
    source = tmp_path / "plan.json"
    source.write_text(json.dumps(plan(60)))
    words = [sys.executable, "-m", "equipod", "sweep", str(source), "--shard", "2/4", "--output", str(tmp_path / "out"), "-q"]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
    assert equipod.sweep.status(tmp_path / "out")["missing_ranges"] == "0-1,3"
    status = equipod.sweep.run(source, output=tmp_path / "out")
    assert (status["done"], status["rows"]) == ([0, 1, 2, 3], 60)
    with pytest.raises(equipod.DesignError) as refused:
        equipod.sweep.run(plan(61), output=tmp_path / "out", shards=4)
    assert refused.value.code == "sweep::other_sweep"
    with pytest.raises(equipod.DesignError) as refused:
        equipod.sweep.run({**plan(5), "compute": ["det_b"]}, output=tmp_path / "bad", shards=1)
    assert "det_a" in str(refused.value) or refused.value.code == "sweep::bad_plan"


def test_the_time_of_a_plan_is_estimated_and_a_bad_plan_refused_before_anything_is_written(tmp_path):
    told = equipod.sweep.estimate(plan(5000), shards=7, threads=2)
    assert (told["candidates"], told["shards"], told["threads"]) == (5000, 7, 2)
    assert told["seconds"] == pytest.approx(told["seconds_each"] * 5000 / 2) and told["seconds"] > 0
    assert [c["name"] for c in told["columns"]][:2] == ["candidate", "offsets_1"]
    source = tmp_path / "plan.json"
    source.write_text(json.dumps(plan(5000)))
    assert equipod.sweep.estimate(source)["columns"] == told["columns"]
    assert list(tmp_path.iterdir()) == [source]
    with pytest.raises(equipod.DesignError) as refused:
        equipod.sweep.estimate({**plan(5), "compute": ["det_b"]})
    assert refused.value.code == "sweep::bad_plan"


def expected(folder):
    return equipod.sweep.status(folder)["rows"]


def test_pyarrow_reads_values_types_and_metadata(swept):
    parquet = pytest.importorskip("pyarrow.parquet")
    files = equipod.sweep.parts(swept)
    tables = [parquet.read_table(f) for f in files]
    assert sum(t.num_rows for t in tables) == expected(swept) > 50
    kinds = {name: str(tables[0].schema.field(name).type) for name in ("candidate", "det_a", "error")}
    assert kinds == {"candidate": "int64", "det_a": "double", "error": "string"}
    notes = {k.decode(): v.decode() for k, v in parquet.read_metadata(files[0]).metadata.items()}
    columns = {c["name"]: c for c in json.loads(notes["equipod.columns"])}
    assert columns["base_spacing"]["unit"] == "mm" and notes["equipod.seed"] == "1"
    assert notes["equipod.version"] == equipod.__version__ and "offsets" in notes["equipod.plan"]
    # the figures are those of the designs
    row = tables[1].slice(0, 1).to_pylist()[0]
    design = equipod.Design.load(BASE)
    offsets = [row[f"offsets_{k}"] for k in range(1, 7)]
    product = 1.0
    other = 1.0
    for t in offsets:
        product *= 1 - t
        other *= t
    assert row["det_a"] == pytest.approx(product - other, abs=1e-12) and design is not None


def test_pandas_and_polars_and_duckdb_read_the_same_rows(swept):
    pandas = pytest.importorskip("pandas")
    polars = pytest.importorskip("polars")
    duckdb = pytest.importorskip("duckdb")
    pattern = str(swept / "part-*.parquet")
    frame = pandas.concat([pandas.read_parquet(f) for f in equipod.sweep.parts(swept)])
    lazy = polars.scan_parquet(pattern).filter(polars.col("det_a") > 0.02)
    seen = lazy.select(polars.len(), polars.col("conditioning").sum()).collect().row(0)
    asked = duckdb.sql(f"select count(*), sum(conditioning) from '{pattern}' where det_a > 0.02").fetchall()[0]
    chosen = frame[frame.det_a > 0.02]
    assert len(frame) == expected(swept)
    assert seen[0] == asked[0] == len(chosen) > 5
    assert seen[1] == pytest.approx(asked[1]) == pytest.approx(chosen.conditioning.sum())
    assert frame.candidate.is_monotonic_increasing and frame.error.isna().all()


def test_merged_tables_are_read_as_one(swept, tmp_path):
    polars = pytest.importorskip("polars")
    merged = tmp_path / "all.parquet"
    words = [sys.executable, "-m", "equipod", "sweep", "merge", str(swept), "--output", str(merged)]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
    assert polars.read_parquet(merged).equals(polars.read_parquet(str(swept / "part-*.parquet")))
