# The warnings and the hardening of this project, linked PRIVATE and only at build time: a user's own flags are his own.
add_library(acs_warnings INTERFACE)
target_link_libraries(acs_warnings INTERFACE acs_hardening)
target_compile_options(acs_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wformat=2 -Wswitch-enum -Wswitch-default -Wextra-semi -Wmissing-field-initializers
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wuseless-cast>
  # g++ 12 reports overlaps in std::string's own copying at -O2 that do not exist (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # In a unity build a source is included, and g++ takes its anonymous namespace for a header's.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${ACS_UNITY_BATCH}>>:-Wno-subobject-linkage>
  $<$<CXX_COMPILER_ID:Clang>:-Wno-switch-default>
  $<$<BOOL:${ACS_WARNINGS_AS_ERRORS}>:-Werror>)
