#pragma once

#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/StoreOrigin.hpp>

#include <string>

namespace ACS::Acsd
{

/// The contents of the store at the start, for the log: "schema 3, 2 open plans resumed, 120 ended plans, 1 report not
/// acknowledged, no alarms".
[[nodiscard]] std::string MakeStoreSummary(const Planning::StoreOrigin& origin, const Planning::StoredState& state);

} // namespace ACS::Acsd
