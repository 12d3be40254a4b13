#include "ClientControls.hpp"

#include "ClientEvents.hpp"

#include <algorithm>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

void ReportSettled(std::uint64_t token, EControlOutcome outcome, std::string_view detail, ClientActions& out)
{
    Detail::Report(ClientControlSettled{token, outcome, 0, std::nullopt, std::string(detail)}, out);
}

} // namespace

ClientControls::ClientControls(std::size_t maximumWaiting)
    : _waiting(maximumWaiting)
{
}

bool ClientControls::TryAdd(std::uint64_t token, Core::SteadyTime deadline, ControlCall call)
{
    return _waiting.TryPush(Waiting{token, deadline, std::move(call)});
}

const ControlRequest* ClientControls::BeginNextOrNull()
{
    std::optional<Waiting> next = _waiting.PopFrontOrNull();
    if (!next.has_value())
    {
        return nullptr;
    }
    _current = std::move(*next);
    _stage = EStage::Leaving;
    _bAbandoned = false;
    return &_current.call.request;
}

bool ClientControls::TryBeginWindow(Core::Now now)
{
    if (_stage != EStage::Leaving)
    {
        return false;
    }
    _stage = EStage::Window;
    _leftAt = now.steady;
    return true;
}

bool ClientControls::TryAccept(ClientActions& out)
{
    if (_bAbandoned || !_current.call.isConfirmed || _stage == EStage::Confirmed)
    {
        SettleCurrent(EControlOutcome::Accepted, {}, out);
        return true;
    }
    FinishCurrent(out);
    _confirmations.push_back(
        Confirmation{_current.token, _leftAt + _current.call.confirmWithin, std::move(_current.call.isConfirmed)});
    return false;
}

void ClientControls::Refuse(
    int status,
    std::optional<Core::JsonText> bodyOrNull,
    std::string detail,
    ClientActions& out)
{
    FinishCurrent(out);
    if (_bAbandoned)
    {
        Detail::Report(ClientControlFault{status, std::move(bodyOrNull), std::move(detail)}, out);
        return;
    }
    Detail::Report(
        ClientControlSettled{
            _current.token,
            EControlOutcome::Refused,
            status,
            std::move(bodyOrNull),
            std::move(detail)},
        out);
}

void ClientControls::AbandonCurrent(std::string_view detail, ClientActions& out)
{
    if (IsInFlight() && !std::exchange(_bAbandoned, true))
    {
        ReportSettled(_current.token, EControlOutcome::Unknown, detail, out);
    }
}

void ClientControls::OnSample(const DataLine& sample, ClientActions& out)
{
    if (_stage == EStage::Window && !_bAbandoned && _current.call.isConfirmed && _current.call.isConfirmed(sample))
    {
        _stage = EStage::Confirmed;
    }
    std::erase_if(_confirmations, [&sample, &out](const Confirmation& confirmation) {
        const bool bHolds = confirmation.isConfirmed(sample);
        if (bHolds)
        {
            ReportSettled(confirmation.token, EControlOutcome::Accepted, {}, out);
        }
        return bHolds;
    });
}

void ClientControls::SettleLate(Core::Now now, ClientActions& out)
{
    _waiting.EraseIf([now, &out](const Waiting& control) {
        const bool bLate = now.steady >= control.deadline;
        if (bLate)
        {
            ReportSettled(control.token, EControlOutcome::NotSent, "its turn did not come in time", out);
        }
        return bLate;
    });
    std::erase_if(_confirmations, [now, &out](const Confirmation& confirmation) {
        const bool bLate = now.steady >= confirmation.deadline;
        if (bLate)
        {
            constexpr const char* DETAIL = "no refusal came, and no sample showed its effect in time";
            ReportSettled(confirmation.token, EControlOutcome::Unconfirmed, DETAIL, out);
        }
        return bLate;
    });
}

void ClientControls::SettleCurrent(EControlOutcome outcome, std::string_view detail, ClientActions& out)
{
    if (!IsInFlight())
    {
        return;
    }
    FinishCurrent(out);
    if (!_bAbandoned)
    {
        ReportSettled(_current.token, outcome, detail, out);
    }
}

void ClientControls::SettleConfirmations(std::string_view detail, ClientActions& out)
{
    for (const Confirmation& confirmation : std::exchange(_confirmations, {}))
    {
        ReportSettled(confirmation.token, EControlOutcome::Unknown, detail, out);
    }
}

void ClientControls::SettleWaiting(std::string_view detail, ClientActions& out)
{
    while (const std::optional<Waiting> control = _waiting.PopFrontOrNull())
    {
        ReportSettled(control->token, EControlOutcome::NotSent, detail, out);
    }
}

bool ClientControls::IsInFlight() const noexcept
{
    return _stage != EStage::Nothing;
}

Core::SteadyTime ClientControls::GetSendDeadline() const noexcept
{
    return _stage == EStage::Leaving ? _current.deadline : Core::SteadyTime::max();
}

Core::SteadyTime ClientControls::GetDeadline() const noexcept
{
    Core::SteadyTime earliest = Core::SteadyTime::max();
    for (const Waiting& control : _waiting)
    {
        earliest = std::min(earliest, control.deadline);
    }
    for (const Confirmation& confirmation : _confirmations)
    {
        earliest = std::min(earliest, confirmation.deadline);
    }
    return earliest;
}

void ClientControls::FinishCurrent(ClientActions& out)
{
    _stage = EStage::Nothing;
    out.emplace_back(ClientCancelTimer{EClientTimer::Answer});
}

} // namespace ACS::OpenStream
