#include "transaction/AlarmBook.hpp"

#include "Catch.hpp"
#include "transaction/EngineAlarm.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

using namespace std::chrono_literals;

constexpr ACS::Core::SteadyTime NOW{1h};

Alarm MakeStall(const std::string& robotID, EAlarmLevel level = EAlarmLevel::Light, std::string message = "stalled")
{
    return MakeAlarm(robotID, ALARM_STALL, level, std::move(message));
}

} // namespace

TEST_CASE("AlarmBook: an alarm is reported once when it is set and once when it is cleared")
{
    AlarmBook book;
    CHECK(book.Raise(MakeStall("LR01"), NOW) == std::vector<ErrorReport>{{MakeStall("LR01"), true}});
    CHECK(book.Raise(MakeStall("LR01"), NOW).empty());
    CHECK(book.Raise(MakeStall("LR01", EAlarmLevel::Light, "still stalled"), NOW).empty());
    CHECK(book.GetAlarms() == std::vector<Alarm>{MakeStall("LR01")});

    CHECK(
        book.Clear(MakeStall("LR01", EAlarmLevel::Heavy, {}), NOW)
        == std::vector<ErrorReport>{{MakeStall("LR01"), false}});
    CHECK(book.Clear(MakeStall("LR01"), NOW).empty());
    CHECK(book.GetAlarms().empty());
}

TEST_CASE("AlarmBook: another level clears the alarm and sets it again")
{
    AlarmBook book;
    static_cast<void>(book.Raise(MakeStall("LR01"), NOW));
    const Alarm heavy = MakeStall("LR01", EAlarmLevel::Heavy, "blocked");
    CHECK(book.Raise(heavy, NOW) == std::vector<ErrorReport>{{MakeStall("LR01"), false}, {heavy, true}});
    CHECK(book.GetAlarms() == std::vector<Alarm>{heavy});
}

TEST_CASE("AlarmBook: Update replaces an alarm whose text differs")
{
    AlarmBook book;
    static_cast<void>(book.Update(MakeStall("LR01"), NOW));
    CHECK(book.Contains(MakeStall("LR01")));
    CHECK(book.Update(MakeStall("LR01"), NOW).empty());
    const Alarm later = MakeStall("LR01", EAlarmLevel::Light, "node 4 not reached");
    CHECK_FALSE(book.Contains(later));
    CHECK(book.Update(later, NOW) == std::vector<ErrorReport>{{MakeStall("LR01"), false}, {later, true}});
}

TEST_CASE(
    "AlarmBook: an alarm is cleared with the code of the MCS that it was set with, and set again with the present one")
{
    AlarmBook former(AlarmBook::McsCodes{{{std::string(ALARM_STALL), "E77"}}});
    static_cast<void>(former.Raise(MakeStall("LR01"), NOW));
    static_cast<void>(former.Raise(MakeAlarm("LR01", ALARM_CHARGE, EAlarmLevel::Light, {}), NOW));
    REQUIRE(former.GetAlarms().size() == 2);
    CHECK(former.GetAlarms()[0].mcsCode == "E77");
    CHECK(former.GetAlarms()[1].mcsCode == std::string(ALARM_CHARGE));

    AlarmBook book(AlarmBook::McsCodes{{{std::string(ALARM_STALL), "E78"}}});
    book.Restore(former.GetAlarms());
    CHECK(book.Contains(MakeStall("LR01")));
    CHECK(book.Update(MakeStall("LR01"), NOW).empty());
    const std::vector<ErrorReport> reports = book.Raise(MakeStall("LR01", EAlarmLevel::Heavy, "blocked"), NOW);
    REQUIRE(reports.size() == 2);
    CHECK(reports[0].alarm.mcsCode == "E77");
    CHECK(reports[1].alarm.mcsCode == "E78");
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
        CHECK(book.Raise(alarm, NOW).size() == 1);
    }
    CHECK(book.GetAlarms() == alarms);
    CHECK(book.Clear(ofPlan, NOW) == std::vector<ErrorReport>{{ofPlan, false}});
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

TEST_CASE("AlarmBook: an alarm that is set five times without a quiet minute is cleared after a quiet minute")
{
    AlarmBook book;
    ACS::Core::SteadyTime now = NOW;
    for (int i = 1; i <= 5; ++i)
    {
        CHECK(book.Raise(MakeStall("LR01"), now).size() == 1);
        now += 59s;
        CHECK(book.Clear(MakeStall("LR01"), now).size() == (i < 5 ? 1 : 0));
    }
    CHECK(book.GetNextDelayedOrNull() == now + 60s);
    CHECK(book.Clear(MakeStall("LR01"), now + 30s).empty());
    CHECK(book.GetNextDelayedOrNull() == now + 60s); // the same again does not prolong the wait

    CHECK(book.Raise(MakeStall("LR01"), now + 40s).empty());
    CHECK(book.GetNextDelayedOrNull() == std::nullopt);
    CHECK(book.Clear(MakeStall("LR01"), now + 50s).empty());
    CHECK(book.ApplyDelayed(now + 109s).empty());
    CHECK(book.ApplyDelayed(now + 110s) == std::vector<ErrorReport>{{MakeStall("LR01"), false}});
    CHECK(book.GetNextDelayedOrNull() == std::nullopt);
    CHECK(book.GetAlarms().empty());
}

TEST_CASE(
    "AlarmBook: an alarm that was set for a minute without a change is cleared at once, however often it was set before")
{
    AlarmBook book;
    for (int i = 1; i <= 5; ++i)
    {
        static_cast<void>(book.Raise(MakeStall("LR01"), NOW));
        static_cast<void>(book.Clear(MakeStall("LR01"), NOW));
    }
    static_cast<void>(book.Raise(MakeStall("LR01"), NOW));
    CHECK(book.Clear(MakeStall("LR01"), NOW + 59s).empty());
    static_cast<void>(book.Raise(MakeStall("LR01"), NOW + 59s));
    CHECK(book.Clear(MakeStall("LR01"), NOW + 119s).size() == 1);
}

TEST_CASE("AlarmBook: a level that changes often stays heavy for a minute; it rises at once")
{
    AlarmBook book;
    const Alarm light = MakeStall("LR01");
    const Alarm heavy = MakeStall("LR01", EAlarmLevel::Heavy);
    std::size_t reports = 0;
    for (int i = 0; i < 100; ++i)
    {
        reports += book.Raise(heavy, NOW).size() + book.Raise(light, NOW).size();
    }
    CHECK(reports == 9);
    CHECK(book.GetAlarms() == std::vector<Alarm>{heavy});
    CHECK(book.ApplyDelayed(NOW + 60s) == std::vector<ErrorReport>{{heavy, false}, {light, true}});
    CHECK(book.Raise(heavy, NOW + 60s).size() == 2);
}

TEST_CASE("AlarmBook: alarms about plans, and alarms that an operator clears, are not delayed")
{
    AlarmBook book;
    Alarm ofPlan = MakeStall("LR01");
    ofPlan.planID = "P1";
    for (int i = 0; i < 10; ++i)
    {
        CHECK(book.Raise(ofPlan, NOW).size() == 1);
        CHECK(book.Clear(ofPlan, NOW).size() == 1);
        static_cast<void>(book.Raise(MakeStall("LR01"), NOW));
        static_cast<void>(book.Clear(MakeStall("LR01"), NOW));
    }
    CHECK(book.ClearIf([](const Alarm&) { return true; }).size() == 1);
    CHECK(book.GetAlarms().empty());
    CHECK(book.GetNextDelayedOrNull() == std::nullopt);
}
