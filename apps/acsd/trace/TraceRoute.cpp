#include "trace/TraceRoute.hpp"

#include "operator/LinesRoute.hpp"
#include "operator/OperatorAnswer.hpp"
#include "trace/TraceQuery.hpp"

#include <optional>
#include <string>

namespace ACS::Acsd
{

Apps::HttpResponse RespondWithTrace(const Apps::HttpRequest& request, const MessageTrace& trace)
{
    if (const std::optional<std::string> unexpected =
            FindUnexpectedParameterOrNull(request, {"limit", "plan", "robot", "transaction"}))
    {
        return MakeOperatorError(OperatorCode::BAD_REQUEST, *unexpected);
    }
    const TraceQuery query{
        request.GetQueryOrNull("plan").value_or(std::string()),
        request.GetQueryOrNull("robot").value_or(std::string()),
        request.GetQueryOrNull("transaction").value_or(std::string())};
    if (query.IsEmpty())
    {
        return RespondWithLines(request, trace.GetNewest());
    }
    return RespondWithLines(request, trace.Find(query, MOST_SHOWN_LINES));
}

} // namespace ACS::Acsd
