#include "trace/TraceRoute.hpp"

#include "common/http/HttpPendingResponse.hpp"
#include "common/trace/TraceQuery.hpp"
#include "operator/LinesRoute.hpp"
#include "operator/OperatorAnswer.hpp"

#include <boost/asio/post.hpp>

#include <chrono>
#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::chrono::seconds RETRY_SEARCH{1};

} // namespace

struct TraceRoute::Search
{
    std::shared_ptr<Apps::HttpPendingResponse> response = std::make_shared<Apps::HttpPendingResponse>();
    bool bDone = false; ///< Used on the executor's thread.
};

TraceRoute::TraceRoute(boost::asio::any_io_executor executor, const MessageTrace* traceOrNull)
    : _executor(std::move(executor)),
      _traceOrNull(traceOrNull)
{
}

TraceRoute::~TraceRoute()
{
    if (_thread.joinable())
    {
        _thread.join();
    }
}

Apps::HttpResponse TraceRoute::Respond(const Apps::HttpRequest& request)
{
    if (_traceOrNull == nullptr)
    {
        return MakeOperatorError(OperatorCode::NOT_FOUND, "Messages are not traced: start acsd with --trace DIR.");
    }
    const tl::expected<std::size_t, std::string> limit =
        ReadLineLimit(request, {"limit", "plan", "robot", "transaction"});
    if (!limit.has_value())
    {
        return MakeOperatorError(OperatorCode::BAD_REQUEST, limit.error());
    }
    const Apps::TraceQuery query{
        request.GetQueryOrNull("plan").value_or(std::string()),
        request.GetQueryOrNull("robot").value_or(std::string()),
        request.GetQueryOrNull("transaction").value_or(std::string())};
    return query.IsEmpty() ? MakeLines(_traceOrNull->GetNewest(), *limit)
                           : SearchAsync(_traceOrNull->MakeSearch(query, *limit), *limit);
}

Apps::HttpResponse TraceRoute::SearchAsync(MessageTrace::LineSearch search, std::size_t limit)
{
    if (_search != nullptr && !_search->bDone)
    {
        Apps::HttpResponse busy =
            MakeOperatorError(OperatorCode::UNAVAILABLE, "Another search of the trace runs. Retry in 1 s.");
        busy.retryAfter = RETRY_SEARCH;
        return busy;
    }
    if (_thread.joinable())
    {
        _thread.join(); // it has posted its answer
    }
    _search = std::make_shared<Search>();
    _thread = std::thread([executor = _executor, state = _search, search = std::move(search), limit] {
        boost::asio::post(executor, [state, answer = MakeLines(search(), limit)] {
            state->bDone = true;
            state->response->Complete(answer);
        });
    });
    Apps::HttpResponse response;
    response.pending = _search->response;
    return response;
}

} // namespace ACS::Acsd
