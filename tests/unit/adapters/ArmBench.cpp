#include "ArmBench.hpp"

#include <acs/protocol/messages/ExecutionPlan.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

namespace
{

constexpr const char* ARM_ROBOT = "CR01";
constexpr std::array<const char*, 2> SOURCES{"A01.CP01.TP01", "A01.CP01.TP02"};
constexpr std::array<const char*, 2> TARGETS{"CR01.TP01", "CR01.TP02"};
constexpr std::array<const char*, 2> TRAYS{"T1", "T2"};

Planning::SiteMap MakeArmSite()
{
    const auto node = [](std::string nodeID, double x) {
        return Planning::SiteNode{std::move(nodeID), x, 0.0, "floor", {{"any", std::nullopt}}};
    };
    Planning::SiteEdgeRule rule;
    rule.vehicleTypeID = "any";
    auto site = Planning::SiteMap::Create(
        {node("N0", 0.0), node("N1", 4.0), node("N2", 8.0), node("N3", 12.0), node("N4", 16.0)},
        {{"N0>N1", "N0", "N1", {rule}},
         {"N1>N2", "N1", "N2", {rule}},
         {"N2>N3", "N2", "N3", {rule}},
         {"N3>N4", "N3", "N4", {rule}}},
        {{"A01.CP01", {"N0"}}});
    if (!site.has_value())
    {
        throw std::runtime_error(Core::Describe(site.error()));
    }
    return std::move(*site);
}

Planning::RobotOptions MakeArmOptions()
{
    return {
        *Core::RobotID::Parse(ARM_ROBOT),
        Planning::ERobotType::CR,
        "any",
        "N0",
        std::nullopt,
        *Core::ParseLocationRange("CR01.TP01-03"),
        {},
        {}};
}

/// Both jobs in one plan, and the second one under the jobID of the first in another plan.
const std::array<Protocol::ExecutionPlan, 2>& GetPlans()
{
    const auto make = [](const char* planID, std::vector<Protocol::PlanJob> jobs, std::vector<std::string> trays) {
        Protocol::ExecutionPlan plan;
        plan.planID = planID;
        plan.steps.push_back({1, "TrayLoad", "A01.CP01", std::move(trays), std::move(jobs)});
        return plan;
    };
    static const std::array<Protocol::ExecutionPlan, 2> PLANS{
        make("plan-1", {{"job-1", SOURCES[0], TARGETS[0]}, {"job-2", SOURCES[1], TARGETS[1]}}, {TRAYS[0], TRAYS[1]}),
        make("plan-2", {{"job-1", SOURCES[1], TARGETS[1]}}, {TRAYS[1]})};
    return PLANS;
}

} // namespace

class ArmBench::Forwarder final : public Planning::IRobotAdapter
{
    ArmBench& _bench;
    AdapterTest::IAdapterHost& _host;
    Planning::AdapterActions* _outOrNull = nullptr; ///< During a command.
    const std::unique_ptr<Simulation::IRobotConnection> _connection;

public:
    Forwarder(ArmBench& bench, AdapterTest::IAdapterHost& host)
        : _bench(bench),
          _host(host),
          _connection(
              bench._world->robot.MakeConnection(++bench._connection, [this](const Planning::RobotEvent& event) {
                  Raise(event);
              }))
    {
    }

    void Handle(const Planning::RobotCommand& command, Core::Now /*now*/, Planning::AdapterActions& out) override
    {
        if (const auto* const jobOrNull = std::get_if<Planning::StartJob>(&command))
        {
            _bench._world->workChecker.NoteCommand(*jobOrNull);
        }
        _bench.Continue();
        _outOrNull = &out;
        _connection->Handle(command);
        _outOrNull = nullptr;
        _bench.WakeLater();
    }

    void OnTimer(Planning::AdapterTimerID /*timer*/, Core::Now /*now*/, Planning::AdapterActions& /*out*/) override
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }

private:
    void Raise(const Planning::RobotEvent& event)
    {
        if (_outOrNull != nullptr)
        {
            _outOrNull->emplace_back(Planning::RaiseEvent{event});
            return;
        }
        _host.Call([&event](Core::Now /*now*/, Planning::AdapterActions& out) {
            out.emplace_back(Planning::RaiseEvent{event});
        });
    }
};

