#include "http/ApiClient.hpp"

#include "http/ApiConnection.hpp"

#include <utility>

namespace ACS::Acsctl
{

ApiClient::ApiClient(
    EventLoop& loop,
    Connection connection,
    std::shared_ptr<boost::asio::ssl::context> tlsOrNull,
    std::chrono::milliseconds timeout)
    : _loop(loop),
      _connection(std::move(connection)),
      _tlsOrNull(std::move(tlsOrNull)),
      _timeout(timeout),
      _resolver(loop, _connection.url.peer)
{
}

tl::expected<ApiAnswer, ApiFailure> ApiClient::Send(const ApiRequest& request)
{
    const auto trySend = [this, &request]() -> tl::expected<ApiAnswer, ApiFailure> {
        ApiConnection connection(_loop, _connection, _tlsOrNull, _timeout);
        tl::expected<void, ApiFailure> done = connection.Open(_resolver);
        if (done.has_value())
        {
            done = connection.Write(request);
        }
        return done.has_value() ? connection.Read() : tl::make_unexpected(std::move(done.error()));
    };
    tl::expected<ApiAnswer, ApiFailure> answer = trySend();
    const bool bRepeatable = !request.idempotencyKey.empty() || request.method == "GET";
    if (!answer.has_value() && answer.error().kind == EApiFailure::ConnectionLost && bRepeatable)
    {
        tl::expected<ApiAnswer, ApiFailure> second = trySend();
        if (!second.has_value())
        {
            second.error().bSent = second.error().bSent || answer.error().bSent;
        }
        return second;
    }
    return answer;
}

tl::expected<ApiAnswer, ApiFailure> ApiClient::Stream(
    const ApiRequest& request,
    const std::function<bool(std::string_view)>& tryHandle)
{
    ApiConnection connection(_loop, _connection, _tlsOrNull, _timeout);
    tl::expected<void, ApiFailure> done = connection.Open(_resolver);
    if (done.has_value())
    {
        done = connection.Write(request);
    }
    return done.has_value() ? connection.ReadStream(tryHandle) : tl::make_unexpected(std::move(done.error()));
}

} // namespace ACS::Acsctl
