#pragma once

#include "common/http/HttpMessage.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/IOpenApiService.hpp>

namespace ACS::OpenStreamSim
{

/// Passes an HTTP request to the service and returns its answer. An empty body counts as {}, the content type is ignored; a
/// body that is not JSON is refused with 400, a method other than GET, HEAD, POST, PUT and DELETE with 404.
[[nodiscard]] Apps::HttpResponse AnswerHTTP(
    const Apps::HttpRequest& request,
    OpenStream::IOpenApiService& service,
    Core::Now now);

} // namespace ACS::OpenStreamSim
