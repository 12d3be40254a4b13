#pragma once

#include "programs/ProgramSpec.hpp"
#include "programs/RelayMemory.hpp"
#include "world/IWorld.hpp"
#include "world/WorldEvent.hpp"
#include <acs/core/Result.hpp>

#include <optional>
#include <string>

namespace ACS::OpenStreamSim
{

/// What the programs of one arm do on the simulated floor. The relay words name the places where a program starts; the work
/// is done at its good end, so that a program that is given up has moved nothing.
class FloorWork
{
    Sim::IWorld* _world;
    std::string _robotID;
    Core::Result<std::optional<Sim::WorldEvent>> _planned; ///< By the program that started last.

public:
    /// Without a floor, places are read and nothing moves. It must outlive this object.
    FloorWork(Sim::IWorld* worldOrNull, std::string robotID);

    /// A program starts.
    void Plan(const ProgramWork& work, const RelayMemory& relays);

    /// It is at its good end. The error says why the arm could not do its work; nothing has moved then.
    [[nodiscard]] Core::Result<void> Finish();
};

} // namespace ACS::OpenStreamSim
