# `make demo` renders the scratched titanium plate, `make figures` the paper's other pictures, `make compare` judges the library by
# brute force and POV-Ray, `make test` checks everything.
# All of them install the Debian packages they need, as root or through sudo.

MAKEFLAGS += --no-print-directory
BUILD := build
OUT := out
JOBS := $(shell nproc 2>/dev/null || echo 2)
# cmake without a line for every file that it compiles.
CONFIGURE = cmake -S . -B $(BUILD) --log-level=NOTICE -DCMAKE_BUILD_TYPE=Release \
	-DCMAKE_RULE_MESSAGES=OFF -DCMAKE_TARGET_MESSAGES=OFF
PACKAGES := cmake libembree-dev libopenexr-dev libpng-dev pkg-config
SCENES := plate crossing aluminium car ring
TEST_PACKAGES := $(PACKAGES) g++ binutils valgrind

.DEFAULT_GOAL := help
.PHONY: help demo figures compare test bench page clean rust

help:
	@echo "make demo           render the plate's three views into $(OUT)/"
	@echo "make demo CHECK=1   and compare one sample per pixel with 256"
	@echo "make demo ARGS=...  with the renderer's own options: ARGS=--help lists them"
	@echo "make figures        the paper's Figures 5, 7 and 9 to 13 into $(OUT)/; half an hour or so"
	@echo "make figures SCENES=ring    Figures 7 and 9, and only some of the scenes: plate crossing aluminium car ring"
	@echo "make compare        the library against brute force and POV-Ray, which see the relief's own triangles: a table,"
	@echo "                    $(OUT)/compare.json and pictures in $(OUT)/compare/; ten minutes or so"
	@echo "make test           every check: Rust and C"
	@echo "make page           $(OUT)/index.html of all that the other commands left there, with FLIP maps; they make it themselves"
	@echo "make bench          what cross-sections, a million scratches, the index and rendering cost, beside earlier systems"
	@echo "                    and explicit geometry: $(OUT)/bench.json, $(OUT)/equal-error.png"
	@echo "make clean          remove $(BUILD)/, $(OUT)/ and target/"

# The demo reads no files: a library without them builds in half the time.
demo: BUILD := build/demo
demo: rust
	@scripts/need $(PACKAGES)
	@$(CONFIGURE) -DSTRIAE_FILES=OFF -DSTRIAE_BUILD_TESTS=OFF
	@cmake --build $(BUILD) --parallel $(JOBS) --target striae_render
	@$(BUILD)/c_examples/renderer/striae_render --out $(OUT) $(if $(CHECK),--check) $(ARGS)

figures: rust
	@scripts/need $(PACKAGES)
	@$(CONFIGURE) -DSTRIAE_BUILD_TESTS=OFF
	@cmake --build $(BUILD) --parallel $(JOBS) --target striae_figure7 striae_figure9 striae_render
	@$(BUILD)/c_examples/figure7/striae_figure7 $(OUT)
	@$(BUILD)/c_examples/figure9/striae_figure9 $(OUT)
	@for scene in $(SCENES); do $(BUILD)/c_examples/renderer/striae_render --scene $$scene --out $(OUT) $(ARGS) || exit 1; done
	@$(MAKE) page

# Like the demo it reads no files, and shares its build.
compare: BUILD := build/demo
compare: rust
	@scripts/need $(PACKAGES) povray
	@$(CONFIGURE) -DSTRIAE_FILES=OFF -DSTRIAE_BUILD_TESTS=OFF
	@cmake --build $(BUILD) --parallel $(JOBS) --target striae_compare
	@mkdir -p $(OUT)
	@$(BUILD)/c_examples/compare/striae_compare $(OUT)/compare $(ARGS)
	@$(MAKE) page

test: rust
	@scripts/need $(TEST_PACKAGES)
	@BUILD='$(BUILD)' JOBS='$(JOBS)' CONFIGURE='$(CONFIGURE)' scripts/test

bench: rust
	@scripts/need $(PACKAGES) librsvg2-bin
	@cargo bench --locked
	@$(CONFIGURE) -DSTRIAE_BUILD_TESTS=OFF
	@cmake --build $(BUILD) --parallel $(JOBS) --target striae_bench
	@mkdir -p $(OUT)
	@$(BUILD)/c_examples/bench/striae_bench $(OUT)
	@rsvg-convert $(OUT)/equal-error.svg -o $(OUT)/equal-error.png

# Of what the others left in $(OUT).
page: rust
	@scripts/need g++
	@cargo run --quiet --release --locked --manifest-path tools/page/Cargo.toml --target-dir target/page -- $(OUT)

clean:
	rm -rf $(BUILD) $(OUT) target

rust:
	@command -v cargo >/dev/null || { echo "cargo is missing: install Rust first, https://rustup.rs" >&2; exit 1; }
