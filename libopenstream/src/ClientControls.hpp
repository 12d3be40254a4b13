#pragma once

#include <acs/core/BoundedQueue.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::OpenStream
{

/// The tracked CONTROLs of a ClientSession, from the queue to their outcome: one is in flight at a time, and those that a
/// sample has to confirm wait for it after their window. Each is settled exactly once. → ClientControlSettled, CancelTimer.
class ClientControls
{
    struct Waiting
    {
        std::uint64_t token = 0;
        Core::SteadyTime deadline; ///< For sending it.
        ControlCall call;
    };

    /// A CONTROL whose window has passed and whose confirmation is pending.
    struct Confirmation
    {
        std::uint64_t token = 0;
        Core::SteadyTime deadline;
        std::function<bool(const DataLine& sample)> isConfirmed;
    };

    /// How far the CONTROL in flight is.
    enum class EStage : std::uint8_t
    {
        Nothing,   ///< None is in flight.
        Leaving,   ///< Not yet sent completely.
        Window,    ///< Sent; a refusal may come.
        Confirmed, ///< Likewise, and a sample has confirmed it.
    };

    Core::BoundedQueue<Waiting> _waiting;
    Waiting _current; ///< The one in flight.
    EStage _stage = EStage::Nothing;
    bool _bAbandoned = false; ///< Its outcome was reported before its window has passed.
    Core::SteadyTime _leftAt;
    std::vector<Confirmation> _confirmations;

public:
    explicit ClientControls(std::size_t maximumWaiting);

    /// Puts it into the queue. False if the queue is full.
    [[nodiscard]] bool TryAdd(std::uint64_t token, Core::SteadyTime deadline, ControlCall call);

    /// Takes the next one into flight: it is to be sent. Null if none waits. Valid until the next call.
    [[nodiscard]] const ControlRequest* BeginNextOrNull();

    /// The one in flight was sent completely: its window begins. False if there is none, or its window had begun already.
    [[nodiscard]] bool TryBeginWindow(Core::Now now);

    /// The window has passed without a refusal: that is success, unless a sample has to confirm it and none has yet. False:
    /// it waits for its confirmation. One that was abandoned is only no longer in flight.
    [[nodiscard]] bool TryAccept(ClientActions& out);

    /// Settles the one in flight. If it was abandoned: → ClientControlFault.
    void Refuse(int status, std::optional<Core::JsonText> bodyOrNull, std::string detail, ClientActions& out);

    /// Settles the one in flight, if there is one, as Unknown. It stays in flight to the end of its window, because a late
    /// refusal would otherwise be matched to the next command.
    void AbandonCurrent(std::string_view detail, ClientActions& out);

    void OnSample(const DataLine& sample, ClientActions& out);

    /// Settles those that have waited for too long: for their turn or for their confirmation.
    void SettleLate(Core::Now now, ClientActions& out);

    /// Settles the one in flight, if there is one.
    void SettleCurrent(EControlOutcome outcome, std::string_view detail, ClientActions& out);
    void SettleConfirmations(std::string_view detail, ClientActions& out);
    void SettleWaiting(std::string_view detail, ClientActions& out);

    [[nodiscard]] bool IsInFlight() const noexcept;

    /// When the one in flight has to have left; max: none is leaving.
    [[nodiscard]] Core::SteadyTime GetSendDeadline() const noexcept;

    /// When SettleLate has something to do; max: nothing waits.
    [[nodiscard]] Core::SteadyTime GetDeadline() const noexcept;

private:
    void FinishCurrent(ClientActions& out);
};

} // namespace ACS::OpenStream
