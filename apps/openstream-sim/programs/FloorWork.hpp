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

/// The work of one arm's programs on the simulated floor. The relays are read when a program begins; the work is done when
/// it finishes, so that an abandoned program has moved nothing.
class FloorWork
{
    Sim::IWorld* _world;
    std::string _robotID;
    Core::Result<std::optional<Sim::WorldEvent>> _planned; ///< Of the program that began last.

public:
    /// Without a floor the places are evaluated and nothing moves. It must outlive this object.
    FloorWork(Sim::IWorld* worldOrNull, std::string robotID);

    /// A program begins.
    void Plan(const ProgramWork& work, const RelayMemory& relays);

    /// The program finishes. The error states why the arm could not do its work; nothing has moved then.
    [[nodiscard]] Core::Result<void> Finish();
};

} // namespace ACS::OpenStreamSim
