"""tools/steering-table: what a champion does of what it is told."""
import os
import pathlib
import subprocess
import sys

import amble
from conftest import SOURCE

SMALL = {"population.size": 8, "trial.duration_s": 1.0, "generations": 1, "champion.episodes": 0}


def test_each_engine_has_a_row_of_eight_commands(tmp_path):
    amble.evolve(amble.load_config(SOURCE / "robots/servo/steer.toml", SMALL), 1, out=tmp_path / "run")
    environment = dict(os.environ, AMBLE=os.environ["AMBLE_PROGRAM"], AMBLE_PYTHON=str(pathlib.Path(amble.__file__).parents[1]))
    command = [sys.executable, SOURCE / "tools/steering-table", "--engines", "batch,ode", "--trials", "1", "--stretch", "0.5",
               "--speed", "0.2", "--turn", "0.1", tmp_path / "run"]
    rows = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout.splitlines()
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    assert [row[:2] for row in cells[5:]] == [["run", "batch"], ["run", "ode"]]
    assert cells[2][4:6] == ["0.20, +0.00", "0.14, +0.10"]  # what they are told first
    # All turns are small: who stands follows both stops and what is no faster than 0.1 m/s; who walks at 0.1 m/s all.
    assert [row[0] for row in cells[3:5]] == ["*stands*", "*deaf, straight ahead at 0.10 m/s*"]
    assert [row[2] for row in cells[3:5]] == ["4", "8"]
    for row in cells[5:]:
        assert len(row) == len(cells[0]) == 12
        assert 0.0 <= float(row[2]) <= 8.0
        assert row[3] in ("0 of 1", "1 of 1")
        for cell in row[4:]:
            assert cell == "fell" or all(abs(float(number)) < 20.0 for number in cell.split(","))
