// Adapters with one defect each. The suite must find each of them, and name the rule that it breaks.

#include "Catch.hpp"
#include "ReferenceAdapter.hpp"
#include "ReferenceBench.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

namespace
{

using AdapterTest::ERule;

/// Changes the events that the adapter raises.
class EventFilter : public ReferenceAdapter
{
    using Change = std::function<std::vector<Planning::RobotEvent>(const Planning::RobotEvent& event)>;

    const Change _change;

public:
    explicit EventFilter(Change change)
        : _change(std::move(change))
    {
    }

protected:
    void Raise(Planning::RobotEvent event, Out& out) override
    {
        for (Planning::RobotEvent& changed : _change(event))
        {
            ReferenceAdapter::Raise(std::move(changed), out);
        }
    }
};

template <typename TEvent>
[[nodiscard]] bool Is(const Planning::RobotEvent& event)
{
    return std::holds_alternative<TEvent>(event);
}

struct Deaf final : ReferenceAdapter
{
    void Handle(const Planning::RobotCommand& /*command*/, Core::Now /*now*/, Out& /*out*/) override
    {
    }
    void OnLinkUp(Out& /*out*/) override
    {
    }
    void OnLinkDown(Out& /*out*/) override
    {
    }
    void OnMessage(const ReferenceMessage& /*message*/, Out& /*out*/) override
    {
    }
};

struct KeepsOutput final : ReferenceAdapter
{
    Out* firstOrNull = nullptr;

    void OnMessage(const ReferenceMessage& message, Out& out) override
    {
        firstOrNull = firstOrNull == nullptr ? &out : firstOrNull;
        ReferenceAdapter::OnMessage(message, *firstOrNull);
    }
};

struct RestartsTimer final : ReferenceAdapter
{
    void OnLinkUp(Out& out) override
    {
        ReferenceAdapter::OnLinkUp(out);
        out.emplace_back(Planning::StartAdapterTimer{1, Core::Duration::zero()});
    }
    void OnTimer(Planning::AdapterTimerID timer, Core::Now /*now*/, Out& out) override
    {
        out.emplace_back(Planning::StartAdapterTimer{timer, Core::Duration::zero()});
    }
};

struct RejectsWhenOnline final : ReferenceAdapter
{
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return _bOnline ? std::optional<std::string>("it is busy") : std::nullopt;
    }
};

struct HidesLinkLoss final : ReferenceAdapter
{
    void OnLinkDown(Out& /*out*/) override
    {
        _state.reset();
    }
};

/// Shows the command that it has sent, not the one that the robot has received.
struct ShowsSentCommand final : ReferenceAdapter
{
    void Raise(Planning::RobotEvent event, Out& out) override
    {
        if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&event))
        {
            stateOrNull->restartEvidence.commandID = _job.has_value() ? "sent-" + _job->commandID : std::string();
        }
        ReferenceAdapter::Raise(std::move(event), out);
    }
};

/// Remembers a cancellation that has come too late, for the next drive.
struct CancelsNextDrive final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& /*command*/, Out& out) override
    {
        _bCancelsDrive = true;
        ContinueDrive(out);
    }
    void OnDrive(const Planning::Drive& command, Out& out) override
    {
        _drive = command;
        _passedCount = 0;
        ContinueDrive(out);
        _bCancelsDrive = false;
    }
};

struct LosesOfflineJob final : ReferenceAdapter
{
    void OnStartJob(const Planning::StartJob& command, Out& out) override
    {
        if (_bOnline)
        {
            ReferenceAdapter::OnStartJob(command, out);
        }
    }
};

struct IgnoresExtension final : ReferenceAdapter
{
    void OnExtendDrive(const Planning::ExtendDrive& /*command*/, Out& /*out*/) override
    {
    }
};

struct DrivesBeyondBase final : ReferenceAdapter
{
    void OnDrive(const Planning::Drive& command, Out& out) override
    {
        Planning::Drive whole = command;
        whole.releasedCount = whole.route.nodes.size();
        ReferenceAdapter::OnDrive(whole, out);
    }
};

