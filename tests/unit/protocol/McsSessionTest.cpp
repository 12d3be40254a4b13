#include "Catch.hpp"
