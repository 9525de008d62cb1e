# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# `make help` lists the targets. CMAKE_FLAGS adds options to the first configuration of a build tree,
# for example CMAKE_FLAGS=-DBUILD_SHARED_LIBS=ON.
export CMAKE_FLAGS
PREFIX ?= /usr/local
PACKAGES := wheels deb conan vcpkg conda docker consumers
MEASUREMENTS := bench-scaling bench-steps bench-edges bench-confidence bench-codec latency soak-test surface-figures

.PHONY: help build demo install test test-all test-python sanitize sanitize-thread format format-check tidy docs wheel \
        web test-web test-page test-arm64 test-windows build-macos packages $(PACKAGES) sbom \
        bench-compare bench-bags $(MEASUREMENTS) surface-study worlds-study invariance-study runs-study contact-sheet \
        map-image clean
.DEFAULT_GOAL := build

help: ## list the targets
	@sed -n 's/^\([a-z0-9-]*\):.* ## /\1\t/p' Makefile | expand -t 18

build: ## install missing tools, build the library and the command: build/flagstone
	@scripts/setup build
	@[ -e build/build.ninja ] || cmake --preset release $(CMAKE_FLAGS)
	@cmake --build build --target flagstone libflagstone

demo: build ## build the command, simulate a street, segment and score it
	@build/flagstone demo

install: build ## install the library, the command, its manual pages and completions under PREFIX (/usr/local)
	@cmake --build build --target libflagstone_baselines flagstone_shell_files
	@cmake --install build --prefix $(PREFIX)

test: ## build and test the library, the command and the Python package
	@scripts/setup build test python && scripts/test

test-all: ## also fuzzers, sanitizers, a Ray cluster and the documentation site
	@scripts/setup build test fuzz python docs web && scripts/test all

test-python: ## build and test the Python package; PYTHON selects another interpreter
	@scripts/setup build python && scripts/test python

sanitize: ## run the C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@scripts/setup build test && scripts/test sanitize

sanitize-thread: ## run the C++ tests under ThreadSanitizer
	@scripts/setup build test && scripts/test sanitize-thread

format: ## format the C and C++ sources
	@scripts/setup format && scripts/format -i

format-check: ## fail if `make format` would change a file
	@scripts/setup format && scripts/format --dry-run -Werror

tidy: ## run clang-tidy over the library and the command
	@scripts/setup build test tidy && scripts/tidy

docs: ## build the documentation site, warnings are errors: build/site/index.html
	@scripts/setup python docs && NO_MKDOCS_2_WARNING=1 "$$(scripts/python environment)" -m mkdocs build --strict

wheel: ## build the Python wheel for glibc 2.31 into dist/ and test it in an empty environment; PYTHON selects another interpreter
	@scripts/setup build wheel && wheel=$$(scripts/wheel) && scripts/check-wheel "$$wheel"

web: build ## build the WebAssembly module and the npm package into dist/, and the page into web/page/dist, print sizes
	@scripts/setup web && scripts/web package && scripts/web-page build

test-page: web ## test the page in web/page/dist in headless Chromium; screenshots in web/page/screenshots
	@scripts/setup test && scripts/web-page test

test-web: ## compare all bytes and times of the WebAssembly module with the native build; on every scan of FLAGSTONE_DATA and in every scene
	@scripts/setup build test python web && scripts/web build && scripts/test web

test-arm64: ## run the tests of the library and the readers on 64-bit Arm under QEMU, compare all bytes with the native build
	@scripts/setup build test arm64 && scripts/cross arm64

test-windows: ## the same on Windows under Wine
	@scripts/setup build test windows && scripts/cross windows

build-macos: ## compile the library and the readers for macOS on 64-bit Arm; nothing is run
	@scripts/setup build macos && scripts/cross macos

packages: ## build and test every package below, print a table; a package that fails does not stop the others
	@scripts/setup build packages && scripts/packages/run $(PACKAGES)

