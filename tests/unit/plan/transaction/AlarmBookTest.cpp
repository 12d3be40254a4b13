#include "transaction/AlarmBook.hpp"

#include "Catch.hpp"
#include "transaction/EngineAlarm.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

Alarm MakeStall(const std::string& robotID, EAlarmLevel level = EAlarmLevel::Light, std::string message = "stalled")
{
    return MakeAlarm(robotID, ALARM_STALL, level, std::move(message));
}

} // namespace

TEST_CASE("AlarmBook: an alarm is reported once when it is set and once when it is cleared")
{
    AlarmBook book;
    CHECK(book.Raise(MakeStall("LR01")) == std::vector<ErrorReport>{{MakeStall("LR01"), true}});
    CHECK(book.Raise(MakeStall("LR01")).empty());
    CHECK(book.Raise(MakeStall("LR01", EAlarmLevel::Light, "still stalled")).empty());
    CHECK(book.GetAlarms() == std::vector<Alarm>{MakeStall("LR01")});

    CHECK(
        book.Clear(MakeStall("LR01", EAlarmLevel::Heavy, {})) == std::vector<ErrorReport>{{MakeStall("LR01"), false}});
    CHECK(book.Clear(MakeStall("LR01")).empty());
    CHECK(book.GetAlarms().empty());
}

TEST_CASE("AlarmBook: another level clears the alarm and sets it again")
{
    AlarmBook book;
    static_cast<void>(book.Raise(MakeStall("LR01")));
    const Alarm heavy = MakeStall("LR01", EAlarmLevel::Heavy, "blocked");
    CHECK(book.Raise(heavy) == std::vector<ErrorReport>{{MakeStall("LR01"), false}, {heavy, true}});
    CHECK(book.GetAlarms() == std::vector<Alarm>{heavy});
}

TEST_CASE("AlarmBook: Update replaces an alarm whose text differs")
{
    AlarmBook book;
    static_cast<void>(book.Update(MakeStall("LR01")));
    CHECK(book.Contains(MakeStall("LR01")));
    CHECK(book.Update(MakeStall("LR01")).empty());
    const Alarm later = MakeStall("LR01", EAlarmLevel::Light, "node 4 not reached");
    CHECK_FALSE(book.Contains(later));
    CHECK(book.Update(later) == std::vector<ErrorReport>{{MakeStall("LR01"), false}, {later, true}});
}

TEST_CASE("AlarmBook: alarms of other robots, codes, plans and jobs are others")
{
    AlarmBook book;
    Alarm ofPlan = MakeStall("LR01");
    ofPlan.planID = "P1";
    Alarm ofJob = ofPlan;
    ofJob.jobID = "J1";
    const std::vector<Alarm> alarms{
        MakeStall("LR01"),
        MakeStall("CR01"),
        MakeAlarm("LR01", ALARM_CHARGE, EAlarmLevel::Light, {}),
        ofPlan,
        ofJob};
    for (const Alarm& alarm : alarms)
    {
        CHECK(book.Raise(alarm).size() == 1);
    }
    CHECK(book.GetAlarms() == alarms);
    CHECK(book.Clear(ofPlan) == std::vector<ErrorReport>{{ofPlan, false}});
    CHECK(book.GetAlarms().size() == 4);
}

TEST_CASE("AlarmBook: ClearIf reports what it clears in the order in which it was set")
{
    AlarmBook book;
    book.Restore({MakeStall("LR01"), MakeStall("CR01"), MakeStall("LR02")});
    const auto isOfLogistics = [](const Alarm& alarm) {
        return alarm.robotID.starts_with("LR");
    };
    CHECK(
        book.ClearIf(isOfLogistics)
        == std::vector<ErrorReport>{{MakeStall("LR01"), false}, {MakeStall("LR02"), false}});
    CHECK(book.GetAlarms() == std::vector<Alarm>{MakeStall("CR01")});
}
