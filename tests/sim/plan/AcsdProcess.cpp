#include "AcsdProcess.hpp"

#include "TraceText.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

Protocol::SessionOptions MakeSessionOptions()
{
    Protocol::SessionOptions options;
    options.positionInterval = 0ms; // no rule depends on positions, and they would be nine of ten messages
    return options;
}

} // namespace

/// The simulated MCS does not use isConnected: it is reported neither after a grace time nor periodically.
Acsd::AcsdConfig AcsdProcess::MakeConfig(const Scenario& scenario)
{
    Acsd::AcsdConfig config;
    config.engine = scenario.options;
    config.site = scenario.MakeSite();
    config.localOffset = Apps::LocalOffset(540min);
    config.operations.workGrace = 24h;
    return config;
}

AcsdProcess::AcsdProcess(
    const Dependencies& around,
    std::unique_ptr<SimulatedLease> leaseOrNull,
    CrashHandler onCrash,
    CommitHandler onCommit)
    : _around(around),
      _onCrash(std::move(onCrash)),
      _bCrashing(_around.scenario.Has(EFault::Crashes)),
      _core(MakeDependencies(), MakeConfig(_around.scenario)),
      _session(MakeSessionOptions(), _around.ownRandom),
      _timers(_around.timeline),
      _sessionTimers(_around.timeline),
      _mutator(_around.mutation, _around.chance, _around.ownRandom),
      _disk(
          {_around.timeline,
           _around.trace,
           _around.chance,
           _around.store,
           _around.scenario,
           _mutator,
           *this,
           _around.epoch,
           std::move(onCommit)},
          std::move(leaseOrNull))
{
}

AcsdProcess::~AcsdProcess()
{
    if (_connection.has_value())
    {
        _around.network.Abandon(*_connection, ETextEnd::Client);
    }
}

Acsd::AcsdCore::Dependencies AcsdProcess::MakeDependencies()
{
    const Acsd::AcsdCore::Dependencies real{
        _around.timeline,
        _around.ownRandom,
        Core::Logger(),
        *this,
        *this,
        [this](const Planning::EngineAction& action, const Acsd::AcsdCore::ActionHandler& execute) {
            OnAction(action, execute);
        }};
    return _around.onRecord ? _recorder.emplace(_around.onRecord).Wrap(real) : real;
}

void AcsdProcess::Begin()
{
    _around.trace.Add("acsd: start {}", _around.number);
    for (const auto& [robotID, robot] : _around.robots)
    {
        _hands.emplace(
            robotID,
            robot->MakeConnection(_around.number, [this, robotID = robotID](const Planning::RobotEvent& event) {
                OnRobotEvent(robotID, event);
            }));
    }
    _core.Restore(_mutator.OnRestore(_around.store.Load()));
    if (_bDead)
    {
        return;
    }
    _core.Start();
    RunSession([this](Core::Now now, auto& out) { _session.Start(now, out); });
}

void AcsdProcess::Crash(std::string_view where)
{
    if (std::exchange(_bDead, true))
    {
        return;
    }
    _around.trace.Add("acsd: crash {}", where);
    if (_recorder.has_value())
    {
        _recorder->Stop();
    }
    _timers.CancelAll();
    _sessionTimers.CancelAll();
    _core.Close();
    _disk.End();
    _onCrash();
}

std::uint64_t AcsdProcess::GetNumber() const noexcept
{
    return _around.number;
}

void AcsdProcess::EndCrashes()
{
    _bCrashing = false;
}

void AcsdProcess::CrashByChance(std::size_t permyriad, std::string_view where)
{
    constexpr std::size_t ALL = 10'000;
    if (_bCrashing && !_bDead && _around.chance.GetBelow(ALL) < permyriad)
    {
        Crash(where);
    }
}

void AcsdProcess::PushCommand(Planning::PlanCommand command)
{
    static_cast<void>(_core.Offer(std::move(command)));
}

const Planning::PlanEngine& AcsdProcess::GetEngine() const noexcept
{
    return _core.GetEngine();
}

void AcsdProcess::Store(const Planning::StoreBatch& batch)
{
    if (!_bDead)
    {
        _disk.Write(batch);
    }
}

bool AcsdProcess::HasCrashed(std::string_view where)
{
    CrashByChance(20, where);
    return _bDead;
}

void AcsdProcess::OnStored(const Core::Result<void>& result)
{
    _core.OnStored(result);
}

void AcsdProcess::Stop()
{
    _disk.Release();
}

void AcsdProcess::CutOff()
{
    _disk.CutOff();
}

