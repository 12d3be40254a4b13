#pragma once

#include <acs/core/Now.hpp>
#include <acs/protocol/McsSession.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Protocol::Detail
{

/// Which Acks an MCS that misbehaves holds back, for how long, and those that have not left yet.
class HeldAcks
{
public:
    struct Ack
    {
        ConnectionID connection = 0;
        std::string text;
        Core::SteadyTime deadline{};
        bool bRegisters = false; ///< With it the connection's ACS is registered.
    };

private:
    struct RunningHold
    {
        AckHold hold;
        Core::SteadyTime end{};
    };

    std::vector<RunningHold> _holds;
    std::vector<Ack> _acks;

public:
    void Begin(const AckHold& hold, Core::Now now);
    /// Ends every hold; what is held back by then leaves at its time.
    void EndAll() noexcept;
    /// The latest one that holds this command's Ack back now. Valid until the next Begin.
    [[nodiscard]] const AckHold* FindOrNull(EAcsCommand command, Core::Now now) const;

    void Keep(Ack ack);
    /// Those that are to leave by now, in the order in which they were kept.
    [[nodiscard]] std::vector<Ack> TakeDue(Core::Now now);
    /// Nothing leaves to a connection that is closed.
    void Forget(ConnectionID connection);
    /// Until the next one is due; nothing where none is kept.
    [[nodiscard]] std::optional<std::chrono::milliseconds> GetDelayOrNull(Core::Now now) const;
    /// Whether one that is kept registers another connection than this.
    [[nodiscard]] bool HasRegistrationOfOther(ConnectionID connection) const;
};

} // namespace ACS::Protocol::Detail
