#include "ClientOutput.hpp"

#include <acs/openstream/OpenStreamCodec.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace ACS::OpenStream
{

ClientOutput::ClientOutput(std::size_t maximumBytes)
    : _outbox(maximumBytes)
{
}

void ClientOutput::Reset()
{
    _outbox.Reset();
    _commandMark = 0;
    _stopMark = 0;
    _waitingDue = Core::SteadyTime::max();
    _sendingDue = Core::SteadyTime::max();
}

void ClientOutput::SendCommand(const OpenStreamRequest& request, ClientActions& out)
{
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

void ClientOutput::SendStopControl(Core::SteadyTime deadline, ClientActions& out)
{
    if (_outbox.WasTaken(_stopMark) || _outbox.GetMark() != _stopMark)
    {
        SendUntil(StopRequest{EStopTarget::Control}, deadline, out);
        _stopMark = _outbox.GetMark();
    }
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
