#include "faults/EFault.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ACS::AcsSim
{

namespace
{

/// By EFault.
constexpr std::array<std::string_view, FAULT_COUNT> NAMES{
    "late-report",
    "duplicate-report",
    "out-of-order",
    "unknown-report",
    "unknown-command",
    "bad-payload",
    "malformed",
    "unknown-ack",
    "late-ack",
    "refuse-plan",
    "fail-job",
    "not-connected",
    "reconnect"};

} // namespace

std::string_view GetName(EFault fault)
{
    return NAMES.at(static_cast<std::size_t>(fault));
}

std::optional<EFault> ReadFaultOrNull(std::string_view name)
{
    const auto* const found = std::ranges::find(NAMES, name);
    return found == NAMES.end() ? std::nullopt : std::optional(static_cast<EFault>(found - NAMES.begin()));
}

std::string ListFaults()
{
    return fmt::format("{}", fmt::join(NAMES, ", "));
}

} // namespace ACS::AcsSim
