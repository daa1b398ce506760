#!/bin/sh
# Packs the build $1 (with the Python module) as a wheel by pip, installs it in a clean environment, and uses it far from the sources.
set -eu
build=$1
source=$(cd "$(dirname "$0")/../.." && pwd)
python=/usr/bin/python3
"$python" -c "import ensurepip" 2>/dev/null || { echo "python3-venv is missing: ./setup --python"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# numpy is Debian's, as nothing is fetched here.
"$python" -m venv --system-site-packages "$scratch/venv"
pip="$scratch/venv/bin/pip --quiet --disable-pip-version-check"
$pip wheel "$source" --no-deps --no-index --config-settings=build-dir="$build" --wheel-dir "$scratch"
$pip install --no-index "$scratch"/amble-*.whl
# What it says of other packages of this machine is not ours.
if "$scratch/venv/bin/pip" --disable-pip-version-check check | grep "^amble "; then exit 1; fi
cd "$scratch"
"$scratch/venv/bin/python" -B -W error - "$scratch/venv" <<'END'
import sys, amble
assert amble.__file__.startswith(sys.argv[1]), amble.__file__
assert str(amble.data_folder()).startswith(sys.argv[1]), amble.data_folder()
config = amble.load_config(amble.data_folder() / "configs/quick/quadruped.toml",
                           {"population.size": 16, "trial.duration_s": 1.0, "champion.episodes": 0, "generations": 2})
run = amble.evolve(config, seed=1, out="run")
amble.view(run.champion()).save("walk.html")
print(len(amble.robots()), "robots,", run.generations()["best"].max(), "m")
END
"$scratch/venv/bin/pip" --disable-pip-version-check show -f amble >"$scratch/files"
grep -q "amble/data/configs/quick/quadruped.toml" "$scratch/files"
