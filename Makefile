# make run      runs a scene:  make run SCENE=couplet ARGS='--set law=brittle'   results go to results/
# make test     style, types, then the tests
# make bench    speed, into bench.json
# make report   the verification report: all cases and studies, results/report.html (long; ARGS="--quick --only cases" is not)
# make docs     the documentation, as a site that opens without a network: site/index.html
# make lint     style and types only
# make clean    removes what the others made, results/ excepted
# Each sets up .venv first where that is needed, and on Debian the libraries that gmsh lacks (.ci/setup). `make run`
# installs what a run needs; the others install the tools of tests and documentation as well.

SCENE ?= wallette-mode-1
ARGS ?=
PYTHON ?= python3
export PYTHON
PY := .venv/bin/python
# What of the standard library differs from system to system; other packages have no types in that look, so that it takes
# seconds.
ASKS := asyncio|ctypes|errno|fcntl|locale|mmap|multiprocessing|os|posix|pwd|resource|select|selectors|shutil|signal|socket|subprocess|sys|tempfile|threading|time
OF_A_SYSTEM := --follow-imports=skip --no-warn-unused-ignores --no-warn-redundant-casts --disable-error-code var-annotated

.PHONY: run test bench report docs lint clean

run: .venv/.core
	@.venv/bin/masonry run $(SCENE) $(ARGS)

test: lint
	@echo "pytest"
	@$(PY) -m pytest -n auto --dist loadfile $(ARGS)

bench: .venv/.ready
	@$(PY) -m pytest benchmarks -m "" --benchmark-json=bench.json $(ARGS)

report: .venv/.ready
	@$(PY) -m verification.report $(ARGS)

docs: .venv/.ready
	@$(PY) -m sphinx -W --keep-going -q -d build/trees docs site $(ARGS)
	@echo "site/index.html"

lint: .venv/.ready
	@echo "ruff check"
	@$(PY) -m ruff check .
	@$(PY) -m ruff format --check .
	@echo "mypy"
	@$(PY) -m mypy
	@echo "mypy as on Windows and on macOS, of what asks the system"
	@for system in win32 darwin; do \
		$(PY) -m mypy --platform $$system --cache-dir .mypy_cache/$$system $(OF_A_SYSTEM) \
			$$(grep -rlE "^ *(import|from) ($(ASKS))\b" --include=*.py geometry masonry verification) || exit 1; done

clean:
	@[ ! -e .venv ] || [ -e .venv/.ours ] || [ -e .venv/.core ] || { echo ".venv was not made by make: delete it yourself" >&2; exit 1; }
	rm -rf .venv build site jupyter_execute docs/_generated *.egg-info bench.json .pytest_cache .mypy_cache .ruff_cache .hypothesis .benchmarks
	find geometry masonry verification tests benchmarks -name __pycache__ -prune -exec rm -rf {} +

# A stamp holds the folder that .venv was made in: a copied, moved or broken .venv is made again.
runs := $(shell $(PY) -c 'import importlib.util as u, sys; sys.exit(not u.find_spec("numba"))' 2>/dev/null && echo yes)
stamped = $(shell [ "$$(cat .venv/$(1) 2>/dev/null)" = "$$(pwd -P)" ] && echo $(runs))
ifneq ($(call stamped,.core),yes)
.PHONY: .venv/.core
endif
ifneq ($(call stamped,.ready),yes)
.PHONY: .venv/.ready
endif

.venv/.core: pyproject.toml .ci/setup .ci/apt
	@.ci/setup core

.venv/.ready: pyproject.toml .ci/setup .ci/apt
	@.ci/setup