wheels: ## build the source distribution and the wheels for Python 3.10 to 3.13, test each of them
deb: ## build the Debian packages and test them in a new Debian system
conan: ## build the Conan package and test it
vcpkg: ## test the vcpkg port; VCPKG_ROOT: the directory of vcpkg, if you have it
conda: ## build the conda package with libraries of the system and test it
docker: ## check the Dockerfile, build the image and test it
consumers: ## build examples/consumer from the sources and with `make install`
$(PACKAGES):
	@scripts/setup build packages && scripts/packages/run $@

sbom: ## write the bill of materials: build-packages/flagstone.cdx.json
	@mkdir -p build-packages && scripts/sbom > build-packages/flagstone.cdx.json && echo build-packages/flagstone.cdx.json

bench-compare: build ## compare the speed of METHOD in the working tree and in REVISION on SCANS
	@python3 bench/compare.py $(if $(REVISION),--revision $(REVISION)) $(if $(METHOD),--method $(METHOD)) $(if $(TARGET),--target $(TARGET)) $(SCANS)

bench-scaling: PROGRAM = scaling ## time and memory by points, beams, bins and threads
bench-steps: PROGRAM = sharpness ## errors of the surface at kerbs, ditches and drops
bench-edges: PROGRAM = edges ## labels at kerbs, ditches and drops, and of ghost points
bench-confidence: PROGRAM = confidence ## confidence of the surface and its errors in all simulated scenes
bench-codec: PROGRAM = codec ## time to read, label and divide PointCloud2 messages
latency: PROGRAM = latency ## time of 10,000 different scans, including adversarial ones
soak-test: PROGRAM = soak ## memory of one segmenter over 100,000 different scans
surface-figures: PROGRAM = surface_stages ## draw the images of docs/explanation/surface.md
$(MEASUREMENTS):
	@scripts/setup build plot && scripts/benchmark $(PROGRAM)

bench-bags: ## time `flagstone bag` with each format of bags; BAGS: options of bench/bags.py
	@scripts/setup build python && scripts/python install && "$$(scripts/python environment)" bench/bags.py $(BAGS)

surface-study: build ## measure accuracy, write tables of docs/benchmarks/accuracy.md and robustness.md; WORK: a directory with 4 GB free
	@scripts/setup plot && "$$(scripts/python plotting)" bench/surface_study.py run --work $(or $(WORK),out/study)
	@"$$(scripts/python plotting)" bench/accuracy_study.py run --work $(or $(WORK),out/study)

worlds-study: build ## measure both methods in all simulated scenes, write tables of docs/benchmarks/robustness.md; WORK: a directory with 8 GB free
	@scripts/setup plot && "$$(scripts/python plotting)" bench/worlds_study.py run --work $(or $(WORK),out/worlds)

invariance-study: build ## shuffle, double, turn and flip real scans, write tables of docs/benchmarks/robustness.md; WORK: a directory with 1 GB free
	@scripts/setup plot && "$$(scripts/python plotting)" bench/invariance_study.py run --work $(or $(WORK),out/invariance)

runs-study: build ## measure labels, maps and moving points of simulated and real runs, write tables of docs/benchmarks/runs.md; WORK: a directory with 25 GB free
	@scripts/setup plot && "$$(scripts/python plotting)" bench/runs_study.py run --work $(or $(WORK),out/runs)

contact-sheet: build ## draw every scene as seen by three sensors: docs/images/worlds.png; SHEET: options of bench/contact_sheet.py
	@scripts/setup plot && "$$(scripts/python plotting)" bench/contact_sheet.py $(SHEET)

map-image: build ## simulate and map a run and draw its ground and moving points: docs/images/map.png; IMAGE: options of bench/map_image.py
	@scripts/setup plot && "$$(scripts/python plotting)" bench/map_image.py $(IMAGE)

clean: ## remove the build trees
	@rm -rf build build-python build-tidy build-fuzz build-thread build-sanitize build-sanitize-thread build-compare build-web build-packages
	@rm -rf build-arm64 build-windows build-macos
	@rm -rf web/dist web/page/dist web/page/public/samples web/page/screenshots
