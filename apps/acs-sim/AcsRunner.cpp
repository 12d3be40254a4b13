#include "AcsRunner.hpp"

#include <acs/protocol_beast/EWireDirection.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::AcsSim
{

namespace
{

constexpr std::chrono::milliseconds TICK{50};

} // namespace

AcsRunner::AcsRunner(
    const boost::asio::any_io_executor& executor,
    const Core::IClock& clock,
    Core::IRandom& random,
    const Core::Logger& logger,
    Options options,
    std::ostream& out,
    DoneHandler onDone)
    : _executor(executor),
      _clock(clock),
      _random(random),
      _logger(logger),
      _options(std::move(options)),
      _out(out),
      _onDone(std::move(onDone)),
      _judge(_options.ackTimeout),
      _timers(executor, [this](ETimer timer) { OnTimer(timer); }),
      _acs(_options.acs, *this, _judge, random, [this](const std::string& line) { Print(line); })
{
    _options.client.onWire = [this](ProtocolBeast::EWireDirection direction, std::string_view text) {
        const Core::SteadyTime now = _clock.GetNow().steady;
        direction == ProtocolBeast::EWireDirection::Out ? _judge.OnSent(text, now) : _judge.OnReceived(text, now);
    };
}

Core::Result<void> AcsRunner::Connect()
{
    auto client = ProtocolBeast::AcsClient::Create(_executor, _clock, _random, _logger, _options.client, *this);
    if (!client.has_value())
    {
        return tl::make_unexpected(std::move(client.error()));
    }
    _client = std::move(*client);
    return {};
}

Core::Result<void> AcsRunner::Start()
{
    Core::Result<void> created = Connect();
    if (created.has_value())
    {
        _acs.Start();
        _client->Start();
        _timers.Start(ETimer::Tick, TICK);
        if (_options.duration.count() > 0)
        {
            _timers.Start(ETimer::End, _options.duration);
        }
    }
    return created;
}

void AcsRunner::Stop()
{
    if (!std::exchange(_bStopping, true))
    {
        _client->Stop();
    }
}

void AcsRunner::OnSessionEvent(const Protocol::SessionEvent& event)
{
    _acs.OnEvent(event, _clock.GetNow());
    PrintNews();
    if (std::holds_alternative<Protocol::Stopped>(event))
    {
        Finish();
        return;
    }
    ScheduleModel();
}

void AcsRunner::OnTimer(ETimer timer)
{
    switch (timer)
    {
        case ETimer::Tick:
            _judge.OnTick(_clock.GetNow().steady);
            _timers.Start(ETimer::Tick, TICK);
            if (_acs.IsDone())
            {
                Stop();
            }
            break;
        case ETimer::Model:
            _acs.OnTimer(_clock.GetNow());
            ScheduleModel();
            break;
        case ETimer::End:
            Stop();
            break;
        default:
            break;
    }
    PrintNews();
}

void AcsRunner::ScheduleModel()
{
    const std::optional<Core::SteadyTime> due = _acs.GetNextDueOrNull();
    if (!due.has_value() || _bStopping)
    {
        _timers.Cancel(ETimer::Model);
        return;
    }
    _timers.Start(ETimer::Model, std::max(*due - _clock.GetNow().steady, Core::Duration{}));
}

void AcsRunner::Print(const std::string& line)
{
    _out << line << std::endl; // A reader of a pipe sees each line at once.
}

void AcsRunner::PrintNews()
{
    for (const std::string& line : _judge.GetBook().ExtractNews())
    {
        Print("VIOLATION " + line);
    }
}

void AcsRunner::Finish()
{
    _timers.CancelAll();
    for (const EFault fault : _acs.ListArmedFaults())
    {
        Print(fmt::format("fault {} has not occurred: its moment has not come", GetName(fault)));
    }
    const std::size_t wanted = _options.acs.plans;
    const std::size_t ended = _acs.CountEndedPlans();
    for (const std::string& line : _judge.GetBook().MakeTable())
    {
        Print(line);
    }
    Print(
        wanted > 0 ? fmt::format("{} of {} plans have ended", ended, wanted)
                   : fmt::format("{} plans have ended", ended));
    if (!_acs.WasRegistered())
    {
        Print("the MCS has not accepted a registration");
    }
    const bool bGood = !_judge.GetBook().IsViolated() && _acs.WasRegistered() && ended >= wanted;
    _onDone(bGood ? EXIT_SUCCESS : EXIT_FAILURE);
}

// ---- the link

bool AcsRunner::TrySendDurable(const Protocol::AcsRequest& request)
{
    return _client->TrySendDurable(request);
}

void AcsRunner::ReplayDone()
{
    _client->ReplayDone();
}

void AcsRunner::SendStatus(const Protocol::AcsPayload& status)
{
    _client->SendStatus(status);
}

void AcsRunner::SendPosition(const Protocol::RobotPositionUpdate& positions)
{
    _client->SendPosition(positions);
}

void AcsRunner::Answer(
    Protocol::EAcsCommand command,
    std::string_view transactionID,
    Protocol::EAckResult result,
    std::string_view message,
    const Protocol::AckPayload& payload)
{
    _client->Answer(command, transactionID, result, message, payload);
}

void AcsRunner::SendText(const std::string& text)
{
    _client->SendText(text);
}

void AcsRunner::Cut()
{
    const Core::Result<void> connected = Connect(); // Replaces the client.
    if (!connected.has_value())
    {
        Print("cannot connect again: " + Describe(connected.error()));
        Stop();
        return;
    }
    _client->Start();
}

} // namespace ACS::AcsSim
