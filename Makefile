# Thin: each target prints and runs the commands one would type. PRESET chooses another build for `make test`: dev (warnings are errors), asan,
# tsan, fuzz.
PRESET ?= release
PREFIX ?= /usr/local
JOBS ?= $(shell nproc)
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)

.PHONY: demo picture build wasm wasm-check test test-aarch64 python package bench install doxygen article reproduce-sample coverage clean

demo: build
	rm -rf demo
	build/release/src/cli/amble evolve configs/quick/quadruped.toml --seed 8 --generations 350 --jobs $(JOBS) --out demo/run
	build/release/src/cli/amble compare demo/run --seconds 15,300 --trials 5
	build/release/src/cli/amble view demo/run --static --engine ode -o demo/index.html --figures demo/figures
	build/release/src/cli/amble view demo/run --engine ode -o demo/walk.html
	@if [ -n "$$DISPLAY$$WAYLAND_DISPLAY" ] && command -v xdg-open >/dev/null; then xdg-open demo/walk.html; \
	else echo "now open demo/walk.html in a browser"; fi

# The README's picture, from the page of `make demo`.
picture: $(if $(wildcard demo/walk.html),,demo)
	./setup --dev
	viewer/install-packages
	tools/render-video.mjs demo/walk.html docs/pictures/walker.png --whole --at 8.3 --size 1280x720

build:
	./setup
	cmake --preset release
	cmake --build --preset release

# The part of amble that runs in pages, viewer/dist/amble.wasm, and what the module with relaxed SIMD differs by from it, which are committed.
# The same compiler gives the same bytes: `make wasm-check`.
MODULES := build/wasm/src/browser
wasm:
	./setup --wasm
	cmake --preset wasm
	cmake --build --preset wasm
	node viewer/make-patch.mjs $(MODULES)/amble.wasm $(MODULES)/amble-relaxed.wasm viewer/dist/amble-relaxed.patch
	cp $(MODULES)/amble.wasm viewer/dist/amble.wasm

wasm-check:
	@if ./setup --wasm; then set -ex; cmake --preset wasm; cmake --build --preset wasm; \
	node viewer/make-patch.mjs $(MODULES)/amble.wasm $(MODULES)/amble-relaxed.wasm $(MODULES)/amble-relaxed.patch; \
	for file in amble.wasm amble-relaxed.patch; do cmp $(MODULES)/$$file viewer/dist/$$file || \
	  { echo "viewer/dist/$$file is not what src gives: run make wasm" >&2; exit 1; }; done; \
	else echo "skipped: the compiler for WebAssembly could not be installed (see above)"; fi

# What `make demo` has compiled is not compiled again. Without the tests that take long (pages in browsers, clusters, every command of the docs,
# installing): TESTS=all is what CI runs.
# The programs that tests run (browser, Slurm, Clang for exported C) are installed while the tests compile. One job more than
# processors: a test that waits needs none.
TESTS ?= short
test:
	./setup $(if $(filter fuzz,$(PRESET)),--dev,--test)
	@{ ./setup --tools && viewer/install-packages >/dev/null; } & tools=$$!; \
	set -ex; cmake --preset $(PRESET) $(if $(filter release,$(PRESET)),-DAMBLE_TESTS=ON -DAMBLE_PYTHON=ON); cmake --build --preset $(PRESET); \
	wait $$tools || echo "some tests will be skipped: see above"; \
	ctest --preset $(PRESET) -j $$(($(JOBS) + 1)) $(if $(filter all,$(TESTS)),,-LE long) || { tools/failed-tests build/$(PRESET); exit 8; }
	@$(if $(filter all,$(TESTS)),,echo "the tests that take long are left out; to run them too: make test TESTS=all")

# The libraries that need neither ODE nor MuJoCo, compiled for aarch64, and their tests under an emulator: the same bits as on x86-64.
test-aarch64:
	@if ./setup --aarch64; then set -ex; cmake --preset aarch64; cmake --build --preset aarch64; ctest --preset aarch64 -j $(JOBS); \
	else echo "skipped: compiler and libraries for aarch64, and the emulator, could not be installed (see above)"; fi

