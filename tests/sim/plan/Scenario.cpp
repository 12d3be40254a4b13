#include "Scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

constexpr std::uint64_t SCENARIO_PART = 1;
constexpr std::uint64_t ARM_PART = 2; ///< Whether a run has arms: separate from the other random numbers.
constexpr std::uint64_t LEASE_PART = 900;
constexpr std::uint64_t SERVICE_PART = 3; ///< Maintenance and batteries, likewise.
constexpr std::uint64_t QUEUE_PART = 4;   ///< The order of the queue, likewise.
constexpr double SPACING = 2.0;

/// Nodes and edges for both types of vehicles.
class SiteDraft final
{
    Scenario& _scenario;

public:
    explicit SiteDraft(Scenario& scenario)
        : _scenario(scenario)
    {
    }

    void AddNode(const std::string& nodeID, double x, double y)
    {
        _scenario.nodes.push_back({nodeID, x, y, "floor", {{"lr-base", std::nullopt}, {"cr-base", std::nullopt}}});
    }

    void AddWay(const std::string& from, const std::string& to)
    {
        const auto makeRule = [](std::string type) {
            Planning::SiteEdgeRule rule;
            rule.vehicleTypeID = std::move(type);
            rule.maxSpeed = 1.2;
            return rule;
        };
        _scenario.edges.push_back({from + ">" + to, from, to, {makeRule("lr-base"), makeRule("cr-base")}});
    }

    void AddRoad(const std::string& from, const std::string& to)
    {
        AddWay(from, to);
        AddWay(to, from);
    }

    /// A station next to a lane node.
    void AddDock(const std::string& stationID, const std::string& lane, double x, double y)
    {
        const std::string nodeID = "D-" + stationID;
        AddNode(nodeID, x, y);
        AddRoad(lane, nodeID);
        _scenario.stations.push_back({stationID, {nodeID}});
    }
};

const std::vector<std::string>& GetStationIDs()
{
    static const std::vector<std::string> STATIONS{
        "CHG01",
        "A01.CP01",
        "A01.SET01",
        "CHG02",
        "A01.CP02",
        "A01.SET02",
        "CHG03",
        "A02.CP03",
        "A01.CP03",
        "CHG04",
        "A02.CP04",
        "A01.SET03"};
    return STATIONS;
}

/// A one-way ring: two lanes of six nodes, joined at their ends, with a dock on the outer side of each node.
void DrawRing(Scenario& scenario)
{
    SiteDraft draft(scenario);
    const std::vector<std::string>& stations = GetStationIDs();
    const std::size_t half = stations.size() / 2;
    const auto name = [&stations](std::size_t index) {
        return fmt::format("L{:02}", index % stations.size() + 1);
    };
    for (std::size_t i = 0; i < stations.size(); ++i)
    {
        const bool bUpper = i >= half;
        const double x = SPACING * static_cast<double>(bUpper ? stations.size() - 1 - i : i);
        draft.AddNode(name(i), x, bUpper ? SPACING : 0.0);
        draft.AddDock(stations[i], name(i), x, bUpper ? 2 * SPACING : -SPACING);
    }
    for (std::size_t i = 0; i < stations.size(); ++i)
    {
        draft.AddWay(name(i), name(i + 1));
    }
}

/// One lane in both directions, with docks on both sides.
void DrawLine(Scenario& scenario)
{
    SiteDraft draft(scenario);
    const std::vector<std::string>& stations = GetStationIDs();
    for (std::size_t i = 0; i < stations.size(); ++i)
    {
        const std::string lane = fmt::format("L{:02}", i / 2 + 1);
        const std::size_t column = i / 2;
        const double x = SPACING * static_cast<double>(column);
        if (i % 2 == 0)
        {
            draft.AddNode(lane, x, 0.0);
        }
        draft.AddDock(stations[i], lane, x, i % 2 == 0 ? -SPACING : SPACING);
    }
    for (std::size_t i = 1; i < stations.size() / 2; ++i)
    {
        draft.AddRoad(fmt::format("L{:02}", i), fmt::format("L{:02}", i + 1));
    }
}

