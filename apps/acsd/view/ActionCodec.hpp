#pragma once

#include "view/RobotActionsView.hpp"

#include <string>

namespace ACS::Acsd
{

/// The answer to GET /v1/robots/ID/actions (docs/reference/openapi.json), with a line end.
[[nodiscard]] std::string EncodeActions(const RobotActionsView& view);

} // namespace ACS::Acsd
