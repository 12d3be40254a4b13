#include <acs/openstream/ServerSession.hpp>

#include <utility>

namespace ACS::OpenStream
{

void ServerSession::Handle(const ControlRequest& request, Core::Now /*now*/, ServerActions& out)
{
    ApiRequest call;
    FillRequest(request.method, request.url, request.args, call);
    call.body = request.body.value_or(Core::JsonText::FromTrusted("{}"));
    if (!_controls.TryPush(std::move(call)))
    {
        AppendError(EOpenStreamErrorCode::ControlBusy, "too many CONTROLs wait for the controller");
        return;
    }
    _bControlled = true;
    CallNextControl(out);
}

bool ServerSession::TryStopControl(ServerActions& out)
{
    if (!_bControlled)
    {
        return false;
    }
    _bControlled = false;
    // What waits is not executed any more; the one in flight cannot be taken back and keeps its place.
    bool bFirst = true;
    _controls.EraseIf([&bFirst](const ApiRequest&) { return !std::exchange(bFirst, false); });
    _bRefusingControls = _bRefusingControls && _controls.IsFull();
    out.emplace_back(ServerStopControl{});
    return true;
}

void ServerSession::CallNextControl(ServerActions& out)
{
    const ApiRequest* next = _controls.GetFrontOrNull();
    if (_controlToken == 0 && next != nullptr)
    {
        _controlToken = ++_lastToken;
        out.emplace_back(ServerCall{_controlToken, next});
    }
}

void ServerSession::FinishControl(const ApiResponse& response, Core::Now now, ServerActions& out)
{
    if (!response.IsSuccess())
    {
        ++_stats.controlErrors;
        OpenStreamCodec::EncodeLine(ControlError{response.status, response.body}, _outbox.GetLines());
    }
    const bool bWasFull = _controls.IsFull();
    static_cast<void>(_controls.PopFrontOrNull());
    _controlToken = 0;
    CallNextControl(out);
    if (bWasFull)
    {
        _bRefusingControls = false;
        out.emplace_back(ServerCancelTimer{EServerTimer::ControlBusy});
        ProcessLines(now, out);
    }
}

} // namespace ACS::OpenStream
