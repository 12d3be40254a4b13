#pragma once

#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <string>

namespace ACS::McsSim
{

/// A plan that is to be sent, as it goes over the wire.
struct PlannedPlan
{
    Protocol::ExecutionPlan plan;
    std::string transactionID; ///< The same on every attempt. Empty: a payload file gave none.

    bool operator==(const PlannedPlan&) const = default;
};

} // namespace ACS::McsSim
