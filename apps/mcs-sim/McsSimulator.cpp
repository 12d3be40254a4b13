#include "McsSimulator.hpp"

#include "console/CleanText.hpp"
#include "console/Summary.hpp"
#include "plans/PlanFile.hpp"
#include "scenario/ScenarioSummary.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

constexpr const char* CONSOLE_REASON = "asked for at the console";
constexpr std::chrono::milliseconds TICK{100};
constexpr std::chrono::milliseconds LINGER{300};
constexpr std::chrono::milliseconds CLOSE_LIMIT{1'500};

/// Renamed carriers are on no floor but one that is restocked.
ECarrierNames GetCarrierNames(const SimulatorOptions& options)
{
    const bool bFound = options.worldOrNull != nullptr && options.stocking == EStocking::Leave;
    return bFound ? ECarrierNames::Kept : ECarrierNames::Fresh;
}

} // namespace

McsSimulator::McsSimulator(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    const SimulatorOptions& options,
    std::vector<PlannedPlan> plans,
    std::ostream& out,
    Screen* screenOrNull,
    DoneHandler onDone)
    : _clock(clock),
      _random(random),
      _logger(logger),
      _options(options),
      _output(clock, out, screenOrNull, options.columns, options.rows),
      _lines(_output.GetLines()),
      _onDone(std::move(onDone)),
      _executor(executor),
      _judge(options, std::move(plans), _lines),
      _tracker(_judge.GetTracker()),
      _refresher(random, options.date, GetCarrierNames(options)),
      _sender(
          _tracker,
          _judge.GetBoard(),
          _judge.GetFloorOrNull(),
          options.profile,
          options.bFreshPlans,
          [this](const Protocol::ExecutionPlan& plan, const std::string& transactionID) {
              return TrySendPlan(plan, transactionID);
          }),
      _scenarios(
          executor,
          ScenarioStage{clock, random, _sender, _judge.GetNotes(), _lines},
          options.scenarios,
          PlanRefresher(random, options.date, GetCarrierNames(options)),
          [this] { OnPlayed(); }),
      _timers(executor, [this](ETimer timer) { OnTimer(timer); })
{
}

Core::Result<Apps::Endpoint> McsSimulator::Start()
{
    ProtocolBeast::ServerOptions server;
    server.address = _options.listen.host;
    server.port = _options.listen.port;
    server.path = _options.path;
    server.tls = _options.tls;
    server.onWire = [this](auto direction, auto connection, std::string_view text) {
        OnWire(direction, connection, text);
    };
    server.link.bLastFrameOnly = _options.profile == EProfile::Nexus;
    Protocol::McsSessionOptions options;
    options.bSecondRefused = _options.profile == EProfile::Nexus;
    options.ackTimeout = PlanTracker::RESEND_AFTER;
    options.codec.siteOffset = _options.siteOffset;
    auto session = std::make_unique<SimulatedMcsSession>(
        options,
        MakeBehaviour(_options.profile),
        _random,
        [this](std::chrono::milliseconds delay) { _timers.Start(ETimer::Delay, delay); });
    _sessionOrNull = session.get();
    auto created = ProtocolBeast::McsServer::Create(_executor, _clock, _logger, server, std::move(session), *this);
    if (!created.has_value())
    {
        return tl::make_unexpected(created.error());
    }
    _server = std::move(*created);
    _scenarios.SetServer(*_server, *_sessionOrNull);
    const Apps::Endpoint endpoint{_options.listen.host, _server->GetPort()};
    _output.SetAddress((_options.tls.has_value() ? "wss://" : "ws://") + MakeText(endpoint) + _options.path);
    _timers.Start(ETimer::Tick, TICK);
    return endpoint;
}

void McsSimulator::Release()
{
    if (_phase == EPhase::Waiting)
    {
        _phase = EPhase::Released;
        _output.Begin();
        _scenarios.Start();
        SendDue();
        _output.Flush();
    }
}

void McsSimulator::Interrupt()
{
    if (_server == nullptr)
    {
        FinishRun();
        return;
    }
    End();
}

void McsSimulator::Execute(const std::string& line)
{
    const tl::expected<ConsoleCommand, std::string> command = ParseConsoleLine(line);
    if (!command.has_value())
    {
        _lines.push_back(command.error());
    }
    else
    {
        Execute(*command);
    }
    _output.Flush();
}

