#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>
#include <acs/openstream/ServerSessionActions.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::OpenStream
{

/// The MONITOR of a ServerSession: when its samples are due, the call in flight, and whether the service fails.
/// → Call, StartTimer, CancelTimer.
class ServerMonitor
{
public:
    /// What a tick or an answer leads to, apart from its actions.
    struct Outcome
    {
        std::uint64_t skipped = 0;  ///< Periods without a sample.
        bool bFailureBegan = false; ///< The service begins to fail, which is reported once.
    };

private:
    std::chrono::milliseconds _serviceTimeout;
    ApiRequest _call; ///< A GET.
    std::optional<Core::JsonText> _id;
    std::chrono::milliseconds _period{};
    Core::SteadyTime _begin;
    Core::SteadyTime _nextTick;
    Core::SteadyTime _lastDataAt;
    Core::SteadyTime _askedAt;
    std::uint64_t _token = 0; ///< Of the call in flight; 0: none.
    bool _bFailing = false;   ///< Internal errors persist and were reported.

public:
    explicit ServerMonitor(std::chrono::milliseconds serviceTimeout);

    void Begin(const MonitorRequest& request, Core::Now now, ServerActions& out);

    /// Another MONITOR replaces the one that is active.
    void Replace(const MonitorRequest& request, Core::Now now, ServerActions& out);

    /// The call in flight is outdated then.
    void Stop(ServerActions& out);

    /// The MonitorTick timer fired: calls the service with this token, unless the previous call is in flight.
    [[nodiscard]] Outcome OnTick(std::uint64_t token, Core::Now now, ServerActions& out);

    /// The call in flight was answered.
    [[nodiscard]] Outcome OnAnswer(const ApiResponse& response);

    /// Writes the data line of an answer.
    void Encode(const ApiResponse& response, Core::Now now, std::string& line) const;

    /// A data line was sent.
    void OnDataSent(Core::Now now) noexcept;

    [[nodiscard]] bool IsCall(std::uint64_t token) const noexcept;

    /// When the next data line is due. The longest period exceeds each limit on silence.
    [[nodiscard]] Core::SteadyTime GetDataDue() const noexcept;

private:
    void Apply(const MonitorRequest& request, Core::SteadyTime firstTick, ServerActions& out);
    [[nodiscard]] bool TryBeginFailure() noexcept;
};

} // namespace ACS::OpenStream
