#pragma once

#include "common/log/LogRateLimiter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <cstdint>
#include <optional>

namespace ACS::Acsd
{

/// Logs how the MCS deviates from the protocol, rate-limited by kind and reason. A message that is undecodable or has an
/// unknown command may also be refused, which the session reports next and which is logged on its own: the note waits for
/// the next event and is then dropped or written. Pure.
class McsNoteLog
{
    struct Waiting
    {
        Protocol::ProtocolNoted noted;
        std::uint64_t total = 0;
    };

    Apps::LogRateLimiter _log;
    std::optional<Waiting> _waiting;

public:
    explicit McsNoteLog(Core::Logger logger);

    /// The total is of all notes of this kind.
    void OnNoted(const Protocol::ProtocolNoted& noted, std::uint64_t total, Core::SteadyTime now);

    /// Drops the waiting note: its message was refused, which is logged on its own.
    void Drop();

    /// Writes the waiting note: its message was not refused.
    void Flush(Core::SteadyTime now);

private:
    void Write(const Waiting& note, Core::SteadyTime now);
};

} // namespace ACS::Acsd
