#pragma once

#include "world/WorldEvent.hpp"
#include <acs/json/EnumNames.hpp>

#include <array>

namespace ACS::Json
{

/// MemoryEnumNames: the values of EMemory in world files and journals.
template <>
struct EnumNames<Sim::EMemory>
{
    static constexpr std::array WORDS{
        EnumWord<Sim::EMemory>{Sim::EMemory::Unknown, "unknown"},
        EnumWord<Sim::EMemory>{Sim::EMemory::Empty, "empty"},
        EnumWord<Sim::EMemory>{Sim::EMemory::Occupied, "occupied"}};
};

} // namespace ACS::Json
