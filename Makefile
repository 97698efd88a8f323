# Builds pcgc and its runtime under $(BUILD). `make help` lists the targets.
#
# runtime/base, lang and interface come first; with them pcgen, which reads the interface blocks of
# stdlib/ and writes $(BUILD)/gen; then the runtime library and the compiler.

BUILD ?= build
comma := ,
GEN := $(BUILD)/gen
OBJ := $(BUILD)/obj

all:

# ---- settings ------------------------------------------------------------------------------------

ifeq (,$(filter clean help,$(MAKECMDGOALS)))
include config.mak
endif
config.mak:
	echo "configuring; run ./configure yourself to choose options"
	./configure

WARNINGS := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wmissing-prototypes -Wstrict-prototypes
ifdef WERROR
WARNINGS += -Werror
endif
ifdef SANITIZE
override CFLAGS := -O1 -g -fno-omit-frame-pointer -fsanitize=$(SANITIZE) -fno-sanitize-recover=all
endif

# The same bytes from every build: no fused multiply-add behind the text's back. Everything is
# position-independent, since it goes into libpcgrt.so as well.
ALL_CFLAGS = -std=c11 $(CFLAGS) $(WARNINGS) -fPIC -ffp-contract=off -fno-math-errno \
	-D_DEFAULT_SOURCE -D_POSIX_C_SOURCE=200809L -iquote . $(EXTRA_CPPFLAGS) $(CPPFLAGS) -MMD -MP
# libpng, libjpeg and GDAL are opened when first used, so that starting pcgc stays cheap.
LIBS = -ldl -lm -lpthread
# AddressSanitizer looks for what throws exceptions when the program starts, before GDAL is opened.
ifdef SANITIZE
LIBS += $(if $(GDAL_LIBRARY),-Wl$(comma)--no-as-needed -l:libstdc++.so.6)
endif

# The libraries are named by the version that pcg.h says; docs/embedding.md says what the soname's
# number, ABI, stands for.
VERSION := $(shell sed -n 's/^\#define PCG_VERSION "\(.*\)"/\1/p' runtime/pcg.h)
ABI := 0

# Every symbol is visible inside the build; what is linked exports those that begin with pcg_.
EXPORT_DYNAMIC = -Wl,--dynamic-list=$(GEN)/export.list

# Short lines; V=1 shows the commands.
ifndef V
.SILENT:
say = echo "  $(1) $@";
endif

# ---- what is built of what -----------------------------------------------------------------------

