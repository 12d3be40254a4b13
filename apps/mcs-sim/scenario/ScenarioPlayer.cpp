#include "scenario/ScenarioPlayer.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

ScenarioPlayer::ScenarioPlayer(
    const boost::asio::any_io_executor& executor,
    const ScenarioStage& stage,
    std::vector<Scenario> scenarios,
    PlanRefresher refresher,
    std::function<void()> onPlayed)
    : _stage(stage),
      _scenarios(std::move(scenarios), stage.random, std::move(refresher)),
      _onPlayed(std::move(onPlayed)),
      _timers(executor, [this](ETimer timer) { OnTimer(timer); })
{
}

void ScenarioPlayer::SetServer(ProtocolBeast::McsServer& server, SimulatedMcsSession& session) noexcept
{
    _serverOrNull = &server;
    _sessionOrNull = &session;
}

void ScenarioPlayer::Start()
{
    Play([this](Core::Now now, ScenarioActions& out) { _scenarios.Start(now, out); });
}

void ScenarioPlayer::OnRegistered()
{
    Play([this](Core::Now now, ScenarioActions& out) { _scenarios.OnRegistered(now, out); });
}

void ScenarioPlayer::OnLinkLost()
{
    _scenarios.OnLinkLost();
}

void ScenarioPlayer::OnWire(
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text)
{
    if (!_scenarios.IsFinished() && _wireFilter.ShouldPass(direction, connection, text))
    {
        _inbox.emplace_back(text);
        _timers.Start(ETimer::Inbox, std::chrono::milliseconds(0));
    }
}

void ScenarioPlayer::ReadInbox()
{
    while (!_inbox.empty())
    {
        const std::string text = std::move(_inbox.front());
        _inbox.pop_front();
        Play([this, &text](Core::Now now, ScenarioActions& out) { _scenarios.OnMessage(text, now, out); });
    }
}

void ScenarioPlayer::End()
{
    _bEnded = true;
    _timers.CancelAll();
}

bool ScenarioPlayer::IsFinished() const noexcept
{
    return _scenarios.IsFinished();
}

bool ScenarioPlayer::IsEmpty() const noexcept
{
    return _scenarios.IsEmpty();
}

bool ScenarioPlayer::HasHeld() const
{
    return _scenarios.HasHeld();
}

std::vector<ScenarioResult> ScenarioPlayer::GetResults() const
{
    return _scenarios.GetResults();
}

void ScenarioPlayer::Play(const std::function<void(Core::Now now, ScenarioActions& out)>& call)
{
    if (_bEnded)
    {
        return;
    }
    ScenarioActions actions;
    call(_stage.clock.GetNow(), actions);
    for (std::size_t i = 0; i < actions.size(); ++i)
    {
        const ScenarioAction action = actions[i]; // A copy: a failure appends to what it is part of.
        if (!CanPerform(action))
        {
            _scenarios.OnSendFailed(_stage.clock.GetNow(), actions);
        }
    }
}

bool ScenarioPlayer::CanPerform(const ScenarioAction& action)
{
    ProtocolBeast::McsServer& server = *_serverOrNull;
    SimulatedMcsSession& session = *_sessionOrNull;
    return std::visit(
        Core::Overloaded{
            [this, &server](const SendPlannedPlan& send) {
                const bool bTaken = !server.IsRegistered() || server.IsTakingPlans();
                return _stage.sender
                    .TrySendOrHold(send.planned, send.bFreshIDs, bTaken, _stage.clock.GetNow(), _stage.lines);
            },
            [this, &server](const SendPayload& send) {
                _stage.lines.push_back(fmt::format("{} sent", GetText(GetCommand(send.payload))));
                return server.TrySend(server.MakeRequest(send.payload));
            },
            [this, &server, &session](const SendRawText& send) {
                _stage.notes.OnTextSent(send.text);
                bool bSent = false;
                server.Run([&](Core::Now /*now*/, auto& out) { bSent = session.TrySendText(send.text, out); });
                return bSent;
            },
            [&server, &session](const DropStep& drop) {
                const std::uint16_t code = drop.how == EDrop::Cut ? Protocol::CLOSE_ABNORMAL : drop.code;
                server.Run([&](Core::Now /*now*/, auto& out) { session.Drop(code, "requested by a scenario", out); });
                return true;
            },
            [this, &session](const HoldAcksStep& step) {
                session.HoldAcks(step.hold, _stage.clock.GetNow());
                return true;
            },
            [&session](const RefuseRegistrationStep& step) {
                session.RefuseRegistrations(step.times, step.message);
                return true;
            },
            [&session](const EndFaults& /*action*/) {
                session.EndFaults();
                return true;
            },
            [this](const StartScenarioTimer& start) {
                _timers.Start(ETimer::Scenario, start.delay);
                return true;
            },
            [this](const PrintLine& line) {
                _stage.lines.push_back(line.text);
                return true;
            }},
        action);
}

void ScenarioPlayer::OnTimer(ETimer timer)
{
    ReadInbox();
    if (timer == ETimer::Scenario)
    {
        Play([this](Core::Now now, ScenarioActions& out) { _scenarios.OnTimer(now, out); });
    }
    _onPlayed();
}

} // namespace ACS::McsSim
