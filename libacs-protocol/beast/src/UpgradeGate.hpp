#pragma once

#include "BeastLink.hpp"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace ACS::ProtocolBeast
{

using UpgradeRequest = boost::beast::http::request<boost::beast::http::empty_body>;

/// Why a request is refused.
struct UpgradeRefusal
{
    boost::beast::http::status status = boost::beast::http::status::not_found;
    std::string text;
};

/// Reads the HTTP request at the beginning of a connection and hands it on if it asks for a WebSocket that may be; else
/// answers politely and closes. Lives as long as it has work.
class UpgradeGate : public std::enable_shared_from_this<UpgradeGate>
{
public:
    using Judge = std::function<std::optional<UpgradeRefusal>(const UpgradeRequest& request)>;
    using AcceptedHandler = std::function<void(boost::beast::tcp_stream&& stream, const UpgradeRequest& request)>;
    using EndedHandler = std::function<void()>;

private:
    using ErrorCode = boost::beast::error_code;

    boost::beast::tcp_stream _stream;
    boost::beast::flat_buffer _buffer;
    boost::beast::http::request_parser<boost::beast::http::empty_body> _parser;
    boost::beast::http::response<boost::beast::http::string_body> _response;
    Judge _judge;
    AcceptedHandler _onAccepted;
    EndedHandler _onEnded;

public:
    UpgradeGate(boost::beast::tcp_stream&& stream, Judge judge, AcceptedHandler onAccepted, EndedHandler onEnded);

    void RunAsync(std::chrono::milliseconds timeout);
    void Kill();

private:
    void OnRead(ErrorCode error);
    void RefuseAsync(const UpgradeRefusal& refusal);
    void End();
};

} // namespace ACS::ProtocolBeast
