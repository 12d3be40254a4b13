#pragma once

#include <optional>
#include <string>
#include <variant>

namespace ACS::Acsd
{

inline constexpr auto PLAN_ID = [](const auto& content) -> decltype(content.planID) {
    return content.planID;
};
inline constexpr auto ROBOT_ID = [](const auto& content) -> decltype(content.robotID) {
    return content.robotID;
};
inline constexpr auto TRANSACTION_ID = [](const auto& content) -> decltype(content.transactionID) {
    return content.transactionID;
};

/// The member that `get` selects, of the alternative that the variant has; empty if there is none, or if it has no value.
template <typename TVariant, typename TGet>
[[nodiscard]] std::string FindMember(const TVariant& value, const TGet& get)
{
    std::optional<std::string> foundOrNull;
    std::visit(
        [&](const auto& content) {
            if constexpr (requires { foundOrNull = get(content); })
            {
                foundOrNull = get(content);
            }
        },
        value);
    return foundOrNull.value_or(std::string());
}

} // namespace ACS::Acsd
