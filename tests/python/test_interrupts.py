"""Ctrl-C, and the end of the interpreter, while calls run."""

import signal
import subprocess
import sys
import threading
import time

import amble
import pytest

from conftest import CONFIG


def interrupted_after(seconds, call):
    """How long `call` went on after Ctrl-C, s."""
    begin = time.monotonic()
    threading.Timer(seconds, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        call()
    return time.monotonic() - begin - seconds


def test_ctrl_c_interrupts_the_making_of_many_robots(ctrl_c):
    assert interrupted_after(0.5, lambda: amble.Robots("quadruped", 20000, "mujoco", threads=1)) < 5.0


def test_ctrl_c_interrupts_many_typical_trials(ctrl_c, run):
    champion = run.champion()
    for patience in (0.1, 2.0):  # while they are drawn, while they run
        assert interrupted_after(patience, lambda: champion.typical(seconds=100.0, trials=100000)) < 5.0


WAITING = """
import signal, sys, threading, time
import amble
signal.signal(signal.SIGINT, signal.default_int_handler)
problem = amble.Problem(amble.load_config(sys.argv[1], {"engine": "ode", "trial.duration_s": 1000.0}))
genomes = amble.Search(problem.config).ask()
threading.Thread(target=lambda: amble.evaluate(problem, genomes, jobs=1), daemon=True).start()
time.sleep(0.3)
threading.Timer(0.2, signal.raise_signal, [signal.SIGINT]).start()
try:
    amble.evaluate(problem, genomes[:1], jobs=1)
except KeyboardInterrupt:
    print("interrupted")
"""


def run_program(text, *arguments):
    """What it printed; it must end by itself."""
    done = subprocess.run([sys.executable, "-c", text, *map(str, arguments)], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_ctrl_c_interrupts_who_waits_for_another_thread():
    assert run_program(WAITING, CONFIG) == "interrupted\n"  # the other thread would go on for many minutes


CALLS = {
    "step": "robots = amble.Robots('quadruped', 64); rest = np.zeros((64, 12), np.float32); call = lambda: robots.step(rest)",
    "controllers": "walkers = amble.Controllers(config, genomes); call = lambda: walkers.step(np.zeros((8, 12)), np.ones((8, 4)))",
    "evaluate": "problem = amble.Problem(config); call = lambda: amble.evaluate(problem, genomes, jobs=2)",
    "evolve": "call = lambda: amble.evolve(config, out=out + '/run')",
    "callback": "call = lambda: amble.evolve(config, out=out + '/run', on_generation=lambda line: sum(range(10000)))",
    "load": "call = lambda: amble.load_config(path)",
}


@pytest.mark.parametrize("call", CALLS)
def test_a_daemon_s_call_does_not_abort_a_program_that_ends(call, tmp_path):
    program = f"""
import sys, threading, time
import amble, numpy as np
path, out = sys.argv[1:]
config = amble.load_config(path, {{"engine": "batch", "population.size": 8, "trial.duration_s": 1.0, "generations": 100000}})
genomes = amble.Search(config).ask()
{CALLS[call]}
def work():
    while True:
        call()
threading.Thread(target=work, daemon=True).start()
time.sleep(0.3)
"""
    for attempt in range(3):
        run_program(program, CONFIG, tmp_path / str(attempt))