void McsSimulator::Execute(const ConsoleCommand& command)
{
    switch (command.verb)
    {
        case EConsoleVerb::Nothing:
            break;
        case EConsoleVerb::Plan:
            AddPlanOfFile(command.argument);
            break;
        case EConsoleVerb::Cancel:
            SendControl(Protocol::CancelPlan{command.argument, CONSOLE_REASON});
            break;
        case EConsoleVerb::Abort:
            SendControl(Protocol::AbortPlan{command.argument, CONSOLE_REASON});
            break;
        case EConsoleVerb::Pause:
            SendControl(Protocol::PausePlan{command.argument, CONSOLE_REASON});
            break;
        case EConsoleVerb::Resume:
            SendControl(Protocol::ResumePlan{command.argument, {}});
            break;
        case EConsoleVerb::Drop:
            _lines.emplace_back(_server->IsRegistered() ? "the connection is cut" : "no ACS is registered");
            _server->Run([this](Core::Now /*now*/, auto& out) {
                _sessionOrNull->Drop(Protocol::CLOSE_ABNORMAL, CONSOLE_REASON, out);
            });
            break;
        case EConsoleVerb::List:
            std::ranges::copy(DescribePlans(_tracker), std::back_inserter(_lines));
            break;
        case EConsoleVerb::Help:
            _output.PrintLine(std::string(GetConsoleHelp()));
            break;
        case EConsoleVerb::Quit:
            Interrupt();
            break;
        default:
            assert(false);
            break;
    }
}

void McsSimulator::AddPlanOfFile(const std::string& path)
{
    tl::expected<PlannedPlan, std::string> planned = ReadPlanFile(path);
    if (!planned.has_value())
    {
        _lines.push_back(planned.error());
        return;
    }
    _refresher.Refresh(*planned);
    _lines.push_back(planned->plan.planID + " is the plan of " + CleanText(path));
    _sender.Add(std::move(*planned), true);
    SendDue();
}

void McsSimulator::SendControl(const Protocol::AcsPayload& payload)
{
    const bool bSent = _server->TrySend(_server->MakeRequest(payload));
    _lines.push_back(bSent ? fmt::format("{} sent", GetText(GetCommand(payload))) : "no ACS is registered");
}

void McsSimulator::OnSessionEvent(const Protocol::SessionEvent& event)
{
    if (_phase == EPhase::Done)
    {
        return;
    }
    _scenarios.ReadInbox();
    std::visit(
        Core::Overloaded{
            [this](const Protocol::Registered& /*event*/) { OnRegistered(); },
            [this](const Protocol::LinkLost& lost) { OnLinkLost(lost); },
            [this](const Protocol::RequestReceived& received) { _judge.OnRequest(received); },
            [this](const Protocol::AckReceived& received) { _judge.OnAck(received); },
            [this](const Protocol::RequestUnanswered& unanswered) { _judge.OnUnanswered(unanswered); },
            [this](const Protocol::ProtocolNoted& noted) { _judge.OnNoted(noted); },
            // The rest is the ACS's side.
            [](const auto& /*other*/) {
            }},
        event);
    _judge.EndPlans();
    SendDue();
    _output.Flush();
    if (_phase == EPhase::Ending && !_server->IsRegistered())
    {
        FinishRun();
    }
    else
    {
        CheckFinished();
    }
}

void McsSimulator::CheckFinished()
{
    const bool bFinished =
        _scenarios.IsEmpty() ? _tracker.IsFinished() : _phase == EPhase::Released && _scenarios.IsFinished();
    if (bFinished && !_options.bConsole && !_output.IsFinished() && _phase < EPhase::Ending)
    {
        OnFinished();
    }
}

void McsSimulator::OnWire(
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text)
{
    if (_options.onWire)
    {
        _options.onWire(direction, connection, text);
    }
    const bool bLost = direction == ProtocolBeast::EWireDirection::In && _options.profile == EProfile::Nexus
        && text.size() > NEXUS_BUFFER_BYTES;
    if (bLost)
    {
        _judge.OnTextLost(text); // Cut by us.
    }
    if (direction == ProtocolBeast::EWireDirection::Out)
    {
        _judge.OnTextSent(text);
    }
    else
    {
        _judge.OnTextReceived(text);
    }
    if (!bLost)
    {
        _scenarios.OnWire(direction, connection, text);
    }
}

void McsSimulator::OnRegistered()
{
    _output.SetRegistered(true);
    _tracker.OnRegistered();
    _lines.emplace_back("ACS registered");
    _scenarios.OnRegistered();
}

void McsSimulator::OnLinkLost(const Protocol::LinkLost& lost)
{
    if (!lost.bWasRegistered)
    {
        return;
    }
    _output.SetRegistered(false);
    _scenarios.OnLinkLost();
    if (_phase < EPhase::Ending)
    {
        _judge.OnLinkLost();
        _lines.push_back("ACS link lost: " + CleanText(lost.reason));
    }
}

