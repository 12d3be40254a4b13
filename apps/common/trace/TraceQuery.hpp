#pragma once

#include <string>
#include <string_view>

namespace ACS::Apps
{

/// Which lines of the trace are wanted. A member that is empty is not compared.
struct TraceQuery
{
    std::string planID;
    std::string robotID;
    std::string transactionID;

    /// Whether nothing is compared.
    [[nodiscard]] bool IsEmpty() const noexcept;

    /// Whether the line of the trace has these members. Compares the text of the line, without parsing it. False for what only a
    /// replay needs.
    [[nodiscard]] bool IsMatch(std::string_view line) const;
};

} // namespace ACS::Apps
