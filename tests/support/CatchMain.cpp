#define CATCH_CONFIG_MAIN // NOLINT(readability-identifier-naming, cppcoreguidelines-macro-usage): the name Catch2 wants
#include "Catch.hpp"