/// Four rows of four: rows in both directions, outer columns one-way; docks left and right of the rows and above and
/// below.
void DrawGrid(Scenario& scenario)
{
    constexpr std::size_t SIDE = 4;
    SiteDraft draft(scenario);
    const auto name = [](std::size_t row, std::size_t column) {
        return fmt::format("G{}{}", row + 1, column + 1);
    };
    for (std::size_t row = 0; row < SIDE; ++row)
    {
        for (std::size_t column = 0; column < SIDE; ++column)
        {
            draft.AddNode(name(row, column), SPACING * static_cast<double>(column), SPACING * static_cast<double>(row));
        }
    }
    for (std::size_t row = 0; row < SIDE; ++row)
    {
        for (std::size_t column = 0; column + 1 < SIDE; ++column)
        {
            draft.AddRoad(name(row, column), name(row, column + 1));
            if (column == 0)
            {
                draft.AddWay(name(column, row), name(column + 1, row));
                draft.AddWay(name(column + 1, row), name(column, row));
            }
            else if (row % 2 == 0)
            {
                draft.AddWay(name(column, row), name(column + 1, row));
            }
            else
            {
                draft.AddWay(name(column + 1, row), name(column, row));
            }
        }
    }
    const std::vector<std::string>& stations = GetStationIDs();
    const double far = SPACING * static_cast<double>(SIDE);
    for (std::size_t i = 0; i < SIDE; ++i)
    {
        const double at = SPACING * static_cast<double>(i);
        draft.AddDock(stations[i], name(i, 0), -SPACING, at);
        draft.AddDock(stations[SIDE + i], name(i, SIDE - 1), far, at);
        draft.AddDock(stations[2 * SIDE + i], name(0, i), at, -SPACING);
    }
}

Planning::RobotOptions MakeRobot(const std::string& robotID, Planning::ERobotType type, const std::string& home)
{
    const bool bLogistics = type == Planning::ERobotType::LR;
    Planning::RobotOptions robot{
        *Core::RobotID::Parse(robotID),
        type,
        bLogistics ? "lr-base" : "cr-base",
        "D-" + home,
        home,
        *Core::ParseLocationRange(robotID + (bLogistics ? ".CP01" : ".TP01-03")),
        {},
        {}};
    for (int tray = 1; !bLogistics && tray <= 3; ++tray)
    {
        std::ranges::move(
            *Core::ParseLocationRange(fmt::format("{}.TP{:02}.MP01-04", robotID, tray)),
            std::back_inserter(robot.childPorts));
    }
    return robot;
}

void ChooseOptions(Scenario& scenario, ChanceModel& chance)
{
    using Planning::ERobotType;
    Planning::EngineOptions& options = scenario.options;
    options.robots.push_back(MakeRobot("LR01", ERobotType::LR, "CHG01"));
    options.robots.push_back(MakeRobot("CR01", ERobotType::CR, "CHG02"));
    const std::size_t more = chance.GetBelow(3);
    if (more > 0)
    {
        options.robots.push_back(MakeRobot("LR02", ERobotType::LR, "CHG03"));
    }
    if (more > 1)
    {
        options.robots.push_back(MakeRobot("CR02", ERobotType::CR, "CHG04"));
    }
    for (const std::string& place : scenario.trayPlaces)
    {
        std::ranges::move(*Core::ParseLocationRange(place + ".TP01-04"), std::back_inserter(options.places));
    }
    for (const std::string& set : scenario.sets)
    {
        std::ranges::move(*Core::ParseLocationRange(set + ".MP01-08"), std::back_inserter(options.places));
    }
    // Also shorter than some robots are disconnected.
    options.restartWait = std::chrono::seconds(chance.GetBetween(0, 60));
    options.baseLength = chance.GetBetween(1, 4);
    options.bInitialPendingReported = chance.IsHit(200);
    options.bLowerPriorityFirst = chance.IsHit(200);
    if (ChanceModel({scenario.seed, QUEUE_PART}).IsHit(300))
    {
        options.queueOvertaking = std::chrono::minutes(2);
    }
    options.controls.cancelUntil = static_cast<Planning::ECancelWindow>(chance.GetBelow(3));
    options.controls.bPausesAfterJob = chance.IsHit(250);
    options.controls.bAbortStopsJob = chance.IsHit(250);
    options.controls.bAbortFinishesPausedJob = chance.IsHit(250);
    options.controls.bJobFailureFailsAbort = !chance.IsHit(250);
    options.controls.bAbortReportsStep = chance.IsHit(250);
    if (chance.IsHit(200))
    {
        for (auto& [name, rule] : options.actions)
        {
            rule.timeout = std::chrono::milliseconds(chance.GetBetween(4'000, 20'000));
        }
    }
}