c_files = $(wildcard $(addsuffix /*.c,$(1)))
objects = $(patsubst %.c,$(OBJ)/%.o,$(1))

LIBRARIES := $(sort $(patsubst stdlib/%/,%,$(wildcard stdlib/*/)))
STDLIB_C := $(call c_files,stdlib/*)
PCGEN_C := interface/pcgen.c interface/pcgen_abi.c
INTERFACE_C := $(filter-out $(PCGEN_C),$(call c_files,interface))
MAIN_C := $(wildcard compiler/main.c)
COMPILER_C := $(filter-out $(MAIN_C),$(call c_files,compiler))

BASE := $(call objects,$(call c_files,runtime/base))
RUNTIME := $(call objects,$(call c_files,runtime))
STDLIB := $(call objects,$(STDLIB_C))
LANG := $(call objects,$(call c_files,lang)) $(OBJ)/gen/lang/lexer.o $(OBJ)/gen/lang/grammar.o
INTERFACE := $(call objects,$(INTERFACE_C))
PCGEN := $(call objects,$(PCGEN_C))
GENERATED := $(OBJ)/gen/registry.o $(OBJ)/gen/abi_text.o $(OBJ)/gen/abi_symbols.o
COMPILER := $(call objects,$(COMPILER_C)) $(GENERATED)
MAIN := $(call objects,$(MAIN_C))

RUNTIME_LIBRARY := $(BASE) $(RUNTIME) $(STDLIB)
COMPILER_LIBRARY := $(LANG) $(INTERFACE) $(COMPILER)
TCC := $(OBJ)/tcc.o
# What the kernels of other libraries include, as <pcg/shape.h>.
KERNEL_HEADERS := pcg.h abi.h shape.h library.h
PRODUCTS := $(BUILD)/pcgc $(BUILD)/libpcgrt.a $(BUILD)/libpcgrt.so $(BUILD)/libpcg.a \
	$(BUILD)/libpcg.so $(BUILD)/pcg.h $(addprefix $(BUILD)/include/pcg/,$(KERNEL_HEADERS))

TEST_C := $(call c_files,tests/unit tests/api tests/rules)
TEST_PROGRAMS := $(patsubst tests/%.c,$(BUILD)/tests/%,$(TEST_C))
# What graphs are compared with; as fast as the compiler makes it.
BENCH_FLAGS := -O3
BENCH_PROGRAMS := $(patsubst %.c,$(BUILD)/%,$(call c_files,bench))
FUZZ_C := $(call c_files,tests/fuzz)
FUZZ_PROGRAMS := $(patsubst tests/fuzz/%.c,$(BUILD)/fuzz/%,$(FUZZ_C))

.PHONY: all demo bench check check-asan tests fuzz fuzz-build clean install uninstall reference help FORCE
.DELETE_ON_ERROR:
.SECONDARY:

all: $(PRODUCTS)

# ---- compiling -----------------------------------------------------------------------------------

$(OBJ)/%.o: %.c config.mak
	mkdir -p $(@D)
	$(call say,CC  )$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(OBJ)/gen/%.o: $(GEN)/%.c config.mak
	mkdir -p $(@D)
	$(call say,CC  )$(CC) $(ALL_CFLAGS) -c -o $@ $<

$(LANG): EXTRA_CPPFLAGS = -iquote lang -iquote $(GEN)/lang
$(LANG): | $(GEN)/lang/grammar.h

# A kernel includes the header that is made from its own block: "geometry/split.h", or "split.h".
define library_flags
$(OBJ)/stdlib/$(1)/%.o: EXTRA_CPPFLAGS = -iquote $(GEN)/$(1) -iquote $(GEN)
endef
$(foreach l,$(LIBRARIES),$(eval $(call library_flags,$(l))))
$(STDLIB): | $(GEN)/stamp

$(OBJ)/stdlib/io/%.o: EXTRA_CPPFLAGS = -iquote $(GEN)/io -iquote $(GEN) \
	$(if $(PNG_LIBRARY),-DPCG_PNG_LIBRARY='"$(PNG_LIBRARY)"') \
	$(if $(JPEG_LIBRARY),-DPCG_JPEG_LIBRARY='"$(JPEG_LIBRARY)"')

$(OBJ)/stdlib/gis/%.o: EXTRA_CPPFLAGS = -iquote $(GEN)/gis -iquote $(GEN) \
	$(if $(GDAL_LIBRARY),-DPCG_GDAL_LIBRARY='"$(GDAL_LIBRARY)"')

$(OBJ)/runtime/library_open.o: EXTRA_CPPFLAGS = -DPCG_LIBRARIES='"$(LIBDIR)/pcg"'

$(GENERATED): EXTRA_CPPFLAGS = -iquote $(GEN)
$(filter-out $(GENERATED),$(COMPILER)) $(MAIN): EXTRA_CPPFLAGS = \
	-DPCG_TCC_RELOCATE_ARGS=$(TCC_RELOCATE_ARGS) -DPCG_PREFIX='"$(PREFIX)"' \
	-DPCG_MULTIARCH='"$(MULTIARCH)"'

# ---- generated -----------------------------------------------------------------------------------

$(GEN)/lang/lexer.c: lang/lexer.re
	mkdir -p $(@D)
	$(call say,RE2C)re2c -W --no-generation-date --no-debug-info -o $@ $<

$(GEN)/lang/grammar.c: lang/grammar.y
	mkdir -p $(@D)
	$(call say,YACC)bison --no-lines -Wall -Werror --header=$(GEN)/lang/grammar.h -o $@ $<
$(GEN)/lang/grammar.h: $(GEN)/lang/grammar.c ;

$(BUILD)/pcgen: $(PCGEN) $(INTERFACE) $(LANG) $(BASE)
	$(call say,LINK)$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LIBS)

# One run writes everything; what did not change keeps its time. The examples of interfaces name files from the
# project's root; those that need GDAL are left out with it.
$(GEN)/stamp: $(BUILD)/pcgen $(STDLIB_C) $(wildcard stdlib/*/library.pcg) runtime/abi.h
	rm -rf $(GEN)/examples
	$(call say,GEN )$(BUILD)/pcgen --abi runtime/abi.h -o $(GEN) $(addprefix stdlib/,$(LIBRARIES))
	ln -sfn $(CURDIR)/examples $(GEN)/examples/examples
	$(if $(GDAL_LIBRARY),,rm -f $(GEN)/examples/gis_*.pcg)
	touch $@
