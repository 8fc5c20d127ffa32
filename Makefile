# rolling: build, test, and reproduce. `make setup` installs what is missing on Debian.
CXX      ?= g++
CXXFLAGS ?= -O2 -g
override CXXFLAGS += -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion
override CPPFLAGS += -Ilib
override LDFLAGS  += -Wl,--as-needed
LDLIBS   := -lgsl -lgslcblas -lfmt -lm

source := $(wildcard lib/*/*.cpp)
tool   := $(patsubst cmd/%.cpp,%,$(wildcard cmd/*.cpp))
test   := $(wildcard tests/unit/*.cpp tests/unit/*/*.cpp)
object  = $(patsubst %.cpp,build/%.o,$1)

.PHONY: all
all: $(tool:%=bin/%)

bin/%: build/cmd/%.o build/lib.a
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS)

build/lib.a: $(call object,$(source))
	rm -f $@ && $(AR) rcs $@ $^

build/%.o: %.cpp
	@mkdir -p $(@D)
	$(CXX) $(CPPFLAGS) $(CXXFLAGS) -MMD -MP -c -o $@ $<

.SECONDARY:
-include $(patsubst %.o,%.d,$(call object,$(source) $(test) $(wildcard cmd/*.cpp)))
