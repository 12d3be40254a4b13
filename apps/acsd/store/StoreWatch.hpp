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

/// How the store does, for the log and for /readyz: whether its last write failed, and whether the present one takes so long
/// that people should look at the disk. Pure; the timer is the caller's.
class StoreWatch
{
public:
    /// Nothing is told to anybody before a write is over. A good disk takes milliseconds.
    static constexpr std::chrono::milliseconds LIMIT{5'000};

    /// Between two looks at the file's name: so long a file that was removed can go unnoticed where nothing is written.
    static constexpr std::chrono::milliseconds CHECK_INTERVAL{2'000};

private:
    Core::Logger _logger;
    Apps::LogRateLimiter _failures; ///< It is tried again every second.
    Core::SteadyTime _began;
    std::string _fault; ///< Why the store failed last; empty: it did not.
    bool _bHangs = false;

public:
    explicit StoreWatch(Core::Logger logger);

    /// A write begins; OnLate is due LIMIT later, unless OnStored comes first.
    void OnBegun(Core::SteadyTime now);
    void OnLate();

    /// Returns how long it took.
    Core::Duration OnStored(const Core::Result<void>& result, Core::SteadyTime now);

    /// A look at the files has failed, without a write.
    void OnLost(const Core::Error& error, Core::SteadyTime now);

    /// Why plans cannot be taken for the store's sake.
    [[nodiscard]] std::optional<std::string> GetFaultOrNull() const;
};

} // namespace ACS::Acsd