$(GEN)/registry.c $(GEN)/abi_text.c $(GEN)/abi_symbols.c: $(GEN)/stamp ;
$(GEN)/%.h: $(GEN)/stamp ;

$(GEN)/export.list:
	mkdir -p $(@D)
	echo '{ pcg_*; };' >$@
$(GEN)/export.map:
	mkdir -p $(@D)
	echo '{ global: pcg_*; local: *; };' >$@

# ---- products ------------------------------------------------------------------------------------

$(BUILD)/pcgc: $(MAIN) $(COMPILER_LIBRARY) $(RUNTIME_LIBRARY) $(TCC) | $(GEN)/export.list
	$(call say,LINK)$(CC) $(CFLAGS) $(LDFLAGS) $(EXPORT_DYNAMIC) -o $@ $^ $(LIBS)

# libtcc as one object, which shows its own names only, and can be part of a shared library
# (compiler/tcc_variables.c says why its variables are renamed).
$(TCC): $(TCC_ARCHIVE) config.mak
	mkdir -p $(@D)
	$(call say,LD  )$(LD) -r --whole-archive -o $@ $<
	objcopy --wildcard --keep-global-symbol='tcc_*' --redefine-sym stdout=tcc_stdout \
		--redefine-sym stderr=tcc_stderr --redefine-sym environ=tcc_environ $@

# A shared library is libx.so.VERSION; libx.so.ABI is what programs ask for, libx.so what they are
# linked by.
define shared
$(call say,LINK)$(CC) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(@F).$(ABI) -Wl,-Bsymbolic \
	-Wl,-z,noexecstack $(if $(SANITIZE),,-Wl,-z,defs -Wl,-z,text) \
	-Wl,--version-script=$(GEN)/export.map -o $@.$(VERSION) $^ $(LIBS)
ln -sf $(@F).$(VERSION) $@.$(ABI)
ln -sf $(@F).$(ABI) $@
endef

$(BUILD)/libpcgrt.so: $(RUNTIME_LIBRARY) | $(GEN)/export.map
	$(shared)

$(BUILD)/libpcg.so: $(COMPILER_LIBRARY) $(RUNTIME_LIBRARY) $(TCC) | $(GEN)/export.map
	$(shared)

# An archive of one object, in which the names that are not pcg_ are local: nothing collides with
# the host's.
define archive
$(call say,AR  )$(LD) -r -o $(@:.a=.o) $^
objcopy --wildcard --keep-global-symbol='pcg_*' $(@:.a=.o)
rm -f $@
$(AR) rcs $@ $(@:.a=.o)
rm -f $(@:.a=.o)
endef

$(BUILD)/libpcgrt.a: $(RUNTIME_LIBRARY)
	$(archive)

# The compiler for hosts, libtcc inside.
$(BUILD)/libpcg.a: $(COMPILER_LIBRARY) $(RUNTIME_LIBRARY) $(TCC)
	$(archive)

$(BUILD)/pcg.h: runtime/pcg.h
	mkdir -p $(@D)
	cp $< $@

$(BUILD)/include/pcg/%.h: runtime/%.h
	mkdir -p $(@D)
	cp $< $@

# ---- tests ---------------------------------------------------------------------------------------

tests: all $(TEST_PROGRAMS) $(BENCH_PROGRAMS)

$(BUILD)/tests/%: $(OBJ)/tests/%.o $(COMPILER_LIBRARY) $(RUNTIME_LIBRARY) $(TCC) | $(GEN)/export.list
	mkdir -p $(@D)
	$(call say,LINK)$(CC) $(CFLAGS) $(LDFLAGS) $(EXPORT_DYNAMIC) -o $@ $^ $(LIBS)

check: tests
	echo "  TEST"
	LEFT_OUT="$(if $(PNG_LIBRARY),,png) $(if $(JPEG_LIBRARY),,jpeg)" python3 tests/run.py \
		--build $(BUILD) $(if $(SANITIZE),--sanitize $(SANITIZE)) $(TESTFLAGS)

check-asan:
	+$(MAKE) --no-print-directory BUILD=$(BUILD)/asan SANITIZE=address,undefined check

