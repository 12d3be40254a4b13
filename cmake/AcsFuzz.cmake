# Included before the libraries, so that their branches guide the fuzzer too.
if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "ACS_BUILD_FUZZERS needs clang (libFuzzer is part of it), not ${CMAKE_CXX_COMPILER_ID}: "
    "use cmake --preset fuzz")
endif()
add_compile_options(-fsanitize=fuzzer-no-link)

# acs_add_fuzzer(NAME acs_decode_fuzz SOURCES AcsDecodeFuzz.cpp LINK ACS::Protocol [CORPUS folder…] [DICTIONARY file]
#                [OPTIONS -max_len=512 …])
# One libFuzzer program, and the target run_<name>, which lets it search for ACS_FUZZ_SECONDS. What it finds new goes
# to the build folder; the corpus of the repository is only read.
set(ACS_FUZZ_SECONDS 60 CACHE STRING "How long each run_… target of a fuzzer searches")
function(acs_add_fuzzer)
  cmake_parse_arguments(arg "" "NAME;DICTIONARY" "SOURCES;LINK;CORPUS;OPTIONS" ${ARGN})
  if(NOT arg_NAME OR NOT arg_SOURCES)
    message(FATAL_ERROR "acs_add_fuzzer: NAME and SOURCES are required")
  endif()
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE ${arg_LINK} acs_warnings)
  target_link_options(${arg_NAME} PRIVATE -fsanitize=fuzzer)

  set(inputs "${CMAKE_CURRENT_BINARY_DIR}/${arg_NAME}_found")
  file(MAKE_DIRECTORY "${inputs}")
  foreach(folder IN LISTS arg_CORPUS)
    cmake_path(ABSOLUTE_PATH folder)
    if(NOT IS_DIRECTORY "${folder}")
      message(FATAL_ERROR "acs_add_fuzzer(${arg_NAME}): there is no corpus folder ${folder}")
    endif()
    list(APPEND inputs "${folder}")
  endforeach()
  set(options -max_total_time=${ACS_FUZZ_SECONDS} -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 ${arg_OPTIONS})
  if(arg_DICTIONARY)
    cmake_path(ABSOLUTE_PATH arg_DICTIONARY)
    list(APPEND options "-dict=${arg_DICTIONARY}")
  endif()
  add_custom_target(run_${arg_NAME} COMMAND ${arg_NAME} ${options} ${inputs} USES_TERMINAL
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
endfunction()
