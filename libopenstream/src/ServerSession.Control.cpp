#include "ServerSession.Impl.hpp"

#include <cstddef>
#include <optional>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

std::size_t CountBytes(const ApiRequest& call)
{
    std::size_t bytes = call.path.size() + (call.body.has_value() ? call.body->GetText().size() : 0U);
    for (const QueryParameter& parameter : call.query)
    {
        bytes += parameter.name.size() + parameter.value.size();
    }
    return bytes;
}

} // namespace

/// False until the first one is done.
bool ServerSession::Impl::HasRoomForControls() const noexcept
{
    return !_controls.IsFull() && _controlBytes < _options.maximumControlBytes;
}

void ServerSession::Impl::Handle(const ControlRequest& request, Core::Now /*now*/, ServerActions& out)
{
    ApiRequest call;
    FillRequest(request.method, request.url, request.args, call);
    call.body = request.body.value_or(Core::JsonText::FromTrusted("{}"));
    const std::size_t bytes = CountBytes(call);
    if (!HasRoomForControls() || !_controls.TryPush(std::move(call)))
    {
        AppendError(EOpenStreamErrorCode::ControlBusy, "too many CONTROLs wait for the controller");
        return;
    }
    _controlBytes += bytes;
    _bControlled = true;
    CallNextControl(out);
}

bool ServerSession::Impl::TryStopControl(ServerActions& out)
{
    if (!_bControlled)
    {
        return false;
    }
    _bControlled = false;
    // What waits is not executed any more; the one in flight cannot be taken back and keeps its place.
    bool bFirst = true;
    _controls.EraseIf([&bFirst](const ApiRequest&) { return !std::exchange(bFirst, false); });
    const ApiRequest* const first = _controls.GetFrontOrNull();
    _controlBytes = first != nullptr ? CountBytes(*first) : 0;
    _bRefusingControls = _bRefusingControls && !HasRoomForControls();
    out.emplace_back(ServerStopControl{});
    return true;
}

void ServerSession::Impl::CallNextControl(ServerActions& out)
{
    const ApiRequest* next = _controls.GetFrontOrNull();
    if (_controlToken == 0 && next != nullptr)
    {
        _controlToken = ++_lastToken;
        out.emplace_back(ServerCall{_controlToken, next});
    }
}

void ServerSession::Impl::FinishControl(const ApiResponse& response, Core::Now now, ServerActions& out)
{
    if (!response.IsSuccess())
    {
        ++_stats.controlErrors;
        OpenStreamCodec::EncodeLine(ControlError{response.status, response.body}, _outbox.GetLines());
    }
    const bool bWasFull = !HasRoomForControls();
    if (const std::optional<ApiRequest> done = _controls.PopFrontOrNull(); done.has_value())
    {
        _controlBytes -= CountBytes(*done);
    }
    _controlToken = 0;
    CallNextControl(out);
    if (bWasFull && HasRoomForControls())
    {
        _bRefusingControls = false;
        out.emplace_back(ServerCancelTimer{EServerTimer::ControlBusy});
        ProcessLines(now, out);
    }
}

} // namespace ACS::OpenStream