# ---- fuzzing -------------------------------------------------------------------------------------

FUZZ_SECONDS ?= 60

fuzz-build:
	test -n "$(FUZZ_CC)" || \
		{ echo "no fuzzer: ./configure --install-deps --with-fuzz installs it" >&2; exit 1; }
	+$(MAKE) --no-print-directory BUILD=$(BUILD)/fuzz CC=$(FUZZ_CC) \
		SANITIZE=fuzzer-no-link,address,undefined fuzz-programs

.PHONY: fuzz-programs
fuzz-programs: $(FUZZ_PROGRAMS) $(MAIN)
$(FUZZ_PROGRAMS): $(BUILD)/fuzz/%: $(OBJ)/tests/fuzz/%.o $(COMPILER_LIBRARY) $(RUNTIME_LIBRARY) $(TCC)
	mkdir -p $(@D)
	$(call say,LINK)$(CC) $(CFLAGS) -fsanitize=fuzzer -o $@ $^ $(LIBS)

# Each target runs on a copy of its corpus, so that the kept one changes only on purpose.
fuzz: fuzz-build
	python3 tests/fuzz.py --build $(BUILD)/fuzz --seconds $(FUZZ_SECONDS)

# ---- benchmarks ----------------------------------------------------------------------------------

$(BUILD)/bench/map: EXTRA_CPPFLAGS = $(if $(GDAL_LIBRARY),-DPCG_GDAL_LIBRARY='"$(GDAL_LIBRARY)"')
$(BUILD)/bench/map: $(OBJ)/stdlib/gis/gdal.o
$(BUILD)/bench/compile: $(OBJ)/compiler/tcc_variables.o $(TCC)
$(BUILD)/bench/%: bench/%.c bench/rival.h config.mak
	mkdir -p $(@D)
	$(call say,CC  )$(CC) $(filter-out -MMD -MP,$(ALL_CFLAGS)) $(BENCH_FLAGS) $(LDFLAGS) -o $@ \
		$(filter %.c %.o,$^) $(LIBS)

# BENCH="w1 c1" chooses workloads; BENCHFLAGS="--runs 9 --map town.osm.pbf" and others: bench/bench.py --help.
bench: all $(BENCH_PROGRAMS)
	python3 bench/bench.py --build $(BUILD) $(if $(GDAL_LIBRARY),,--without w6) $(BENCHFLAGS) $(BENCH)

# ---- other targets -------------------------------------------------------------------------------

DEMO := $(BUILD)/demo/neighbourhood
demo: all
	mkdir -p $(BUILD)/demo
	$(BUILD)/pcgc run examples/neighbourhood.pcg -o $(DEMO).glb -o $(DEMO).png
	echo
	echo "a neighbourhood as a model:   $(DEMO).glb"
	echo "a neighbourhood as a picture: $(DEMO).png"

reference: $(BUILD)/pcgc
	$(BUILD)/pcgc doc --markdown >$(BUILD)/reference.md
	$(BUILD)/pcgc doc --html >$(BUILD)/reference.html
	echo "the reference: $(BUILD)/reference.html, $(BUILD)/reference.md"

# ---- installing ----------------------------------------------------------------------------------

LIBDIR ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
DATADIR ?= $(PREFIX)/share
DOCDIR ?= $(DATADIR)/doc/pcgc

# The manual page and the shells' completions, which pcgc writes itself.
SHARE := $(BUILD)/share
$(SHARE)/%: $(BUILD)/pcgc
	mkdir -p $(SHARE)/bash
	$(BUILD)/pcgc --manual >$(SHARE)/pcgc.1
	$(BUILD)/pcgc completion bash >$(SHARE)/bash/pcgc
	$(BUILD)/pcgc completion zsh >$(SHARE)/_pcgc

