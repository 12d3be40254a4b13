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
  add_compile_options(-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/sanitizer-ignorelist.txt)
endif()

# Without optimisation a sanitized library computes eight times as long, and a test spends most of its time there.
function(acs_optimise_sanitized target)
  if(ACS_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O1>)
  endif()
endfunction()
