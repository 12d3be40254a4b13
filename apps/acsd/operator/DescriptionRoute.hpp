#pragma once

#include "common/http/HttpRoutes.hpp"

namespace ACS::Acsd
{

/// GET /v1/openapi.json: the description of the operator API (OpenAPI 3.1).
void AddDescriptionRoute(Apps::HttpRoutes& routes);

} // namespace ACS::Acsd
