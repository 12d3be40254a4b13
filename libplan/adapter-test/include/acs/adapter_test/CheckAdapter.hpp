#pragma once

#include <acs/adapter_test/ContractReport.hpp>
#include <acs/adapter_test/IAdapterBench.hpp>

namespace ACS::AdapterTest
{

/// Commands the adapter of the bench as the plan engine does, in scenarios of virtual time, and returns the rules that it
/// breaks. Reads no clock and ends always, unless a call of the adapter or of the bench does not return.
[[nodiscard]] ContractReport CheckAdapter(IAdapterBench& bench);

} // namespace ACS::AdapterTest
