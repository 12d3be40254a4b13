#include "Catch.hpp"
#include <acs/vda5050/FactsheetCheck.hpp>

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

TEST_CASE("Members that every order has may be required; members that no version of the standard has may not")
{
    FactsheetMessage factsheet;
    std::vector<OptionalParameter>& members = factsheet.protocolFeatures.optionalParameters.emplace();
    for (const char* const name :
         {"headerId",
          "timestamp",
          "version",
          "manufacturer",
          "serialNumber",
          "orderId",
          "orderUpdateId",
          "nodes.nodeId"})
    {
        members.push_back({std::string("order.") + name, EParameterSupport::Required, {}});
    }
    CHECK(FindContradictions(factsheet).empty());
    members.push_back({"order.colour", EParameterSupport::Required, {}});
    CHECK(FindContradictions(factsheet) == std::vector<std::string>{"the member order.colour is required and unknown"});
}

TEST_CASE("A factsheet of 300'000 actions and members is checked; compared with each other they would take minutes")
{
    constexpr std::size_t COUNT = 300'000;
    FactsheetMessage factsheet;
    factsheet.protocolFeatures.optionalParameters.emplace();
    for (std::size_t i = 0; i < COUNT; ++i)
    {
        factsheet.protocolFeatures.agvActions.emplace_back().actionType = "action-" + std::to_string(i);
        factsheet.protocolFeatures.optionalParameters->push_back(
            {"order.member-" + std::to_string(i), EParameterSupport::Required, {}});
    }
    CHECK(FindContradictions(factsheet).size() == COUNT);
}

} // namespace ACS::VDA5050::Test