# The Python package, in build/release/python, and its tests. It shares what `make demo` has compiled.
python:
	./setup --python
	cmake --preset release -DAMBLE_PYTHON=ON
	cmake --build --preset release --target _amble amble
	PYTHONPATH=build/release/python AMBLE_PROGRAM=build/release/src/cli/amble /usr/bin/python3 -B -m pytest -q -p no:cacheprovider tests/python

# A Debian package of program, headers and Python module: build/release/amble_*.deb, for apt-get install.
package:
	./setup --package
	cmake --preset release -DAMBLE_PYTHON=ON
	cmake --build --preset release
	cd build/release && cpack

bench:
	./setup --dev
	./setup --python
	cmake --preset release -DAMBLE_PYTHON=ON -DAMBLE_BENCHMARKS=ON
	cmake --build --preset release
	build/release/bench/amble_bench --csv build/bench.csv
	PYTHONPATH=build/release/python /usr/bin/python3 -B bench/robots.py build/release/bench/amble_bench
	build/release/bench/amble_micro

# As root where the folder, or the nearest one above it, may not be written.
install: build
	folder=$(PREFIX); while [ ! -e "$$folder" ]; do folder=$$(dirname "$$folder"); done; \
	if [ -w "$$folder" ]; then sudo=; else sudo=$(SUDO); fi; set -x; rm -f build/release/install_manifest.txt; $$sudo cmake --install build/release --prefix $(PREFIX)

# The reference of the public headers: build/doxygen/html. A warning is an error.
doxygen:
	./setup --docs
	mkdir -p build/doxygen
	{ cat docs/Doxyfile; printf 'INPUT ='; sed 's|^| include/amble/|' cmake/public_headers.txt | tr -d '\n'; echo; } | doxygen -

# The article about the reproduction, build/paper/article.pdf. Stops where text and ledgers differ (tools/article-numbers), and at a
# line that does not fit.
article: build
	./setup --article
	rm -rf build/paper
	mkdir -p build/paper
	tools/article-numbers build/release/src/cli/amble --check --tables build/paper/tables
	for figure in distance-five-min typical-15s; do \
	  rsvg-convert --stylesheet paper/figures.css -f pdf -o build/paper/$$figure.pdf build/paper/tables/paper/figures/$$figure.svg || exit 1; done
	cd paper && for pass in 1 2 3; do \
	  pdflatex -interaction=nonstopmode -halt-on-error -output-directory=../build/paper article >../build/paper/pdflatex.txt || \
	    { grep -A3 '^!' ../build/paper/pdflatex.txt; exit 1; }; \
	  [ $$pass != 1 ] || (cd ../build/paper && BIBINPUTS=../../paper: bibtex -terse article) || exit 1; done
	@! grep -E '^Overfull|undefined|multiply' build/paper/article.log
	@grep -q '(6 pages' build/paper/article.log || { grep 'Output written' build/paper/article.log; echo "expected six pages: shorten paper/article.tex"; exit 1; }
	@echo "now open build/paper/article.pdf"

# Twelve runs of the paper's study, drawn by this seed, repeated from nothing and compared with the ledger, digests included.
SAMPLE ?= 2013
reproduce-sample: build
	tools/spot-check build/release/src/cli/amble studies/paper.toml results/paper 12 $(SAMPLE) $(JOBS)

# Which lines of src the tests run, without those of page, oracles and intervals: build/coverage/index.html. Half an hour on two cores.
coverage:
	./setup --test
	./setup --coverage
	cmake --preset coverage
	cmake --build --preset coverage
	find build/coverage -name '*.gcda' -delete
	ctest --preset coverage -j $(JOBS); tests=$$?; \
	gcovr --root . --filter 'src/' --exclude-unreachable-branches --exclude-throw-branches --print-summary \
	  --html-details build/coverage/index.html --json-summary build/coverage/summary.json build/coverage && exit $$tests

clean:
	rm -rf build demo
