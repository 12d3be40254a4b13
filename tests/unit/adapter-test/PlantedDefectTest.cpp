// Adapters with one defect each. The suite must find each of them, and name the rule that it breaks.

#include "Catch.hpp"
#include "EventFilter.hpp"
#include "PlantedAdapters.hpp"
#include "ReferenceBench.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Testing
{

namespace
{

using AdapterTest::ERule;

/// Its transport still calls it when it is destroyed.
class ForgetfulBench final : public ReferenceBench
{
    AdapterTest::IVirtualTime* _timeOrNull = nullptr;
    AdapterTest::IAdapterHost* _hostOrNull = nullptr;

public:
    ForgetfulBench()
        : ReferenceBench([] { return std::make_unique<ReferenceAdapter>(); })
    {
    }

    void MakeRobot(AdapterTest::IVirtualTime& time) override
    {
        _timeOrNull = &time;
        ReferenceBench::MakeRobot(time);
    }

    [[nodiscard]] Planning::IRobotAdapter& MakeAdapter(AdapterTest::IAdapterHost& host) override
    {
        _hostOrNull = &host;
        Poll();
        return ReferenceBench::MakeAdapter(host);
    }

private:
    void Poll()
    {
        _timeOrNull->Post(std::chrono::seconds(1), [this] {
            _hostOrNull->Call([](Core::Now /*now*/, Planning::AdapterActions& /*out*/) {});
            Poll();
        });
    }
};

struct PlantedDefect
{
    const char* name;
    ERule rule;
    ReferenceBench::MakeFunction make;
};

template <typename TAdapter>
PlantedDefect Plant(const char* name, ERule rule)
{
    return {name, rule, [] {
                return std::make_unique<TAdapter>();
            }};
}

PlantedDefect PlantEvents(
    const char* name,
    ERule rule,
    std::vector<Planning::RobotEvent> (*change)(const Planning::RobotEvent& event))
{
    return {name, rule, [change] {
                return std::make_unique<EventFilter>(change);
            }};
}

PlantedDefect PlantState(const char* name, ERule rule, void (*change)(Planning::StateChanged& state))
{
    return {name, rule, [change] {
                return std::make_unique<EventFilter>([change](const Planning::RobotEvent& event) {
                    std::vector<Planning::RobotEvent> events{event};
                    if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&events.front()))
                    {
                        change(*stateOrNull);
                    }
                    return events;
                });
            }};
}

