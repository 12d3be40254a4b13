#pragma once

#include "common/http/HttpRoutes.hpp"

namespace ACS::Acsd
{

/// The live page: GET / and GET /page/NAME for each of its files. They contain no data of the site.
void AddPageRoutes(Apps::HttpRoutes& routes);

} // namespace ACS::Acsd
