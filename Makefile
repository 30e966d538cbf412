# SPDX-FileCopyrightText: 2026 The tactile_push authors
# SPDX-License-Identifier: Apache-2.0
# make demo: run the demonstration; make test: run all tests; make test-quick: quick unit tests;
# make lint: check without testing; make docs: build the documentation; make bench: measure speeds;
# make faults: inject every fault; make fuzz: spoil every input and surroundings; make soak: run for long;
# make placing: place objects 2,000 times, and 100 times on MuJoCo.
# Each sets up .venv the first time.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/ready
TEST_READY := $(VENV)/ready-to-test
INSTALL := $(BIN)/python -m pip install --quiet --disable-pip-version-check --editable

# Tests of real nodes and messages, which unit tests are not.
GRAPH := test/faults test/fuzzing test/hostile test/nodes test/playing test/recording \
  test/soaking test/system test/testing
# Four processes on two cores: while some wait for nodes the others compute. A file's tests share
# what was started for them, so each process begins with its part of the files.
PYTEST := $(BIN)/python -m pytest --numprocesses 4 --dist worksteal

# Python keeps its byte code, whatever the user has set: the tests start hundreds of processes.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: demo test test-quick docs lint bench faults fuzz soak placing clean

demo: $(READY)
	$(BIN)/tactile_push demo

test: lint
	$(PYTEST)

test-quick: $(TEST_READY)
	$(PYTEST) --numprocesses 2 -m 'not slow' $(GRAPH:%=--ignore=%)

docs: $(TEST_READY)
	$(BIN)/python -m sphinx --fail-on-warning --keep-going --quiet docs out/docs
	@echo 'documentation: out/docs/index.html'

bench: $(TEST_READY)
	$(BIN)/python -m pytest benchmarks/bench_*.py -s --benchmark-columns=min,median,stddev,rounds

faults: $(TEST_READY)
	mkdir -p out
	PYTHONPATH=test $(BIN)/python -m faults --json out/faults.json
	PYTHONPATH=test $(BIN)/python -m faults.doctored

fuzz: $(TEST_READY)
	PYTHONPATH=test $(BIN)/python -m fuzzing
	PYTHONPATH=test $(BIN)/python -m hostile

soak: $(TEST_READY)
	PYTHONPATH=test $(BIN)/python -m soaking

placing: $(TEST_READY)
	mkdir -p out && rm -f out/placing.jsonl out/placing_mujoco.jsonl
	$(BIN)/python benchmarks/placing.py --json out/placing.jsonl
	$(BIN)/python benchmarks/placing.py --physics mujoco --json out/placing_mujoco.jsonl

lint: $(TEST_READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/reuse lint --quiet

$(READY): setup.py setup.cfg pyproject.toml tactile_push/interface.py
	@command -v $(PYTHON) >/dev/null || \
	  { echo "make: $(PYTHON) not found; expected Python 3.10 to 3.13, set PYTHON=" >&2; exit 2; }
	@$(PYTHON) -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 13))' || \
	  { echo "make: $$($(PYTHON) --version) is not supported; expected Python 3.10 to 3.13, set PYTHON=" >&2; exit 2; }
	@$(PYTHON) -c 'import venv, ensurepip' 2>/dev/null || \
	  { echo "make: $(PYTHON) has no venv module; install it (Debian, Ubuntu: apt install python3-venv)" >&2; exit 2; }
	$(PYTHON) -m venv $(VENV)
	$(INSTALL) '.[ros,watch]'
	touch $@

$(TEST_READY): $(READY)
	$(INSTALL) '.[docs,ros,test]'
	touch $@

clean:
	rm -rf $(VENV) build install log out *.egg-info
