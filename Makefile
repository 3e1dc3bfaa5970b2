# SPDX-License-Identifier: MIT
# Builds, runs and tests fieldcast. `make help` lists the targets. GNU make 4.3 or newer.
#
#   CONFIG=release|debug|asan|tsan|cov   objects under $(BUILD)/$(CONFIG)/
#   BUILD=DIR    where everything built goes; `make -f ../src/Makefile` builds in the current folder
#   V=1          show the commands;  WERROR= lets warnings pass
#   CC CFLAGS CPPFLAGS LDFLAGS PREFIX DESTDIR   yours; the project's own flags stand apart from them

S := $(patsubst %/,%,$(dir $(lastword $(MAKEFILE_LIST))))
VERSION := 0.1.0
CONFIG ?= release
BUILD ?= build
PREFIX ?= /usr/local
DESTDIR ?=
WERROR ?= -Werror
PKG_CONFIG ?= pkg-config
ifeq ($(origin CC),default)
CC := gcc
endif
OUT := $(BUILD)/$(CONFIG)
-include config.mk

MAKEFLAGS += --no-builtin-rules --no-print-directory
.SUFFIXES:
.DELETE_ON_ERROR:
.PHONY: all fieldcast web run test programs docs bench speeds screens lint format check golden-accept pictures gallery clean \
        install uninstall dist help deps test-deps FORCE

Q := $(if $(filter 1,$(V)),,@)
say = $(if $(filter 1,$(V)),,@printf '  %-5s %s\n' '$(1)' '$(2)')
again = +$(Q)$(MAKE) -f $(firstword $(MAKEFILE_LIST))

all: web ## the program with the page in it (the default)
	$(again) fieldcast

# --- flags ---

# pkg-config module:Debian package
LIBRARIES := $(shell awk '$$1 == "module" && $$4 == "run" { print $$2 ":" $$3 }' $(S)/deploy/packages)
modules := $(foreach l,$(LIBRARIES),$(firstword $(subst :, ,$(l))))

config_release = -O2 -g $(hardening)
config_debug := -Og -g3
config_asan := -O1 -g1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all
config_tsan := -O1 -g -fsanitize=thread
config_cov := -O0 -g --coverage
link_release := -pie -Wl,-z,relro,-z,now,-z,noexecstack
# The checks have a hundred thousand addresses in writable data: where they are fixed, no start of a
# program writes them all.
link_asan := -no-pie
ifndef config_$(CONFIG)
$(error CONFIG=$(CONFIG) is unknown: release, debug, asan, tsan or cov)
endif

warnings := -Wall -Wextra -Wshadow -Wvla -Wstrict-prototypes -Wmissing-prototypes -Wpointer-arith \
            -Wformat=2 -Werror=format-security -Werror=implicit $(WERROR)
ours = -std=gnu17 -D_GNU_SOURCE -DFIELDCAST_VERSION='"$(VERSION)"' -I$(S) $(warnings) \
        $(config_$(CONFIG)) -pthread
compile = $(CC) $(ours) $(packages_cflags) $(CPPFLAGS) $(CFLAGS)
link = $(CC) $(config_$(CONFIG)) $(link_$(CONFIG)) -pthread $(CFLAGS) $(LDFLAGS)

# Goals that compile nothing themselves do without packages: they install them, remove files, or call
# this Makefile again.
ifneq ($(filter-out all web run test bench speeds lint format check golden-accept clean install uninstall \
                    dist help deps test-deps,$(or $(MAKECMDGOALS),all)),)
missing := $(foreach l,$(LIBRARIES),$(shell $(PKG_CONFIG) --exists $(firstword $(subst :, ,$(l))) \
               2>/dev/null || echo $(lastword $(subst :, ,$(l)))))
ifneq ($(strip $(missing)),)
$(error $(PKG_CONFIG) finds nothing of $(strip $(missing)): run deploy/install-deps.sh, which installs the Debian packages)
endif
# Compilers and processors differ in what they know of these.
accepted = $(shell $(CC) -Werror $(1) -x c -fsyntax-only /dev/null 2>/dev/null && echo '$(1)')
hardening := -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -fPIE \
    $(foreach flag,-fstack-protector-strong -fstack-clash-protection -fcf-protection=full \
                   -ftrivial-auto-var-init=zero,$(call accepted,$(flag)))
