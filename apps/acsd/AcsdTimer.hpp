#pragma once

#include <acs/plan/EngineAction.hpp>

#include <cstdint>
#include <variant>

namespace ACS::Acsd
{

/// The timers of AcsdCore itself.
enum class EAcsdTimer : std::uint8_t
{
    WorkGrace,  ///< Until isConnected=false is reported because no work can be accepted.
    Drain,      ///< Time limit of a drain.
    Settle,     ///< Time for the engine to store the latest acknowledgements.
    Stop,       ///< Time limit of closing the links.
    Status,     ///< Until the states of the robots are repeated.
    StoreLate,  ///< Time limit of a transaction.
    StoreCheck, ///< Until the next check of the store.
};

/// A timer of the core or of its engine.
using AcsdTimer = std::variant<EAcsdTimer, Planning::EngineTimer>;

} // namespace ACS::Acsd
