# Pintle from a fresh checkout: `make demo` and `make test` install what is missing, build, and run.
JOBS   ?= $(shell nproc)
PREFIX ?= /usr/local
# Seconds that each fuzzer runs.
FUZZ_SECONDS ?= 60

CONFIGURE := cmake -G Ninja -S .
# What is seldom changed and built again, for this machine: many sources of a room are compiled together, for the registers of its processor,
# and only the plane, which is all that model files know.
RELEASE   := -DPINTLE_TESTS=OFF -DPINTLE_UNITY=ON -DPINTLE_UNITY_SOURCES=40 -DPINTLE_SPACE=OFF -DPINTLE_REGISTERS=HOST
BUILD     := cmake --build
CLANG     := clang++-14
# Line numbers in the sanitizers' traces: a quarter of the time to build.
DEBUG_INFO := -g1
# Suites that take long under sanitizers in a build without the whole runs (cmake/tests.cmake).
LONG := Slow|Scene|BlockPattern|Envelope|LargeModels|CompareSolvers|TreeMethods|CheckDifferences|CheckBatteries
say        = @printf '\n=== %s\n' "$(1)"

.PHONY: help setup build build-demo demo test install bench fuzz web-check studio studio-test studio-browser-test format clean
.PHONY: paper figure9 published
.PHONY: check-sources test-release test-package test-clang test-all mutants constants

help:
	@echo "make demo       install missing packages, build, run the paper's four-bar, write its report"
	@echo "make test       install missing packages, build and run every test and check; 25 minutes on two cores"
	@echo "make test-all   also with a second compiler and under sanitizers, and the build of make build: an hour"
	@echo "make build      the optimised program, build/release/bin/pintle"
	@echo "make install    library, headers and program to PREFIX (now $(PREFIX))"
	@echo "make bench      work-precision against SUNDIALS, Simbody and MuJoCo, a quarter of an hour; QUICK=1: one minute"
	@echo "make paper      the paper's numbered results: docs/paper/README.md and its pictures"
	@echo "make figure9    the paper's Figure 9 only"
	@echo "make published  published benchmark problems with their own measures"
	@echo "make fuzz       fuzz the reader for FUZZ_SECONDS (now $(FUZZ_SECONDS)) per fuzzer"
	@echo "make studio     the studio: its kernel as WebAssembly, its pages, and pintle studio that serves them"
	@echo "make studio-test  the studio's tests in Node; the WebAssembly kernel gives the native one's numbers"
	@echo "make studio-browser-test  the built studio in chromium: drawing, every template, broken models, axe, sizes"
	@echo "make web-check  compile the library with emscripten"
	@echo "make mutants    changes lines of the sources and lists what no test notices: an hour; ROOMS=laws SAMPLE=40: one room"
	@echo "make constants  what becomes of runs when each constant of the numerics is halved and doubled: an hour; docs/theory/constants.md"
	@echo "make format     clang-format every source"
	@echo "make clean      remove build/ and out/"

setup:
	@tools/setup.sh build

build: setup
	@$(CONFIGURE) -B build/release $(RELEASE) >/dev/null
	@$(BUILD) build/release -j $(JOBS)

# The program alone: neither ensembles, pictures, the studio's server nor the library to install.
build-demo: setup
	@$(CONFIGURE) -B build/release $(RELEASE) >/dev/null
	@$(BUILD) build/release -j $(JOBS) --target pintle_cli

demo: build-demo
	@mkdir -p out
	@build/release/bin/pintle run mechanisms/four_bar.toml --out out/four-bar --force
	@build/release/bin/pintle report out/four-bar --out out/four-bar.html >/dev/null
	@echo "The results are in out/four-bar: $$(ls out/four-bar | paste -sd ' ')"
	@echo "See them move; open this page in a browser: $(CURDIR)/out/four-bar.html"

# Everything below runs one after the other, so that the log reads in order and memory suffices.
test:
	@tools/setup.sh build test
	@$(MAKE) --no-print-directory check-sources
	@$(MAKE) --no-print-directory test-release
	@$(MAKE) --no-print-directory test-package
	$(call say,all tests passed)

# Before a release, and after changes of memory or types: an hour.
test-all: test
	$(call say,the program as make demo and make build build it)
	@$(MAKE) --no-print-directory build
	@$(MAKE) --no-print-directory test-clang

check-sources:
	$(call say,order of rooms and habits)
	@bash -n tools/setup.sh tools/web_check.sh tools/studio.sh
	@python3 tools/check_sources.py
	@python3 tools/constants.py --check