packages_cflags := $(shell $(PKG_CONFIG) --cflags $(modules))
# Only the headers of GL are used: functions are loaded through EGL.
packages_libs := $(shell $(PKG_CONFIG) --libs $(filter-out gl,$(modules))) -lm -ldl
endif

# --- the program ---

# The engine's files are parts of one for each width of vectors; renderer/spmd is a tool of the build.
apart := $(wildcard $(S)/renderer/spmd/*.c) $(foreach f,width interpret checkpoints cells notes bounds code points siblings explore survey explore_again renew textures tile verify passes sparse environment_texels threads,$(S)/renderer/engine/$(f).c)
# The program that finds equations; FLINT is linked with it alone.
algebra := $(wildcard $(S)/renderer/algebra/*.c)
sources := $(filter-out $(apart) $(algebra),$(foreach d,protocol renderer server,$(wildcard $(S)/$(d)/*.c $(S)/$(d)/*/*.c)))
object = $(patsubst $(S)/%.c,$(OUT)/%.o,$(1))
main := $(OUT)/server/main.o
glsl := $(sort $(wildcard $(S)/renderer/glsl/*.glsl))
examples := $(sort $(wildcard $(S)/protocol/examples/*.json $(S)/protocol/examples/*.jpg \
                               $(S)/protocol/examples/assets/* $(S)/protocol/reference/*.jpg \
                               $(S)/server/cli/*.html))
page := $(sort $(shell find $(S)/web/dist -type f ! -name .built 2>/dev/null))
# What is embedded: C by deploy/embed.sh, for renderer/glsl/files.h and server/embedded.h.
embedded := $(if $(wildcard $(S)/renderer/glsl/files.h),$(OUT)/generated/glsl.o) \
            $(if $(wildcard $(S)/server/embedded.h),$(OUT)/generated/embedded.o)
widths := $(if $(filter x86_64%,$(shell $(CC) -dumpmachine)),16 8 4,4)
engine_objects := $(foreach w,$(widths),$(OUT)/generated/engine-$(w).o)
objects := $(filter-out $(main),$(call object,$(sources))) $(embedded) $(engine_objects)
library := $(OUT)/libfieldcast.a

fieldcast: $(OUT)/fieldcast $(OUT)/fieldcast-algebra ## the program with the page that web/dist holds now, if any (C only)

# Of programs with AddressSanitizer. It runs before the sanitizer is ready.
linked_asan := $(call object,$(wildcard $(S)/tests/support/sanitized/*.c))
linked := $(linked_$(CONFIG))
$(linked_asan): config_asan += $(unchecked)

$(OUT)/fieldcast: $(main) $(linked) $(library) $(OUT)/link-flags
	$(call say,LD,$@)
	$(Q)$(link) -o $@ $(filter %.o %.a,$^) $(packages_libs)

$(OUT)/fieldcast-algebra: $(call object,$(algebra)) $(library) $(OUT)/link-flags
	$(call say,LD,$@)
	$(Q)$(link) -o $@ $(filter %.o %.a,$^) -lflint -lgmp $(packages_libs)

$(library): $(objects) $(OUT)/link-flags
	$(Q)rm -f $@ && $(AR) rcs $@ $(filter %.o,$^)

$(OUT)/%.o: $(S)/%.c $(OUT)/flags
	$(call say,CC,$<)
	$(Q)mkdir -p $(@D)
	$(Q)$(compile) -MMD -MP -c -o $@ $<

$(OUT)/generated/%.o: $(OUT)/generated/%.c $(OUT)/flags
	$(call say,CC,$<)
	$(Q)$(compile) -MMD -MP -c -o $@ $<

# The lists of names are prerequisites too, so that a removed file is noticed.
$(OUT)/generated/glsl.c: $(S)/deploy/embed.sh $(glsl) $(OUT)/glsl-names
	$(call say,GEN,$@)
	$(Q)mkdir -p $(@D)
	$(Q)sh $< glsl $(abspath $(glsl)) >$@

# GLSL as C over vectors: the shaders that the engine runs, and each instruction of a field.
spmd := $(OUT)/spmd
spmd_entries := 'kernel_*' trace mix_materials mixed chosen alone mixture_far is_edge seen_at block_start \
                sample_sums pixel_light pixel_color output_of id_bits cell_count cell_next \
                environment_sky environment_prefilter environment_irradiance
spmd_objects := $(call object,$(wildcard $(S)/renderer/spmd/*.c $(S)/protocol/*.c \
                    $(S)/protocol/*/*.c $(S)/renderer/code/*.c $(S)/renderer/field/*.c \
                    $(S)/renderer/sdf/*.c $(S)/renderer/glsl/*.c)) $(OUT)/generated/glsl.o

$(spmd): $(spmd_objects)
	$(call say,LD,$@)
	$(Q)$(link) -o $@ $^ $(packages_libs)

engine_glsl := $(S)/renderer/engine/engine.glsl $(S)/renderer/engine/builtins.glsl
$(OUT)/generated/engine.i: $(spmd) $(engine_glsl)
	$(call say,GEN,$@)
	$(Q)$(spmd) text $(engine_glsl) | grep -v '^#line' >$@.glsl
	$(Q)$(CC) -E -P -x c $@.glsl -o $@

$(OUT)/generated/spmd.c $(OUT)/generated/spmd.h &: $(OUT)/generated/engine.i $(OUT)/spmd-names
	$(Q)$(spmd) c $< $(spmd_entries) >$(OUT)/generated/spmd.c
	$(Q)$(spmd) h $< $(spmd_entries) >$(OUT)/generated/spmd.h

$(OUT)/generated/kernels.table: $(spmd)
	$(Q)$(spmd) table >$@

# The same file for each width; nothing is fused or reordered, so that all give the same bits.
engine_flags := $(call accepted,-ftrivial-auto-var-init=uninitialized) -fno-stack-protector -fwrapv -ffp-contract=off -fno-math-errno -Wno-psabi -Wno-unused -Wno-unused-parameter -Wno-shadow -Wno-missing-prototypes -I$(OUT)/generated
# Checked in the narrowest alone: it is the same source, and takes five times as long so.
unchecked := $(call accepted,-fno-sanitize=all)
engine_width_8 := -mavx2 $(unchecked)
engine_width_16 := -mavx512f -mavx512vl -mavx512bw -mavx512dq -mprefer-vector-width=512 $(unchecked)
$(engine_objects): $(OUT)/generated/engine-%.o: $(S)/renderer/engine/width.c $(OUT)/flags \
        $(OUT)/generated/spmd.c $(OUT)/generated/spmd.h $(OUT)/generated/kernels.table
	$(call say,CC,$@)
	$(Q)$(compile) $(engine_flags) $(engine_width_$*) -DLANES=$* -MMD -MP -c -o $@ $<

$(OUT)/generated/embedded.c: $(S)/deploy/embed.sh $(page) $(examples) $(OUT)/embedded-names
	$(call say,GEN,$@)
	$(Q)mkdir -p $(@D)
	$(Q)sh $< embedded $(abspath $(S)) $(abspath $(@D)) >$@

# stamp NAME TEXT: a file that changes only when its text does.
define stamp
$(OUT)/$(1): FORCE
	@mkdir -p $$(@D)
	@printf '%s\n' $$(call quote,$(2)) | cmp -s - $$@ || printf '%s\n' $$(call quote,$(2)) >$$@
endef
quote = '$(subst ','\'',$(1))'
$(eval $(call stamp,flags,$$(compile)))
$(eval $(call stamp,link-flags,$$(link) $$(packages_libs) $$(objects)))
$(eval $(call stamp,glsl-names,$$(glsl)))
$(eval $(call stamp,embedded-names,$$(page) $$(examples)))
$(eval $(call stamp,spmd-names,$$(spmd_entries)))

# --- the page ---

web_sources := $(wildcard $(S)/web/index.html $(S)/web/*.ts $(S)/web/package.json) \
               $(shell find $(S)/web/src $(S)/web/public -type f 2>/dev/null)

web: $(if $(wildcard $(S)/web/package.json),$(S)/web/dist/.built) ## the page alone, into web/dist

$(S)/web/dist/.built: $(web_sources) $(S)/web/node_modules/.package-lock.json
	$(call say,WEB,$@)
	$(Q)cd $(S)/web && npm run --silent build
	$(Q)touch $@

$(S)/web/node_modules/.package-lock.json: $(S)/web/package-lock.json
	@printf '%s\n' 'web/node_modules is missing or older than web/package-lock.json.' \
	  'deploy/install-deps.sh installs it; `make fieldcast` builds the program without the page.' >&2
	@exit 1

# --- tests and checks ---

test_sources := $(wildcard $(S)/tests/*/test_*.c)
test_programs := $(patsubst %.o,%,$(call object,$(test_sources)))
support := $(call object,$(wildcard $(S)/tests/support/*.c))
preloaded := $(patsubst %.o,%.so,$(call object,$(wildcard $(S)/tests/*/*_driver.c $(S)/tests/*/*/*_driver.c)))

