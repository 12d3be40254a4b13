#pragma once

#include "common/http/HttpMessage.hpp"
#include "trace/MessageTrace.hpp"

namespace ACS::Acsd
{

/// Answers `GET /v1/trace` with the newest lines: `limit`, `plan`, `robot` and `transaction` select them.
[[nodiscard]] Apps::HttpResponse RespondWithTrace(const Apps::HttpRequest& request, const MessageTrace& trace);

} // namespace ACS::Acsd
