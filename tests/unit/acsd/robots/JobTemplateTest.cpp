#include "robots/JobTemplate.hpp"

#include "Catch.hpp"
#include "robots/NumberTemplate.hpp"
#include "robots/VehicleFixture.hpp"

#include <string>
#include <tuple>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

const StationTable& GetStations()
{
    static const StationTable TABLE{
        {"A01.CP01", {{"type", std::string("rack")}, {"height", 0.8}, {"slot", std::int64_t{7}}}},
        {"A01.SET03", {{"type", std::string("set")}}}};
    return TABLE;
}

LoadPositions MakePositions()
{
    return {*Core::ParseLocationRange("CR01.TP01-03"), {{"TP02", "middle"}}};
}

Planning::StartJob MakeTrayLoad()
{
    Planning::StartJob job = MakeJob("TrayLoad");
    job.from = "A01.CP01.TP04";
    job.to = "CR01.TP02";
    job.jobNumber = 4711;
    return job;
}

std::string Resolve(const std::string& text, const Planning::StartJob& job)
{
    const auto parsed = JobTemplate::Parse(text);
    REQUIRE(parsed.has_value());
    const LoadPositions positions = MakePositions();
    const auto value = parsed->Resolve(JobData(job, GetStations(), positions));
    if (!value.has_value())
    {
        return "no " + MakeNameText(value.error());
    }
    const auto* const result = std::get_if<std::string>(&*value);
    return result == nullptr ? "no string" : *result;
}

std::int64_t ResolveNumber(const std::string& text, const Planning::StartJob& job)
{
    const auto parsed = NumberTemplate::Parse(text);
    REQUIRE(parsed.has_value());
    const LoadPositions positions = MakePositions();
    return parsed->Resolve(JobData(job, GetStations(), positions));
}

} // namespace

TEST_CASE("A template has the places, the carrier and the robot's port of the job")
{
    const Planning::StartJob job = MakeTrayLoad();
    CHECK(Resolve("{from} to {to}", job) == "A01.CP01.TP04 to CR01.TP02");
    CHECK(Resolve("{place}", job) == "A01.CP01.TP04");
    CHECK(Resolve("{position}", job) == "A01.CP01");
    CHECK(Resolve("{carrier}", job) == "C1");
    CHECK(Resolve("{robot_port}", job) == "middle");
    CHECK(Resolve("{station.type} {station.height}", job) == "rack 0.8");
    CHECK(Resolve("job {job_number} at {from.area}/{from.cp}/{from.set}", job) == "job 4711 at 1/1/0");
    CHECK(Resolve("{{plain}}", job) == "{plain}");
    CHECK(Resolve("", job).empty());
}

TEST_CASE("The place of an unload is its to, and of a job without places its position")
{
    Planning::StartJob unload = MakeTrayLoad();
    std::swap(unload.from, unload.to);
    CHECK(Resolve("{place} {robot_port}", unload) == "A01.CP01.TP04 middle");
    Planning::StartJob cover = MakeJob("OpenSetCover");
    cover.position = "A01.SET03";
    cover.carrierID.reset();
    CHECK(Resolve("{place} {station.type}", cover) == "A01.SET03 set");
    CHECK(Resolve("{robot_port}", cover) == "no {robot_port}");
    CHECK(Resolve("{from}", cover) == "no {from}");
    CHECK(Resolve("a {carrier}", cover) == "no {carrier}");
    CHECK(Resolve("{station.height}", cover) == "no {station.height}");
}

TEST_CASE("The station is that of the job's own place, where the robot reaches over to it")
{
    Planning::StartJob job = MakeTrayLoad();
    job.position = "A01.SET03";
    CHECK(Resolve("{station.type}", job) == "rack");
}

