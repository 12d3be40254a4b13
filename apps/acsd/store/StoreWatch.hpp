#pragma once

#include "common/log/LogRateLimiter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <chrono>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// The state of the store, for the log and for /readyz: whether its last write failed, and whether the present one exceeds
/// LIMIT. Pure; the caller owns the timer.
class StoreWatch
{
public:
    /// Maximum duration of a write. Until the write ends, no report is sent and no command is answered. A healthy disk takes
    /// milliseconds.
    static constexpr std::chrono::milliseconds LIMIT{5'000};

    /// Interval between two checks: maximum time for which a removed file can go unnoticed if nothing is written.
    static constexpr std::chrono::milliseconds CHECK_INTERVAL{2'000};

private:
    Core::Logger _logger;
    Apps::LogRateLimiter _failures; ///< The write is retried every second.
    Core::SteadyTime _began;
    std::string _fault; ///< Why the last write or check failed; empty: it did not.
    bool _bHangs = false;

public:
    explicit StoreWatch(Core::Logger logger);

    /// A write begins; OnLate is due LIMIT later, unless OnStored comes first.
    void OnBegun(Core::SteadyTime now);
    void OnLate();

    /// Returns the duration of the write.
    Core::Duration OnStored(const Core::Result<void>& result, Core::SteadyTime now);

    /// A check of the files has failed, without a write.
    void OnLost(const Core::Error& error, Core::SteadyTime now);

    /// Why the store keeps acsd from accepting plans.
    [[nodiscard]] std::optional<std::string> GetFaultOrNull() const;
};

} // namespace ACS::Acsd
