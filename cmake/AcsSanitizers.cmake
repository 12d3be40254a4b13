# ACS_SANITIZE=address,undefined or ACS_SANITIZE=thread; the two cannot be mixed.
if(ACS_SANITIZE MATCHES "address" AND ACS_SANITIZE MATCHES "thread")
  message(FATAL_ERROR "ACS_SANITIZE: address and thread cannot be combined; build them in two folders")
endif()
if(ACS_SANITIZE)
  add_compile_options(-fsanitize=${ACS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_definitions(_GLIBCXX_ASSERTIONS) # such as the value of an empty optional, which no sanitizer finds
  add_link_options(-fsanitize=${ACS_SANITIZE})
  # A sanitizer's tables are mostly addresses and names of source lines. These two make a program a fifth smaller; the first needs
  # glibc 2.36.
  include(CheckLinkerFlag)
  check_linker_flag(CXX LINKER:-z,pack-relative-relocs ACS_LINKER_PACKS)
  check_linker_flag(CXX LINKER:--compress-debug-sections=zlib ACS_LINKER_COMPRESSES)
  add_link_options(
    $<$<BOOL:${ACS_LINKER_PACKS}>:LINKER:-z,pack-relative-relocs>
    $<$<BOOL:${ACS_LINKER_COMPRESSES}>:LINKER:--compress-debug-sections=zlib>)
endif()
if(ACS_SANITIZE MATCHES "undefined" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_compile_options(-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/sanitizer-ignorelist.txt)
endif()
