#pragma once

#include "world/WorldEvent.hpp"
#include <acs/core/Result.hpp>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace ACS::Sim
{

/// How a floor is at first: the content of a world file. Names and places as they are written there.
struct WorldStart
{
    std::map<std::string, std::string> carriers; ///< Place by carrier.
    std::map<std::string, bool> covers;          ///< Closed or not, by set.
    std::map<std::string, EMemory> memories;     ///< By place.
    std::set<std::string> places;                ///< "A01.CP01.TP01-04"; none: every place exists.
};

/// Reads a world file. The error has the JSON path.
[[nodiscard]] Core::Result<WorldStart> DecodeWorldStart(std::string_view text);

} // namespace ACS::Sim
