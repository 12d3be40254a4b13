#pragma once

#include <acs/adapter_test/ContractReport.hpp>
#include <acs/adapter_test/IAdapterBench.hpp>
#include <acs/core/Api.hpp>

namespace ACS::AdapterTest
{

/// Commands the adapter of the bench as the plan engine does, in scenarios of virtual time, and returns the rules that it
/// breaks. Reads no clock and ends always, unless a call of the adapter or of the bench does not return.
[[nodiscard]] ACS_API ContractReport CheckAdapter(IAdapterBench& bench);

} // namespace ACS::AdapterTest
