#pragma once

#include "common/log/LogRateLimiter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <cstdint>
#include <optional>

namespace ACS::Acsd
{

/// The lines of how the MCS departs from the protocol, thinned by what it is about. A text that is no message may have been
/// refused, which has a line of its own and comes next: so its note waits for what the session tells then. Pure.
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
    void Take(const Protocol::ProtocolNoted& noted, std::uint64_t total, Core::SteadyTime now);

    /// What waits was refused: it has its line.
    void Forget();

    /// What waits was not: something else has come.
    void Flush(Core::SteadyTime now);

private:
    void Write(const Waiting& note, Core::SteadyTime now);
};

} // namespace ACS::Acsd
