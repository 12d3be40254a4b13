#include "McsSimulator.hpp"

#include "common/process/TimerSet.hpp"
#include "console/CleanText.hpp"
#include "console/ConsoleCommand.hpp"
#include "console/LiveView.hpp"
#include "console/RobotBoard.hpp"
#include "console/Screen.hpp"
#include "console/Summary.hpp"
#include "plans/PlanFile.hpp"
#include "plans/PlanRefresher.hpp"
#include "plans/PlanSender.hpp"
#include "plans/PlanTracker.hpp"
#include "scenario/ScenarioPlayer.hpp"
#include "scenario/ScenarioSummary.hpp"
#include "wire/NoteJudge.hpp"
#include "wire/SimulatedMcsSession.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

enum class ETimer : std::uint8_t
{
    Tick,   ///< Time to draw, and to see whether an Ack is overdue.
    Linger, ///< All plans have ended: late messages of the ACS are still checked.
    Close,  ///< The ACS does not answer the closing handshake.
    Delay,  ///< A delayed Ack is due.
};

/// The summary is written once: a terminal may wrap a long reason, cut off it would be of no use.
constexpr std::size_t MAX_SUMMARY_COLUMNS = 1000;
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

std::chrono::milliseconds GetMilliseconds(Core::Duration duration)
{
    return std::chrono::duration_cast<std::chrono::milliseconds>(duration);
}

} // namespace

class McsSimulator::Impl final : private ProtocolBeast::ISessionHandler
{
    const Core::IClock& _clock;
    Core::IRandom& _random;
    Core::Logger _logger;
    SimulatorOptions _options;
    std::ostream& _out;
    Screen* _screenOrNull;
    DoneHandler _onDone;
    boost::asio::any_io_executor _executor;

    PlanTracker _tracker;
    std::optional<FloorChecker> _floor;
    PlanRefresher _refresher;
    RobotBoard _board;
    PlanSender _sender;
    NoteJudge _notes;
    PlanTracker::Lines _lines;
    ScenarioPlayer _scenarios;
    LiveView _view;
    ViewHeading _heading;
    Core::SteadyTime _started;
    std::optional<Core::SteadyTime> _finished;
    bool _bReleased = false;
    bool _bEnding = false;
    bool _bDone = false;

    std::unique_ptr<ProtocolBeast::McsServer> _server;
    SimulatedMcsSession* _sessionOrNull = nullptr; ///< Of the server.
    Apps::TimerSet<ETimer> _timers;

public:
    Impl(
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
          _out(out),
          _screenOrNull(screenOrNull),
          _onDone(std::move(onDone)),
          _executor(executor),
          _tracker(std::move(plans), options.profile == EProfile::Spec),
          _floor(
              options.worldOrNull == nullptr
                  ? std::nullopt
                  : std::optional<FloorChecker>(std::in_place, _tracker, *options.worldOrNull, options.stocking)),
          _refresher(random, options.date, GetCarrierNames(options)),
          _sender(
              _tracker,
              _board,
              _floor.has_value() ? &*_floor : nullptr,
              options.profile,
              options.bFreshPlans,
              [this](const Protocol::ExecutionPlan& plan, const std::string& transactionID) {
                  return TrySendPlan(plan, transactionID);
              }),
          _scenarios(
              executor,
              ScenarioStage{clock, random, _sender, _notes, _lines},
              options.scenarios,
              PlanRefresher(random, options.date, GetCarrierNames(options)),
              [this] { OnPlayed(); }),
          _view(options.columns, options.rows),
          _started(clock.GetNow().steady),
          _timers(executor, [this](ETimer timer) { OnTimer(timer); })
    {
    }

    [[nodiscard]] Core::Result<Apps::Endpoint> Start()
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
        _heading.address = (_options.tls.has_value() ? "wss://" : "ws://") + MakeText(endpoint) + _options.path;
        _timers.Start(ETimer::Tick, TICK);
        return endpoint;
    }

    void Release()
    {
        if (!_bReleased)
        {
            _bReleased = true;
            _scenarios.Start();
            SendDue();
            Flush();
        }
    }

    void Interrupt()
    {
        if (_server == nullptr)
        {
            FinishRun();
            return;
        }
        End();
    }

    void Execute(const std::string& line)
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
        Flush();
    }

