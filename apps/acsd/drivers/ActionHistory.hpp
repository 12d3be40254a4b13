#pragma once

#include <acs/acsd/RobotAction.hpp>
#include <acs/core/Now.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// An instant action that an operator has requested, and what became of it.
struct RobotActionRecord
{
    std::string actionID;
    std::string actionType;
    std::vector<RobotActionParameter> parameters;
    std::string reason; ///< Of the operator; may be empty.
    Core::WallTime requestedAt;
    ERobotActionStatus status = ERobotActionStatus::Waiting;
    std::string resultDescription;
    std::optional<Core::WallTime> endedAt; ///< Of the present status; nullopt unless it is Finished, Failed or Unknown.

    bool operator==(const RobotActionRecord&) const = default;
};

/// The last instant actions of one robot, in memory only.
class ActionHistory final
{
public:
    /// When there are more, the oldest one that has ended is dropped.
    static constexpr std::size_t MOST_RECORDS = 32;
    /// Bytes of a resultDescription. The rest is left out.
    static constexpr std::size_t MOST_RESULT_BYTES = 1'000;

private:
    std::vector<RobotActionRecord> _records; ///< Oldest first.

public:
    /// False: MOST_RECORDS actions have not ended.
    [[nodiscard]] bool HasRoom() const;

    /// There must be room. The reference is valid until the next call.
    const RobotActionRecord& Add(RobotActionRecord record);

    /// The changed record, valid until the next call; null if the action is not known, or nothing is different.
    [[nodiscard]] const RobotActionRecord* ApplyOrNull(const RobotActionChange& change, Core::WallTime now);

    [[nodiscard]] const std::vector<RobotActionRecord>& GetRecords() const noexcept;
};

/// The word of the operator API: "Waiting".
[[nodiscard]] std::string_view GetText(ERobotActionStatus status);

/// A line for people: "action initPosition of LR01: requested: moved by hand", or how it has ended.
[[nodiscard]] std::string DescribeAction(const std::string& robotID, const RobotActionRecord& record);

} // namespace ACS::Acsd
