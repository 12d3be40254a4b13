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

/// The initial state of a floor: the content of a world file, with names and places as written there.
struct WorldStart
{
    std::map<std::string, std::string> carriers; ///< Place by carrier.
    std::map<std::string, bool> covers;          ///< By set: whether its cover is closed.
    std::map<std::string, EMemory> memories;     ///< By place.
    std::set<std::string> places;                ///< Places and ranges ("A01.CP01.TP01-04"); empty: every place exists.
};

/// Reads a world file. The path of an error is the JSON path.
[[nodiscard]] Core::Result<WorldStart> DecodeWorldStart(std::string_view text);

} // namespace ACS::Sim
