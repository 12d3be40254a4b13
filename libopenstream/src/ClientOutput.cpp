#include "ClientOutput.hpp"

#include <acs/openstream/OpenStreamCodec.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::OpenStream
{

ClientOutput::ClientOutput(std::size_t maximumBytes)
    : _outbox(maximumBytes)
{
}

void ClientOutput::Reset()
{
    _outbox.Reset();
    _commandStart = 0;
    _commandMark = 0;
    _stopMark = 0;
    _stopDue = Core::SteadyTime::max();
    _waitingDue = Core::SteadyTime::max();
    _sendingDue = Core::SteadyTime::max();
}

void ClientOutput::SendCommand(const OpenStreamRequest& request, ClientActions& out)
{
    _commandStart = _outbox.GetMark();
    _bControl = std::holds_alternative<ControlRequest>(request);
    OpenStreamCodec::EncodeRequest(request, _outbox.GetLines());
    _commandMark = _outbox.GetMark();
    Flush(out);
}

void ClientOutput::SendUntil(const OpenStreamRequest& request, Core::SteadyTime deadline, ClientActions& out)
{
    _waitingDue = std::min(_waitingDue, deadline);
    OpenStreamCodec::EncodeRequest(request, _outbox.GetLines());
    Flush(out);
}

bool ClientOutput::TrySendStopControl(Core::SteadyTime deadline, ClientActions& out)
{
    const bool bRepeated = !_outbox.WasTaken(_stopMark);
    const bool bCommandWaits = !WasCommandTaken();
    std::string& lines = _outbox.GetLines();
    const std::uint64_t taken = _outbox.GetMark() - lines.size();
    std::string command; // A MONITOR or STOP monitor that waits.
    if (bCommandWaits && !_bControl)
    {
        command = lines.substr(_commandStart - taken, _commandMark - _commandStart);
    }
    lines.clear();
    OpenStreamCodec::EncodeRequest(StopRequest{EStopTarget::Control}, lines);
    _stopMark = _outbox.GetMark();
    lines += command;
    if (bCommandWaits)
    {
        _commandStart = _stopMark;
        _commandMark = command.empty() ? taken : _outbox.GetMark(); // A dropped CONTROL does not wait any more.
    }
    _stopDue = bRepeated ? _stopDue : deadline;
    _waitingDue = _stopDue;
    Flush(out);
    return !bRepeated;
}

bool ClientOutput::TryCompleteSend()
{
    if (!_outbox.IsSending())
    {
        return false;
    }
    static_cast<void>(_outbox.CompleteSend());
    _sendingDue = Core::SteadyTime::max();
    return true;
}

void ClientOutput::Flush(ClientActions& out)
{
    if (const std::string_view text = _outbox.TakeForSend(); !text.empty())
    {
        _sendingDue = std::exchange(_waitingDue, Core::SteadyTime::max());
        out.emplace_back(ClientSend{text});
    }
}

bool ClientOutput::IsFull() const noexcept
{
    return _outbox.IsFull();
}

bool ClientOutput::WasCommandTaken() const noexcept
{
    return _outbox.WasTaken(_commandMark);
}

bool ClientOutput::WasCommandSent() const noexcept
{
    return _outbox.WasSent(_commandMark);
}

Core::SteadyTime ClientOutput::GetDeadline() const noexcept
{
    return std::min(_waitingDue, _sendingDue);
}

} // namespace ACS::OpenStream
