#include "drivers/ActionHistory.hpp"

#include "Catch.hpp"

#include <chrono>
#include <cstddef>
#include <string>

namespace ACS::Acsd::Test
{

namespace
{

constexpr Core::WallTime REQUESTED = Core::WallTime(std::chrono::hours(1));
constexpr Core::WallTime LATER = Core::WallTime(std::chrono::hours(2));

RobotActionRecord MakeRecord(const std::string& actionID)
{
    return {actionID, "stateRequest", {}, {}, REQUESTED, ERobotActionStatus::Waiting, {}, std::nullopt};
}

} // namespace

TEST_CASE("A record shows the status of its action, and the time of its end")
{
    ActionHistory history;
    CHECK(history.GetRecords().empty());
    history.Add(MakeRecord("1"));
    CHECK(history.ApplyOrNull({"2", ERobotActionStatus::Finished, {}}, LATER) == nullptr);
    CHECK(history.ApplyOrNull({"1", ERobotActionStatus::Waiting, {}}, LATER) == nullptr);
    const RobotActionRecord* changedOrNull = history.ApplyOrNull({"1", ERobotActionStatus::Running, "half"}, LATER);
    REQUIRE(changedOrNull != nullptr);
    CHECK(changedOrNull->resultDescription == "half");
    CHECK_FALSE(changedOrNull->endedAt.has_value());
    changedOrNull = history.ApplyOrNull({"1", ERobotActionStatus::Unknown, "lost"}, LATER);
    REQUIRE(changedOrNull != nullptr);
    CHECK(changedOrNull->endedAt == LATER);
    changedOrNull = history.ApplyOrNull({"1", ERobotActionStatus::Running, {}}, LATER);
    REQUIRE(changedOrNull != nullptr);
    CHECK_FALSE(changedOrNull->endedAt.has_value());
    CHECK(history.GetRecords().size() == 1);
}

TEST_CASE("The oldest action that has ended makes room; actions that have not ended are never dropped")
{
    ActionHistory history;
    for (std::size_t i = 0; i < ActionHistory::MOST_RECORDS; ++i)
    {
        REQUIRE(history.HasRoom());
        history.Add(MakeRecord(std::to_string(i)));
    }
    CHECK_FALSE(history.HasRoom());
    REQUIRE(history.ApplyOrNull({"7", ERobotActionStatus::Failed, {}}, LATER) != nullptr);
    REQUIRE(history.ApplyOrNull({"3", ERobotActionStatus::Unknown, {}}, LATER) != nullptr);
    REQUIRE(history.HasRoom());
    history.Add(MakeRecord("new"));
    CHECK(history.GetRecords().size() == ActionHistory::MOST_RECORDS);
    CHECK(history.GetRecords().back().actionID == "new");
    CHECK(history.ApplyOrNull({"3", ERobotActionStatus::Finished, {}}, LATER) == nullptr); // dropped
    CHECK(history.ApplyOrNull({"0", ERobotActionStatus::Finished, {}}, LATER) != nullptr);
    history.Add(MakeRecord("newer"));
    CHECK(history.GetRecords().front().actionID == "1");
    history.Add(MakeRecord("newest")); // for 7
    CHECK_FALSE(history.HasRoom());
}

TEST_CASE("A long result is shortened at a character, and the line for people states what happened")
{
    ActionHistory history;
    RobotActionRecord record = MakeRecord("1");
    CHECK(DescribeAction("LR01", record) == "action stateRequest of LR01: requested");
    record.reason = "moved by hand";
    CHECK(DescribeAction("LR01", record) == "action stateRequest of LR01: requested: moved by hand");
    history.Add(record);
    std::string text;
    while (text.size() <= ActionHistory::MOST_RESULT_BYTES)
    {
        text += "\u00e9";
    }
    const RobotActionRecord* const failedOrNull = history.ApplyOrNull({"1", ERobotActionStatus::Failed, text}, LATER);
    REQUIRE(failedOrNull != nullptr);
    CHECK(failedOrNull->resultDescription == text.substr(0, ActionHistory::MOST_RESULT_BYTES) + "...");
    CHECK(DescribeAction("LR01", *failedOrNull).starts_with("action stateRequest of LR01: Failed: \u00e9"));
}

} // namespace ACS::Acsd::Test