TEST_CASE("The station is the innermost one that has the job's own place, else the one where the robot is docked")
{
    const StationTable stations{
        {"A01.CP01", {{"type", std::string("rack")}}},
        {"A01.CP01.TP02", {{"type", std::string("tray")}}},
        {"A02", {{"type", std::string("hall")}}}};
    const LoadPositions positions = MakePositions();
    const auto find = [&stations, &positions](const std::string& from) {
        Planning::StartJob job = MakeTrayLoad();
        job.from = from;
        const JobData data(job, stations, positions);
        return data.GetStationID() + " " + std::get<std::string>(*data.FindOrNull(*ParseJobName("station.type")));
    };
    CHECK(find("A01.CP01.TP02") == "A01.CP01.TP02 tray");
    CHECK(find("A01.CP01.TP01") == "A01.CP01 rack");
    CHECK(find("A02.CP05.TP01") == "A02 hall");
    CHECK(find("A03.CP01.TP01") == "A01.CP01 rack");
}

TEST_CASE("What is exactly one name keeps the type of its value")
{
    const LoadPositions positions = MakePositions();
    const Planning::StartJob job = MakeTrayLoad();
    const JobData data(job, GetStations(), positions);
    CHECK(*JobTemplate::Parse("{station.height}")->Resolve(data) == JobValue(0.8));
    CHECK(*JobTemplate::Parse("{station.slot}")->Resolve(data) == JobValue(std::int64_t{7}));
    CHECK(*JobTemplate::Parse("{from.tp}")->Resolve(data) == JobValue(std::int64_t{4}));
    CHECK(*JobTemplate::Parse("{from.tp} ")->Resolve(data) == JobValue(std::string("4 ")));
}

TEST_CASE("A number is as it is or of one name; what a place lacks is 0")
{
    Planning::StartJob job = MakeTrayLoad();
    for (const auto& [text, number] : std::vector<std::pair<std::string, std::int64_t>>{
             {"12", 12},
             {"-3", -3},
             {"{job_number}", 4711},
             {"{from.area}", 1},
             {"{from.cp}", 1},
             {"{from.tp}", 4},
             {"{from.set}", 0},
             {"{to.area}", 0},
             {"{to.tp}", 2},
             {"{robot_port}", 2},
             {"{position.cp}", 1},
             {"{position.set}", 0},
             {"{station.slot}", 7},
             {"{station.none}", 0}})
    {
        INFO(text);
        CHECK(ResolveNumber(text, job) == number);
    }
    job.from = "CR01.TP01.MP03";
    job.to = "A12.SET03.MP25";
    CHECK(ResolveNumber("{from.tp}", job) == 1);
    CHECK(ResolveNumber("{from.mp}", job) == 3);
    CHECK(ResolveNumber("{robot_port}", job) == 1);
    CHECK(ResolveNumber("{to.area}", job) == 12);
    CHECK(ResolveNumber("{to.set}", job) == 3);
    CHECK(ResolveNumber("{to.mp}", job) == 25);
    job.from = "ST01.CP02";
    CHECK(ResolveNumber("{from.st}", job) == 1);
    CHECK(ResolveNumber("{from.area}", job) == 0);
}

TEST_CASE("An invalid template is reported with the reason")
{
    for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
             {"{form}", "unknown name \"form\"; known are from, to"},
             {"{from.xp}", "unknown name \"from.xp\""},
             {"{carrier.cp}", "unknown name"},
             {"{station.}", "unknown name"},
             {"{station}", "unknown name"},
             {"{}", "unknown name \"\""},
             {"{from", "unmatched brace at character 1"},
             {"from}", "unmatched brace at character 5"}})
    {
        INFO(text);
        const auto parsed = JobTemplate::Parse(text);
        REQUIRE_FALSE(parsed.has_value());
        CHECK(parsed.error().find(reason) != std::string::npos);
    }
    for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
             {"{from.cp}1", "exactly one name"},
             {"", "exactly one name"},
             {"1.5", "exactly one name"},
             {"99999999999999999999", "exactly one name"},
             {"{from.cp}{from.tp}", "exactly one name"},
             {"{carrier}", "{carrier} is not a number"},
             {"{from}", "{from} is not a number"},
             {"{nothing}", "unknown name"}})
    {
        INFO(text);
        const auto parsed = NumberTemplate::Parse(text);
        REQUIRE_FALSE(parsed.has_value());
        CHECK(parsed.error().find(reason) != std::string::npos);
    }
}

} // namespace ACS::Acsd::Test
