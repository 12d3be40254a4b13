#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Decodes a VDMA LIF 1.0 file. All its layouts are merged into one map; degrees are converted to radians. Accepts any text:
/// an invalid one is an error with the path of the member ("layouts[0].edges[3].endNodeId"). Errors: those of
/// ACS::Core::ECoreError and EPlanningError::InvalidSite.
///
/// LIF gives no range for knots: those of a trajectory are scaled to 0 to 1. An invalid trajectory closes its edge for the
/// vehicle type: the edge loses its rules for that type, and `warnings` receives a line with the type, the edge and the reason.
/// If nodes have no mapId, which LIF permits, `warnings` receives one line with their number and the path of the first.
[[nodiscard]] ACS_API Core::Result<SiteMap> DecodeLIF(std::string_view text, std::vector<std::string>& warnings);
[[nodiscard]] ACS_API Core::Result<SiteMap> DecodeLIF(std::string_view text); ///< Without the warnings.

} // namespace ACS::Planning
