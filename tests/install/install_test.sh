#!/bin/sh
# Installs the build $1 into a scratch prefix and builds the consumer project against it, by CMake and by pkg-config.
set -eu
build=$1
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
expected="quadruped (authors): 12 joints, 5.4 kg"
robot=$scratch/prefix/share/amble/robots/quadruped/authors.toml

cmake -S "$here/consumer" -B "$scratch/by-cmake" -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/by-cmake" >/dev/null
[ "$("$scratch/by-cmake/consumer" "$robot")" = "$expected" ] || { echo "CMake consumer: wrong output" >&2; exit 1; }

pkg_config_path=$(dirname "$(find "$scratch/prefix" -name amble.pc)")
flags=$(PKG_CONFIG_PATH=$pkg_config_path pkg-config --cflags --libs amble)
# shellcheck disable=SC2086  # flags are several words
c++ -std=c++20 "$here/consumer/main.cpp" $flags -o "$scratch/by-pkg-config"
[ "$("$scratch/by-pkg-config" "$robot")" = "$expected" ] || { echo "pkg-config consumer: wrong output" >&2; exit 1; }

"$scratch/prefix/bin/amble" robot "$robot" >/dev/null
echo "both consumers say: $expected"
