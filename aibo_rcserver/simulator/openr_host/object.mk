# Builds an OPEN-R object as a shared library, which aibo_rcserver loads from its memory stick (machine.cpp).
# scripts/openr_object runs it with these variables; paths must not contain spaces.
#   FOLDER      the object's sources, with stub.cfg
#   BUILD       a folder for what is built; LIBRARY: the file to build
# Sources in the folder `common` beside FOLDER are a library for all objects there. Folders that the object's own Makefile
# names with -I are searched for headers, too. CXXFLAGS and LIBS add options.
HOST := $(patsubst %/,%,$(dir $(abspath $(lastword $(MAKEFILE_LIST)))))
COMMON := $(wildcard $(FOLDER)/../common)
NAME := $(shell sed -n 's/^[ \t]*ObjectName[ \t]*:[ \t]*\([A-Za-z_0-9]*\).*/\1/p' $(FOLDER)/stub.cfg)

# An object of 2004 is not C++17, and may forget to return a value. In that case, only unoptimised code goes on, as on
# the robot. Nothing but the object's description is visible, so two objects may have equal names.
OPTIONS = -O0 -g -fPIC -fvisibility=hidden -fno-gnu-unique -MMD -MP -I$(BUILD) -I$(FOLDER) \
  $(if $(COMMON),$(patsubst %,-I%,$(sort $(dir $(shell find $(COMMON) -name '*.h'))))) \
  $(patsubst %,-I$(FOLDER)/%,$(shell cat $(FOLDER)/Makefile* 2> /dev/null | grep -o -e '-I[^ $$/][^ $$]*' | cut -c 3-)) \
  -I$(HOST)/sdk -I$(HOST)/../..
CXX_OPTIONS = -fpermissive -Wno-write-strings -Wno-int-to-pointer-cast -include $(HOST)/prelude.h $(OPTIONS) $(CXXFLAGS)
# Wrapped, because an object's files are on the memory stick (objects/stick_files.cpp).
WRAPPED = fopen open stat __xstat unlink remove

sources_in = $(filter-out %Stub.cc,$(shell find $(1) -name '*.cc' -o -name '*.cpp' -o -name '*.c'))
object_of = $(foreach source,$(1),$(BUILD)/$(2)/$(subst /,-,$(source:$(3)/%=%)).o)
OWN := $(call sources_in,$(FOLDER))
SHARED := $(if $(COMMON),$(call sources_in,$(COMMON)))
OWN_OBJECTS := $(call object_of,$(OWN),own,$(FOLDER))
SHARED_OBJECTS := $(call object_of,$(SHARED),common,$(COMMON))

$(LIBRARY): $(OWN_OBJECTS) $(BUILD)/stub.o $(if $(SHARED),$(BUILD)/common.a)
	$(CXX) -shared -o $@ $^ $(WRAPPED:%=-Wl,--wrap=%) $(LIBS)

$(BUILD)/common.a: $(SHARED_OBJECTS)
	$(AR) rcs $@ $^

$(BUILD)/$(NAME)_stub.cc: $(FOLDER)/stub.cfg $(HOST)/generate_stub $(HOST)/object.mk
	mkdir -p $(BUILD)/own $(BUILD)/common
	$(HOST)/generate_stub $< $(BUILD)

$(BUILD)/stub.o: $(BUILD)/$(NAME)_stub.cc
	$(CXX) -std=gnu++14 $(CXX_OPTIONS) -DOPENR_OBJECT_LIBRARY -c -o $@ $<

define compile
$(2): $(1) $(BUILD)/$(NAME)_stub.cc
	$(if $(filter %.c,$(1)),$$(CC) $$(OPTIONS) $$(CXXFLAGS),$$(CXX) -std=gnu++98 $$(CXX_OPTIONS)) -c -o $$@ $$<
endef
$(foreach source,$(OWN),$(eval $(call compile,$(source),$(call object_of,$(source),own,$(FOLDER)))))
$(foreach source,$(SHARED),$(eval $(call compile,$(source),$(call object_of,$(source),common,$(COMMON)))))

-include $(OWN_OBJECTS:.o=.d) $(SHARED_OBJECTS:.o=.d) $(BUILD)/stub.d
