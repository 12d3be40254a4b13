#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

struct RejectionParts : EngineParts
{
    RejectionParts()
    {
        PutOn(lr, "D-CHG01");
        Discard();
    }

    /// Up to the limit, with a retry after each.
    void RejectAll()
    {
        for (std::size_t i = 0; i < engine.options.maximumRejections; ++i)
        {
            rejections.OnRetryDue(lr);
            rejections.OnRejected(lr, "no route");
        }
    }
};

} // namespace

TEST_CASE("RejectionWatch: a robot that rejected its drive is unavailable for a delay")
{
    RejectionParts parts;
    parts.rejections.OnRejected(parts.lr, "no route");
    CHECK(parts.lr.GetUnavailability() == EUnavailability::Rejecting);
    CHECK(parts.lr.Describe(EUnavailability::Rejecting) == "rejected its command, which is sent again: no route");
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.GetDelayOrNull(EEngineTimer::RejectionRetry) == parts.engine.options.rejectionRetry);
    CHECK(outcome.ListChanges<AlarmSet>().empty());
    parts.rejections.OnRobotChanged(parts.lr);
    CHECK_FALSE(parts.lr.IsUsable());
    parts.rejections.OnRetryDue(parts.lr);
    CHECK(parts.lr.IsUsable());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("RejectionWatch: a robot that rejects every drive gets an alarm with its reason, and no further drive")
{
    RejectionParts parts;
    parts.RejectAll();
    CHECK(parts.lr.Describe(parts.lr.GetUnavailability()) == "rejects its commands: no route");
    const auto alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.errorCode == "ACS-1012");
    CHECK(alarms.front().alarm.level == EAlarmLevel::Heavy);
    CHECK(
        alarms.front().alarm.message.find("rejected 3 commands in a row, the last one because no route.")
        != std::string::npos);
    parts.rejections.OnRetryDue(parts.lr);
    CHECK_FALSE(parts.lr.IsUsable());
    SECTION("a change of the robot is worth one more drive, and the alarm stays")
    {
        parts.rejections.OnRobotChanged(parts.lr);
        CHECK(parts.lr.IsUsable());
        CHECK(parts.Collect().ListClearedAlarms().empty());
        parts.rejections.OnRejected(parts.lr, "still no route");
        CHECK_FALSE(parts.lr.IsUsable());
        parts.rejections.OnRetryDue(parts.lr);
        CHECK_FALSE(parts.lr.IsUsable());
    }
    SECTION("progress clears the alarm and ends the row")
    {
        parts.rejections.OnRobotChanged(parts.lr);
        parts.rejections.EndRow(parts.lr);
        CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1012"});
        parts.rejections.OnRejected(parts.lr, "no route");
        CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::RejectionRetry).has_value());
    }
}

TEST_CASE("RejectionWatch: an incompatible robot is unavailable with a heavy alarm until it is compatible")
{
    RejectionParts parts;
    parts.rejections.OnCompatibility(parts.lr, {"its factsheet does not list order.edges.maxSpeed. Correct it."});
    CHECK(parts.lr.GetUnavailability() == EUnavailability::Incompatible);
    CHECK(parts.lr.Describe(EUnavailability::Incompatible) == "incompatible, see ACS-1013");
    const auto alarms = parts.Collect().ListChanges<AlarmSet>();
    REQUIRE(alarms.size() == 1);
    CHECK(alarms.front().alarm.errorCode == "ACS-1013");
    CHECK(alarms.front().alarm.level == EAlarmLevel::Heavy);
    CHECK(
        alarms.front().alarm.message
        == "Robot incompatible: its factsheet does not list order.edges.maxSpeed. Correct it.");
    parts.rejections.OnCompatibility(parts.lr, {});
    CHECK(parts.lr.IsUsable());
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1013"});
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}

TEST_CASE("RejectionWatch: a drive that is lost in manual mode or without a connection is not counted")
{
    RejectionParts parts;
    SECTION("manual")
    {
        parts.lr.view.state->bAutomatic = false;
    }
    SECTION("disconnected")
    {
        parts.lr.view.bOnline = false;
    }
    for (std::size_t i = 0; i <= parts.engine.options.maximumRejections; ++i)
    {
        parts.rejections.OnRejected(parts.lr, "the vehicle lost the order");
    }
    CHECK(parts.lr.view.rejections.GetCount() == 0);
    CHECK(parts.Collect().ListChanges<AlarmSet>().empty());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
}
