#pragma once

#include <acs/core/BoundedQueue.hpp>
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/openstream/ServerSessionActions.hpp>

#include <cstddef>
#include <cstdint>

namespace ACS::OpenStream
{

/// The CONTROLs of a ServerSession, which the service executes one at a time, and whether the session may read more of them.
/// → Call, StopControl.
class ServerControls
{
    std::size_t _maximumBytes;
    Core::BoundedQueue<ApiRequest> _calls; ///< The first one is in flight.
    std::size_t _bytes = 0;                ///< Of all of them.
    std::uint64_t _token = 0;              ///< Of the call in flight; 0: none.
    bool _bReceived = false;
    bool _bRefusing = false; ///< Lines are read although there is no room.

public:
    explicit ServerControls(const ServerSessionOptions& options);

    /// A session begins: there is nothing to stop.
    void OnHandshake() noexcept;

    /// False if there is no room.
    [[nodiscard]] bool TryAdd(const ControlRequest& request);

    /// Calls the service with this token, unless a call is in flight or none waits.
    void CallNext(std::uint64_t token, ServerActions& out);

    /// The call in flight was answered. Whether there was no room, and now there is.
    [[nodiscard]] bool ShouldResumeAfterAnswer();

    /// STOP control: the call in flight stays, since it cannot be taken back. False: this session had nothing to stop; the
    /// motion that others have left is to be stopped nevertheless.
    [[nodiscard]] bool TryStop(ServerActions& out);

    /// There has been no room for too long: CONTROLs are read in order to be refused, until there is room.
    void BeginRefusing() noexcept;

    /// Whether no command may be read: there is no room, and CONTROLs are not refused yet.
    [[nodiscard]] bool IsBlocking() const noexcept;
    /// A CONTROL was received since HANDSHAKE or the last STOP control.
    [[nodiscard]] bool HasReceived() const noexcept;
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool IsCall(std::uint64_t token) const noexcept;

private:
    [[nodiscard]] bool HasRoom() const noexcept;
};

} // namespace ACS::OpenStream
