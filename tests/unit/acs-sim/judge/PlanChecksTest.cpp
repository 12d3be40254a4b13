#include "judge/PlanChecks.hpp"

#include "Catch.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace ACS::AcsSim; // NOLINT(google-build-using-namespace)
using ACS::Protocol::ExecutionPlan;

namespace
{

ExecutionPlan MakeTrayPlan()
{
    ExecutionPlan plan;
    plan.planID = "P";
    plan.steps = {
        {1, "TrayLoad", "A01.CP01", {"TRAY_01"}, {{"J1", "A01.CP01.TP01", "AMR.TP01"}}},
        {2, "OpenSetCover", "A01.SET01", {}, {}},
        {3, "MemoryPickAndPlace", "A01.SET01", {}, {{"J2", "AMR.TP01.MP01", "A01.SET01.MP01"}}},
        {4, "TrayUnload", "A01.CP01", {"TRAY_01"}, {{"J3", "CR01.TP01", "A01.CP01.TP02"}}}};
    return plan;
}

} // namespace

TEST_CASE("6.3, 6.4 A correct plan has no findings")
{
    CHECK(CheckPlan(MakeTrayPlan()).empty());
    ExecutionPlan plan;
    plan.steps = {
        {1, "CassetteLoad", "ST01.CP02", {"C"}, {{"J1", "ST01.CP02", "AMR.CP01"}}},
        {2, "CassetteUnload", "A02.CP04", {"C"}, {{"J2", "AMR.CP01", "A02.CP04"}}},
        {3, "Start", "A01.SET01", {}, {{"J3", "", ""}}}};
    CHECK(CheckPlan(plan).empty());
}

TEST_CASE("3.1, 6.3, 6.4 Each error of a plan is found by its rule")
{
    using Spoil = std::function<void(ExecutionPlan&)>;
    const auto& [rule, spoil] = GENERATE(
        std::pair<ERule, Spoil>{
            ERule::PlanLocation,
            [](auto& plan) {
                plan.steps[0].position = "A01.CP1";
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanLocation,
            [](auto& plan) {
                plan.steps[0].jobs[0].from = "a01.cp01.tp01";
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanSteps,
            [](auto& plan) {
                plan.steps[1].stepNo = 1;
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanSteps,
            [](auto& plan) {
                plan.steps[0].stepNo = 0;
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanSteps,
            [](auto& plan) {
                plan.steps[0].stepNo = 9;
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanSteps,
            [](auto& plan) {
                plan.steps[2].jobs[0].jobID = "J1";
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanAction,
            [](auto& plan) {
                plan.steps[1].action = "End";
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanAction,
            [](auto& plan) {
                plan.steps[0].jobs.clear();
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanAction,
            [](auto& plan) {
                plan.steps[0].jobs[0].from.clear();
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanAction,
            [](auto& plan) {
                plan.steps[0].jobs[0].to = "A01.CP01.TP03";
            }},
        std::pair<ERule, Spoil>{
            ERule::PlanAction,
            [](auto& plan) {
                plan.steps[2].jobs[0].to = "A01.SET01";
            }},
        std::pair<ERule, Spoil>{ERule::PlanCarriers, [](auto& plan) {
                                    plan.steps[2].carrierIDs = {"TRAY_01"};
                                }});
    ExecutionPlan plan = MakeTrayPlan();
    spoil(plan);
    const std::vector<PlanFinding> findings = CheckPlan(plan);
    REQUIRE_FALSE(findings.empty());
    for (const PlanFinding& finding : findings)
    {
        CHECK(finding.rule == rule);
        CHECK(finding.text.find("plan \"P\", step ") != std::string::npos);
    }
}

TEST_CASE("A plan without steps has nothing to check")
{
    CHECK(CheckPlan({}).empty());
}
