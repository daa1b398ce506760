#!/bin/sh
# Makes the Debian package of the build $1 (with the Python module), unpacks it, and uses program, module and headers from there.
set -eu
build=$1
here=$(cd "$(dirname "$0")" && pwd)
command -v dpkg-shlibdeps >/dev/null || { echo "dpkg-shlibdeps is missing: ./setup --package"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
complain() { echo "$1" >&2; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B "$scratch" >"$scratch/log" || { cat "$scratch/log"; exit 1; }
deb=$(ls "$scratch"/amble_*.deb)
depends=$(dpkg-deb -f "$deb" Depends)
for package in libode8 libmujoco python3-numpy "python3 (>="; do
  case $depends in *"$package"*) ;; *) complain "does not depend on $package: $depends" ;; esac
done
dpkg-deb -x "$deb" "$scratch/root"
usr=$scratch/root/usr

"$usr/bin/amble" --version | grep -q '^engines .*ode, batch, mujoco' || complain "amble --version names no engines"
"$usr/bin/amble" robot "$usr/share/amble/robots/quadruped/authors.toml" >/dev/null
PYTHONPATH=$usr/lib/python3/dist-packages /usr/bin/python3 -B -W error - "$usr" <<END || complain "the module does not work"
import sys, amble
assert amble.__file__.startswith(sys.argv[1]), amble.__file__
assert str(amble.data_folder()) == sys.argv[1] + "/share/amble", amble.data_folder()
robots = amble.Robots("hexapod", 20)
robots.step([robots.lower_rad] * 20)
amble.load_config(amble.data_folder() / "configs/robust/supg-objective.toml")
END
cmake -S "$here/consumer" -B "$scratch/consumer" -DCMAKE_PREFIX_PATH="$usr" >/dev/null
cmake --build "$scratch/consumer" >/dev/null
"$scratch/consumer/consumer" "$usr/share/amble/robots/quadruped/authors.toml"
