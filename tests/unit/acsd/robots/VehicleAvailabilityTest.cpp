#include "fixtures/PlanWorld.hpp"
#include "robots/DefaultParameters.hpp"
#include "robots/VehicleFixture.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using Testing::PlanWorld;

/// The default pick and drop on a site where one station has a height.
JobMethods MakeLoadMethods()
{
    const Planning::ActionTable actions = Planning::MakeStandardActions();
    auto stations = std::make_shared<const StationTable>(StationTable{
        {"A01.CP01", {{"type", std::string("rack")}, {"height", 0.8}}},
        {"A01.CP02", {{"type", std::string("rack")}}},
        {"A02.CP03", {{"type", std::string("rack")}}}});
    JobMethods methods(LoadPositions(*Core::ParseLocationRange("LR01.CP01-02"), {}), std::move(stations));
    for (const auto& [action, type] : {std::pair("CassetteLoad", "pick"), std::pair("CassetteUnload", "drop")})
    {
        methods.SetMethod(action, {}, {type, 0, MakeDefaultParameters(type, actions.at(action), 1)});
    }
    return methods;
}

/// The standard's, but for one parameter of the pick that is mandatory.
VDA5050::FactsheetMessage MakeFactsheet(const std::string& mandatory)
{
    StandardFactsheet standard;
    VDA5050::AgvAction& pick = standard.GetPick();
    std::erase_if(pick.actionParameters, [&mandatory](const auto& known) { return known.key == mandatory; });
    pick.actionParameters.push_back({mandatory, VDA5050::EValueDataType::String, "", false});
    return standard.factsheet;
}

Planning::Plan MakePlan(
    const std::string& planID,
    const std::string& robotID,
    const std::string& place,
    const std::vector<std::string>& carrierIDs = {"C1"})
{
    const std::string port = robotID + ".CP01";
    return {
        planID,
        "",
        1,
        {{1, "CassetteLoad", place, carrierIDs, {{planID + "-l", place, port}}},
         {2, "CassetteUnload", "A02.CP03", carrierIDs, {{planID + "-u", port, "A02.CP03"}}}}};
}

/// The engine and two LRs, of which LR01's factsheet goes through its adapter.
struct AvailabilityFixture
{
    PlanWorld world{1, true};
    VehicleFixture vehicle{MakeLoadMethods()};

    AvailabilityFixture()
    {
        vehicle.ComeOnline();
        HandOver();
        world.Connect();
    }

    void HandOver()
    {
        for (const Planning::JobCheckChanged& event : vehicle.TakeEvents<Planning::JobCheckChanged>())
        {
            world.Raise("LR01", event);
        }
        vehicle.actions.clear();
    }

    void Publish(const std::string& mandatory)
    {
        vehicle.Receive("factsheet", MakeFactsheet(mandatory));
        HandOver();
    }

    /// "LR02 Completed"; of a plan that waits its reason.
    std::string Run(const Planning::Plan& plan)
    {
        world.Submit(plan);
        REQUIRE(world.TryRun());
        return Describe(plan.planID);
    }

    [[nodiscard]] std::string Describe(const std::string& planID) const
    {
        const Planning::PlanSummary summary = *world.engine->GetPlanOrNull(planID);
        const std::optional<Planning::WaitReason> reason = world.engine->GetWaitReasonOrNull(planID);
        return reason.has_value() ? reason->message
                                  : summary.robotID.value_or("") + " " + std::string(GetText(summary.state));
    }
};

} // namespace

TEST_CASE("A vehicle whose factsheet demands a parameter that is not configured gets no plan")
{
    AvailabilityFixture site;
    CHECK(site.Run(MakePlan("P1", "LR01", "A01.CP01")) == "LR01 Completed");
    site.Publish("fork");
    const std::string reason =
        "No robot can execute the plan: LR01: the parameter fork of pick is mandatory and not configured.";
    CHECK(site.Run(MakePlan("P2", "LR01", "A01.CP01")) == reason);
    CHECK(site.Run(MakePlan("P3", "AMR", "A01.CP01")) == "LR02 Completed");
    CHECK(site.Describe("P2") == reason);
}

TEST_CASE("The station of each job decides whether a vehicle can do the plan, and a better factsheet gives it the plan")
{
    AvailabilityFixture site;
    site.Publish("height");
    const std::string reason =
        "No robot can execute the plan: LR01: the parameter height of pick cannot be given: the job has no {station.height}.";
    CHECK(site.Run(MakePlan("P1", "LR01", "A01.CP02")) == reason);
    CHECK(site.Run(MakePlan("P2", "LR01", "A01.CP01")) == "LR01 Completed");
    CHECK(site.Run(MakePlan("P3", "AMR", "A01.CP02")) == "LR02 Completed");
    CHECK(site.Describe("P1") == reason);
    site.Publish("loadType");
    REQUIRE(site.world.TryRun());
    CHECK(site.Describe("P1") == "LR01 Completed");
}

TEST_CASE("A plan without carriers is rejected by a vehicle whose pick requires the load's id")
{
    AvailabilityFixture site;
    site.Publish("loadId");
    CHECK(
        site.Run(MakePlan("P1", "LR01", "A01.CP01", {}))
        == "No robot can execute the plan: LR01: the parameter loadId of pick cannot be given: the job has no {carrier}.");
    CHECK(site.Run(MakePlan("P2", "LR01", "A01.CP01")) == "LR01 Completed");
}

} // namespace ACS::Acsd::Test