ArmBench::World::World(const Planning::SiteMap& site, const Planning::RobotOptions& options, std::uint64_t seed)
    : trace(timeline, false),
      workChecker(trace, site, Simulation::EHandling::Everything),
      broker(timeline, trace, {seed, 1}, false),
      robot(
          {timeline, trace, workChecker, broker, site, false, Simulation::EMutation::None, false, options, true},
          {{seed, 2}, {{seed, 3}, {seed, 4}}, {seed, 5}},
          ARM_ROBOT,
          "N0",
          false)
{
    for (const Protocol::ExecutionPlan& plan : GetPlans())
    {
        workChecker.NotePlan(plan);
    }
}

ArmBench::ArmBench(std::uint64_t seed)
    : _seed(seed),
      _site(MakeArmSite()),
      _robotOptions(MakeArmOptions())
{
}

ArmBench::~ArmBench() = default;

AdapterTest::BenchOptions ArmBench::GetOptions() const
{
    AdapterTest::BenchOptions options;
    options.answerLimit = std::chrono::seconds(40); // the broker publishes a will after up to 20 s
    options.bSlow = false;
    options.bRefuses = false;
    options.bFails = false;
    options.bRepeats = false;
    options.bCancelsJobs = false; // a stopped program may have moved something
    options.bCharges = false;
    for (const Planning::SiteNode& node : _site.GetNodes())
    {
        options.route.nodes.push_back({node.nodeID, node.x, node.y, std::nullopt, node.mapID});
    }
    for (const Planning::SiteEdge& edge : _site.GetEdges())
    {
        options.route.edges.push_back(
            {edge.edgeID, edge.startNodeID, edge.endNodeID, 4.0, 1.0, std::nullopt, std::nullopt, "", std::nullopt});
    }
    return options;
}

Planning::StartJob ArmBench::MakeJob(std::size_t number) const
{
    Planning::StartJob job;
    job.action = "TrayLoad";
    job.position = "A01.CP01";
    job.from = SOURCES.at(number);
    job.to = TARGETS.at(number);
    job.carrierID = TRAYS.at(number);
    return job;
}

void ArmBench::MakeRobot(AdapterTest::IVirtualTime& time)
{
    _timeOrNull = &time;
    _wakeAt.reset();
    _world = std::make_unique<World>(_site, _robotOptions, _seed);
    _world->robot.Calm(); // no slow network
    WakeLater();
}

Planning::IRobotAdapter& ArmBench::MakeAdapter(AdapterTest::IAdapterHost& host)
{
    Continue();
    _adapter = std::make_unique<Forwarder>(*this, host);
    WakeLater();
    return *_adapter;
}

void ArmBench::DestroyAdapter()
{
    Continue();
    _adapter.reset();
}

void ArmBench::DestroyRobot()
{
    _world.reset();
}

void ArmBench::OnAdapterCalled()
{
}

void ArmBench::SetLink(bool bUp)
{
    Continue();
    _world->robot.SetReachable(bUp);
    WakeLater();
}

void ArmBench::SetConduct(AdapterTest::EConduct /*conduct*/)
{
}

AdapterTest::RobotTruth ArmBench::GetTruth() const
{
    const bool bPlaying = _world->robot.IsPlaying();
    static_cast<void>(_world->robot.IsWorkUnderWay()); // counts what was done
    const std::string nodeID = _world->robot.GetNodeID();
    const bool bOnNode = _site.FindNodeOrNull(nodeID) != nullptr; // otherwise between two
    AdapterTest::RobotTruth truth{bOnNode ? nodeID : _nodeID, _world->robot.IsDriving(), bPlaying, 0};
    _nodeID = truth.nodeID;
    for (const Protocol::ExecutionPlan& plan : GetPlans())
    {
        for (const Protocol::PlanJob& job : plan.steps.front().jobs)
        {
            truth.doneJobs += _world->workChecker.GetTruth(plan.planID, 1, job.jobID).finished;
        }
    }
    return truth;
}

void ArmBench::Continue()
{
    bool bDue = true;
    // A task of now, after all those that are due.
    const Core::Duration behind = _timeOrNull->GetNow().steady - _world->timeline.GetNow().steady;
    _world->timeline.Post(behind, [&bDue] { bDue = false; });
    while (bDue)
    {
        static_cast<void>(_world->timeline.TryStep());
    }
}

void ArmBench::WakeLater()
{
    const std::optional<Core::SteadyTime> next = _world->timeline.GetNextTimeOrNull();
    if (!next.has_value() || (_wakeAt.has_value() && *_wakeAt <= *next))
    {
        return;
    }
    _wakeAt = next;
    _timeOrNull->Post(*next - _timeOrNull->GetNow().steady, [this, at = *next] {
        if (_wakeAt == at)
        {
            _wakeAt.reset();
            Continue();
            WakeLater();
        }
    });
}

} // namespace ACS::Testing