# Each file as mode:from:folder, each link as name:target:folder.
INSTALLED = 755:$(BUILD)/pcgc:$(PREFIX)/bin \
	$(foreach l,libpcg libpcgrt,644:$(BUILD)/$l.a:$(LIBDIR) 644:$(BUILD)/$l.so.$(VERSION):$(LIBDIR) \
		644:$(BUILD)/$l.pc:$(LIBDIR)/pkgconfig) \
	$(foreach h,$(KERNEL_HEADERS),644:runtime/$h:$(INCLUDEDIR)/pcg) \
	644:$(SHARE)/pcgc.1:$(DATADIR)/man/man1 \
	644:$(SHARE)/bash/pcgc:$(DATADIR)/bash-completion/completions \
	644:$(SHARE)/_pcgc:$(DATADIR)/zsh/site-functions \
	$(foreach d,README.md LICENSE,644:$d:$(DOCDIR)) \
	$(foreach d,$(wildcard docs/*.md),644:$d:$(DOCDIR)/docs) \
	$(foreach d,$(wildcard docs/images/*),644:$d:$(DOCDIR)/docs/images) \
	$(foreach e,$(wildcard examples/*.*),644:$e:$(DOCDIR)/examples) \
	$(foreach e,$(wildcard examples/lessons/* examples/figures/* examples/styles/* examples/assets/*/*),644:$e:$(DOCDIR)/$(patsubst %/,%,$(dir $e)))
INSTALLED_LINKS = $(foreach l,libpcg libpcgrt,$l.so.$(ABI):$l.so.$(VERSION):$(LIBDIR) \
	$l.so:$l.so.$(ABI):$(LIBDIR))
# Folders that are ours alone, the inner ones first.
OWN_FOLDERS = $(INCLUDEDIR)/pcg \
	$(sort $(foreach e,$(wildcard examples/assets/*/*),$(DOCDIR)/$(patsubst %/,%,$(dir $e)))) \
	$(DOCDIR)/examples/lessons $(DOCDIR)/examples/figures $(DOCDIR)/examples/styles \
	$(DOCDIR)/examples/assets $(DOCDIR)/examples $(DOCDIR)/docs/images $(DOCDIR)/docs $(DOCDIR)

$(BUILD)/%.pc: packaging/%.pc.in runtime/pcg.h config.mak FORCE
	sed -e 's|@prefix@|$(PREFIX)|' -e 's|@version@|$(VERSION)|' -e 's|@private@|$(LIBS)|' \
		-e 's|@libdir@|$(patsubst $(PREFIX)/%,$${prefix}/%,$(LIBDIR))|' \
		-e 's|@includedir@|$(patsubst $(PREFIX)/%,$${prefix}/%,$(INCLUDEDIR))|' $< >$@

# A loop of the shell over such lists: $$first, $$second and $$folder are the parts of each.
define each
set -e; for entry in $(1); do \
	first=$${entry%%:*}; folder="$(DESTDIR)$${entry##*:}"; \
	second=$${entry#*:}; second=$${second%:*}; \
	$(2); \
done
endef

install: all $(BUILD)/libpcg.pc $(BUILD)/libpcgrt.pc $(SHARE)/pcgc.1
	$(call each,$(INSTALLED),install -D -m $$first -t "$$folder" $$second)
	$(call each,$(INSTALLED_LINKS),ln -sfn $$second "$$folder/$$first")

uninstall:
	$(call each,$(INSTALLED),rm -f "$$folder/$${second##*/}")
	$(call each,$(INSTALLED_LINKS),rm -f "$$folder/$$first")
	for folder in $(OWN_FOLDERS); do \
		test ! -d "$(DESTDIR)$$folder" || \
			rmdir --ignore-fail-on-non-empty "$(DESTDIR)$$folder"; \
	done

clean:
	rm -rf $(BUILD)

help:
	echo "make             build/pcgc; for hosts build/pcg.h, libpcg.so, libpcgrt.so, *.a"
	echo "make demo        runs the neighbourhood: a model and a picture in build/demo"
	echo "make bench       measures it; BENCH=\"w1 c1\" picks workloads, BENCHFLAGS= says how"
	echo "make check       all tests; TESTFLAGS='-k word' picks some"
	echo "make check-asan  all tests under AddressSanitizer and UndefinedBehaviorSanitizer"
	echo "make fuzz        the fuzz targets, for FUZZ_SECONDS (60) in all"
	echo "make reference   the procedures' reference as Markdown and HTML"
	echo "make install     to the --prefix of configure; DESTDIR=, PREFIX= and LIBDIR= are honoured"
	echo "make uninstall   removes what install put there, given the same"
	echo "make clean       removes the build folder"
	echo
	echo "BUILD=folder, CC=compiler, WERROR=1, SANITIZE=address,undefined and V=1 (shows the"
	echo "commands) work with every target."

ifneq (,$(wildcard $(OBJ)))
-include $(shell find $(OBJ) -name '*.d')
endif
