# ACS_SANITIZE=address,undefined or ACS_SANITIZE=thread; the two cannot be mixed.
if(ACS_SANITIZE MATCHES "address" AND ACS_SANITIZE MATCHES "thread")
  message(FATAL_ERROR "ACS_SANITIZE: address and thread cannot be combined; build them in two folders")
endif()
if(ACS_SANITIZE)
  add_compile_options(-fsanitize=${ACS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_definitions(_GLIBCXX_ASSERTIONS) # such as the value of an empty optional, which no sanitizer finds
  add_link_options(-fsanitize=${ACS_SANITIZE})
  # lld links these programs in a fifth of the time that GNU ld takes. GNU ld makes them a fifth smaller: a sanitizer's tables are
  # mostly addresses and names of source lines. Packed relocations need glibc 2.36.
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=lld ACS_LINKER_LLD)
  if(ACS_LINKER_LLD)
    add_link_options(-fuse-ld=lld)
  else()
    check_linker_flag(CXX LINKER:-z,pack-relative-relocs ACS_LINKER_PACKS)
    add_link_options($<$<BOOL:${ACS_LINKER_PACKS}>:LINKER:-z,pack-relative-relocs>)
  endif()
  check_linker_flag(CXX LINKER:--compress-debug-sections=zlib ACS_LINKER_COMPRESSES)
  add_link_options($<$<BOOL:${ACS_LINKER_COMPRESSES}>:LINKER:--compress-debug-sections=zlib>)
endif()
if(ACS_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  set(list "${CMAKE_CURRENT_LIST_DIR}/sanitizer-ignorelist.txt")
  if(CMAKE_GENERATOR MATCHES "Ninja") # which compiles in this folder: an absolute path would keep the object cache from other clones
    file(RELATIVE_PATH list "${CMAKE_BINARY_DIR}" "${list}")
  endif()
  add_compile_options("-fsanitize-ignorelist=${list}")
endif()

# The libraries that compute: without optimisation they take eight times as long. Of sources with Boost the compiler would take ten
# times as long.
function(acs_optimise_sanitized)
  if(ACS_SANITIZE)
    foreach(target acs_core acs_json acs_protocol acs_vda5050 acs_openstream acs_plan)
      target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O1>)
    endforeach()
  endif()
endfunction()