test-release:
	$(call say,release build and all tests)
	@$(CONFIGURE) -B build/test -DPINTLE_WERROR=ON -DPINTLE_UNITY=ON >/dev/null
	@$(BUILD) build/test -j $(JOBS)
	@ctest --test-dir build/test -j $(JOBS) --output-on-failure --no-tests=error

test-package: | build/test
	$(call say,the installed package and a program outside the tree)
	@rm -rf build/prefix build/outside
	@cmake --install build/test --prefix build/prefix >/dev/null
	@$(CONFIGURE)/examples/outside -B build/outside -DCMAKE_PREFIX_PATH=$(CURDIR)/build/prefix >/dev/null
	@$(BUILD) build/outside
	@build/outside/pendulum
	@cd build/outside && ./sweep

build/test:
	@$(MAKE) --no-print-directory test-release

# The second compiler: warnings are errors, tests under the address and undefined-behaviour sanitizers, what the
# fuzzers have found among them. Suites that integrate for long, and the programs, are left to the release build;
# make test-sanitized has them all, make fuzz looks for more.
test-clang:
	$(call say,$(CLANG) without warnings; tests under the sanitizers)
	@$(MAKE) --no-print-directory build/clang WHOLE=OFF CLI=OFF FUZZ=OFF DEBUG_INFO=
	@ctest --test-dir build/clang -j $(JOBS) --output-on-failure --no-tests=error -E '$(LONG)'

test-sanitized:
	@tools/setup.sh build test
	@$(MAKE) --no-print-directory build/clang
	@ctest --test-dir build/clang -j $(JOBS) --output-on-failure --no-tests=error

.PHONY: build/clang test-sanitized
build/clang:
	@$(CONFIGURE) -B build/clang -DCMAKE_CXX_COMPILER=$(CLANG) -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 $(DEBUG_INFO)" \
	  -DPINTLE_WHOLE_RUN_TESTS=$(or $(WHOLE),ON) -DPINTLE_CLI=$(or $(CLI),ON) -DPINTLE_SANITIZE=ON -DPINTLE_FUZZ=$(or $(FUZZ),ON) -DPINTLE_WERROR=ON -DPINTLE_UNITY=ON >/dev/null
	@$(BUILD) build/clang -j $(JOBS)

fuzz:
	@tools/setup.sh build test
	@$(MAKE) --no-print-directory build/clang
	@tools/fuzz.sh build/clang $(FUZZ_SECONDS)

mutants:
	@tools/setup.sh build test
	@python3 tools/mutants.py --jobs $(JOBS) $(if $(ROOMS),--rooms $(ROOMS)) $(if $(SAMPLE),--sample $(SAMPLE))

constants:
	@tools/setup.sh build
	@python3 tools/constants.py --build --seconds 86400 --write

bench:
	@tools/setup.sh build bench
	@$(CONFIGURE) -B build/bench -DPINTLE_TESTS=OFF -DPINTLE_BENCH=ON >/dev/null
	@$(BUILD) build/bench -j $(JOBS)
	@mkdir -p out/bench
	@build/bench/bin/pintle-bench --json out/bench/curves.json curves --write out/bench $(if $(QUICK),--quick)
	@echo "Pictures, a page and every number are in out/bench."

# Both programs need nothing beyond what the program itself needs.
build/release/bin/%: setup
	@$(CONFIGURE) -B build/release $(RELEASE) >/dev/null
	@$(BUILD) build/release -j $(JOBS) --target $(subst -,_,$*)

paper: build/release/bin/pintle-paper
	@build/release/bin/pintle-paper

figure9: build/release/bin/pintle-paper
	@build/release/bin/pintle-paper --only figure-9

published: build/release/bin/pintle-published
	@build/release/bin/pintle-published

studio: build
	@tools/setup.sh web
	@tools/studio.sh
	@echo "build/studio works from any web server; build/release/bin/pintle studio serves it with this folder's models."

studio-test:
	@tools/setup.sh build test web
	@tools/studio.sh kernel
	@$(CONFIGURE) -B build/test -DPINTLE_WERROR=ON -DPINTLE_UNITY=ON >/dev/null
	@$(BUILD) build/test -j $(JOBS) --target pintle_answers
	@PINTLE_ANSWERS=$(CURDIR)/build/test/bin/pintle-answers tools/studio.sh test

studio-browser-test: studio
	@PINTLE=$(CURDIR)/build/release/bin/pintle tools/studio.sh browser

web-check:
	@tools/setup.sh web build
	@tools/web_check.sh

install: build
	cmake --install build/release --prefix $(PREFIX)

format:
	@command -v clang-format >/dev/null || { echo "clang-format is missing (apt-get install clang-format)"; exit 1; }
	find include src cli tests bench examples -name '*.h' -o -name '*.cpp' | xargs clang-format -i

clean:
	rm -rf build out