void ChooseService(Scenario& scenario)
{
    ChanceModel chance({scenario.seed, SERVICE_PART});
    scenario.bMaintenance = chance.IsHit(200) && scenario.Has(EFault::Controls);
    scenario.bBatteries = chance.IsHit(300) && scenario.HasVehicles();
    if (!scenario.bBatteries)
    {
        return;
    }
    // A robot that leaves its charger is back some drives later, for half a minute.
    scenario.options.dispatch.batteryFloor = 20;
    scenario.options.dispatch.batteryResume = 35;
    for (Planning::RobotOptions& robot : scenario.options.robots)
    {
        robot.chargingStationID = robot.homeStationID;
    }
}

Protocol::PlanStep MakeStep(std::int32_t stepNo, std::string action, std::string position)
{
    Protocol::PlanStep step;
    step.stepNo = stepNo;
    step.action = std::move(action);
    step.position = std::move(position);
    return step;
}

/// One or two transports of a cassette.
void AddTransports(
    Protocol::ExecutionPlan& plan,
    const Scenario& scenario,
    ChanceModel& chance,
    const std::string& port)
{
    std::int32_t stepNo = 0;
    for (std::size_t count = chance.GetBetween(1, 2); count > 0; --count)
    {
        const std::string from = chance.Pick(scenario.cassettePlaces);
        const std::string to = chance.Pick(scenario.cassettePlaces);
        const std::string carrier = fmt::format("{}-C{}", plan.planID, count);
        ++stepNo;
        Protocol::PlanStep load = MakeStep(stepNo, "CassetteLoad", from);
        load.carrierIDs = {carrier};
        load.jobs = {{fmt::format("{}-{}", plan.planID, stepNo), from, port}};
        ++stepNo;
        Protocol::PlanStep unload = MakeStep(stepNo, "CassetteUnload", to);
        unload.carrierIDs = {carrier};
        unload.jobs = {{fmt::format("{}-{}", plan.planID, stepNo), port, to}};
        plan.steps.push_back(std::move(load));
        plan.steps.push_back(std::move(unload));
    }
}

/// Trays are loaded, samples moved at a set, trays unloaded.
void AddTrayWork(Protocol::ExecutionPlan& plan, const Scenario& scenario, ChanceModel& chance, const std::string& robot)
{
    const std::string place = chance.Pick(scenario.trayPlaces);
    const std::string set = chance.Pick(scenario.sets);
    const std::size_t trays = chance.GetBetween(1, 3);
    std::int32_t stepNo = 1;
    Protocol::PlanStep load = MakeStep(stepNo, "TrayLoad", place);
    Protocol::PlanStep work = MakeStep(stepNo + 2, "MemoryPickAndPlace", set);
    Protocol::PlanStep unload = MakeStep(stepNo + 4, "TrayUnload", place);
    for (std::size_t tray = 1; tray <= trays; ++tray)
    {
        const std::string port = fmt::format("{}.TP{:02}", robot, tray);
        const std::string fixed = fmt::format("{}.TP{:02}", place, tray);
        load.carrierIDs.push_back(fmt::format("{}-T{}", plan.planID, tray));
        unload.carrierIDs.push_back(load.carrierIDs.back());
        load.jobs.push_back({fmt::format("{}-a{}", plan.planID, tray), fixed, port});
        work.jobs.push_back(
            {fmt::format("{}-b{}", plan.planID, tray), port + ".MP01", fmt::format("{}.MP{:02}", set, tray)});
        unload.jobs.push_back({fmt::format("{}-c{}", plan.planID, tray), port, fixed});
    }
    plan.steps.push_back(std::move(load));
    if (chance.IsHit(500))
    {
        plan.steps.push_back(MakeStep(stepNo + 1, "OpenSetCover", set));
    }
    plan.steps.push_back(std::move(work));
    plan.steps.push_back(std::move(unload));
}

} // namespace

std::string_view GetText(ERobotKind kind)
{
    switch (kind)
    {
        case ERobotKind::Vda5050:
            return "vda5050";
        case ERobotKind::Arms:
            return "arms";
        case ERobotKind::Memory:
        default:
            return "memory";
    }
}

