#pragma once

#include "common/http/HttpMessage.hpp"
#include "trace/MessageTrace.hpp"

#include <boost/asio/any_io_executor.hpp>

#include <memory>
#include <thread>

namespace ACS::Acsd
{

/// Answers `GET /v1/trace` with the newest lines: `limit`, `plan`, `robot` and `transaction` select them. The files are searched on
/// a thread of its own, by one request at a time; a further one is answered with 503. Used on the executor's thread.
class TraceRoute final
{
    struct Search;

    boost::asio::any_io_executor _executor;
    const MessageTrace* const _traceOrNull;
    std::shared_ptr<Search> _search; ///< The last one; null: none yet.
    std::thread _thread;

public:
    /// The trace outlives the route; null: messages are not traced.
    TraceRoute(boost::asio::any_io_executor executor, const MessageTrace* traceOrNull);
    TraceRoute(const TraceRoute&) = delete;
    TraceRoute& operator=(const TraceRoute&) = delete;

    /// Waits for the end of a search, which reads at most 16 MiB.
    ~TraceRoute();

    [[nodiscard]] Apps::HttpResponse Respond(const Apps::HttpRequest& request);

private:
    [[nodiscard]] Apps::HttpResponse SearchAsync(MessageTrace::LineSearch search, std::size_t limit);
};

} // namespace ACS::Acsd