void AcsdProcess::OnAction(const Planning::EngineAction& action, const Acsd::AcsdCore::ActionHandler& execute)
{
    CrashByChance(5, "between two actions");
    if (_bDead)
    {
        return;
    }
    std::visit(
        Core::Overloaded{
            [this, &execute](const Planning::ReplyCommand& reply) { execute(_mutator.OnReply(reply)); },
            [this, &execute](const Planning::SendReport& report) { OnReport(report, execute); },
            [&execute](const auto& other) {
                execute(other);
            }},
        action);
}

void AcsdProcess::OnReport(const Planning::SendReport& report, const Acsd::AcsdCore::ActionHandler& execute)
{
    _around.trace.Add("acsd: report {}: {}", report.entry.sequence, Describe(report.entry.report));
    if (std::optional<Planning::OutboxEntry> entry = _mutator.PassReportOrNull(report.entry))
    {
        execute(Planning::SendReport{std::move(*entry), report.replaced});
    }
    else
    {
        PushCommand(Planning::MessageAcknowledged{report.entry.sequence});
    }
}

void AcsdProcess::CheckStore()
{
    // A simulated disk never loses its file.
}

void AcsdProcess::StartTimer(const Acsd::AcsdTimer& timer, Core::Duration delay)
{
    const bool bOfEngine = std::holds_alternative<Planning::EngineTimer>(timer);
    if (_bDead || (bOfEngine && _mutator.ShouldForgetTimer()))
    {
        return;
    }
    _timers.Start(timer, delay, [this, timer] { _core.OnTimer(timer); });
}

void AcsdProcess::CancelTimer(const Acsd::AcsdTimer& timer)
{
    _timers.Cancel(timer);
}

void AcsdProcess::CancelTimers()
{
    _timers.CancelAll();
}

void AcsdProcess::CloseLinks()
{
    // It only crashes: the links end with it.
}

void AcsdProcess::OnStopped()
{
    assert(false && "it only crashes");
}

void AcsdProcess::OnStoreTaken(const std::string& /*reason*/)
{
    Crash("because another process has taken the store");
}

void AcsdProcess::ObserveCommit(Core::Duration /*duration*/)
{
}

void AcsdProcess::OnOperatorRefused(const Acsd::RefusedOffer& /*refused*/)
{
}

void AcsdProcess::ObserveAckWait(Core::Duration /*wait*/)
{
}

void AcsdProcess::CommandRobot(const Planning::CommandRobot& command)
{
    if (!_disk.CanCommand())
    {
        return;
    }
    _around.trace.Add("acsd: {} {}", command.robotID, Describe(command.command));
    const auto found = _hands.find(command.robotID);
    assert(found != _hands.end());
    IRobotConnection& hand = *found->second;
    const Mutator::CommandOutcome outcome = _mutator.OnCommand(command);
    for (const Planning::RobotCommand& sent : outcome.sent)
    {
        if (const auto* jobOrNull = std::get_if<Planning::StartJob>(&sent); jobOrNull != nullptr)
        {
            _around.workChecker.NoteCommand(*jobOrNull);
        }
        hand.Handle(sent);
    }
    for (const Planning::RobotCommand& sent : outcome.sentLater)
    {
        if (const auto* jobOrNull = std::get_if<Planning::StartJob>(&sent); jobOrNull != nullptr)
        {
            _around.workChecker.NoteCommand(*jobOrNull);
        }
        _timers.Post(5s, [&hand, sent] { hand.Handle(sent); });
    }
    for (const Planning::RobotEvent& event : outcome.raised)
    {
        _timers.Post(1ms, [this, robotID = command.robotID, event] { _core.OnRobotEvent(robotID, event); });
    }
}

void AcsdProcess::OnRobotEvent(const std::string& robotID, const Planning::RobotEvent& event)
{
    if (_bDead)
    {
        return;
    }
    _around.trace.Add("acsd receives: {} {}", robotID, Describe(event));
    for (const Planning::RobotEvent& heard : _mutator.OnEvent(robotID, event))
    {
        _core.OnRobotEvent(robotID, heard);
    }
    CheckWaitReasons();
}

void AcsdProcess::CheckWaitReasons() const
{
    for (const Planning::WaitReason& reason : GetEngine().GetWaitReasons())
    {
        const bool bComplete = !reason.message.empty()
            && std::ranges::none_of(reason.robots, [](const Planning::RobotUnavailability& robot) {
                   return robot.reason.empty();
               });
        if (!bComplete)
        {
            _around.trace.Violate("plan {} waits without a reason", reason.planID);
        }
    }
}