Planning::SiteMap Scenario::MakeSite() const
{
    return *Planning::SiteMap::Create(nodes, edges, stations);
}

Scenario MakeScenario(std::uint64_t seed, const ScenarioDemands& demands)
{
    ChanceModel chance({seed, SCENARIO_PART});
    Scenario scenario;
    scenario.seed = seed;
    scenario.cassettePlaces = {"A01.CP01", "A01.CP02", "A02.CP03", "A02.CP04"};
    scenario.trayPlaces = {"A01.CP01", "A01.CP02", "A01.CP03"};
    scenario.sets = {"A01.SET01", "A01.SET02", "A01.SET03"};
    const std::size_t site = chance.GetBelow(3);
    if (site == 0)
    {
        scenario.siteName = "ring";
        DrawRing(scenario);
    }
    else if (site == 1)
    {
        scenario.siteName = "line";
        DrawLine(scenario);
    }
    else
    {
        scenario.siteName = "grid";
        DrawGrid(scenario);
    }
    ChooseOptions(scenario, chance);
    scenario.planCount = chance.GetBetween(3, 8);
    scenario.faultsEnd = std::chrono::seconds(chance.GetBetween(60, 240));
    // Some runs have all faults, most have some, so that each fault also occurs without others that hide its effect.
    const bool bAll = chance.IsHit(250);
    constexpr auto PARTITIONS = static_cast<std::size_t>(EFault::Partitions);
    for (std::size_t fault = 0; fault < PARTITIONS; ++fault)
    {
        const bool bChosen = chance.IsHit(500);
        scenario.faults.set(fault, (bAll || bChosen) && !demands.without.test(fault));
    }
    ChanceModel leaseChance({seed, LEASE_PART});
    scenario.bShared = demands.bShared.value_or(leaseChance.IsHit(150));
    scenario.faults.set(PARTITIONS, leaseChance.IsHit(700) && !demands.without.test(PARTITIONS));
    const bool bVehicles = chance.IsHit(70);
    const bool bArms = !bVehicles && ChanceModel({seed, ARM_PART}).IsHit(40);
    const ERobotKind kind = bArms ? ERobotKind::Arms : ERobotKind::Memory;
    scenario.robots = demands.robots.value_or(bVehicles ? ERobotKind::Vda5050 : kind);
    ChooseService(scenario);
    return scenario;
}

Protocol::ExecutionPlan MakeGoodPlan(const Scenario& scenario, ChanceModel& chance, const std::string& planID)
{
    Protocol::ExecutionPlan plan;
    plan.planID = planID;
    plan.lotID = "LOT-" + planID;
    if (chance.IsHit(700))
    {
        plan.priority = static_cast<std::int32_t>(chance.GetBelow(4));
    }
    const bool bLogistics = chance.IsHit(500);
    std::vector<std::string> robots{"AMR", "AMR", "AMR"};
    for (const Planning::RobotOptions& robot : scenario.options.robots)
    {
        if ((robot.type == Planning::ERobotType::LR) == bLogistics)
        {
            robots.push_back(robot.robotID.GetText());
        }
    }
    const std::string robot = chance.Pick(robots);
    if (bLogistics)
    {
        AddTransports(plan, scenario, chance, robot + ".CP01");
    }
    else
    {
        AddTrayWork(plan, scenario, chance, robot);
    }
    return plan;
}

Protocol::ExecutionPlan MakeBadPlan(const Scenario& scenario, ChanceModel& chance, const std::string& planID)
{
    Protocol::ExecutionPlan plan = MakeGoodPlan(scenario, chance, planID);
    Protocol::PlanStep& step = plan.steps[chance.GetBelow(plan.steps.size())];
    switch (chance.GetBelow(6))
    {
        case 0:
            step.action = "Levitate";
            break;
        case 1:
            step.position = "A07.CP01";
            break;
        case 2:
            plan.steps.back().stepNo = plan.steps.front().stepNo;
            break;
        case 3:
            plan.steps.front().jobs.front().to = "LR77.CP01";
            break;
        case 4:
            plan.steps.back().jobs.front().jobID = plan.steps.front().jobs.front().jobID;
            break;
        default:
            plan.steps.front().stepNo = -1;
            break;
    }
    return plan;
}

} // namespace ACS::Simulation
