#pragma once

#include <acs/adapter_test/ERule.hpp>

#include <functional>
#include <string>

namespace ACS::AdapterTest
{

/// Adds a finding of the present scenario and time.
using FindingSink = std::function<void(ERule rule, std::string happened)>;

} // namespace ACS::AdapterTest
