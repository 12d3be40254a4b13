#pragma once

#include "view/SiteView.hpp"
#include <acs/plan/SiteMap.hpp>

namespace ACS::Acsd
{

/// The floor without its blocks.
[[nodiscard]] SiteView MakeSiteView(const Planning::SiteMap& site);

} // namespace ACS::Acsd
