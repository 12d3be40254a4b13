#include "common/http/HttpPendingResponse.hpp"

#include <utility>

namespace ACS::Apps
{

void HttpPendingResponse::Complete(const HttpResponse& response)
{
    if (const Handler onComplete = std::exchange(_onComplete, nullptr); onComplete)
    {
        onComplete(response);
    }
}

void HttpPendingResponse::Attach(Handler onComplete)
{
    _onComplete = std::move(onComplete);
}

} // namespace ACS::Apps
