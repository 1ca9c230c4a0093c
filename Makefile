# Everything a newcomer types. `make` alone lists the targets.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
OUT := out

# Two workers fill the smallest machine that runs the tests; more gain nothing there.
WORKERS ?= 2

.DEFAULT_GOAL := help
.PHONY: help demo gallery test check samples vectors map clean

help: ## list these targets
	@awk -F ':.*## ' '/^[a-z]+:.*## / { printf "  make %-8s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(VENV)/.runtime $(VENV)/.opengl ## draw a sample and its comparison page into out/
	$(BIN)/gltf-iri samples $(OUT)/samples
	$(BIN)/gltf-iri render $(OUT)/samples/anodised-ramp/anodised-ramp.gltf -o $(OUT)/anodised-ramp.png
	$(BIN)/gltf-iri compare $(OUT)/samples/anodised-ramp/anodised-ramp.gltf -o $(OUT)/compare
	@echo "Look at $(OUT)/anodised-ramp.png and open $(OUT)/compare/index.html in a browser."

gallery: $(VENV)/.runtime $(VENV)/.opengl ## draw all samples, and ASSETS="folder …", onto one page in out/gallery
	$(BIN)/gltf-iri gallery $(OUT)/gallery samples $(ASSETS)

test: check $(VENV)/.opengl $(VENV)/.glslang ## check, then run every test
	$(BIN)/python -m pytest -n $(WORKERS)

check: $(VENV)/.development ## formatting, lint, types, and that no generated file is stale
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/python -m gltf_iri.generate --check

samples: $(VENV)/.runtime ## write samples/ anew from gltf_iri/samples
	$(BIN)/gltf-iri samples samples

vectors: $(VENV)/.development ## write the test vectors in spec/vectors anew, minutes
	$(BIN)/python -m gltf_iri.conformance spec/vectors

map: $(VENV)/.development $(VENV)/.opengl ## measure the map of cost and error anew, minutes on a quiet machine
	$(BIN)/gltf-iri bench accuracy -o spec/accuracy
	mv spec/accuracy/costs.json gltf_iri/planning/costs.json

clean: ## remove the virtual environment and everything made
	rm -rf $(VENV) $(OUT) build dist .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# What the machine must bring. As root on Debian or Ubuntu it is installed, elsewhere the one command is named.
# $(call install,PACKAGES,WHAT IS MISSING)
define install
	if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then \
	  apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $(1); \
	else \
	  echo "$(2). On Debian or Ubuntu type: sudo apt-get install -y $(1)" >&2; exit 3; \
	fi
endef

$(BIN)/python:
	@command -v $(PYTHON) >/dev/null || { \
	  echo "There is no $(PYTHON). Install Python 3.11 or later, or name it: make PYTHON=python3.12 …" >&2; exit 3; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "$(PYTHON) is older than Python 3.11. Name a later one: make PYTHON=python3.12 …" >&2; exit 3; }
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || { \
	  $(call install,python3-venv,Python's venv module is missing); }
	$(PYTHON) -m venv --clear $(VENV)

$(VENV)/.runtime: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

$(VENV)/.development: pyproject.toml | $(BIN)/python
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test]'
	@touch $@ $(VENV)/.runtime

# A real context is the only proof that OpenGL works: libraries may be there without a driver behind them.
opengl = $(BIN)/python -c 'from gltf_iri.rendering.context import create_context; create_context().release()'

$(VENV)/.opengl: | $(VENV)/.runtime
	@$(opengl) 2>/dev/null || { $(call install,libegl1 libgl1,OpenGL is missing) && $(opengl) 2>/dev/null; } || { \
	  echo "libegl1 and libgl1 are installed, yet OpenGL 3.3 does not start: this machine wants another driver." >&2; \
	  exit 3; }
	@touch $@

# Only tests want it: where it cannot be installed, those are skipped and say so.
$(VENV)/.glslang: | $(BIN)/python
	@command -v glslangValidator >/dev/null || ( $(call install,glslang-tools,glslangValidator is missing) ) || true
	@touch $@
