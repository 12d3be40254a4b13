#pragma once

namespace ACS::Planning
{

/// Why a robot does not drive although its route is open (RouteSearch::block).
inline constexpr const char* CUT_OFF = "blocks would cut off its way to its parking position, or that of another robot";

} // namespace ACS::Planning
