# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# `make help` lists what there is. CMAKE_FLAGS adds options to the first configuration of a build tree,
# for example CMAKE_FLAGS=-DFLAGSTONE_WARNINGS_AS_ERRORS=OFF.
export CMAKE_FLAGS
PREFIX ?= /usr/local

.PHONY: help build demo test test-python test-ray wheel docs sanitize sanitize-thread format format-check tidy bench-scaling latency primitives bench-steps \
        bench-edges soak-test bench-compare surface-study surface-figures worlds-study contact-sheet install clean
.DEFAULT_GOAL := build

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 16

build: ## install what is missing, build the command: build/flagstone
	@scripts/setup build && scripts/build

demo: build ## build, then simulate a street, segment it and score the result
	@build/flagstone demo

test: ## install what is missing, build and run every test, short fuzz runs included
	@scripts/setup build test python docs && scripts/test

test-python: ## build and test the Python package alone; PYTHON names another interpreter
	@scripts/setup build python && scripts/test-python

wheel: ## build the Python package's wheel into dist/, and use it in an empty environment; PYTHON names another interpreter
	@scripts/setup build python && wheel=$$(scripts/wheel) && scripts/check-wheel "$$wheel"

sanitize: ## run the tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@scripts/setup build test && scripts/test sanitize

sanitize-thread: ## run the tests under ThreadSanitizer
	@scripts/setup build test && scripts/test sanitize-thread

test-ray: ## a Ray cluster of three nodes, one of them killed: two minutes; of the environment that test-python makes
	@scripts/setup build python && scripts/test-python -m slow python/tests/test_ray_cluster.py

docs: ## build all documentation as one site, warnings are errors: build/site/index.html
	@scripts/setup python docs && scripts/docs

format: ## format the C++ sources
	@scripts/setup format && scripts/format -i

format-check: ## fail where `make format` would change something
	@scripts/setup format && scripts/format --dry-run -Werror

tidy: ## run clang-tidy over our sources
	@scripts/setup build test tidy && scripts/tidy

bench-scaling: ## time and memory over points, beams, bins and threads; draws docs/images/growth.png
	@scripts/setup build benchmark plot && scripts/benchmark growth

latency: ## time of 10,000 different scans, with those meant to take long
	@scripts/setup build benchmark && scripts/benchmark latency

primitives: ## time of each step for every instruction set
	@scripts/setup build benchmark && scripts/benchmark primitives

bench-steps: ## how sharp the surface shows kerbs, ditches and drops of known shape
	@scripts/setup build benchmark && scripts/benchmark sharpness

bench-edges: ## what methods make of the ground on both sides of kerbs, ditches and drops, and of ghosts below
	@scripts/setup build benchmark && scripts/benchmark edges

soak-test: ## 100,000 different scans by one segmenter: does it hold its memory? draws docs/images/soak.png
	@scripts/setup build benchmark plot && scripts/benchmark soak

bench-compare: build ## is METHOD in the working tree slower than in REVISION, on SCANS?
	@python3 bench/compare.py $(if $(REVISION),--revision $(REVISION)) $(if $(METHOD),--method $(METHOD)) $(SCANS)

worlds-study: build ## measures both methods in every simulated world, writes docs/robustness.md; WORK: a folder with 8 GB to spare
	@scripts/setup plot && "$$(scripts/plotting-python)" bench/worlds_study.py run --work $(or $(WORK),out/worlds)

surface-study: build ## measures the method surface, writes the tables of docs/surface.md; WORK: a folder with 4 GB to spare
	@scripts/setup plot && "$$(scripts/plotting-python)" bench/surface_study.py run --work $(or $(WORK),out/study)

surface-figures: ## draws the figures of docs/surface.md
	@scripts/setup build benchmark plot && scripts/benchmark surface_stages

contact-sheet: build ## draws every scene as three sensors see it: docs/images/worlds.png; SHEET: options of bench/contact_sheet.py
	@scripts/setup plot && "$$(scripts/plotting-python)" bench/contact_sheet.py $(SHEET)

install: build ## install the library and the command under PREFIX (/usr/local)
	@cmake --install build --prefix $(PREFIX)

clean: ## remove the build trees
	@rm -rf build build-python build-fuzz build-thread build-sanitize build-sanitize-thread build-compare
