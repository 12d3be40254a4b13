#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/SiteMap.hpp>

#include <string_view>

namespace ACS::Planning
{

/// Reads a VDMA LIF 1.0 layout. All layouts of the file make one map. LIF's degrees become radians. Total: any text
/// gives a map or an error whose path says where ("layouts[0].edges[3].endNodeId"). Errors: those of
/// ACS::Core::ECoreError and EPlanningError::InvalidSite.
[[nodiscard]] Core::Result<SiteMap> DecodeLIF(std::string_view text);

} // namespace ACS::Planning
