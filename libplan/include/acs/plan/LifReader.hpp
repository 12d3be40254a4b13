#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string_view>

namespace ACS::Planning
{

/// Decodes a VDMA LIF 1.0 file. All its layouts are merged into one map; degrees are converted to radians. Accepts any text:
/// an invalid one is an error with the path of the member ("layouts[0].edges[3].endNodeId"). Errors: those of
/// ACS::Core::ECoreError and EPlanningError::InvalidSite.
[[nodiscard]] Core::Result<SiteMap> DecodeLIF(std::string_view text);

} // namespace ACS::Planning