std::vector<PlantedDefect> PlantAll()
{
    using Events = std::vector<Planning::RobotEvent>;
    using Planning::RobotEvent;
    return {
        Plant<Deaf>("never raises an event", ERule::LinkReported),
        Plant<KeepsOutput>("appends to the output of the first call", ERule::OutputInCall),
        Plant<RestartsTimer>("restarts a timer without a delay", ERule::TimeAdvances),
        Plant<RejectsWhenOnline>("rejects an action while it is connected", ERule::ConstantAnswers),
        Plant<HidesLinkLoss>("does not report that the link is lost", ERule::LinkReported),
        PlantEvents(
            "reports the link up without a state",
            ERule::StateAfterConnection,
            [](const RobotEvent& event) { return Is<Planning::StateChanged>(event) ? Events() : Events{event}; }),
        PlantEvents(
            "reports no end of driving",
            ERule::StateTrue,
            [](const RobotEvent& event) {
                const auto* const stateOrNull = std::get_if<Planning::StateChanged>(&event);
                return stateOrNull != nullptr && !stateOrNull->bDriving && stateOrNull->lastNodeID == "E"
                    ? Events()
                    : Events{event};
            }),
        PlantState(
            "reports a pose that is not a number",
            ERule::StateTrue,
            [](Planning::StateChanged& state) {
                state.bPoseKnown = true;
                state.theta = std::numeric_limits<double>::quiet_NaN();
            }),
        PlantState(
            "reports a battery that is not a number",
            ERule::StateTrue,
            [](Planning::StateChanged& state) { state.batteryPercent = std::numeric_limits<double>::quiet_NaN(); }),
        PlantState(
            "is never automatic",
            ERule::Usable,
            [](Planning::StateChanged& state) { state.bAutomatic = false; }),
        PlantState("is always occupied", ERule::Usable, [](Planning::StateChanged& state) { state.bOccupied = true; }),
        PlantState(
            "always has an error",
            ERule::Usable,
            [](Planning::StateChanged& state) {
                state.errors.push_back({"AGV-1", Planning::EAlarmLevel::Heavy, "it is broken"});
            }),
        Plant<IsIncompatible>("is incompatible", ERule::Usable),
        Plant<ShowsLoadsLate>("shows the loads after a job too late", ERule::LoadsTrue),
        PlantState(
            "reports a port of another robot",
            ERule::LoadsTrue,
            [](Planning::StateChanged& state) { state.loads->front().port = "CP99"; }),
        PlantState("reports no port", ERule::LoadsTrue, [](Planning::StateChanged& state) { state.loads->clear(); }),
        PlantState(
            "reports a port twice",
            ERule::LoadsTrue,
            [](Planning::StateChanged& state) { state.loads->push_back(state.loads->front()); }),
        PlantState(
            "does not list the node that the robot may enter after a restart",
            ERule::HeldNodes,
            [](Planning::StateChanged& state) { state.heldNodeIDs.clear(); }),
        Plant<ShowsSentCommand>("shows a command that the robot did not receive", ERule::RestartEvidenceTrue),
        PlantEvents(
            "names the job by another ID",
            ERule::KnownIDs,
            [](const RobotEvent& event) {
                return Is<Planning::JobFinished>(event) ? Events{Planning::JobFinished{"the last job"}} : Events{event};
            }),
        Plant<CancelsNextDrive>(
            "cancels the next drive when it is too late for the last one",
            ERule::LateCommandsIgnored),
        PlantEvents(
            "reports the end of a job twice",
            ERule::OneEnd,
            [](const RobotEvent& event) {
                return Is<Planning::JobFinished>(event) ? Events{event, event} : Events{event};
            }),
        PlantEvents(
            "reports a job as started after its end",
            ERule::OneEnd,
            [](const RobotEvent& event) {
                const auto* const finishedOrNull = std::get_if<Planning::JobFinished>(&event);
                return finishedOrNull == nullptr ? Events{event}
                                                 : Events{event, Planning::JobStarted{finishedOrNull->jobID}};
            }),
        Plant<RejectsBeforeStop>("rejects a drive before the robot is stopped", ERule::NothingKept),
        Plant<LosesOfflineJob>("loses a job that is commanded while the robot is disconnected", ERule::CommandsKept),
        Plant<IgnoresExtension>("ignores that a drive is extended", ERule::DriveAnswered),
        PlantEvents(
            "does not report the first node of a drive",
            ERule::NodesInOrder,
            [](const RobotEvent& event) {
                const auto* const passedOrNull = std::get_if<Planning::NodePassed>(&event);
                return passedOrNull != nullptr && passedOrNull->nodeID == "A" ? Events() : Events{event};
            }),
        Plant<DrivesBeyondBase>("drives to nodes that are not released", ERule::ReleasedNodesOnly),
        Plant<ArrivesEarly>("arrives when the last node is the next", ERule::ArrivalTrue),
        Plant<IgnoresCancel>("ignores that a drive is cancelled", ERule::CancelStops),
        Plant<CancelsBeforeStop>("reports a drive as cancelled before the robot is stopped", ERule::CancelStops),
        PlantEvents(
            "does not report that a job is rejected",
            ERule::JobAnswered,
            [](const RobotEvent& event) { return Is<Planning::JobRejected>(event) ? Events() : Events{event}; }),
        Plant<RepeatsJobAfterReconnect>("sends a job again after a reconnect", ERule::JobOnce),
        Plant<RecoversWithoutAsking>("reports a job as done after a restart without asking", ERule::OutcomeTrue),
        Plant<AnswersUnknownWithDone>("reports a job as done that the robot does not know", ERule::OutcomeTrue),
        Plant<RecoversAsUnknown>("reports each job as unknown after a restart", ERule::OutcomeTrue),
        Plant<RecoversByStarting>("starts a job that it is asked for", ERule::RecoveryStartsNothing),
        Plant<IgnoresJobCancel>("ignores that a job is cancelled", ERule::CancelJobAnswered),
        Plant<ForgetsPause>("forgets a pause when the drive is extended", ERule::PauseObeyed),
        Plant<IgnoresResume>("ignores that it is resumed", ERule::ResumeObeyed),
        Plant<IgnoresStopCharging>("does not stop charging", ERule::ChargingReported),
    };
}

} // namespace

TEST_CASE("Each planted defect is found, with the rule that it breaks")
{
    for (const PlantedDefect& defect : PlantAll())
    {
        ReferenceBench bench(defect.make);
        const AdapterTest::ContractReport report = AdapterTest::CheckAdapter(bench);
        INFO(defect.name << " breaks " << GetRuleName(defect.rule) << "\n" << report.Describe());
        CHECK(report.HasFinding(defect.rule));
    }
}

TEST_CASE("An adapter whose transport calls it after its destruction is found")
{
    ForgetfulBench bench;
    CHECK(AdapterTest::CheckAdapter(bench).HasFinding(ERule::SilentAfterDestruction));
}

TEST_CASE("For each rule there is a planted defect that breaks it")
{
    std::set<ERule> broken{ERule::SilentAfterDestruction};
    for (const PlantedDefect& defect : PlantAll())
    {
        broken.insert(defect.rule);
    }
    CHECK(broken.size() == AdapterTest::ALL_RULES.size());
}

} // namespace ACS::Testing
