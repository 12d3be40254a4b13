#pragma once

#include "GapLog.hpp"
#include <acs/core/Now.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace ACS::Load
{

inline constexpr std::chrono::milliseconds PERIOD{2};

/// One kind of traffic.
struct StreamKind
{
    std::string name;
    std::size_t connections = 1;
    bool bBare = false;     ///< No Open Stream: a timer, a line, a reader.
    bool bControls = false; ///< Each connection sends a CONTROL at each period as well.
};

/// Results of all its runs.
struct StreamMetrics
{
    GapLog frames{PERIOD};
    GapLog controls{PERIOD};      ///< From one CONTROL given to the client to the next.
    std::uint64_t framesSent = 0; ///< That left the server.
    std::uint64_t framesReceived = 0;
    std::uint64_t framesReplaced = 0; ///< By a newer one, before they left.
    std::uint64_t ticksSkipped = 0;
    std::uint64_t controlsSent = 0;
    std::uint64_t controlsServed = 0;
    std::uint64_t controlsHeldBack = 0; ///< Not sent because too many were not served yet.
    std::uint64_t linesRefused = 0;     ///< error and control_err lines: none is expected.
    std::string firstRefusal;
    std::string failure;              ///< Why a run was abandoned; empty if none was.
    std::uint64_t framesAtPeriod = 0; ///< Of those received: until the clients asked for a longer period at the end.
    std::int64_t periods = 0;         ///< Elapsed until the last frame, by the server's clock.
    Core::Duration elapsed{};         ///< Time during which the gaps were measured.
    Core::Duration serverTime{};      ///< Processor time within it.
    Core::Duration clientTime{};
    std::uint64_t residentBefore = 0; ///< Bytes of both ends together, at the beginning and the end of the last run.
    std::uint64_t residentAfter = 0;  ///< Without the lists of the measurement.
};

} // namespace ACS::Load