template <typename TCall>
void AcsdProcess::RunSession(TCall call)
{
    if (_bDead)
    {
        return;
    }
    Protocol::SessionActions actions;
    call(_around.timeline.GetNow(), actions);
    std::ranges::move(actions, std::back_inserter(_sessionActions));
    if (std::exchange(_bActing, true))
    {
        return;
    }
    while (!_sessionActions.empty() && !_bDead)
    {
        const Protocol::SessionAction action = std::move(_sessionActions.front());
        _sessionActions.pop_front();
        Act(action);
    }
    _bActing = false;
}

void AcsdProcess::Act(const Protocol::SessionAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Protocol::SendText& send) {
                if (_connection.has_value())
                {
                    _around.network.Send(*_connection, ETextEnd::Client, send.text);
                }
            },
            [this](const Protocol::Connect&) { _connection = _around.network.Connect(*this); },
            [this](const Protocol::Close& close) {
                if (_connection.has_value())
                {
                    _around.network.Close(*_connection, ETextEnd::Client, close.reason);
                }
            },
            [this](const Protocol::StartTimer& start) {
                const Protocol::ESessionTimer timer = start.timer;
                _sessionTimers.Start(timer, start.delay, [this, timer] {
                    RunSession([this, timer](Core::Now now, auto& out) { _session.OnTimer(timer, now, out); });
                });
            },
            [this](const Protocol::CancelTimer& cancel) { _sessionTimers.Cancel(cancel.timer); },
            [this](const Protocol::Deliver& deliver) {
                // AcsClient posts events: other work of the same thread may come between.
                const Core::SteadyTime now = _around.timeline.GetNow().steady;
                _lastDelivery = std::max(_lastDelivery, now + _around.chance.GetBetween(0ms, 3ms));
                _sessionTimers.Post(_lastDelivery - now, [this, event = deliver.event] { OnSessionEvent(event); });
            }},
        action);
}

void AcsdProcess::OnSessionEvent(const Protocol::SessionEvent& event)
{
    const bool bAckForgotten = _mutator.Is(EMutation::AckForgotten) && std::holds_alternative<Protocol::Acked>(event);
    if (_bDead || bAckForgotten)
    {
        return;
    }
    if (_mutator.Is(EMutation::ReplayForgotten) && std::holds_alternative<Protocol::Registered>(event))
    {
        ReplayDone();
        return;
    }
    _core.OnSessionEvent(event);
}

bool AcsdProcess::IsRegistered() const
{
    return _session.IsRegistered();
}

bool AcsdProcess::TrySendDurable(const Protocol::AcsRequest& request)
{
    bool bSent = true;
    RunSession([this, &request, &bSent](Core::Now now, auto& out) {
        bool bFirst = true;
        for (const Protocol::AcsRequest& sent : _mutator.OnSend(request))
        {
            const bool bAccepted = _session.TrySendDurable(sent, now, out);
            bSent = std::exchange(bFirst, false) ? bAccepted : bSent;
        }
    });
    return bSent;
}

void AcsdProcess::ReplayDone()
{
    RunSession([this](Core::Now now, auto& out) { _session.ReplayDone(now, out); });
}

void AcsdProcess::SendStatus(const Protocol::AcsPayload& status)
{
    RunSession([this, &status](Core::Now now, auto& out) { _session.SendStatus(status, now, out); });
}

void AcsdProcess::SendPosition(const Protocol::RobotPositionUpdate& positions)
{
    RunSession([this, &positions](Core::Now now, auto& out) { _session.SendPosition(positions, now, out); });
}

void AcsdProcess::Answer(
    Protocol::EAcsCommand command,
    std::string_view transactionID,
    Protocol::EAckResult result,
    std::string_view message,
    const Protocol::AckPayload& payload)
{
    RunSession(
        [&](Core::Now now, auto& out) { _session.Answer(command, transactionID, result, message, payload, now, out); });
}

void AcsdProcess::SetSiteOffset(std::chrono::minutes offset)
{
    _session.SetSiteOffset(offset);
}

void AcsdProcess::OnOpened(Protocol::ConnectionID /*connection*/)
{
    RunSession([this](Core::Now now, auto& out) { _session.OnConnected(now, out); });
}

void AcsdProcess::OnText(Protocol::ConnectionID /*connection*/, const std::string& text)
{
    RunSession([this, &text](Core::Now now, auto& out) { _session.OnText(text, now, out); });
}

void AcsdProcess::OnClosed(Protocol::ConnectionID /*connection*/, const std::string& reason)
{
    _connection.reset();
    RunSession([this, &reason](Core::Now now, auto& out) { _session.OnClosed(reason, now, out); });
}

} // namespace ACS::Simulation