struct ArrivesEarly final : ReferenceAdapter
{
    void Send(ReferenceMessage message) override
    {
        const bool bLast = message.kind == EKind::Go && _passedCount + 1 == _drive->route.nodes.size();
        ReferenceAdapter::Send(std::move(message));
        _bArrives = _bArrives || bLast;
    }
    void ContinueDrive(Out& out) override
    {
        ReferenceAdapter::ContinueDrive(out);
        if (std::exchange(_bArrives, false) && _drive.has_value())
        {
            EndDrive(Planning::Arrived{_drive->driveID}, out);
        }
    }

private:
    bool _bArrives = false;
};

struct IgnoresCancel final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& /*command*/, Out& /*out*/) override
    {
    }
};

struct CancelsBeforeStop final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& command, Out& out) override
    {
        if (_drive.has_value() && _state.has_value())
        {
            EndDrive(Planning::DriveCancelled{command.driveID, _state->nodeID}, out);
        }
    }
};

struct RejectsBeforeStop final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& command, Out& out) override
    {
        if (_drive.has_value())
        {
            EndDrive(Planning::DriveRejected{command.driveID, "it was cancelled"}, out);
        }
    }
};

/// The robot may have executed the job already, under another ID.
struct RepeatsJobAfterReconnect final : ReferenceAdapter
{
    void OnLinkUp(Out& out) override
    {
        ReferenceAdapter::OnLinkUp(out);
        if (_job.has_value())
        {
            _job->commandID += "-again";
            Send({EKind::Do, _job->commandID});
        }
    }
};

/// Concludes from the request that the job was commanded, and from the silence that it is done.
struct RecoversWithoutAsking final : ReferenceAdapter
{
    void OnRecoverJob(const Planning::RecoverJob& command, Out& out) override
    {
        Raise(Planning::JobFinished{command.job.jobID}, out);
    }
};

struct AnswersUnknownWithDone final : ReferenceAdapter
{
    void OnJobState(const std::string& text, Out& out) override
    {
        ReferenceAdapter::OnJobState(text == "unknown" ? "done" : text, out);
    }
};

struct RecoversByStarting final : ReferenceAdapter
{
    void OnRecoverJob(const Planning::RecoverJob& command, Out& out) override
    {
        OnStartJob(command.job, out);
    }
};

/// Reports an unknown job, although a StartJob of this adapter's predecessor may be in transit.
struct RecoversAsUnknown final : ReferenceAdapter
{
    void OnRecoverJob(const Planning::RecoverJob& command, Out& out) override
    {
        Raise(Planning::JobUnknown{command.job.jobID}, out);
    }
};

struct IgnoresJobCancel final : ReferenceAdapter
{
    void OnCancelJob(const Planning::CancelJob& /*command*/, Out& /*out*/) override
    {
    }
};

/// Forgets the pause when the drive is extended.
struct ForgetsPause final : ReferenceAdapter
{
    void OnExtendDrive(const Planning::ExtendDrive& command, Out& out) override
    {
        Send({EKind::Resume});
        ReferenceAdapter::OnExtendDrive(command, out);
    }
};

struct IgnoresResume final : ReferenceAdapter
{
    void OnResume(const Planning::Resume& /*command*/, Out& /*out*/) override
    {
    }
};

struct IgnoresStopCharging final : ReferenceAdapter
{
    void OnStopCharging(const Planning::StopCharging& /*command*/, Out& /*out*/) override
    {
    }
};

/// Shows the loads after a job only when it has ended the job.
struct ShowsLoadsLate final : ReferenceAdapter
{
    void Raise(Planning::RobotEvent event, Out& out) override
    {
        if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&event))
        {
            _shown = _job.has_value() && _shown.has_value() ? _shown : stateOrNull->loads;
            stateOrNull->loads = _shown;
        }
        ReferenceAdapter::Raise(std::move(event), out);
    }

private:
    std::optional<std::vector<Planning::PortLoad>> _shown;
};

struct IsIncompatible final : ReferenceAdapter
{
    void OnLinkUp(Out& out) override
    {
        Raise(Planning::CompatibilityChanged{"it is too wide"}, out);
        ReferenceAdapter::OnLinkUp(out);
    }
};

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
