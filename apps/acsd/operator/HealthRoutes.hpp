#pragma once

#include "common/http/HttpGuard.hpp"
#include "common/http/HttpMessage.hpp"
#include "common/http/HttpRoutes.hpp"
#include "config/HttpConfig.hpp"
#include "view/ProgramState.hpp"

#include <functional>

namespace ACS::Acsd
{

/// GET /livez: the process is running.
[[nodiscard]] Apps::HttpResponse MakeLiveResponse();

/// GET /readyz: 200 with "ready" if there is no not-ready reason, else 503 with a line for each reason. The last line is isConnected
/// as it was last published to the MCS.
[[nodiscard]] Apps::HttpResponse MakeReadyResponse(const ProgramState& program);

/// Adds /livez and /readyz.
void AddHealthRoutes(Apps::HttpRoutes& routes, const std::function<ProgramState()>& getState);

/// The host names under which acsd answers requests at this address.
[[nodiscard]] Apps::HttpGuard MakeHttpGuard(const HttpListenConfig& config);

} // namespace ACS::Acsd
