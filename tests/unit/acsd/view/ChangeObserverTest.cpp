#include "view/ChangeObserver.hpp"

#include "Catch.hpp"
#include "fixtures/PlanWorldSteps.hpp"
#include "view/ViewCodec.hpp"

#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// The values of the member in the entries, in order.
std::vector<std::string> ListTexts(const std::vector<std::string>& entries)
{
    constexpr std::string_view KEY = R"("text":")";
    std::vector<std::string> texts;
    for (const std::string& entry : entries)
    {
        const std::size_t begin = entry.find(KEY) + KEY.size();
        texts.push_back(entry.substr(begin, entry.rfind('"') - begin));
    }
    return texts;
}

} // namespace

TEST_CASE("Each change of state is an entry with its objects and a line")
{
    std::vector<std::string> entries;
    ChangeObserver feed(
        [&entries](const ChangeEntry& entry, Core::Now now) { entries.push_back(EncodeEntry(entry, now.wall)); });

    const Planning::Alarm alarm{"LR01", "ACS-1008", Planning::EAlarmLevel::Heavy, "job \"J\" unknown", "P1", 3, "J1"};
    feed.OnAlarmChanged(alarm, true, "t1", {});
    feed.OnAlarmChanged(alarm, false, "t2", {});
    feed.OnTscChanged(Planning::ETscState::Pausing, Planning::ETscState::Auto, {});
    feed.OnNote("LR01", "entered N1", {});
    Planning::RobotStatus status;
    status.robotID = "LR01";
    status.message = "LR01: no connection.";
    feed.OnRobotStatusChanged(status, {});
    REQUIRE(entries.size() == 5);
    CHECK(
        entries[0]
        == R"({"time":"1970-01-01T00:00:00.000Z","kind":"alarm","robotId":"LR01","planId":"P1","stepNo":3,"jobId":"J1",)"
           R"("text":"heavy alarm ACS-1008 of LR01 set: job \"J\" unknown"})");
    CHECK(
        entries[2]
        == R"({"time":"1970-01-01T00:00:00.000Z","kind":"tsc","robotId":null,"planId":null,"stepNo":null,"jobId":null,)"
           R"("text":"TSC: Auto -> Pausing"})");
    const std::vector<std::string> texts = ListTexts(entries);
    CHECK(texts[1] == "heavy alarm ACS-1008 of LR01 cleared");
    CHECK(texts[3] == "entered N1");
    CHECK(texts[4] == "robot LR01: Disconnected: LR01: no connection.");
}

TEST_CASE("Each observer of an engine receives each change, in the order in which they were added")
{
    Testing::PlanWorld world{1, true};
    std::vector<std::string> received;
    const auto recordAs = [&received](const std::string& name) {
        return [&received, name](const ChangeEntry& entry, Core::Now /*now*/) {
            received.push_back(name + std::string(entry.text));
        };
    };
    ChangeObserver first(recordAs("1 "));
    ChangeObserver second(recordAs("2 "));
    world.engine->AddObserver(first);
    world.engine->AddObserver(second);
    Planning::EngineActions actions;
    world.engine->Handle(Planning::ControlTSC{true, 0}, {}, actions);
    REQUIRE(received.size() >= 2);
    CHECK(received[0].starts_with("1 TSC: Auto -> "));
    CHECK(received[1] == "2" + received[0].substr(1));
}

} // namespace ACS::Acsd::Test
