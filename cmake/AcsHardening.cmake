# acs_hardening: compiler options against the use of memory errors, for the optimised build types; part of acs_warnings, so
# linked PRIVATE and only at build time. An option that the compiler does not have is left out. assert() stays active: many
# assertions guard a dereference. acs_harden_program(NAME): the options of the linker for a program.
include(CheckCXXCompilerFlag)
include(CheckLinkerFlag)
include(CheckPIESupported)

option(ACS_HARDENING "Harden optimised builds; not with sanitizers, which replace the same functions" ON)

add_library(acs_hardening INTERFACE)
set(acs_hardening_link_options)
if(ACS_HARDENING AND NOT ACS_SANITIZE)
  set(optimised "$<CONFIG:Release,RelWithDebInfo,MinSizeRel>")
  foreach(flag IN ITEMS -fstack-protector-strong -fstack-clash-protection -fcf-protection -ftrivial-auto-var-init=zero)
    string(MAKE_C_IDENTIFIER "ACS_HAS${flag}" variable)
    check_cxx_compiler_flag(${flag} ${variable})
    if(${variable})
      target_compile_options(acs_hardening INTERFACE $<${optimised}:${flag}>)
    endif()
  endforeach()
  # -U first: distributions set another level in CXXFLAGS.
  target_compile_options(acs_hardening INTERFACE
    $<${optimised}:-U_FORTIFY_SOURCE> $<${optimised}:-D_FORTIFY_SOURCE=3> $<${optimised}:-D_GLIBCXX_ASSERTIONS>
    $<${optimised}:-UNDEBUG>)

  # Its result applies to every program of the build, so not to those of a project around this one.
  if(PROJECT_IS_TOP_LEVEL)
    check_pie_supported(LANGUAGES CXX)
  endif()
  foreach(flag IN ITEMS relro now noexecstack)
    string(TOUPPER "ACS_HAS_Z_${flag}" variable)
    check_linker_flag(CXX "LINKER:-z,${flag}" ${variable})
    if(${variable})
      list(APPEND acs_hardening_link_options "$<${optimised}:LINKER:-z,${flag}>")
    endif()
  endforeach()
endif()

function(acs_harden_program target)
  target_link_options(${target} PRIVATE ${acs_hardening_link_options})
  if(CMAKE_CXX_LINK_PIE_SUPPORTED)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
endfunction()
