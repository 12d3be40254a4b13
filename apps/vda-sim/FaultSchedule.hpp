#pragma once

#include "vda-sim/Fault.hpp"
#include <acs/core/Now.hpp>

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

/// The faults of a vehicle, from the first time that it is online: earlier ones wait for it. Collects the changes for the
/// vehicle, which applies them. Pure.
class FaultSchedule
{
    FaultBoard _board;
    FaultChanges _changes;
    std::vector<Fault> _waiting; ///< Until it is online for the first time.
    bool _bWasOnline = false;

public:
    /// False if there are already FaultBoard::MAX_FAULTS.
    [[nodiscard]] bool TryAdd(const Fault& fault, Core::SteadyTime now);
    /// Ends the faults of the kind (nullopt: all), those that have not begun included. Returns the number of them.
    std::size_t End(std::optional<EFaultKind> kindOrNull, std::string_view reason);
    /// Counts one use of a fault of the board.
    void Use(const Fault& fault);

    void OnLinkUp(Core::SteadyTime now);
    void OnTime(Core::SteadyTime now);
    void OnPlace(std::string_view nodeID, Core::SteadyTime now);

    /// The changes since the last call.
    [[nodiscard]] FaultChanges TakeChanges();

    [[nodiscard]] bool WasOnline() const noexcept;
    [[nodiscard]] const FaultBoard& GetBoard() const noexcept;
};

} // namespace ACS::VdaSim