programs: $(OUT)/fieldcast $(OUT)/fieldcast-algebra $(test_programs) $(preloaded) $(BUILD)/compile_commands.json ## the program and all C tests

$(test_programs): %: %.o $(support) $(linked) $(library) $(OUT)/link-flags
	$(call say,LD,$@)
	$(Q)$(link) -o $@ $(filter %.o %.a,$^) -lcmocka -lturbojpeg $(tested_libs) $(packages_libs)

# The one test of FLINT's side.
$(OUT)/tests/unit/test_groebner: tested_libs := -lflint -lgmp
$(OUT)/tests/unit/test_groebner: $(filter-out %/main.o,$(call object,$(algebra)))

# The one test that counts allocations.
$(OUT)/tests/property/test_patch: tested_libs := $(foreach f,malloc calloc realloc,-Wl,--wrap=$(f))

# Loaded in front of everything else, so without the sanitizers' own libraries.
$(preloaded): $(OUT)/%.so: $(S)/%.c
	$(call say,CC,$<)
	$(Q)mkdir -p $(@D)
	$(Q)$(CC) -std=gnu17 -D_GNU_SOURCE $(warnings) -O1 -fPIC -shared -pthread -o $@ $< -ldl

$(BUILD)/compile_commands.json: $(OUT)/flags $(sources) $(test_sources)
	$(Q)for f in $(filter %.c,$^); do printf '{"directory":"%s","file":"%s","command":"%s"},\n' \
	  "$(CURDIR)" "$$f" $(call quote,$(subst ",\",$(compile)))" -c $$f"; \
	done | sed -e '1s/^/[/' -e '$$s/,$$/]/' >$@

# Everything, with the sanitizers on; the last line is `N passed, N failed`.
test: test-deps ## install what is missing, build with ASan and UBSan, run all tests
	$(again) web
	$(again) CONFIG=asan programs
	+$(Q)cd $(S) && node tests/run.mjs $(abspath $(BUILD)/asan) $(SUITE)

bench: test-deps ## measure; prints JSON
	$(again) all
	$(Q)cd $(S) && node tests/bench.mjs $(abspath $(OUT)) $(ARGS)

speeds: test-deps ## measure, and write tests/bench/README.md and its plots: half an hour on a quiet machine
	$(again) all
	$(Q)cd $(S) && node tests/speeds.mjs $(abspath $(OUT))

screens: all ## pictures of every panel, dialog and state of the page, and what is wrong in them
	$(Q)cd $(S) && FIELDCAST=$(abspath $(OUT))/fieldcast node tests/e2e/screens.mjs $(abspath $(BUILD))/screens $(ARGS)

lint: ## the rules of the house
	$(Q)cd $(S) && node tests/lint/lint.mjs

format: ## rewrite the C sources by .clang-format, the page by biome
	$(Q)cd $(S) && clang-format -i $$(git ls-files '*.c' '*.h')
	$(Q)cd $(S)/web && if [ -x node_modules/.bin/biome ]; then node_modules/.bin/biome format --write .; fi

check: ## lint and test
	$(again) lint
	$(again) test

golden-accept: ## draw CASE=name (or all) and take the picture as its reference
	$(if $(CASE),,$(error golden-accept wants CASE=name, or CASE=all))
	$(again) CONFIG=release programs
	$(Q)cd $(S) && GOLDEN_ACCEPT='$(CASE)' $(abspath $(BUILD))/release/tests/golden/test_golden

pictures: fieldcast ## draw the pictures of the examples and of the reference page
	$(Q)for f in $(S)/protocol/examples/*.json; do $(OUT)/fieldcast render $$f --width 480 --height 270 \
	  --samples 4 --quality 85 -o $${f%.json}.jpg || exit 1; done
	$(Q)mkdir -p $(S)/protocol/reference
	$(Q)for d in $(S)/tests/golden/nodes/*/; do $(OUT)/fieldcast render $${d}scene.json --width 192 \
	  --height 144 --samples 4 --quality 80 -o $(S)/protocol/reference/$$(basename $$d).jpg || exit 1; done

gallery: fieldcast ## draw the pictures of README.md anew: a quarter of an hour each without a GPU
	$(Q)for f in $(S)/protocol/gallery/*.jpg; do $(OUT)/fieldcast render \
	  $(S)/protocol/examples/$$(basename $$f .jpg).json --width 1920 --height 1080 --level final \
	  --quality 88 -o $$f || exit 1; done

docs: fieldcast ## write the reference page, and into README.md the table of options and the arrows
	$(Q)$(OUT)/fieldcast schema --reference >$(S)/protocol/REFERENCE.md
	$(Q)$(S)/deploy/update-readme.sh $(OUT)/fieldcast $(S)/README.md
	$(Q)node $(S)/tests/lint/arrows.mjs $(S)/README.md

# --- use ---

data := $(or $(XDG_DATA_HOME),$(HOME)/.local/share)/fieldcast

run: deps ## install what is missing, build, and serve on http://127.0.0.1:8080/ (PORT=8080)
	$(again) all
	$(Q)exec $(OUT)/fieldcast serve --host 127.0.0.1 --port $(or $(PORT),8080) --data '$(data)'

deps test-deps:
	$(Q)$(S)/deploy/install-deps.sh $(if $(filter test-%,$@),test)

install: ## copy program and service files to $(DESTDIR)$(PREFIX)
	$(again) all
	install -Dm755 $(OUT)/fieldcast $(DESTDIR)$(PREFIX)/bin/fieldcast
	install -Dm755 $(OUT)/fieldcast-algebra $(DESTDIR)$(PREFIX)/bin/fieldcast-algebra
	install -Dm644 $(S)/deploy/fieldcast.conf $(DESTDIR)$(PREFIX)/share/doc/fieldcast/fieldcast.conf
	install -Dm644 $(S)/README.md $(DESTDIR)$(PREFIX)/share/doc/fieldcast/README.md
	install -d $(DESTDIR)$(PREFIX)/lib/systemd/system
	sed 's|@PREFIX@|$(PREFIX)|' $(S)/deploy/fieldcast.service \
	  >$(DESTDIR)$(PREFIX)/lib/systemd/system/fieldcast.service

uninstall: ## remove what install copied
	rm -f $(DESTDIR)$(PREFIX)/bin/fieldcast $(DESTDIR)$(PREFIX)/bin/fieldcast-algebra $(DESTDIR)$(PREFIX)/lib/systemd/system/fieldcast.service
	rm -rf $(DESTDIR)$(PREFIX)/share/doc/fieldcast

dist: ## a source archive of the last commit
	$(Q)mkdir -p $(BUILD)
	$(Q)git -C $(S) archive --prefix=fieldcast-$(VERSION)/ HEAD | gzip -9n >$(BUILD)/fieldcast-$(VERSION).tar.gz
	@echo $(BUILD)/fieldcast-$(VERSION).tar.gz

clean: ## remove everything built
	rm -rf $(BUILD) $(S)/web/dist

help: ## this list
	@sed -n 's/^\([a-z-]*\):[^#]*## \(.*\)/  \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 18
	@sed -n '4,9s/^#//p' $(firstword $(MAKEFILE_LIST))

-include $(patsubst %.o,%.d,$(main) $(objects) $(call object,$(algebra)) $(support) $(spmd_objects) $(test_programs:=.o))
