#pragma once

#include "view/SiteView.hpp"
#include <acs/plan/Block.hpp>
#include <acs/plan/SiteMap.hpp>

#include <vector>

namespace ACS::Acsd
{

/// The floor without its blocks.
[[nodiscard]] SiteView MakeSiteView(const Planning::SiteMap& site);

[[nodiscard]] std::vector<BlockView> MakeBlockViews(const std::vector<Planning::Block>& blocks);

} // namespace ACS::Acsd
