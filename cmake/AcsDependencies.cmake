# What each part needs from the system (Debian 12 package names: scripts/setup).
find_package(fmt 9 REQUIRED)
find_package(tl-expected REQUIRED)
find_package(RapidJSON REQUIRED)
if(ACS_WITH_BEAST OR ACS_WITH_ASIO OR ACS_WITH_MOSQUITTO)
  find_package(Threads REQUIRED)
  find_package(Boost 1.81 REQUIRED)
endif()
if(ACS_WITH_BEAST)
  find_package(OpenSSL REQUIRED)
endif()
if(ACS_WITH_MOSQUITTO)
  find_package(Mosquitto REQUIRED)
endif()
if(ACS_WITH_POSTGRES)
  find_package(PostgreSQL 14 REQUIRED)
endif()
if(ACS_WITH_SQLITE)
  find_package(SQLiteCpp REQUIRED)
endif()

# RapidJSON's package sets variables and no target. Never exported: no public header includes it.
add_library(acs_rapidjson INTERFACE)
target_include_directories(acs_rapidjson SYSTEM INTERFACE ${RAPIDJSON_INCLUDE_DIRS})
target_compile_definitions(acs_rapidjson INTERFACE RAPIDJSON_HAS_STDSTRING=1)
# Its headers add to null pointers and normalise a zero ("0e5"), harmlessly, but UBSan reports it in every program that
# parses. Only their code is passed over, not ours around it.
if(ACS_SANITIZE MATCHES "undefined")
  target_compile_options(acs_rapidjson INTERFACE
    $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/sanitizer-ignorelist.txt>)
endif()
