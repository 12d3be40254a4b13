#include "trace/TraceRoute.hpp"

#include "common/trace/TraceQuery.hpp"
#include "operator/LinesRoute.hpp"

#include <string>

namespace ACS::Acsd
{

Apps::HttpResponse RespondWithTrace(const Apps::HttpRequest& request, const MessageTrace& trace)
{
    const Apps::TraceQuery query{
        request.GetQueryOrNull("plan").value_or(std::string()),
        request.GetQueryOrNull("robot").value_or(std::string()),
        request.GetQueryOrNull("transaction").value_or(std::string())};
    const auto respond = [&request](const Apps::NewestLines& lines) {
        return RespondWithLines(request, lines, {"limit", "plan", "robot", "transaction"});
    };
    return query.IsEmpty() ? respond(trace.GetNewest()) : respond(trace.Find(query, MOST_SHOWN_LINES));
}

} // namespace ACS::Acsd
