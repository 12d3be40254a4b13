#pragma once

#include <acs/plan/CommandReceipt.hpp>

#include <optional>
#include <string>

namespace ACS::Acsd
{

/// A command of the operator that the engine refused after its sender had been answered: what it is for had changed while it
/// waited for the store, or the store failed.
struct RefusedOffer
{
    std::string command; ///< For people: "Abort of plan P1".
    std::string reason;  ///< A sentence.
    std::optional<Planning::CommandReceipt> receipt{};
};

} // namespace ACS::Acsd
