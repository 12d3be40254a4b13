#include "Catch.hpp"
#include <acs/vda5050/FactsheetCheck.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace ACS::VDA5050::Test
{

TEST_CASE("A factsheet without contradictions has none, and equal limits of a range are none")
{
    FactsheetMessage factsheet;
    CHECK(FindContradictions(factsheet).empty());
    factsheet.physicalParameters.speedMin = 1.0;
    factsheet.physicalParameters.speedMax = 1.0;
    factsheet.physicalParameters.angularSpeedMin = 1.0; // the other one is not stated
    factsheet.protocolLimits.timing.minOrderInterval = LONGEST_PLAUSIBLE_INTERVAL;
    factsheet.protocolLimits.timing.minStateInterval = LONGEST_PLAUSIBLE_INTERVAL;
    factsheet.protocolLimits.timing.defaultStateInterval = LONGEST_PLAUSIBLE_INTERVAL;
    factsheet.loadSpecification.loadSets.emplace_back().minLoadhandlingHeight = 2.0;
    CHECK(FindContradictions(factsheet).empty());
}

TEST_CASE("Reversed ranges of speed, height and state intervals are contradictions")
{
    FactsheetMessage factsheet;
    factsheet.physicalParameters.speedMin = 2.0;
    factsheet.physicalParameters.speedMax = 1.5;
    factsheet.physicalParameters.angularSpeedMin = 1.0;
    factsheet.physicalParameters.angularSpeedMax = 0.5;
    factsheet.physicalParameters.heightMin = 1.2;
    factsheet.physicalParameters.heightMax = 1.0;
    factsheet.protocolLimits.timing.minStateInterval = 31.0;
    LoadSet& set = factsheet.loadSpecification.loadSets.emplace_back();
    set.minLoadhandlingHeight = 2.0;
    set.maxLoadhandlingHeight = 1.0;
    CHECK(
        FindContradictions(factsheet)
        == std::vector<std::string>{
            "speedMin 2 is above speedMax 1.5",
            "angularSpeedMin 1 is above angularSpeedMax 0.5",
            "heightMin 1.2 is above heightMax 1",
            "minStateInterval 31 is above defaultStateInterval 30",
            "minLoadhandlingHeight 2 is above maxLoadhandlingHeight 1"});
}

TEST_CASE("Intervals beyond reason are reported with their value and their effect")
{
    FactsheetMessage factsheet;
    factsheet.protocolLimits.timing = {LONGEST_INTERVAL, LONGEST_INTERVAL, LONGEST_INTERVAL, LONGEST_INTERVAL};
    CHECK(
        FindContradictions(factsheet)
        == std::vector<std::string>{
            "minOrderInterval is 86400 s, above 300 s: each order message waits this long after the one before",
            "minStateInterval is 86400 s, above 300 s: the vehicle shows what it does this late",
            "defaultStateInterval is 86400 s, above 300 s: a vehicle that has failed counts as connected this long"});
}

TEST_CASE("A factsheet of 10 times the actions and members is checked in about 10 times the time")
{
    const auto measure = [](std::size_t count) {
        FactsheetMessage factsheet;
        factsheet.protocolFeatures.optionalParameters.emplace();
        for (std::size_t i = 0; i < count; ++i)
        {
            factsheet.protocolFeatures.agvActions.emplace_back().actionType = "action-" + std::to_string(i);
            factsheet.protocolFeatures.optionalParameters->push_back(
                {"order.member-" + std::to_string(i), EParameterSupport::Required, {}});
        }
        auto best = std::chrono::steady_clock::duration::max();
        for (int run = 0; run < 5; ++run) // the machine may do something else meanwhile
        {
            const auto begin = std::chrono::steady_clock::now();
            CHECK(FindContradictions(factsheet).size() == count);
            best = std::min(best, std::chrono::steady_clock::now() - begin);
        }
        return best;
    };
    const auto few = measure(3'000);
    const auto many = measure(30'000);
    CHECK(many < 40 * few); // 100 times in quadratic time
}

} // namespace ACS::VDA5050::Test
