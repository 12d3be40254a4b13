#include "Floor.hpp"

#include "SeededRandom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

constexpr std::uint64_t SHORTEST_JOB = 3; ///< Seconds.
constexpr std::uint64_t JOB_RANGE = 8;

const std::string& Choose(const std::vector<std::string>& stations, SeededRandom& random)
{
    return stations[random.GetNext() % stations.size()];
}

} // namespace

std::string MakeDockID(const std::string& stationID)
{
    return "D-" + stationID;
}

EngineOptions MakeEngineOptions(const Floor& floor, std::size_t vehicles)
{
    EngineOptions options;
    options.maximumPlans = 1'000;
    for (std::size_t i = 0; i < vehicles; ++i)
    {
        const std::string robotID = fmt::format("LR{:02}", i + 1);
        const std::string& home = floor.parking.at(i);
        options.robots.push_back(
            {*Core::RobotID::Parse(robotID),
             ERobotType::LR,
             FLEET_TYPE,
             MakeDockID(home),
             home,
             *Core::ParseLocationRange(robotID + ".CP01"),
             {},
             {}});
    }
    return options;
}

std::vector<Demand> MakeDemands(const Floor& floor, std::uint64_t seed, std::size_t count, std::uint64_t priorities)
{
    SeededRandom random(seed);
    const std::uint64_t weights = std::accumulate(
        floor.flows.begin(),
        floor.flows.end(),
        std::uint64_t{0},
        [](std::uint64_t sum, const Flow& flow) { return sum + flow.weight; });
    std::vector<Demand> demands;
    while (demands.size() < count)
    {
        std::uint64_t drawn = random.GetNext() % weights;
        const auto flow = std::ranges::find_if(floor.flows, [&drawn](const Flow& candidate) {
            const bool bFound = drawn < candidate.weight;
            drawn -= bFound ? 0 : candidate.weight;
            return bFound;
        });
        Demand demand;
        demand.from = Choose(flow->from, random);
        do
        {
            demand.to = Choose(flow->to, random);
        }
        while (demand.to == demand.from);
        demand.priority = static_cast<std::int32_t>(random.GetNext() % priorities);
        demand.loadSeconds = static_cast<double>(SHORTEST_JOB + random.GetNext() % JOB_RANGE);
        demand.unloadSeconds = static_cast<double>(SHORTEST_JOB + random.GetNext() % JOB_RANGE);
        demands.push_back(std::move(demand));
    }
    return demands;
}

} // namespace ACS::Testing
