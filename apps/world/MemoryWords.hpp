#pragma once

#include "world/WorldEvent.hpp"
#include <acs/json/EnumWords.hpp>

#include <array>

namespace ACS::Json
{

/// MemoryWords: what a memory place holds, as world files and journals spell it.
template <>
struct EnumWords<Sim::EMemory>
{
    static constexpr std::array WORDS{
        EnumWord<Sim::EMemory>{Sim::EMemory::Unknown, "unknown"},
        EnumWord<Sim::EMemory>{Sim::EMemory::Empty, "empty"},
        EnumWord<Sim::EMemory>{Sim::EMemory::Occupied, "occupied"}};
};

} // namespace ACS::Json
