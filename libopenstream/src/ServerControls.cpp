#include "ServerControls.hpp"

#include <optional>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

/// The memory of a call. The parameters need more of it than their text: they may have one byte of it each.
std::size_t CountBytes(const ApiRequest& call)
{
    std::size_t bytes = sizeof(ApiRequest) + call.query.size() * sizeof(QueryParameter);
    bytes += call.path.size() + (call.body.has_value() ? call.body->GetText().size() : 0U);
    for (const QueryParameter& parameter : call.query)
    {
        bytes += parameter.name.size() + parameter.value.size();
    }
    return bytes;
}

} // namespace

ServerControls::ServerControls(const ServerSessionOptions& options)
    : _maximumBytes(options.maximumControlBytes),
      _calls(options.maximumControls)
{
}

void ServerControls::OnHandshake() noexcept
{
    _bReceived = false;
}

bool ServerControls::TryAdd(const ControlRequest& request)
{
    ApiRequest call;
    call.method = request.method;
    SplitURL(request.url, call);
    if (request.args.has_value())
    {
        AddArguments(*request.args, call);
    }
    call.body = request.body.value_or(Core::JsonText::FromTrusted("{}"));
    const std::size_t bytes = CountBytes(call);
    if (!HasRoom() || !_calls.TryPush(std::move(call)))
    {
        return false;
    }
    _bytes += bytes;
    _bReceived = true;
    return true;
}

void ServerControls::CallNext(std::uint64_t token, ServerActions& out)
{
    const ApiRequest* const next = _calls.GetFrontOrNull();
    if (_token == 0 && next != nullptr)
    {
        _token = token;
        out.emplace_back(ServerCall{_token, next});
    }
}

bool ServerControls::ShouldResumeAfterAnswer()
{
    const bool bWasFull = !HasRoom();
    if (const std::optional<ApiRequest> done = _calls.PopFrontOrNull(); done.has_value())
    {
        _bytes -= CountBytes(*done);
    }
    _token = 0;
    const bool bResume = bWasFull && HasRoom();
    _bRefusing = _bRefusing && !bResume;
    return bResume;
}

bool ServerControls::TryStop(ServerActions& out)
{
    out.emplace_back(ServerStopControl{_bReceived});
    if (!_bReceived)
    {
        return false;
    }
    _bReceived = false;
    bool bFirst = true;
    _calls.EraseIf([&bFirst](const ApiRequest&) { return !std::exchange(bFirst, false); });
    const ApiRequest* const first = _calls.GetFrontOrNull();
    _bytes = first != nullptr ? CountBytes(*first) : 0;
    _bRefusing = _bRefusing && !HasRoom();
    return true;
}

void ServerControls::BeginRefusing() noexcept
{
    _bRefusing = !HasRoom();
}

bool ServerControls::IsBlocking() const noexcept
{
    return !HasRoom() && !_bRefusing;
}

bool ServerControls::HasReceived() const noexcept
{
    return _bReceived;
}

bool ServerControls::IsEmpty() const noexcept
{
    return _calls.IsEmpty();
}

bool ServerControls::IsCall(std::uint64_t token) const noexcept
{
    return _token == token;
}

bool ServerControls::HasRoom() const noexcept
{
    return !_calls.IsFull() && _bytes < _maximumBytes;
}

} // namespace ACS::OpenStream
