#include "McsSimulator.hpp"

#include "CleanText.hpp"
#include "common/TimerSet.hpp"
#include "LiveView.hpp"
#include "PlanTracker.hpp"
#include "RobotBoard.hpp"
#include "Screen.hpp"
#include "Summary.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <fmt/format.h>

#include <cstdint>
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
    Linger, ///< All plans have ended: what the ACS still says, right or wrong, is heard for so long.
    Close,  ///< The ACS does not answer the closing handshake.
};

/// The summary is written once: a terminal may wrap a long reason, cut off it would be of no use.
constexpr std::size_t MAX_SUMMARY_COLUMNS = 1000;
constexpr std::chrono::milliseconds TICK{100};
constexpr std::chrono::milliseconds LINGER{300};
constexpr std::chrono::milliseconds CLOSE_LIMIT{1'500};

std::uint64_t MakeKey(ETimer timer)
{
    return static_cast<std::uint64_t>(timer);
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
    RobotBoard _board;
    LiveView _view;
    ViewHeading _heading;
    PlanTracker::Lines _lines;
    Core::SteadyTime _started;
    std::optional<Core::SteadyTime> _firstSent;
    std::optional<Core::SteadyTime> _finished;
    bool _bReleased = false;
    bool _bEnding = false;
    bool _bDone = false;

    std::unique_ptr<ProtocolBeast::McsServer> _server;
    Apps::TimerSet _timers;

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
          _tracker(std::move(plans)),
          _view(options.columns, options.rows),
          _started(clock.GetNow().steady),
          _timers(executor, [this](std::uint64_t key) { OnTimer(static_cast<ETimer>(key)); })
    {
    }

    [[nodiscard]] Core::Result<Apps::Endpoint> Start()
    {
        ProtocolBeast::ServerOptions server;
        server.address = _options.listen.host;
        server.port = _options.listen.port;
        server.path = _options.path;
        server.onWire = _options.onWire;
        server.session.ackTimeout = PlanTracker::RESEND_AFTER;
        server.session.codec.siteOffset = _options.siteOffset;
        auto created = ProtocolBeast::McsServer::Create(_executor, _clock, _random, _logger, server, *this);
        if (!created.has_value())
        {
            return tl::make_unexpected(created.error());
        }
        _server = std::move(*created);
        const Apps::Endpoint endpoint{_options.listen.host, _server->GetPort()};
        _heading.address = "ws://" + MakeText(endpoint) + _options.path;
        _timers.Start(MakeKey(ETimer::Tick), TICK);
        return endpoint;
    }

    void Release()
    {
        if (!_bReleased)
        {
            _bReleased = true;
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

private:
    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        if (_bDone)
        {
            return;
        }
        std::visit(
            Core::Overloaded{
                [this](const Protocol::Registered& /*event*/) { OnRegistered(); },
                [this](const Protocol::LinkLost& lost) { OnLinkLost(lost); },
                [this](const Protocol::RequestReceived& received) { OnRequest(received); },
                [this](const Protocol::AckReceived& received) { _tracker.OnAck(received.ack, _lines); },
                // Overdue Acks are the tracker's to see; the rest is of no interest here, or the ACS's side.
                [](const auto& /*other*/) {
                }},
            event);
        SendDue();
        Flush();
        if (_bEnding && !_bDone && !_server->IsRegistered())
        {
            FinishRun();
        }
        else if (_tracker.IsFinished() && !_finished.has_value())
        {
            OnFinished();
        }
    }

    void OnRegistered()
    {
        _heading.bRegistered = true;
        _tracker.OnRegistered();
        _lines.emplace_back("ACS registered");
    }

    void OnLinkLost(const Protocol::LinkLost& lost)
    {
        if (!lost.bWasRegistered)
        {
            return;
        }
        _heading.bRegistered = false;
        _tracker.OnLinkLost();
        if (!_bEnding)
        {
            _lines.push_back("ACS link lost: " + CleanText(lost.reason));
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
            _board.OnPosition(*positionOrNull);
        }
        else
        {
            _tracker.OnRequest(payload, _lines);
        }
    }

    void SendDue()
    {
        if (!_bReleased || _bEnding)
        {
            return;
        }
        const Core::Now now = _clock.GetNow();
        std::optional<std::size_t> next = _tracker.GetNextToSendOrNull(now);
        while (next.has_value())
        {
            const PlannedPlan& planned = _tracker.GetPlans()[*next].planned;
            Protocol::AcsRequest request = _server->MakeRequest(planned.plan);
            request.transactionID = planned.transactionID;
            if (!_server->TrySend(request))
            {
                return; // The link has just gone, or is full: the next event or tick tries again.
            }
            _firstSent = _firstSent.value_or(now.steady);
            _tracker.OnSent(*next, now, _lines);
            next = _tracker.GetNextToSendOrNull(now);
        }
    }

    void OnTimer(ETimer timer)
    {
        switch (timer)
        {
            case ETimer::Tick:
                SendDue();
                Flush();
                Draw();
                _timers.Start(MakeKey(ETimer::Tick), TICK);
                break;
            case ETimer::Linger:
                End();
                break;
            case ETimer::Close:
                FinishRun();
                break;
            default:
                break;
        }
    }

    void OnFinished()
    {
        _finished = _clock.GetNow().steady;
        if (!_options.bKeep)
        {
            _timers.Start(MakeKey(ETimer::Linger), LINGER);
            return;
        }
        _heading.bKept = true;
        _lines.emplace_back("all plans finished, Ctrl-C ends");
        Flush();
    }

    void End()
    {
        if (_bEnding)
        {
            return;
        }
        _bEnding = true;
        _timers.Cancel(MakeKey(ETimer::Linger));
        const bool bWait = _server->IsRegistered();
        _server->Stop();
        // Not at once: this may be called from the server's own event.
        _timers.Start(MakeKey(ETimer::Close), bWait ? CLOSE_LIMIT : std::chrono::milliseconds(0));
    }

    void FinishRun()
    {
        if (_bDone)
        {
            return;
        }
        _bDone = true;
        _timers.CancelAll();
        Flush();
        Draw();
        const Core::SteadyTime end = _finished.value_or(_clock.GetNow().steady);
        const auto duration = GetMilliseconds(end - _firstSent.value_or(end));
        const Protocol::SessionStatistics none{};
        const auto& statistics = _server == nullptr ? none : _server->GetStatistics();
        if (_screenOrNull != nullptr)
        {
            _screenOrNull->Leave();
        }
        for (const StyledLine& line : MakeSummary(_tracker, statistics, duration))
        {
            _out << MakeText(line, MAX_SUMMARY_COLUMNS, _screenOrNull != nullptr) << '\n';
        }
        _out << MakeLastLine(_tracker) << std::endl;
        _onDone(_tracker.IsSuccess() ? 0 : 1);
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

void McsSimulator::Interrupt()
{
    _impl->Interrupt();
}

} // namespace ACS::McsSim