private:
    void Execute(const ConsoleCommand& command)
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
                _out << GetConsoleHelp() << std::endl;
                break;
            case EConsoleVerb::Quit:
                Interrupt();
                break;
            default:
                assert(false);
                break;
        }
    }

    void AddPlanOfFile(const std::string& path)
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

    void SendControl(const Protocol::AcsPayload& payload)
    {
        const bool bSent = _server->TrySend(_server->MakeRequest(payload));
        _lines.push_back(bSent ? fmt::format("{} sent", GetText(GetCommand(payload))) : "no ACS is registered");
    }

    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        if (_bDone)
        {
            return;
        }
        _scenarios.ReadInbox();
        std::visit(
            Core::Overloaded{
                [this](const Protocol::Registered& /*event*/) { OnRegistered(); },
                [this](const Protocol::LinkLost& lost) { OnLinkLost(lost); },
                [this](const Protocol::RequestReceived& received) { OnRequest(received); },
                [this](const Protocol::AckReceived& received) { _tracker.OnAck(received.ack, _lines); },
                [this](const Protocol::RequestUnanswered& unanswered) { OnUnanswered(unanswered); },
                [this](const Protocol::ProtocolNoted& noted) { OnNoted(noted); },
                // The rest is the ACS's side.
                [](const auto& /*other*/) {
                }},
            event);
        if (_floor.has_value())
        {
            _floor->EndPlans(_lines);
        }
        SendDue();
        Flush();
        if (_bEnding && !_bDone && !_server->IsRegistered())
        {
            FinishRun();
        }
        else
        {
            CheckFinished();
        }
    }

    void CheckFinished()
    {
        const bool bFinished = _scenarios.IsEmpty() ? _tracker.IsFinished() : _bReleased && _scenarios.IsFinished();
        if (bFinished && !_options.bConsole && !_finished.has_value() && !_bEnding)
        {
            OnFinished();
        }
    }

    void OnWire(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text)
    {
        if (_options.onWire)
        {
            _options.onWire(direction, connection, text);
        }
        if (direction == ProtocolBeast::EWireDirection::In && _options.profile == EProfile::Nexus
            && text.size() > NEXUS_BUFFER_BYTES)
        {
            _notes.Excuse(); // Cut by us.
        }
        _scenarios.OnWire(direction, connection, text);
    }

    void OnRegistered()
    {
        _heading.bRegistered = true;
        _tracker.OnRegistered();
        _lines.emplace_back("ACS registered");
        _scenarios.OnRegistered();
    }

    void OnLinkLost(const Protocol::LinkLost& lost)
    {
        if (!lost.bWasRegistered)
        {
            return;
        }
        _heading.bRegistered = false;
        _tracker.OnLinkLost();
        _scenarios.OnLinkLost();
        if (!_bEnding)
        {
            _lines.push_back("ACS link lost: " + CleanText(lost.reason));
        }
    }

    void OnUnanswered(const Protocol::RequestUnanswered& unanswered)
    {
        _notes.Excuse();
        // Overdue Acks of plans are the tracker's to see.
        if (unanswered.command != Protocol::EAcsCommand::ExecutionPlan)
        {
            _lines.push_back(fmt::format("{} was not answered", GetText(unanswered.command)));
        }
    }

    void OnNoted(const Protocol::ProtocolNoted& noted)
    {
        std::optional<NoteJudge::Verdict> verdict = _notes.JudgeOrNull(noted);
        if (!verdict.has_value())
        {
            return;
        }
        if (verdict->bViolation)
        {
            _tracker.AddViolation(std::move(verdict->text), _lines);
        }
        else
        {
            _lines.push_back(std::move(verdict->text));
        }
    }

    void OnRequest(const Protocol::RequestReceived& received)
    {
        if (received.bDuplicate)
        {
            return;
        }
        const Protocol::AcsPayload& payload = received.request.payload;
        if (const auto* const statusOrNull = std::get_if<Protocol::RobotStatusUpdate>(&payload))
        {
            _board.OnStatus(*statusOrNull, _lines);
        }
        else if (const auto* const positionOrNull = std::get_if<Protocol::RobotPositionUpdate>(&payload))
        {
            _board.OnPosition(*positionOrNull, _lines);
        }
        else
        {
            _tracker.OnRequest(payload, _lines);
        }
        if (_floor.has_value())
        {
            _floor->OnRequest(payload, _lines);
        }
    }

    void SendDue()
    {
        if (!_bReleased || _bEnding)
        {
            return;
        }
        const Core::Now now = _clock.GetNow();
        _sender.SendHeld(now, _lines);
        if (_scenarios.IsEmpty())
        {
            _sender.SendDue(now, _lines);
        }
    }

    [[nodiscard]] bool TrySendPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID)
    {
        Protocol::AcsRequest request = _server->MakeRequest(plan);
        request.transactionID = transactionID;
        return _server->TrySend(request);
    }

    void OnTimer(ETimer timer)
    {
        switch (timer)
        {
            case ETimer::Tick:
                SendDue();
                Flush();
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

    void OnPlayed()
    {
        Flush();
        CheckFinished();
    }

    void OnFinished()
    {
        _finished = _clock.GetNow().steady;
        if (!_options.bKeep)
        {
            _timers.Start(ETimer::Linger, LINGER);
            return;
        }
        _heading.bKept = true;
        _lines.emplace_back("all is finished, Ctrl-C ends");
        Flush();
    }

    void End()
    {
        if (_bEnding)
        {
            return;
        }
        _bEnding = true;
        _scenarios.End();
        _timers.Cancel(ETimer::Linger);
        const bool bWait = _server->IsRegistered();
        _server->Stop();
        // Not at once: this may be called from the server's own event.
        _timers.Start(ETimer::Close, bWait ? CLOSE_LIMIT : std::chrono::milliseconds(0));
    }

    void FinishRun()
    {
        if (_bDone)
        {
            return;
        }
        _bDone = true;
        _scenarios.End();
        _timers.CancelAll();
        if (_floor.has_value())
        {
            _floor->Finish(_lines);
        }
        Flush();
        Draw();
        const Core::SteadyTime end = _finished.value_or(_clock.GetNow().steady);
        const auto duration = GetMilliseconds(end - _sender.GetFirstSentOrNull().value_or(end));
        const Protocol::SessionStatistics none{};
        const auto& statistics = _server == nullptr ? none : _server->GetStatistics();
        if (_screenOrNull != nullptr)
        {
            _screenOrNull->Leave();
        }
        for (const StyledLine& line : MakeSummary(_tracker, statistics, _notes.GetCounts(), duration))
        {
            _out << MakeText(line, MAX_SUMMARY_COLUMNS, _screenOrNull != nullptr) << '\n';
        }
        if (_scenarios.IsEmpty())
        {
            if (!_options.bFreshPlans && WasDuplicateRefused(_tracker))
            {
                _out << " The ACS knows a planId already: with --fresh-ids plans go under new ids.\n";
            }
            PrintDeliveries();
            _out << MakeLastLine(_tracker) << std::endl;
            _onDone(_tracker.IsSuccess() ? 0 : 1);
            return;
        }
        const std::vector<ScenarioResult> results = _scenarios.GetResults();
        for (const StyledLine& line : MakeScenarioTable(results))
        {
            _out << MakeText(line, MAX_SUMMARY_COLUMNS, _screenOrNull != nullptr) << '\n';
        }
        PrintDeliveries();
        _out << MakeScenarioLastLine(results, _tracker.CountViolations()) << std::endl;
        _onDone(_scenarios.HasHeld() && _tracker.CountViolations() == 0 ? 0 : 1);
    }

    void PrintDeliveries()
    {
        if (_floor.has_value())
        {
            _out << MakeDeliveryLine(_floor->GetCount()) << '\n';
        }
    }

    void Draw()
    {
        if (_screenOrNull == nullptr || !_bReleased)
        {
            return;
        }
        _heading.elapsed = GetMilliseconds(_finished.value_or(_clock.GetNow().steady) - _started);
        _screenOrNull->Draw(_view.Render(_tracker, _board, _heading));
    }

    /// Prints what happened since the last time, where no live view shows it.
    void Flush()
    {
        if (_screenOrNull == nullptr && !_lines.empty())
        {
            const std::chrono::duration<double> elapsed = _clock.GetNow().steady - _started;
            for (const std::string& line : _lines)
            {
                _out << fmt::format("{:.3f} {}\n", elapsed.count(), line);
            }
            _out << std::flush;
        }
        _lines.clear();
    }
};

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
    : _impl(std::make_unique<
            Impl>(executor, clock, random, logger, options, std::move(plans), out, screenOrNull, std::move(onDone)))
{
}

McsSimulator::~McsSimulator() = default;

Core::Result<Apps::Endpoint> McsSimulator::Start()
{
    return _impl->Start();
}

void McsSimulator::Release()
{
    _impl->Release();
}

void McsSimulator::Execute(const std::string& line)
{
    _impl->Execute(line);
}

void McsSimulator::Interrupt()
{
    _impl->Interrupt();
}

} // namespace ACS::McsSim
