# Two commands matter: `make cast` and `make test`. Either sets up what it needs; `make help` lists the others.

PYTHON ?= python3
BLENDER ?= blender

# The newest bpy for this Python: "5.0". Where there is none, a sentence says why.
BPY := $(shell $(PYTHON) scripts/environment.py 2>/dev/null || echo "needs Python 3.11 or 3.13, cannot run $(PYTHON)")

ifeq ($(words $(BPY)),1)
VENV := .venv/bpy-$(BPY)
else
VENV := .venv/none
.venv/none/ready: ; $(error $(BPY); run make PYTHON=/path/to/python3.13 $(MAKECMDGOALS))
endif

# Python keeps what it has compiled, also where the system says that it shall not: the tests start many processes.
export PYTHONDONTWRITEBYTECODE :=

SCENE := blend_scenes/spheres_and_planes.blend

.PHONY: cast test test-full test-hostile test-all release-check test-blender test-in-blender test-window lint check-model docs lesson zip dist clean help

cast: $(VENV)/ready  ## render the example scene into out/ and print the report
	$(VENV)/bin/python scripts/cast.py $(SCENE) --output out

# One worker more than processors, since tests wait for processes that they start.
WORKERS ?= $(shell $(PYTHON) -c "import os; print(os.cpu_count() + 1)")

# The tests of a file stay together, since they share fixtures, and one window. A worker that dies, or a test that hangs,
# ends the run. The longest files come first (tests/tiers.py); pytest-xdist would begin with those of most tests.
BY_FILE = --dist loadfile --no-loadscope-reorder
PYTEST = $(VENV)/bin/python -m pytest --numprocesses $(WORKERS) --max-worker-restart 0 --timeout 600

test: $(VENV)/ready  ## run the tests with this Python, on all cores: each thing once, two to five minutes
	$(PYTEST) $(BY_FILE)

test-full: $(VENV)/ready  ## the same with all further examples, ten to twenty-five minutes
	$(PYTEST) $(BY_FILE) -m "not hostile"

test-hostile: $(VENV)/ready  ## try all hostile inputs, kills and full disks, some minutes; PART=1/4: a fourth of them
	$(PYTEST) tests/hostile tests/core/camera/test_guard.py -m hostile $(if $(PART),--part $(PART))

test-all:  ## run the tests on each supported bpy for which a Python is found, all but those in a window on the newest
	@$(PYTHON) scripts/environment.py test-all

release-check: lint docs dist test-all  ## before a release: all of it, with all hostile inputs

test-blender: test-in-blender test-window  ## run tests/blender inside a real Blender, and tests/gui in its window: BLENDER=/path

IF_BLENDER := command -v "$(BLENDER)" >/dev/null || { \
	echo "$$t: skipped, no program $(BLENDER); run make BLENDER=/path/to/blender $$t"; exit 0; };

test-in-blender: .venv/pure/ready  ## the first half of test-blender
	@t=$@; $(IF_BLENDER) "$(BLENDER)" --background --factory-startup --python-exit-code 1 \
		--python tests/run_in_blender.py -- .venv/pure tests/blender

test-window: .venv/pure/ready  ## the other half
	@t=$@; $(IF_BLENDER) BLENDER="$(BLENDER)" PYTHONPATH=.venv/pure $(PYTHON) -m pytest tests/gui -m "not hostile"

.venv/peers/ready: pyproject.toml  # other programs' readers, which Python 3.11 can install
	$(PYTHON) -m venv .venv/peers
	.venv/peers/bin/pip install --quiet --upgrade pip
	.venv/peers/bin/pip install --quiet --only-binary ouster-sdk ".[peers]"
	touch $@

lint: $(VENV)/ready  ## check style, types and the table of models
	$(VENV)/bin/ruff check
	$(VENV)/bin/mypy
	$(VENV)/bin/python scripts/make_docs.py --check

check-model: $(VENV)/ready  ## hold a camera model of your own to the contract of all models: MODEL=/path/to/its.py
	$(VENV)/bin/python -m pytest -q -m "" --model "$(MODEL)" tests/core/cameras tests/core/truth tests/core/errors \
		tests/core/camera/test_setting_derivatives.py

docs: .venv/docs/ready  ## build the documentation site in out/site/; without Blender, warnings are errors
	.venv/docs/bin/python -m sphinx -q -W --keep-going -c docs -d out/doctrees . out/site

lesson: .venv/numpy/ready  ## write the pages that are made of the code, the lesson for a browser among them; copy it to dist/
	.venv/numpy/bin/python scripts/make_docs.py
	mkdir -p dist
	cp docs/lesson/index.html dist/lesson.html

zip:  ## build the extension for Blender in dist/
	$(PYTHON) scripts/make_zip.py dist

dist: zip  ## build the extension for Blender, the wheel for pip and the lesson in dist/; needs Python and pip only
	$(PYTHON) -m pip wheel --quiet --no-deps --wheel-dir dist .
	rm -rf build
	cp docs/lesson/index.html dist/lesson.html

clean:  ## remove everything that these commands made
	rm -rf build out dist docs/api docs/cameras .venv addon/*.egg-info .hypothesis .mypy_cache .pytest_cache .ruff_cache
	find addon scripts tests -name __pycache__ -prune -exec rm -rf {} +

help:  ## show this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 17

# pip from outside installs into the environment, itself, too: no ensurepip needed, which some systems package apart.
# Python compiles what is imported; all of an environment would take 20 s of a processor.
INSTALL = $(PYTHON) -m pip --python $(@D)/bin/python install --quiet --no-compile

.venv/bpy-%/ready: pyproject.toml
	@echo "once: pip fetches bpy $*, 1.5 GB on disk, without a word, for some minutes"
	$(PYTHON) -m venv --without-pip $(@D)
	$(INSTALL) --editable '.[test]' 'bpy==$*.*' pip
	@touch $@

# Any Python from 3.11 on.
.venv/numpy/ready:
	$(PYTHON) -m venv --without-pip $(@D)
	$(INSTALL) numpy
	@touch $@

.venv/docs/ready: pyproject.toml
	$(PYTHON) -m venv --without-pip $(@D)
	$(INSTALL) --editable '.[docs]'
	@touch $@

# Pure Python only: Blender brings its own Python and its own numpy.
.venv/pure/ready: pyproject.toml
	$(PYTHON) -m pip install --quiet --upgrade --target $(@D) --only-binary :all: --platform any pytest
	@touch $@
