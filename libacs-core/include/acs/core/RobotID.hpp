#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>

#include <compare>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// The name of a robot ("LR01"), valid by construction: 1 to 64 of the characters A-Z a-z 0-9 _ -, and nothing that
/// is a segment of a location (A01, ST1, SET12, T01, CP01 …, in any case). Case-sensitive.
class ACS_API RobotID
{
public:
    static constexpr std::size_t MAX_LENGTH = 64; ///< Of the text, in bytes.
    /// Stands for the robot that executes the plan (section 10 of MCS-ACS).
    static constexpr std::string_view ALIAS = "AMR";

    friend std::strong_ordering operator<=>(const RobotID& left, const RobotID& right) noexcept
    {
        return left._text <=> right._text;
    }

private:
    std::string _text;

    explicit RobotID(std::string text);

public:
    /// Whether Parse would accept this text.
    [[nodiscard]] static bool IsRobotID(std::string_view text) noexcept;

    /// Fails with ECoreError::InvalidIdentifier.
    [[nodiscard]] static Result<RobotID> Parse(std::string_view text);

    /// As it was parsed.
    [[nodiscard]] const std::string& GetText() const noexcept;

    /// Whether this is the alias, which is not a valid name for a robot of a fleet.
    [[nodiscard]] bool IsAlias() const noexcept;

    bool operator==(const RobotID&) const = default;
};

} // namespace ACS::Core

template <>
struct std::hash<ACS::Core::RobotID>
{
    std::size_t operator()(const ACS::Core::RobotID& robotID) const noexcept
    {
        return std::hash<std::string>()(robotID.GetText());
    }
};
