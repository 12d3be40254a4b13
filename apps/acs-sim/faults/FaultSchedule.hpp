#pragma once

#include "faults/EFault.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::AcsSim
{

/// A fault of the command line: "malformed", "malformed=3" or "malformed=always".
struct FaultOrder
{
    EFault fault = EFault::Malformed;
    std::optional<std::size_t> count = 1; ///< Nullopt: always.

    bool operator==(const FaultOrder&) const = default;
};

[[nodiscard]] std::optional<FaultOrder> ReadFaultOrderOrNull(std::string_view text);

/// Which fault comes next: in the order of the command line, again and again until each has occurred as often as it shall.
/// Pure.
class FaultSchedule
{
    std::vector<FaultOrder> _orders;
    std::size_t _next = 0;

public:
    FaultSchedule() = default;
    explicit FaultSchedule(std::vector<FaultOrder> orders);

    /// Nullopt: all have occurred.
    [[nodiscard]] std::optional<EFault> ExtractNextOrNull();
    /// Faults with a count that have still to occur.
    [[nodiscard]] bool HasCounted() const;
};

} // namespace ACS::AcsSim
