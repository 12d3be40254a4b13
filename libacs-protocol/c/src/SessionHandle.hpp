#pragma once

#include "Arguments.hpp"
#include "Guard.hpp"
#include "HandleRandom.hpp"
#include "ShownMessage.hpp"
#include <acs/c/acs_protocol.h>
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/DecodeOutcome.hpp>
#include <acs/protocol/SessionAction.hpp>

#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace ACS::CInterface
{

/// The two clocks of a caller.
struct CallTime
{
    std::int64_t steadyMs = 0;
    std::int64_t wallMs = 0;
};

/// What the handles of both sessions share: the queue of actions, and the codec of what the caller sends.
class SessionHandle
{
    Protocol::AcsCodec _codec;
    std::chrono::minutes _siteOffset;
    Core::SteadyTime _latest;
    ShownMessage _shown;
    Protocol::SessionActions _new;
    std::deque<Protocol::SessionAction> _waiting;
    Protocol::SessionAction _taken; ///< The last one that the caller has taken; its texts are valid.
    std::string _takenText;
    bool _bBroken = false;

protected:
    HandleRandom _random;

public:
    SessionHandle(const Protocol::CodecOptions& codec, acs_random randomOrNull, void* contextOrNull);

    /// Ends in ACS_ERROR_BROKEN where an earlier call has thrown.
    template <typename TCall>
    [[nodiscard]] std::int32_t Use(TCall call) noexcept
    {
        if (_bBroken)
        {
            return ACS_ERROR_BROKEN;
        }
        const std::int32_t result = Guard(call);
        _bBroken = result == ACS_ERROR_MEMORY || result == ACS_ERROR_INTERNAL;
        return result;
    }

    /// One call of the session with the time and the vector of its actions. Nothing is called if an argument is invalid.
    template <typename TCall>
    [[nodiscard]] std::int32_t Run(Arguments arguments, CallTime time, TCall call) noexcept
    {
        return Use([&]() -> std::int32_t {
            const Core::SteadyTime steady = arguments.ReadSteadyTime(time.steadyMs);
            const Core::WallTime wall = arguments.ReadWallTime(time.wallMs);
            arguments.Add(_waiting.size() >= ACS_MAX_ACTIONS ? ACS_ERROR_QUEUE_FULL : ACS_OK);
            if (!arguments.IsValid())
            {
                return arguments.GetResult();
            }
            _latest = steady > _latest ? steady : _latest;
            const std::int32_t result = call(Core::Now{_latest, wall}, _new);
            KeepActions();
            return result;
        });
    }

    /// Decodes what the caller sends. A missing timestamp is replaced by the time.
    [[nodiscard]] Protocol::DecodeOutcome Decode(std::string_view text, Core::Now now);

    /// Shows the message, where the caller wants it: ACS_OK or ACS_ERROR_MESSAGE.
    [[nodiscard]] std::int32_t Show(const Protocol::DecodeOutcome& outcome, acs_message* messageOrNull);

    /// ACS_ACTION_NONE if no action waits.
    void TakeAction(acs_action& out);

    [[nodiscard]] std::uint64_t GetWaitingCount() const noexcept;
    void SetSiteOffset(std::chrono::minutes offset) noexcept;

private:
    void KeepActions();
};

} // namespace ACS::CInterface
