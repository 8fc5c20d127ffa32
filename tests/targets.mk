# SPDX-License-Identifier: GPL-3.0-or-later
# What only those need who develop: the tests and how they are built, other compilers and machines,
# analysis, measurements. The Makefile includes it.
# A sanitizer does not link statically.
static_libc := $(if $(findstring -fsanitize,$(CXXFLAGS)),,$(wildcard /usr/lib/*/libgsl.a))
target := number reader scene $(tool)

.PHONY: check-arm64 check-clang check-libcxx check-long static-arm64 fuzz sanitize coverage-lines \
        mutate coverage bad-runs lab-rates extremes peers results work-precision work-precision-signal bench \
        lint

# The unit tests of a module are one source, which parses headers and Catch2 once, in a third of the
# time: the headers of its files, then each file in a namespace of its own. They are compiled with -Og.
module   := $(notdir $(patsubst %/,%,$(wildcard tests/unit/*/))) pipeline
of_test  := $(module:%=build/tests/%_tests.o)
of_bench := $(call object,$(wildcard tests/bench/*.cpp tests/fuzz/*.cpp))
-include $(patsubst %.o,%.d,$(of_test) $(of_bench) build/tests/fused/fused.o) \
         $(shell find build/fused -name '*.d' 2>/dev/null)
without_time := $(patsubst %,build/tests/bench/%.o,coverage troubles ulp)
$(of_test) build/catch_main.o $(without_time): override CXXFLAGS := $(CXXFLAGS:-O2=-Og)
$(of_test): override CPPFLAGS += -Itests
.SECONDEXPANSION:
build/tests/%_tests.cpp: $$(wildcard $$(addsuffix $$*,tests/unit/ tests/) tests/unit/$$*/*.cpp tests/$$*/*.cpp)
	@mkdir -p $(@D)
	@{ cat $(filter %.cpp,$^) | grep '^#include' | grep -v '[.]inc"' | sort -u; \
	  for file in $(filter %.cpp,$(^:tests/%=%)); do \
	    printf 'namespace %s {\n#include "%s"\n}\n' "$$(basename $$file .cpp)" $$file; done; } >$@

# Catch2 brings its own main: a library, or version 2 without one a header, which is compiled; so it is
# where flags change the containers of the C++ library.
catch_library := $(if $(wildcard /usr/include/catch2/catch.hpp),\
                   $(if $(findstring -D_GLIBCXX,$(CPPFLAGS) $(CXXFLAGS)),,\
                     $(if $(wildcard /usr/lib/libCatch2WithMain.a),-lCatch2WithMain)),\
                   -lCatch2Main -lCatch2)
catch_main := $(if $(strip $(catch_library)),,build/catch_main.o)
build/unit: $(of_test) $(catch_main) build/lib.a
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS) $(catch_library)

build/catch_main.o:
	@mkdir -p $(@D)
	printf '#define CATCH_CONFIG_MAIN\n#include <catch2/catch.hpp>\n' | \
	  $(CXX) $(CXXFLAGS) -x c++ -c -o $@ -

# The unit tests of one module of lib/, by themselves: build/unit-fit.
build/unit-%: build/tests/%_tests.o $(catch_main) build/lib.a
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS) $(catch_library)

# The exact arithmetic built as it is, and with flags in front of the project's that would fuse
# multiplications and additions: tests/pipeline/fused.sh compares what the two print, and smooth and
# differentiate with their sums built so.
has_fma := $(shell grep -qw avx2 /proc/cpuinfo 2>/dev/null && grep -qw fma /proc/cpuinfo && \
                   uname -m | grep -x x86_64)
build/fused/obj/%.o: %.cpp build/flags
	@mkdir -p $(@D)
	$(CXX) $(CPPFLAGS) -O3 -march=x86-64-v3 -ffp-contract=fast $(filter-out -O%,$(CXXFLAGS)) \
	  -MMD -MP -c -o $@ $<
built_so = $(patsubst %,build/fused/obj/build/lib/%.o,$1)
build/fused/fused: build/fused/obj/tests/fused/fused.o $(call built_so,contact law motion ode)
build/fused/plain: build/tests/fused/fused.o
$(addprefix build/fused/bin/,smooth differentiate): build/fused/bin/%: build/cmd/%.o $(call built_so,signal)
fused := $(addprefix build/fused/,plain fused bin/smooth bin/differentiate)
$(fused): build/lib.a
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $(filter %.o,$^) $< $(LDLIBS)

# What the suite does not build rots: every source is compiled, those of measurements too.
bench := $(patsubst tests/bench/%.cpp,build/bench/%,$(filter-out %/coverage.cpp,\
           $(wildcard tests/bench/*.cpp))) build/coverage
check: build/unit build/shim.so $(bench) $(target:%=build/replay/%) $(if $(has_fma),$(fused)) \
       $(if $(static_libc),$(tool:%=build/static/bin/%))

# Most of the suite on arm64, through qemu: make setup check-arm64.
check-arm64: all
	@$(call copy,build/arm64)
	tests/arm64.sh build/arm64

# build/rolling-VERSION-linux-aarch64.tar.xz, built likewise; its Table 1 is compared.
static-arm64: all
	@$(call copy,build/arm64)
	tests/arm64.sh build/arm64 $(tool:%=build/static/bin/%)
	@TOOLS=build/arm64/build/static/bin STRIP=aarch64-linux-gnu-strip cmd/install/static.sh aarch64

# tests/faults preloads it into the tools: it may not depend on the C++ library or on a sanitizer.
build/shim.so: tests/faults/shim.cpp
	@mkdir -p $(@D)
	$(CXX) -O1 -Wall -Wextra -shared -fPIC -o $@ $<

# Fuzz targets: the readers, and each tool with its main() under another name. build/replay runs
# them on the files of tests/fuzz/corpus; `make fuzz` looks for more, SECONDS for each, in a copy
# that clang builds for its fuzzer.
build/tests/fuzz/%.o: CPPFLAGS += -Itests/fuzz
$(tool:%=build/fuzz/%.o): build/fuzz/%.o: build/cmd/%.o tests/fuzz/tool.cpp tests/fuzz/streams.h
	@mkdir -p $(@D)
	objcopy --redefine-sym main=_Z9tool_mainiPPc $< $(@:.o=-main.o)
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -DTOOL='"$*"' -c -o $(@:.o=-target.o) tests/fuzz/tool.cpp
	$(LD) -r -o $@ $(@:.o=-main.o) $(@:.o=-target.o)
build/fuzz/%.o: build/tests/fuzz/%.o
	@mkdir -p $(@D)
	cp $< $@
build/replay/%: build/fuzz/%.o build/tests/fuzz/replay.o build/lib.a
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS)
build/fuzzer/%: build/fuzz/%.o build/lib.a
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -fsanitize=fuzzer $(LDFLAGS) -o $@ $^ $(LDLIBS)

# A copy of the sources for a build of another kind; what has not changed there is not built again.
copy = mkdir -p $1 && rm -rf $(addprefix $1/,cmd lib man samples tests) && \
       tar -cf - Makefile README.md LICENSE cmd lib man samples tests | tar -xf - -C $1
# There the tests of what the tools do run, with more time for each; those of pages, packages and
# the sizes of programs do not.
check_in = $(MAKE) -C $1 check SLOWER=5 \
           TESTS='build/unit tests/tools tests/pipeline/*.sh tests/faults/*.sh \
                  tests/pages/terminal.sh'
SECONDS ?= 60
sanitized := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined \
             -fno-sanitize-recover=all -D_GLIBCXX_ASSERTIONS -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3
fuzz:
	@$(call copy,build/fuzzing)
	$(MAKE) -C build/fuzzing CXX=clang++-14 CXXFLAGS="$(sanitized) -fsanitize=fuzzer-no-link" \
	  $(target:%=build/fuzzer/%)
	tests/fuzz/fuzz.sh build/fuzzing/build/fuzzer $(SECONDS) $(target)

# The suite with another compiler, and with the library of macOS and FreeBSD: LIBCXX is its version.
# What Debian has of fmt and Catch2 is compiled for the other library. Version 14 lacks algorithms of
# ranges.
check-clang:
	@$(call copy,build/clang)
	+$(call check_in,build/clang) CXX=clang++-14
LIBCXX ?= 14
libcxx  = catch_library= CXX='clang++-$(LIBCXX) -stdlib=libc++' CPPFLAGS='-DFMT_HEADER_ONLY \
          $(if $(filter 14,$(LIBCXX)),-include tests/libcxx/ranges.h)'
check-libcxx:
	@$(call copy,build/libcxx-$(LIBCXX))
	+$(call check_in,build/libcxx-$(LIBCXX)) $(libcxx)

# The whole suite under AddressSanitizer and UndefinedBehaviorSanitizer, then most of it under
# valgrind.
sanitize: all build/unit $(target:%=build/replay/%)
	@$(call copy,build/sanitized)
	+$(call check_in,build/sanitized) CXXFLAGS="$(sanitized)"
	tests/valgrind.sh

# Lines and branches of lib/ and cmd/ that the tests reach; less than every line is an error.
covered := -O0 -g --coverage
coverage-lines:
	@$(call copy,build/covered)
	find build/covered -name '*.gcda' -delete
	$(MAKE) -C build/covered build/tests/gcov_exit.o CXXFLAGS="$(covered)"
	+$(call check_in,build/covered) CXXFLAGS="$(covered)" LDFLAGS=build/tests/gcov_exit.o
	gcovr --root build/covered --filter build/covered/lib/ --filter build/covered/cmd/ \
	  --exclude-throw-branches --exclude-unreachable-branches --print-summary \
	  -o build/covered/lines.txt --fail-under-line 100 \
	  $(addprefix build/covered/build/,lib cmd tests) || { cat build/covered/lines.txt; exit 1; }

# Mutants of lib/ and cmd/ that the nearest tests do not notice; some hours of one processor.
MUTANTS ?= 150
mutate:
	tests/mutate.py --near --count $(MUTANTS)

# SHORT=1 runs a measurement on the smallest amount, in a second or so, to see that it runs:
# tests/house/goals.sh.
short = $(if $(SHORT),$1,$2)

# The long form of the tests of numbers, memory and packages.
check-long:
	LONG=1 $(MAKE) check
	PATH="$$PWD/bin:$$PATH" build/unit '[.long]'

# How often the errors of fitpower hold, by case and route: 1000 simulated runs each. Then what it
# says of runs with one thing wrong, and which law it finds. Some 20 minutes of two processors.
build/tests/bench/coverage.o: CPPFLAGS += -Itests
build/coverage: build/tests/bench/coverage.o build/lib.a
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS) -pthread
coverage: build/coverage build/bench/troubles
	@{ echo 'Of build/coverage and build/bench/troubles, run by make coverage:'; \
	  build/coverage $(call short,2); build/bench/troubles $(call short,2); } | \
	  tee $(call short,build,samples)/coverage.txt

# What came out of each goal on this system, kept in tests/results.txt; hours.
RESULTS ?= check check-long check-clang check-libcxx check-arm64 sanitize fuzz lint coverage-lines mutate \
           coverage bad-runs lab-rates extremes work-precision work-precision-signal peers bench
results:
	@tests/results.sh $(RESULTS)

# What `fitpower --check` says of runs with one thing wrong: two minutes.
bad-runs: all
	@PATH="$$PWD/bin:$$PATH" tests/bench/bad-runs.sh $(call short,1) | \
	  tee $(call short,build,samples)/bad-runs.txt

# How many good folders `samples/lab/lab.sh --check` takes for bad ones, and how many bad ones it finds:
# some ten minutes.
lab-rates: all
	@PATH="$$PWD/bin:$$PATH" tests/bench/lab-rates.sh $(call short,1 3) | \
	  tee $(call short,build,samples)/lab-rates.txt

# The errors of simulate at the ends of what can be asked, against 30 digits: some seconds.
extremes: all
	@PATH="$$PWD/bin:$$PATH" tests/bench/extremes.py $(call short,short) | \
	  tee $(call short,build,samples)/extremes.txt

# Error against run time of all methods: some minutes; figures where gnuplot is installed. See
# tests/bench/README.md.
build/bench/%: CPPFLAGS += -Itests
build/bench/%: build/tests/bench/%.o build/lib.a
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS) -pthread

# CVODE beside them where libsundials-dev is installed: see tests/bench/cvode.h.
ifneq ($(wildcard /usr/include/cvode/cvode.h),)
build/bench/work_precision: LDLIBS += -lsundials_cvode -lsundials_nvecserial \
                                      -lsundials_sunmatrixdense -lsundials_sunlinsoldense
endif

work-precision: all build/bench/ulp build/bench/work_precision
	@mkdir -p build/work-precision
	tests/bench/tools.sh $(call short,2) | tee $(call short,build,samples)/tools.txt
	build/bench/ulp $(call short,200) | tee build/work-precision/ulp.tsv
	build/bench/work_precision build/work-precision $(call short,memory-1e-3)
	tests/bench/work-precision.sh build/work-precision | tee build/work-precision/failures.tsv
	$(call short,,[ ! -e build/work-precision/overview.svg ] || \
	  cp build/work-precision/overview.svg samples/work-precision.svg)

# The errors of smooth and differentiate on noisy runs, by method and window: some seconds.
work-precision-signal: build/bench/signal
	@mkdir -p build/work-precision
	tests/bench/signal.sh build/work-precision $(call short,2)
	$(call short,,[ ! -e build/work-precision/filters.svg ] || \
	  cp build/work-precision/filters.svg samples/filters.svg)
	@echo 'results: build/work-precision/signal.tsv and, with gnuplot, its pictures'

# The digits of other programs on the certified fits, beside ours: the table at the end of that README.
# And b of the same runs by theirs and by ours: scatter, coverage and time.
peer_python = $(firstword $(foreach p,python3 /usr/bin/python3,\
                $(shell $p -c 'import lmfit' 2>/dev/null && echo $p)) python3)
peers: all
	@PATH="$$PWD/bin:$$PATH" $(peer_python) tests/reference/peers.py tests/reference/fits \
	  $(call short,Rubber1 Turn1) >build/peers.txt
	@cat build/peers.txt
	@PATH="$$PWD/bin:$$PATH" tests/bench/beside.sh $(peer_python) build $(call short,3)
	@cat build/beside.tsv
ifeq ($(SHORT),)
	@[ ! -e build/fit-routes.svg ] || cp build/fit-routes.svg samples/
	@{ sed '/^    record /,$$d' tests/reference/README.md; sed 's/^/    /; s/ *$$//' build/peers.txt; } \
	  >build/README && cp build/README tests/reference/README.md
endif

# How fast the tools are beside peers and bare loops: some minutes.
bench: all build/bench/speed build/unit
	@PATH="$$PWD/bin:$$PATH" tests/bench/speed.sh $(call short,2000 1)
	@PATH="$$PWD/bin:$$PATH" $(call short,: )tests/bench/profile.sh
	build/unit '[time]'

# Static analysis: .clang-tidy says what is checked. calls.sh looks for loops and for what nothing calls.
lint:
	clang-format-14 --dry-run --Werror $$(find lib cmd tests -name '*.cpp' -o -name '*.h')
	mandoc -Tlint -Wwarning man/*
	shellcheck -x -P SCRIPTDIR --severity=warning --exclude=SC2154 cmd/install/*.sh samples/*.sh samples/*/*.sh \
	  tests/*.sh tests/*/*.sh
	cppcheck --quiet --std=c++20 --language=c++ --enable=warning,performance,portability \
	  --inline-suppr --error-exitcode=1 -Ilib --suppress=internalAstError \
	  --suppress=derefInvalidIteratorRedundantCheck --suppress=containerOutOfBounds \
	  --suppress=passedByValue lib cmd
	printf '%s\n' $(source) $(wildcard cmd/*.cpp) | xargs -P $$(nproc) -n 4 sh -c \
	  'clang-tidy-14 --quiet --warnings-as-errors="*" "$$@" -- -x c++ -std=c++20 -Ilib' sh
	clang++-14 -fsyntax-only -Werror -Wcomma $(CPPFLAGS) $(CXXFLAGS) $(source) cmd/*.cpp
	printf '%s\n' $(wildcard tests/*/*.cpp tests/*/*/*.cpp) | xargs -P $$(nproc) -n 4 \
	  clang++-14 -fsyntax-only -Werror '-DTOOL=""' $(CPPFLAGS) -Itests $(CXXFLAGS)
	tests/calls.sh
	set -e; for script in form layers includes words clean-text; do tests/house/$$script.sh; done

