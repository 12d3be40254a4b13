#pragma once

#include "common/http/HttpMessage.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/IOpenApiService.hpp>

namespace ACS::OpenStreamSim
{

/// Lets the service answer a request that came over HTTP. An empty body counts as {}, the content type is not looked at;
/// a body that is no JSON is refused with 400, a method other than GET, HEAD, POST, PUT and DELETE with 404.
[[nodiscard]] Apps::HttpResponse AnswerHTTP(
    const Apps::HttpRequest& request,
    OpenStream::IOpenApiService& service,
    Core::Now now);

} // namespace ACS::OpenStreamSim
