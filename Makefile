# SPDX-License-Identifier: GPL-3.0-or-later
# rolling: build, test, reproduce. `make setup` installs what is missing on Debian, and says what
# other systems call it; `make table1` and `make check` do the rest. GNU make 3.81 and newer. The
# goals of those who develop are in tests/targets.mk.
ifeq ($(MAKELEVEL),0)
MAKEFLAGS += --jobs=$(shell nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
endif
export LC_ALL := C
unexport CDPATH
.DELETE_ON_ERROR:

# `make setup GOAL...` installs what these goals need, and only what is missing: no root when
# nothing is. A second make then sees what was installed.
ifneq ($(filter setup,$(MAKECMDGOALS)),)
goals := $(filter-out setup,$(MAKECMDGOALS))
.PHONY: setup $(goals)
setup:
	@cmd/install/setup.sh $(if $(goals),$(goals),check)
$(firstword $(goals)): setup
	@$(MAKE) --no-print-directory $(goals)
$(wordlist 2,$(words $(goals)),$(goals)): $(firstword $(goals)) ;
else

system   := $(shell uname -s 2>/dev/null)
CXX      ?= g++
CXXFLAGS ?= -O2
# No flag of the user's, behind which these stand, may fuse a multiplication and an addition or
# regroup a sum.
override CXXFLAGS += -ffp-contract=off -fno-unsafe-math-optimizations
override CXXFLAGS += -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion
override CPPFLAGS += -Ilib
LDLIBS   := -lgsl -lgslcblas -lfmt -lm
ifneq ($(filter Darwin FreeBSD,$(system)),)  # where libraries lie beside the system
others   := $(firstword $(wildcard /opt/homebrew /usr/local))
override CPPFLAGS += -isystem $(others)/include
override LDFLAGS  += -L$(others)/lib
endif
ifneq ($(system),Darwin)
override LDFLAGS  += -Wl,--as-needed
endif

# The target is replaced if what a command prints is new.
if_new = $1 >$@.new; if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

source := $(wildcard lib/*/*.cpp)
tool   := $(patsubst cmd/%.cpp,%,$(wildcard cmd/*.cpp))
object  = $(patsubst %.cpp,build/%.o,$1)

# A module is compiled as one source, build/lib/MODULE.cpp, which includes its files: in a third of
# the time. The files of cli are compiled apart, since a tool links only those that it calls.
whole  := $(filter-out cli,$(sort $(notdir $(patsubst %/,%,$(dir $(source))))))
of_lib := $(whole:%=build/lib/%.o) $(call object,$(filter lib/cli/%,$(source)))

.PHONY: all table1 paper samples figures report html check install uninstall static deb clean
.SECONDARY:
all: $(tool:%=bin/%)

bin/%: build/cmd/%.o build/lib.a
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS)

build/lib.a: $(of_lib)
	rm -f $@ && $(AR) rcs $@ $^

# A checkout has its commit in the version.
commit ?= $(if $(wildcard .git),$(addprefix +,$(shell \
            git describe --always --dirty=.modified --exclude='*' --abbrev=8 2>/dev/null)))
build/commit: $(if $(SHORT)$(filter install,$(MAKECMDGOALS)),,always)
	@mkdir -p $(@D)
	@$(call if_new,printf '%s\n' '$(commit)')
build/lib/base.o: build/commit
build/lib/base.o: override CPPFLAGS += -DROLLING_COMMIT='"$(commit)"'

# CLI11 runs once, and at -O2 it takes as long to compile as five other sources.
build/lib/cli/tool_options.o: override CXXFLAGS := $(CXXFLAGS:-O2=-Og)

build/lib/%.cpp: lib/%
	@mkdir -p $(@D)
	@printf '#include "%s"\n' $(patsubst lib/%,%,$(sort $(wildcard $</*.cpp))) >$@
build/%.o: build/%.cpp build/flags
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -MMD -MP -c -o $@ $<
build/%.o: %.cpp build/flags
	@mkdir -p $(@D)
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -MMD -MP -c -o $@ $<

# The compiler and its flags: a build with others compiles all again, but `make install` installs and
# SHORT=1 runs what was built.
flags := $(CXX) $(CPPFLAGS) $(CXXFLAGS)
build/flags: $(if $(SHORT)$(filter install,$(MAKECMDGOALS)),,always)
	@mkdir -p $(@D)
	@$(call if_new,printf '%s\n' '$(subst ','\'',$(flags))')
.PHONY: always

-include $(patsubst %.o,%.d,$(of_lib) $(call object,$(wildcard cmd/*.cpp)))

table1: all
	@PATH="$$PWD/bin:$$PATH" samples/table1.sh

# Each equation, table, figure and claim of the paper, for the samples and for another body.
another := simulate -K 0.7 -R 0.03 -a 1.2e-3 -b 0.1 --v0 -0.6 --memory 1e-3 --sensor pasco --seed 7
paper: all
	@PATH="$$PWD/bin:$$PATH"; export PATH; mkdir -p build; $(another) >build/another.csv && \
	{ samples/paper.sh && printf '\nAnother body, whose run.csv is made by: %s\n' '$(another)' && \
	  samples/paper.sh -K 0.7 -R 0.03 -m 0.9 build/another.csv; } >build/paper.txt && \
	mv build/paper.txt samples

# The raw runs: simulated, so that the answer is known; see samples/README.md.
sensor := --memory 5e-4 --damping 0.02 --sensor pasco
samples: bin/simulate
	set -e; seed=0; for scene in CF CR SF SR; do \
	  seed=$$((seed + 1)); file=samples/$$scene.csv; \
	  bin/simulate --scene samples/$$scene.toml $(sensor) --seed $$seed >$$file.new; \
	  mv $$file.new $$file; \
	done
	samples/exports/make.sh samples/exports

# Figures of the paper: each is drawn by the script of its name in samples/figures.
figure  := $(patsubst samples/figures/%.sh,%,\
             $(filter-out %/draw.sh,$(wildcard samples/figures/*.sh)))
figures: $(figure:%=figures/%.svg) $(figure:%=figures/%.png)
drawn_from := $(addprefix bin/,$(tool)) $(wildcard samples/*.sh samples/*.csv samples/*.toml) \
              samples/figures/draw.sh $(wildcard samples/figures/*.gp)
define draw
	@command -v gnuplot >/dev/null || \
	  { echo 'gnuplot is not installed; make setup figures installs it' >&2; exit 1; }
	@mkdir -p $(@D)
	$< -t $1 >$@.new && mv $@.new $@
endef
figures/%.svg: samples/figures/%.sh $(drawn_from)
	$(call draw,svg)
figures/%.png: samples/figures/%.sh $(drawn_from)
	$(call draw,png)

# One page with the table, the energy check and the figures in it; those of work-precision too
# where they have been made. It and the manual pages link to each other where mandoc can make them.
report: figures/report.html
figures/report.html: samples/report.sh samples/table1.sh $(figure:%=figures/%.svg) \
                     $(wildcard build/work-precision/*.svg) \
                     $(if $(shell command -v mandoc),figures/man/index.html) | all
	PATH="$$PWD/bin:$$PATH" $< figures \
	  $(if $(wildcard build/work-precision/CR.svg),build/work-precision) >$@.new && \
	  mv $@.new $@
	$(if $(shell command -v mandoc),cmd/install/html.sh figures/man && touch $@)

# The manual pages as one site of HTML.
html: figures/man/index.html
figures/man/index.html: cmd/install/html.sh $(wildcard man/*)
	$< $(@D)

# The whole suite; TESTS='tests/house/form.sh tests/tools' is a part of it.
check: all
	@PATH="$$PWD/bin:$$PATH" tests/run.sh $(or $(TESTS),build/unit)

# The names smooth and simulate are common: PROGRAM_PREFIX=roll- installs roll-smooth,
# roll-simulate, ... and their pages so. The script reads all of these from its environment, where
# no blank and no sign of the shell has a meaning.
PREFIX     ?= /usr/local
prefix      = $(PREFIX)
exec_prefix = $(prefix)
bindir      = $(exec_prefix)/bin
datarootdir = $(prefix)/share
datadir     = $(datarootdir)
mandir      = $(datarootdir)/man
docdir      = $(datarootdir)/doc/rolling
TOOLS       = bin
export bindir datadir mandir docdir PROGRAM_PREFIX DESTDIR TOOLS
install: all
	@cmd/install/install.sh install
uninstall:
	@cmd/install/install.sh uninstall

# build/rolling-VERSION-linux-ARCHITECTURE.tar.xz: static programs, which run on any Linux. Debian's
# fmt has no static library.
static: $(tool:%=build/static/bin/%) all
	@TOOLS=build/static/bin cmd/install/static.sh $$(uname -m)
build/static/bin/%: build/cmd/%.o build/lib.a build/cmd/install/fmt.o
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -static -o $@ $^ $(filter-out -lfmt,$(LDLIBS))

# build/rolling_VERSION_ARCHITECTURE.deb, of programs built with the flags of Debian's packages.
pathless  = reproducible=-fixfilepath,-fixdebugpath
of_debian = $(shell DEB_BUILD_MAINT_OPTIONS='hardening=+all $(pathless)' \
              DEB_CXXFLAGS_MAINT_STRIP=-g dpkg-buildflags --get $1)
deb: all
	@$(call copy,build/debian)
	$(MAKE) -C build/debian all commit='$(commit)' $(foreach f,CPPFLAGS CXXFLAGS LDFLAGS,$f='$(call of_debian,$f)')
	@TOOLS=build/debian/bin cmd/install/deb.sh

clean:
	rm -rf bin build figures

include tests/targets.mk
endif
