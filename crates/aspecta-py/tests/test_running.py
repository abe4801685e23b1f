"""Running: threads, processes, interruption, memory; types."""

import multiprocessing
import os
import resource
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import aspecta

PACKAGE = Path(aspecta.__file__).parent


def count(name: str) -> tuple[int, int | None]:
    found = aspecta.Robot(name).analyze()
    return found.low, found.high


def test_threads_analyse_side_by_side() -> None:
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(count, ["five-bar", "five-bar"])) == [(10, 10)] * 2


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes_get_robots_and_give_solutions_back(method: str) -> None:
    if method == "fork" and not hasattr(os, "fork"):
        pytest.skip("no fork here")
    robot = aspecta.Robot("3-rrr")
    robot.ik([[-9, 0, 0.1]] * 2000)  # the pool of threads is there before the fork
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert len(pool.apply_async(robot.ik, ([[-15.468, 0.781, 0.073]] * 2000,)).get(60)) == 2000
        assert pool.apply_async(count, ("five-bar",)).get(60) == (10, 10)


def test_a_time_ends_work_and_keeps_what_there_is(five_bar: aspecta.Robot) -> None:
    certificate = five_bar.analyze(certificate=True).certificate
    assert certificate is not None
    ended = certificate.verify(seconds=1e-9)
    assert not ended and ended.verified is None and str(ended).endswith("not all was checked, it was stopped")
    assert certificate.verify(seconds=1e9) and certificate.verify(seconds=1e30)
    assert five_bar.analyze().modes(seconds=1e300).searched
    found = aspecta.Robot("3-rrr").analyze(depth=4)
    assert found.domains(cells=200, surfaces=False, seconds=1e-9).aspects == []
    assert not found.modes(seconds=1e-9).searched and five_bar.analyze().modes().searched
    assert not aspecta.Robot("3-rpr").cusps(fix={"q1": 14.98}, seconds=1e-9).complete
    with pytest.raises(aspecta.Error, match="seconds = 0"):
        certificate.verify(seconds=0)


def test_the_number_of_threads_is_chosen(five_bar: aspecta.Robot) -> None:
    try:
        aspecta.set_threads(1)
        alone = five_bar.analyze(depth=6).classes
        aspecta.set_threads(3)
        assert five_bar.analyze(depth=6).classes == alone
    finally:
        aspecta.set_threads(None)
    for count in (0, 1025):
        with pytest.raises(aspecta.Error, match=f"count = {count}"):
            aspecta.set_threads(count)


def test_ctrl_c_raises_and_keeps_what_there_is() -> None:
    script = """
import _thread, threading, aspecta
threading.Timer(1.0, _thread.interrupt_main).start()
try:
    aspecta.Robot("3-rrr").analyze(depth=12)
except KeyboardInterrupt as interrupt:
    found = interrupt.partial()
    print("interrupted", type(found).__name__, found is interrupt.partial() or found.low == interrupt.partial().low)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "interrupted Analysis True\n"


@pytest.mark.parametrize(
    ("work", "kept"),
    [
        ("found.modes()", "ModeGraph"),
        ("robot.cusps()", "Cusps"),
        (
            "robot.plan([-15.468, 0.781, 0.073], [-9.902, -7.091, 1.081], mode='+++', to_mode='++-', depth=12)",
            "NoneType",
        ),
        ("robot.assembly(robot.ik([-15.468, 0.781, 0.073])[0].q, depth=12)", "NoneType"),
    ],
)
def test_ctrl_c_tells_whether_there_is_something(work: str, kept: str) -> None:
    script = f"""
import _thread, threading, aspecta
robot = aspecta.Robot("3-rrr")
found = robot.analyze(depth=5)
aspecta.set_threads(1)
threading.Timer(0.1, _thread.interrupt_main).start()
try:
    {work}
except KeyboardInterrupt as interrupt:
    print(type(interrupt.partial()).__name__)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == f"{kept}\n"


def test_a_hundred_thousand_calls_leak_nothing() -> None:
    robot = aspecta.Robot("five-bar")
    start = robot.ik([4, 7], mode="++")[0]
    follower = robot.follower(start.pose, start.q)

    def work(times: int) -> None:
        for k in range(times):
            follower.step(start.q + 1e-4 * (k % 100))
            if k % 10 == 0:
                robot.ik(start.pose)

    work(20_000)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    work(80_000)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 8 << 10


def test_the_interpreter_is_free_while_it_works() -> None:
    ticks = 0
    done = threading.Event()

    def tick() -> None:
        nonlocal ticks
        while not done.wait(0.001):
            ticks += 1

    thread = threading.Thread(target=tick)
    thread.start()
    aspecta.Robot("3-rrr").analyze(fix={"phi": 0})
    done.set()
    thread.join()
    assert ticks > 5


def test_every_public_name_is_documented_and_typed() -> None:
    for name in aspecta.__all__:
        thing = getattr(aspecta, name)
        assert thing.__doc__, name
        for key, member in vars(thing).items() if isinstance(thing, type) else ():
            if callable(member) and not key.startswith("_"):
                assert member.__doc__, f"{name}.{key}"
        for field in thing.__annotations__ if isinstance(thing, type) else ():
            assert field.startswith("_") or f"    {field}: " in thing.__doc__, f"{name}.{field}"


@pytest.mark.parametrize("tool", [["mypy", "--strict"], ["mypy.stubtest", "aspecta"]])
def test_types(tool: list[str], tmp_path: Path) -> None:
    pytest.importorskip("mypy")
    configuration = tmp_path / "mypy.ini"
    configuration.write_text("[mypy]\nstrict = True\n[mypy-pandas.*,tqdm.*]\nignore_missing_imports = True\n")
    where = [] if tool[0] == "mypy.stubtest" else ["-p", "aspecta"]
    # mypy finds what is installed by itself, and wants to be told of nothing else there.
    path = {} if "site-packages" in PACKAGE.parts else {"MYPYPATH": str(PACKAGE.parent)}
    option = "--mypy-config-file" if tool[0] == "mypy.stubtest" else "--config-file"
    line = [sys.executable, "-m", tool[0], *tool[1:], option, str(configuration), *where]
    done = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path, env=os.environ | path, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
