#include "UpgradeGate.hpp"

#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

namespace http = boost::beast::http;

constexpr std::uint32_t LONGEST_HEADER = 16U * 1024U;

} // namespace

UpgradeGate::UpgradeGate(
    boost::beast::tcp_stream&& stream,
    Judge judge,
    AcceptedHandler onAccepted,
    EndedHandler onEnded)
    : _stream(std::move(stream)),
      _judge(std::move(judge)),
      _onAccepted(std::move(onAccepted)),
      _onEnded(std::move(onEnded))
{
    _parser.header_limit(LONGEST_HEADER);
}

void UpgradeGate::RunAsync(std::chrono::milliseconds timeout)
{
    _stream.expires_after(timeout);
    http::async_read_header(
        _stream,
        _buffer,
        _parser,
        [self = shared_from_this()](ErrorCode error, std::size_t /*count*/) { self->OnRead(error); });
}

void UpgradeGate::Kill()
{
    _judge = nullptr;
    _onAccepted = nullptr;
    _onEnded = nullptr;
    _stream.close();
}

void UpgradeGate::OnRead(ErrorCode error)
{
    if (!_judge)
    {
        return;
    }
    if (error == http::error::end_of_stream || error == boost::asio::error::operation_aborted
        || error == boost::beast::error::timeout)
    {
        End();
        return;
    }
    if (error)
    {
        RefuseAsync({http::status::bad_request, "This is no HTTP request: " + error.message() + ".\n"});
        return;
    }
    const std::optional<UpgradeRefusal> refusal = _judge(_parser.get());
    if (refusal.has_value())
    {
        RefuseAsync(*refusal);
        return;
    }
    const AcceptedHandler onAccepted = std::exchange(_onAccepted, nullptr);
    const UpgradeRequest request = _parser.release();
    onAccepted(std::move(_stream), request);
    End();
}

void UpgradeGate::RefuseAsync(const UpgradeRefusal& refusal)
{
    _response.result(refusal.status);
    _response.set(http::field::content_type, "text/plain");
    if (refusal.status == http::status::upgrade_required)
    {
        _response.set(http::field::upgrade, "websocket");
    }
    _response.keep_alive(false);
    _response.body() = refusal.text;
    _response.prepare_payload();
    http::async_write(_stream, _response, [self = shared_from_this()](ErrorCode /*error*/, std::size_t /*count*/) {
        ErrorCode ignored;
        self->_stream.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
        self->_stream.close();
        self->End();
    });
}

void UpgradeGate::End()
{
    _judge = nullptr;
    const EndedHandler onEnded = std::exchange(_onEnded, nullptr);
    if (onEnded)
    {
        onEnded();
    }
}

} // namespace ACS::ProtocolBeast
