#include "AcsPeer.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <utility>
#include <variant>

namespace ACS::Fuzz
{

using namespace Protocol; // NOLINT(google-build-using-namespace)

AcsPeer::AcsPeer(const SessionOptions& options)
    : _options(options),
      _session(options, _random)
{
}

void AcsPeer::Start()
{
    _bStarted = true;
    _session.Start(_now, _actions);
    Execute();
}

void AcsPeer::Stop()
{
    _session.Stop(_now, _actions);
    Execute();
}

void AcsPeer::Connect()
{
    if (_connection == EConnection::Opening)
    {
        _connection = EConnection::Open;
        _session.OnConnected(_now, _actions);
        Execute();
    }
}

void AcsPeer::CloseConnection()
{
    if (_connection == EConnection::None)
    {
        return;
    }
    _connection = EConnection::None;
    _bRegistrationSent = false;
    _bRegistered = false;
    _sent.clear();
    _late.merge(_accepted); // their Acks may still come
    _accepted.clear();
    _session.OnClosed("lost", _now, _actions);
    Execute();
}

void AcsPeer::PassTime(std::chrono::milliseconds span)
{
    const Core::SteadyTime end = _now.steady + span;
    while (true)
    {
        auto* const next = std::ranges::min_element(_deadlines, {}, [](const auto& deadline) {
            return deadline.value_or(Core::SteadyTime::max());
        });
        if (!next->has_value() || **next > end)
        {
            break;
        }
        _now.steady = std::max(_now.steady, **next);
        next->reset();
        _session.OnTimer(static_cast<ESessionTimer>(next - _deadlines.begin()), _now, _actions);
        Execute();
    }
    _now.steady = end;
}

void AcsPeer::Receive(std::string_view text)
{
    if (_connection == EConnection::Open)
    {
        _session.OnText(text, _now, _actions);
        Execute();
    }
}

void AcsPeer::Acknowledge(std::uint32_t choice, EAckResult result)
{
    if (_sent.empty() || _connection != EConnection::Open)
    {
        return;
    }
    const auto request = _sent.begin() + static_cast<std::ptrdiff_t>(choice % _sent.size());
    AcsAck ack;
    ack.command = GetCommand(request->payload);
    ack.transactionID = request->transactionID;
    ack.result = result;
    _sent.erase(request);
    std::string text;
    AcsCodec::EncodeAck(ack, text);
    Receive(text);
}

void AcsPeer::SendReport()
{
    const std::string transactionID = "t" + std::to_string(++_requests);
    const std::size_t room = _session.GetRoom();
    const AcsRequest request{transactionID, {}, PlanReport{"P", EPlanStatus::InProgress, "fine"}};
    const std::size_t before = _accepted.size();
    _accepted.insert(transactionID);
    const bool bTaken = _session.TrySendDurable(request, _now, _actions);
    Require(bTaken == (room > 0), "GetRoom is what TrySendDurable accepts");
    Require(!bTaken || _bRegistered, "a request is accepted while registered only");
    if (!bTaken)
    {
        _accepted.erase(transactionID);
        Require(_accepted.size() == before, "a refused request is not kept");
    }
    Require(_accepted.size() <= _options.window, "no more requests without an Ack than the window");
    Execute();
}

void AcsPeer::SendStatus(std::uint32_t robot, std::uint32_t status)
{
    RobotStatusUpdate update;
    update.robotID = "LR0" + std::to_string(robot);
    update.robotStatus = static_cast<ERobotStatus>(status);
    _session.SendStatus(update, _now, _actions);
    Execute();
}

void AcsPeer::SendPosition()
{
    _session.SendPosition({}, _now, _actions);
    Execute();
}

void AcsPeer::FinishReplay()
{
    if (_bRegistered)
    {
        _session.ReplayDone(_now, _actions);
        Execute();
    }
}

void AcsPeer::Execute()
{
    while (!_actions.empty()) // answers to what is delivered are appended
    {
        const SessionActions actions = std::exchange(_actions, {});
        std::ranges::for_each(actions, [this](const SessionAction& action) { Carry(action); });
    }
}

void AcsPeer::Carry(const SessionAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const SendText& text) { Send(text); },
            [this](const Protocol::Connect&) {
                Require(_connection == EConnection::None, "one connection at a time");
                Require(_bStarted, "no connection after Stopped");
                _connection = EConnection::Opening;
            },
            [this](const Close&) {
                Require(_connection != EConnection::None, "only a connection is closed");
                _connection = EConnection::Closing;
            },
            [this](const StartTimer& timer) {
                Require(timer.delay.count() >= 0, "no timer of the past");
                _deadlines.at(static_cast<std::size_t>(timer.timer)) = _now.steady + timer.delay;
            },
            [this](const CancelTimer& timer) { _deadlines.at(static_cast<std::size_t>(timer.timer)).reset(); },
            [this](const Protocol::Deliver& event) {
                Deliver(event.event);
            }},
        action);
}

void AcsPeer::Send(const SendText& action)
{
    Require(_connection == EConnection::Open, "texts on an open connection only");
    const DecodeOutcome outcome = _codec.Decode(action.text);
    Require(outcome.message.has_value(), "what is sent can be decoded");
    const AcsRequest* const requestOrNull = std::get_if<AcsRequest>(&*outcome.message);
    if (requestOrNull == nullptr)
    {
        return;
    }
    const bool bRegistration = std::holds_alternative<Registration>(requestOrNull->payload);
    Require(bRegistration || _bRegistered, "Registration first");
    _bRegistrationSent = _bRegistrationSent || bRegistration;
    if (!action.bDroppable)
    {
        std::erase_if(_sent, [requestOrNull](const AcsRequest& other) {
            return other.transactionID == requestOrNull->transactionID; // a resend
        });
        _sent.push_back(*requestOrNull);
    }
}

void AcsPeer::Deliver(const SessionEvent& event)
{
    Require(_bStarted, "nothing after Stopped");
    std::visit(
        Core::Overloaded{
            [this](const Registered&) {
                Require(_connection == EConnection::Open && _bRegistrationSent, "registered on an open connection");
                Require(!std::exchange(_bRegistered, true), "registered once for each connection");
            },
            [this](const RequestReceived& received) {
                Require(_bRegistered, "requests come while registered");
                _session.Answer(
                    GetCommand(received.request.payload),
                    received.request.transactionID,
                    EAckResult::Success,
                    {},
                    EmptyAck{},
                    _now,
                    _actions);
            },
            [this](const Acked& acked) {
                const std::size_t found = _accepted.erase(acked.transactionID) + _late.erase(acked.transactionID);
                Require(found == 1, "acked once");
            },
            [this](const RequestUnanswered& unanswered) {
                Require(_accepted.erase(unanswered.transactionID) == 1, "unanswered once");
                _late.insert(unanswered.transactionID);
            },
            [this](const WindowOpened&) { Require(_session.GetRoom() > 0, "an open window has room"); },
            [this](const PositionDue&) { Require(_bRegistered, "positions come while registered"); },
            [this](const Stopped&) {
                _bStarted = false;
                Require(_connection == EConnection::None, "stopped without a connection");
                Require(
                    std::ranges::none_of(_deadlines, [](const auto& deadline) { return deadline.has_value(); }),
                    "no timer after Stopped");
            },
            [](const auto&) {
            }},
        event);
}

} // namespace ACS::Fuzz
