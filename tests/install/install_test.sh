#!/bin/sh
# Installs the build $1 into a scratch prefix and builds the consumer project against it, by CMake and by pkg-config.
set -eu
build=$1
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
expected="quadruped (authors): 12 joints, 5.4 kg"

# Each public header compiles by itself, and brings no library of JSON or TOML and no engine of others. What is installed besides is what
# these include.
include=$scratch/prefix/include
headers=$here/../../cmake/public_headers.txt
# shellcheck disable=SC2016  # for the inner shell
xargs -P 2 -I '{}' sh -c 'c++ -std=c++20 -fsyntax-only -I "$0" -MD -MF "$1/$(echo "{}" | tr / .).d" -x c++ - <<END || exit 255
#include <amble/{}>
END' "$include" "$scratch" <"$headers" || { echo "a public header does not compile alone" >&2; exit 1; }
if grep -lE "nlohmann|toml\+\+|mujoco|/ode/|Eigen|boost" "$scratch"/*.hpp.d; then echo "a public header brings another library" >&2; exit 1; fi
cat "$scratch"/*.hpp.d | grep -o "$include/amble/[a-z_/-]*\.hpp" | sort -u >"$scratch/reached"
find "$include/amble" -name '*.hpp' | sort | cmp - "$scratch/reached" || { echo "more or fewer headers are installed" >&2; exit 1; }
robot=$scratch/prefix/share/amble/robots/quadruped/authors.toml

cmake -S "$here/consumer" -B "$scratch/by-cmake" -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/by-cmake" >/dev/null
[ "$("$scratch/by-cmake/consumer" "$robot")" = "$expected" ] || { echo "CMake consumer: wrong output" >&2; exit 1; }
# A champion walks as far as by the program.
champion=$here/../../robots/servo/champion.json
far=$("$scratch/prefix/bin/amble" trial "$champion" --undisturbed --seconds 2 | awk '$1 == "distance" { print $2 " m" }')
[ "$("$scratch/by-cmake/consumer" "$robot" "$champion" | head -n 1)" = "$far" ] || { echo "CMake consumer: not $far" >&2; exit 1; }

pkg_config_path=$(dirname "$(find "$scratch/prefix" -name amble.pc)")
flags=$(PKG_CONFIG_PATH=$pkg_config_path pkg-config --cflags --libs amble)
# shellcheck disable=SC2086  # flags are several words
c++ -std=c++20 "$here/consumer/main.cpp" $flags -o "$scratch/by-pkg-config"
[ "$("$scratch/by-pkg-config" "$robot")" = "$expected" ] || { echo "pkg-config consumer: wrong output" >&2; exit 1; }

# A component brings what it needs and no more: the targets of others' packages are not there.
cat >"$scratch/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(alone LANGUAGES CXX)
find_package(amble REQUIRED COMPONENTS neat physics_batch trial score)
if(TARGET mujoco::mujoco OR TARGET PkgConfig::ODE OR TARGET PkgConfig::OPENBLAS)
  message(FATAL_ERROR "neat, and trials in the batch engine, look for what they do not need")
endif()
file(WRITE ${CMAKE_BINARY_DIR}/alone.cpp "#include <amble/core/version.hpp>\n#include <amble/neat/population.hpp>\n"
  "int main() { return amble::neat::Population({}, 2, 1, false, 1).genomes().empty() || AMBLE_VERSION < 100; }\n")
add_executable(alone ${CMAKE_BINARY_DIR}/alone.cpp)
target_link_libraries(alone PRIVATE amble::neat)
file(WRITE ${CMAKE_BINARY_DIR}/engines.cpp "#include <amble/trial/trial.hpp>\n#include <cstdio>\n"
  "int main() { for (const auto name : amble::physics::engine_names()) std::printf(\"%s\\n\", std::string(name).c_str()); }\n")
add_executable(engines ${CMAKE_BINARY_DIR}/engines.cpp)
target_link_libraries(engines PRIVATE amble::physics_batch amble::score amble::trial)
find_package(amble QUIET COMPONENTS dancing)
if(amble_FOUND)
  message(FATAL_ERROR "there is no such component")
endif()
END
cmake -S "$scratch" -B "$scratch/alone" -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/alone" >/dev/null
"$scratch/alone/alone"
[ "$("$scratch/alone/engines")" = batch ] || { echo "a program has other engines than the one it links" >&2; exit 1; }
if ldd "$scratch/alone/engines" | grep -E 'libode|libmujoco|openblas'; then echo "the batch engine alone needs others' libraries" >&2; exit 1; fi

# Without pkg-config that is said, and not what it would have found.
said=$(cmake -S "$scratch" -B "$scratch/bare" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON 2>&1 || true)
case $(echo "$said" | tr -s ' \n' ' ') in *"needs pkg-config, which finds"*) ;; *) echo "a missing pkg-config is not told: $said" >&2; exit 1 ;; esac

# NEAT by itself, from the installed tree.
cmake -S "$here/../../examples/neat" -B "$scratch/neat" -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/neat" >/dev/null
for problem in "xor 5" "dpv 2"; do
  # shellcheck disable=SC2086  # a problem and a number of seeds
  "$scratch/neat/neat_alone" $problem
done

# A controller, a search, a ground, a quantity and an engine from outside, loaded by the installed program; a worker's process loads them too.
examples=$here/../../examples/extend
cmake -S "$examples" -B "$scratch/extend" -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/extend" >/dev/null
amble=$scratch/prefix/bin/amble
for name in swing climb ripples puppet; do
  "$amble" --plugin "$scratch/extend/lib$name.so" evolve "$examples/$name.toml" --seed 1 --jobs 2 --set population.size=16 \
    --set trial.duration_s=1 --set champion.episodes=0 --generations 2 --out "$scratch/$name" >/dev/null
  "$amble" --plugin "$scratch/extend/lib$name.so" resume "$scratch/$name" --generations 3 --jobs 1 >/dev/null
  "$amble" --plugin "$scratch/extend/lib$name.so" evolve "$examples/$name.toml" --seed 1 --jobs 1 --set population.size=16 \
    --set trial.duration_s=1 --set champion.episodes=0 --generations 3 --out "$scratch/$name-again" >/dev/null
  [ "$(ls "$scratch/$name/champions")" = "$(ls "$scratch/$name-again/champions")" ] || { echo "$name: other champions after resume" >&2; exit 1; }
  cmp "$scratch/$name/champions/$(ls "$scratch/$name/champions" | tail -1)" \
    "$scratch/$name-again/champions/$(ls "$scratch/$name/champions" | tail -1)"
done
for name in swing puppet; do
  if "$amble" trial "$scratch/$name" >/dev/null 2>&1; then echo "$name: a champion of a plugin's kind was read without it" >&2; exit 1; fi
done

"$scratch/prefix/bin/amble" robot "$robot" >/dev/null
echo "both consumers say: $expected"