void McsSimulator::SendDue()
{
    if (_phase != EPhase::Released)
    {
        return;
    }
    const Core::Now now = _clock.GetNow();
    _sender.SendHeld(_server->IsTakingPlans(), now, _lines);
    if (_scenarios.IsEmpty())
    {
        _sender.SendDue(now, _lines);
    }
}

bool McsSimulator::TrySendPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID)
{
    Protocol::AcsRequest request = _server->MakeRequest(plan);
    request.transactionID = transactionID;
    const std::uint64_t sent = _server->GetStatistics().Of(Protocol::EAcsCommand::ExecutionPlan).sent;
    if (!_server->TrySend(request))
    {
        return false;
    }
    if (_server->GetStatistics().Of(Protocol::EAcsCommand::ExecutionPlan).sent != sent)
    {
        return true;
    }
    // The session sends nothing twice that still waits for its Ack.
    std::string text;
    Protocol::AcsCodec::EncodeRequest(request, text);
    _judge.GetNotes().OnTextSent(text);
    bool bSent = false;
    _server->Run([&](Core::Now /*now*/, auto& out) { bSent = _sessionOrNull->TrySendText(text, out); });
    return bSent;
}

void McsSimulator::OnTimer(ETimer timer)
{
    switch (timer)
    {
        case ETimer::Tick:
            SendDue();
            _output.Flush();
            Draw();
            _timers.Start(ETimer::Tick, TICK);
            break;
        case ETimer::Linger:
            End();
            break;
        case ETimer::Close:
            FinishRun();
            break;
        case ETimer::Delay:
            _server->Run([this](Core::Now now, auto& out) { _sessionOrNull->SendDelayed(now, out); });
            break;
        default:
            assert(false);
            break;
    }
}

void McsSimulator::OnPlayed()
{
    _output.Flush();
    CheckFinished();
}

void McsSimulator::OnFinished()
{
    _output.SetFinished();
    if (!_options.bKeep)
    {
        _timers.Start(ETimer::Linger, LINGER);
        return;
    }
    _output.SetKept();
    _lines.emplace_back("all is finished, Ctrl-C ends");
    _output.Flush();
}

void McsSimulator::End()
{
    if (_phase >= EPhase::Ending)
    {
        return;
    }
    _phase = EPhase::Ending;
    _scenarios.End();
    _timers.Cancel(ETimer::Linger);
    const bool bWait = _server->IsRegistered();
    _server->Stop();
    // Not at once: this may be called from the server's own event.
    _timers.Start(ETimer::Close, bWait ? CLOSE_LIMIT : std::chrono::milliseconds(0));
}

void McsSimulator::FinishRun()
{
    if (_phase == EPhase::Done)
    {
        return;
    }
    _phase = EPhase::Done;
    _scenarios.End();
    _timers.CancelAll();
    _judge.Finish();
    _output.Flush();
    Draw();
    _output.Leave();
    PrintSummary();
    _scenarios.IsEmpty() ? FinishPlans() : FinishScenarios();
}

void McsSimulator::PrintSummary()
{
    const Core::SteadyTime end = _output.GetEnd();
    const Core::Duration duration = end - _sender.GetFirstSentOrNull().value_or(end);
    const Protocol::SessionStatistics none{};
    _output.PrintTable(MakeSummary(
        _tracker,
        _server == nullptr ? none : _server->GetStatistics(),
        _judge.GetNotes().GetCounts(),
        _judge.GetTimestampCounts(),
        _judge.GetMembers().GetCount(),
        std::chrono::duration_cast<std::chrono::milliseconds>(duration)));
}

void McsSimulator::FinishPlans()
{
    if (!_options.bFreshPlans && WasDuplicateRefused(_tracker))
    {
        _output.PrintLine(" The ACS knows a planId already: with --fresh-ids plans go under new ids.");
    }
    PrintDeliveries();
    _output.PrintLine(MakeLastLine(_tracker));
    _onDone(_tracker.IsSuccess() ? 0 : 1);
}

void McsSimulator::FinishScenarios()
{
    const std::vector<ScenarioResult> results = _scenarios.GetResults();
    _output.PrintTable(MakeScenarioTable(results));
    PrintDeliveries();
    _output.PrintLine(MakeScenarioLastLine(results, _tracker.CountViolations()));
    _onDone(_scenarios.HasHeld() && _tracker.CountViolations() == 0 ? 0 : 1);
}

void McsSimulator::PrintDeliveries()
{
    if (const FloorChecker* const floorOrNull = _judge.GetFloorOrNull())
    {
        _output.PrintLine(MakeDeliveryLine(floorOrNull->GetCount()));
    }
}

void McsSimulator::Draw()
{
    _output.Draw(_tracker, _judge.GetBoard());
}

} // namespace ACS::McsSim
